// SPDX-License-Identifier: Apache-2.0
//
// What a verdict was asked about, for results: the files and their hashes, their order, what to know of them.
#pragma once

#include <string>
#include <vector>

#include "certify/json.h"
#include "trajectory/formats/frame_look.h"
#include "trajectory/formats/polygons.h"

namespace noli::report {

/// [{"file": as given, "bytes": n, "sha256": 64 hex digits, "numbers": "float32", "vertices": n, "cells": n}, ...]. All
/// but "file" are null for a frame that was not looked at (a pipe that was not read), "cells" where no frame was
/// parsed. Files of a run have the first three alone.
Json inputs_json(const std::vector<FrameFacts>& inputs);

/// What the statement says of polygons.
std::string polygons_text(PolygonRule rule);

/// "Note: ....", a line each.
std::string notes_text(const std::vector<std::string>& notes);

}  // namespace noli::report
