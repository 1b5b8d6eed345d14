// SPDX-License-Identifier: Apache-2.0
#include "report/figures/repair_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include <noli/errors.h>
#include "report/figures/png.h"
#include "report/page/report_results.h"
#include "report/repaired_motions.h"
#include "trajectory/write_file.h"

namespace noli::report {
namespace {

/// The body fills the picture.
void zoom_to(const std::string& name, const Json& bodies, View& view) {
  const auto body = std::ranges::find_if(bodies, [&](const Json& of) { return of.at("name") == name; });
  if (body == bodies.end()) throw UsageError("--zoom " + name + ": the repair has no such body");
  view.first = body->at("first_vertex").get<std::size_t>();
  view.count = body->at("vertices").get<std::size_t>();
}

Extent around_both(const Extent& a, const Extent& b) {
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right), std::max(a.bottom, b.bottom)};
}

PictureOutcome drawn(const RepairPictureRequest& request, const Json& result) {
  const RepairedMotions motions = repaired_motions(result, request.result);
  const double last = motions.repaired->times().back();
  if (!(request.time >= 0 && request.time <= last)) {
    throw InputError(request.result.string(), "",
                     fmt::format("is about the times from 0 to {} steps, not {}", last, request.time));
  }
  View view = view_from(request.view, result.at("dimension").get<int>());
  if (!request.view.zoom.empty()) zoom_to(request.view.zoom, result.at("bodies"), view);
  const Frame repaired{motions.mesh, motions.repaired->at(request.time)};
  const Frame given{motions.mesh, motions.given->at(request.time)};
  const std::vector<bool> fixed(motions.mesh.vertex_count, false);
  return with_asked_view([&] {
    // Pictures before and after are to be laid side by side.
    view.extent = around_both(extent_of(repaired, fixed, view), extent_of(given, fixed, view));
    const Picture picture = draw(request.given ? given : repaired, fixed, view);
    replace_file(request.output, png(picture));
    return PictureOutcome{request.time, picture.width, picture.height};
  });
}

}  // namespace

PictureOutcome repair_picture(const RepairPictureRequest& request) {
  require_pictures();
  const Json result = read_result(request.result);
  try {
    return drawn(request, result);
  } catch (const Json::exception& error) {
    throw InputError(request.result.string(), "", fmt::format("is not a result of noli repair: {}", error.what()));
  }
}

}  // namespace noli::report
