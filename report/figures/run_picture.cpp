// SPDX-License-Identifier: Apache-2.0
#include "report/figures/run_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <noli/errors.h>
#include "certify/export_frames.h"
#include "certify/result_file.h"
#include "certify/runs/frame_times.h"
#include "certify/runs/run_folder.h"
#include "certify/runs/run_log_facts.h"
#include "certify/runs/run_series_reader.h"
#include "report/figures/picture.h"
#include "report/figures/png.h"
#include "report/figures/run_frame.h"
#include "trajectory/sample.h"
#include "trajectory/stop.h"
#include "trajectory/write_file.h"

namespace noli::report {
namespace {

void check(const PictureRequest& request) {
  require_pictures();
  if (request.output.extension() != ".png") {
    throw UsageError("-o " + request.output.string() + ": expected a name that ends in .png");
  }
  make_writable_folder(request.output.parent_path(), "-o");
}

BodyNames::Body body_of(const std::filesystem::path& run, const std::string& wanted) {
  const std::vector<BodyNames::Body> bodies = read_log(run).names.bodies();
  std::string names;
  for (const BodyNames::Body& body : bodies) {
    if (body.name == wanted) return body;
    names += (names.empty() ? "" : ", ") + body.name;
  }
  throw UsageError(fmt::format("--zoom {}: expected a body of the run{}", wanted,
                               names.empty() ? ", whose log names none" : ": " + names));
}

View view_of(const PictureView& asked, const std::filesystem::path& run, std::uint32_t dimension) {
  View view = view_from(asked, static_cast<int>(dimension));
  if (!asked.zoom.empty()) {
    const BodyNames::Body body = body_of(run, asked.zoom);
    view.first = body.first;
    view.count = body.vertices;
  }
  return view;
}

std::vector<bool> fixed_of(const RunScene& scene) { return {scene.labels.begin(), scene.labels.end()}; }

/// What all frames of a run take of a view.
Extent extent_of_run(const ExportRequest& request, const View& view) {
  SeriesReader reader = open_run(request.run);
  const std::vector<bool> fixed = fixed_of(reader.scene());
  std::optional<Extent> all;
  while (const auto window = reader.next_window()) {
    end_if_stopped();
    for_each_frame(*window, request.fps, [&](double, const std::vector<Position>& positions) {
      const Extent one = extent_of({reader.mesh(), positions}, fixed, view);
      if (!all) all = one;
      all = {std::min(all->left, one.left), std::min(all->top, one.top), std::max(all->right, one.right),
             std::max(all->bottom, one.bottom)};
      return true;
    });
  }
  return all.value_or(Extent());
}

}  // namespace

void require_pictures() {
  if (!can_write_png()) throw UsageError("-o: this noli was built without pictures (NOLI_WITH_PNG=OFF)");
}

View view_from(const PictureView& asked, int dimension) {
  View view;
  if (dimension == 2) {
    view.from = {0, 0, 1};
    view.up = {0, 1, 0};
  }
  if (asked.from) view.from = *asked.from;
  if (asked.size) {
    view.width = (*asked.size)[0];
    view.height = (*asked.size)[1];
  }
  // From straight above, what is ahead is up.
  if (view.from[0] == 0 && view.from[1] == 0) view.up = {0, 1, 0};
  return view;
}

ExportOutcome run_film(const FilmRequest& request) {
  const StopOfThread stop_of_thread(request.frames.stop);
  require_pictures();
  const SeriesReader reader = open_run(request.frames.run);
  const std::vector<bool> fixed = fixed_of(reader.scene());
  return with_asked_view([&] {
    View view = view_of(request.view, request.frames.run, reader.header().dimension);
    view.extent = extent_of_run(request.frames, view);
    return export_frames(request.frames, [&](const Frame& frame, const std::filesystem::path& path) {
      replace_file(path, png(draw(frame, fixed, view)));
    });
  });
}

PictureOutcome run_picture(const PictureRequest& request) {
  check(request);
  SeriesReader reader = open_run(request.run);
  const RunFrame frame = run_frame_at(reader, request.run, request.time);
  const std::vector<bool> fixed = fixed_of(reader.scene());
  return with_asked_view([&] {
    const View view = view_of(request.view, request.run, reader.header().dimension);
    const Picture picture = draw({reader.mesh(), frame.positions}, fixed, view);
    replace_file(request.output, png(picture));
    return PictureOutcome{frame.time, picture.width, picture.height};
  });
}

}  // namespace noli::report
