// SPDX-License-Identifier: Apache-2.0
#include "certify/simulate/start_check.h"

#include <fmt/format.h>

#include <cstdint>

#include "certify/simulate/model_facts.h"
#include "certify/simulate/model_run.h"
#include "integrator/scene/build_model.h"
#include "trajectory/stop.h"

namespace noli {

namespace {

/// "face cloth[0]-cloth[1]-cloth[2]". Cells are numbered as in include/noli/mesh.h.
std::string cell_name(const Mesh& mesh, std::size_t cell, const BodyNames& names) {
  if (cell < mesh.faces.size()) return names.feature(mesh.faces[cell]);
  cell -= mesh.faces.size();
  if (cell < mesh.edges.size()) return names.feature(mesh.edges[cell]);
  return names.feature({&mesh.points[cell - mesh.edges.size()], 1});
}

/// "1 pair of cells intersects", "3 pairs of cells intersect"; "" for none.
std::string pairs_that(std::uint64_t n, const char* of, const std::string& verb) {
  if (n == 0) return "";
  return n == 1 ? fmt::format("1 pair of {} {}s", of, verb) : fmt::format("{} pairs of {} {}", n, of, verb);
}

template <int Dim>
std::string contact_at_start_of(const integrator::Scene& scene, const std::atomic<bool>* stop,
                                const std::optional<std::chrono::steady_clock::time_point>& deadline) {
  const integrator::BuiltScene<Dim> built = integrator::build_model<Dim>(scene);
  const std::vector<std::uint8_t> labels = labels_of<Dim>(built.model);
  const Exclusions exclusions = exclusions_of<Dim>(built.model);
  const std::vector<Position> x = positions_of<Dim>(built.model.x);
  WindowOptions options;
  options.dimension = Dim;
  options.scripted = labels;
  options.exclusions = &exclusions;
  options.stop = stop;
  options.deadline = deadline;
  const WindowVerifier verifier(built.model.mesh, x, options);
  return contact_at_start(verifier, built.model.mesh, x, options, names_of(built.bodies));
}

}  // namespace

std::string contact_at_start(const WindowVerifier& verifier, const Mesh& mesh, const std::vector<Position>& x,
                             WindowOptions options, const BodyNames& names) {
  options.initial = true;
  options.max_reports = 3;
  const WindowResult result = verifier.verify(WorldLines::from_frames(x, x), options);
  if (!result.complete) throw Stopped(stop_asked().value_or(StopReason::out_of_time), "the start of the scene");
  if (result.contact_count() + result.initial_intersections == 0) return "";
  std::string pairs;
  for (const auto& contact : result.reports) {
    pairs += fmt::format("{}{}", pairs.empty() ? "" : ", ", names.pair(contact.pair, contact.vertices, "meets"));
  }
  for (const auto& cells : result.initial_reports) {
    pairs += fmt::format("{}{} intersects {}", pairs.empty() ? "" : ", ", cell_name(mesh, cells.first_cell, names),
                         cell_name(mesh, cells.second_cell, names));
  }
  const std::string meet = pairs_that(result.contact_count(), "features", "meet");
  const std::string intersect = pairs_that(result.initial_intersections, "cells", "intersect");
  return fmt::format("{}; in all, {}{}{}; expected none", pairs, meet, meet.empty() || intersect.empty() ? "" : " and ",
                     intersect);
}

std::string contact_at_start(const integrator::Scene& scene, const std::atomic<bool>* stop,
                             std::optional<std::chrono::steady_clock::time_point> deadline) {
  return scene.dimension == 2 ? contact_at_start_of<2>(scene, stop, deadline)
                              : contact_at_start_of<3>(scene, stop, deadline);
}

}  // namespace noli
