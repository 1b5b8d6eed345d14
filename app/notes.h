// SPDX-License-Identifier: Apache-2.0
//
// What the user should know of a scene, on standard error, a line each: no fault, and no result.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace noli::app {

/// The notes of `noli explain` on the scene; if there are many, the first few.
void tell_notes(const std::vector<std::string>& notes);

/// A line of its own. `note`: without a full stop.
void tell_note(const std::string& note);

/// For --short with a scene that has no short form.
void note_missing_short_form();

/// Tells whoever reads the run, on standard error, when another process writes to it.
void note_if_being_written(const std::filesystem::path& run);

}  // namespace noli::app
