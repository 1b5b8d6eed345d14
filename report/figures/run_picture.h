// SPDX-License-Identifier: Apache-2.0
//
// A picture of a run at one time.
//
// What this does not do: like frames, a picture is a sample of the motion, not the certified motion.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include <noli/errors.h>
#include <noli/export.h>
#include <noli/mesh.h>
#include "report/figures/picture.h"

namespace noli::report {

/// How a picture shows a run.
struct PictureView {
  std::optional<Position> from;  ///< direction in which the eye is; its own for each dimension
  /// Width and height [pixels]; without it, 640 and what the shape of what is seen asks for.
  std::optional<std::array<std::size_t, 2>> size;
  /// The name of a body that fills the picture. Empty: everything fills it, where there are faces except fixed parts of
  /// at most four vertices.
  std::string zoom;
};

/// Throws UsageError in a build without a library for pictures.
void require_pictures();

/// Calls `draw`, which draws a view that the user chose. Throws UsageError if nothing can be seen from there.
template <class Function>
auto with_asked_view(const Function& function) {
  try {
    return function();
  } catch (const std::invalid_argument&) {
    throw UsageError("--from: expected a finite direction other than zero");
  }
}

/// Direction and size; `zoom` is about runs.
View view_from(const PictureView& asked, int dimension);

struct PictureRequest {
  std::filesystem::path run;
  double time = 0;  ///< [s]
  PictureView view;
  std::filesystem::path output;  ///< ends in .png
};

struct PictureOutcome {
  double time = 0;  ///< of the picture [s]; of a run that recorded frames alone, that of the nearest one
  std::size_t width = 0, height = 0;
};

/// Throws InputError (no run, a damaged one, one that does not have that time), UsageError (the output's name or place,
/// a direction of length zero, a body that the run does not name, built without a library for pictures),
/// std::system_error (disk).
PictureOutcome run_picture(const PictureRequest& request);

/// Pictures of all frames of a run, in one view: named by a pattern as in noli/export.h that ends in .png.
struct FilmRequest {
  ExportRequest frames;
  PictureView view;
};

/// Errors: those of run_picture() and run_export().
ExportOutcome run_film(const FilmRequest& request);

}  // namespace noli::report
