// SPDX-License-Identifier: Apache-2.0
//
// What a verdict was asked about, for results: the files and their hashes, their order, what to know of them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/json.h"
#include "trajectory/frame_look.h"
#include "trajectory/polygons.h"

namespace noli::app {

/// [{"file": as given, "bytes": n, "sha256": 64 hex digits, "numbers": "float32", "vertices": n, "cells": n}, ...]. All
/// but "file" are null for a frame that was not looked at (a pipe that was not read), "cells" where no frame was
/// parsed. Files of a run have the first three alone.
Json inputs_json(const std::vector<FrameFacts>& inputs);

/// What the statement says of polygons.
std::string polygons_text(PolygonRule rule);

/// "Note: ....", a line each.
std::string notes_text(const std::vector<std::string>& notes);

/// The files of a run that `noli verify` reads and that do not change once it has ended: trajectory.blocks and, where it
/// is there, manifest.json, each with the SHA-256 of its bytes. Throws InputError; ReadInterrupted when `stop` says true.
std::vector<FrameFacts> run_facts(const std::filesystem::path& run, const std::function<bool()>& stop);

}  // namespace noli::app
