// SPDX-License-Identifier: Apache-2.0
//
// What the user should know of a scene, on standard error, a line each: no fault, and no result.
#pragma once

#include <filesystem>
#include <string>

#include "integrator/scene/explain.h"

namespace noli::app {

/// What explain notes of the scene, so that whoever did not ask it knows too; of many the first few.
void tell_notes(const integrator::Explanation& explanation);

/// A line of its own. `note`: without a full stop.
void tell_note(const std::string& note);

/// For --short: that it changes nothing, if the scene has no short form.
void note_missing_short_form(const integrator::Scene& scene);

/// Tells whoever reads the run, on standard error, when another process writes to it.
void note_if_being_written(const std::filesystem::path& run);

}  // namespace noli::app
