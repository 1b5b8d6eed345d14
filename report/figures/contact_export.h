// SPDX-License-Identifier: Apache-2.0
//
// Shows one contact of a result of `noli verify`: the geometry at the time of contact, with what meets marked.
//
//   .vtu   a grid with a number for each cell under the name "contact": 1 for cells of the first feature, 2 for those
//          of the second, else 0
//   .png   a picture around the point of contact, cells of the first feature red, of the second yellow
//
// What this does not do: positions at the time of contact are rounded. It decides nothing.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "report/figures/run_picture.h"

namespace noli::report {

struct ContactExportRequest {
  std::filesystem::path result;  ///< written by noli verify --json; the files that it names must be as they were
  std::size_t number =
      0;             ///< which of its listed contacts, from 1; 0: the first, or else the first cells that intersect
  PictureView view;  ///< of a picture; `zoom` is not used
  std::filesystem::path output;  ///< ends in .vtu or .png
};

struct ContactExport {
  std::size_t step = 0;  ///< from 1
  double time = 0;
  std::size_t cells = 0;  ///< how many are marked
};

/// Throws InputError (a result without contacts or of another version, files that are gone or have changed), UsageError
/// (the output's name or place, built without a library for pictures), std::system_error (disk).
ContactExport export_contact(const ContactExportRequest& request);

}  // namespace noli::report
