// SPDX-License-Identifier: Apache-2.0
//
// A picture of a motion before or after `noli repair`, at one time.
//
// What this does not do: it decides nothing.
#pragma once

#include <filesystem>

#include "report/figures/run_picture.h"

namespace noli::report {

struct RepairPictureRequest {
  std::filesystem::path result;  ///< written by noli repair --json; the files that it names must be as they were
  double time = 0;               ///< in steps from the first frame
  bool given = false;            ///< the motion as it was given; else the repaired one
  PictureView view;              ///< `zoom`: a body by name, if there are any
  std::filesystem::path output;  ///< ends in .png
};

/// Throws InputError (no result of noli repair, a time that it does not have, files that are gone or have changed),
/// UsageError (the output's name or place, a body that it does not name, built without a library for pictures),
/// std::system_error (disk).
PictureOutcome repair_picture(const RepairPictureRequest& request);

}  // namespace noli::report
