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
#include <memory>
#include <string>
#include <vector>

#include <noli/frames.h>
#include "certify/json.h"
#include "report/figures/picture.h"
#include "report/figures/run_picture.h"

namespace noli::report {

struct ContactExportRequest {
  std::filesystem::path result;  ///< written by noli verify --json; the files that it names must be as they were
  std::size_t number =
      0;             ///< which of its listed contacts, from 1; 0: the first, or else the first cells that intersect
  PictureView view;  ///< of a picture; `zoom` is not used
  std::filesystem::path output;  ///< ends in .vtu or .png
};

/// What is shown: everything at the time of contact.
struct ShownContact {
  std::size_t step = 0;  ///< from 1
  double time = 0;
  Frame frame;
  std::vector<Mark> marks;  ///< the cells of both features
  Position point{};         ///< where they meet; of cells that intersect, the middle of their corners
};

/// The same for frames in memory: `result` is what report::document() makes of their verification, and they have to be
/// what it is about. Throws InputError.
ShownContact contact_in(const Json& result, std::shared_ptr<const GivenFrames> given, std::size_t number);
ShownContact contact_in(const std::filesystem::path& result, std::size_t number);

/// As export_contact(). Throws UsageError, std::system_error.
void write_contact(const ShownContact& shown, const std::filesystem::path& output, const PictureView& view);

struct ContactExport {
  std::size_t step = 0;  ///< from 1
  double time = 0;
  std::size_t cells = 0;  ///< how many are marked
  bool picture = false;   ///< else a grid (.vtu)
};

/// Throws InputError (a result without contacts or of another version, files that are gone or have changed), UsageError
/// (the output's name or place, built without a library for pictures), std::system_error (disk).
ContactExport export_contact(const ContactExportRequest& request);

}  // namespace noli::report
