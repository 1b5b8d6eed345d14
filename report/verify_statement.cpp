// SPDX-License-Identifier: Apache-2.0
#include "report/verify_statement.h"

#include <fmt/format.h>

#include <string>

#include "certify/not_compared.h"
#include "report/input_report.h"

namespace noli::report {
namespace {

const char* motion_of(const VerifyRequest& request) {
  if (request.reproduce) {
    return "every vertex moves linearly between its own breakpoints, from each window to the next; the windows were "
           "integrated again from the run's own scene, and the hashes of their world lines were those of the run";
  }
  if (request.run) return "every vertex moves linearly between its own breakpoints, from each window to the next";
  return request.constant_motion ? "each frame by itself, at rest"
                                 : "every vertex moves linearly from each frame to the next";
}

std::string claimed(const VerifyRequest& request) {
  const std::string who = fmt::format("no two features of two different cells{} that share no vertex",
                                      request.strict ? ", or of one," : "");
  if (request.min_distance == 0) return who + " meet at any time of a step";
  const std::string which =
      request.ring > 1 ? fmt::format(" (except features fewer than {} mesh edges apart)", request.ring) : "";
  return fmt::format("{} meet at any time of a step, or come within {} of each other{}", who,
                     digits17(request.min_distance), which);
}

Json bodies_json(const std::vector<FrameBody>& bodies) {
  Json list = Json::array();
  for (const FrameBody& body : bodies) {
    list.push_back({{"name", body.name},
                    {"first_vertex", body.first_vertex},
                    {"vertices", body.vertices},
                    {"first_face", body.first_face},
                    {"faces", body.faces},
                    {"still", body.still}});
  }
  return list;
}

Json excluded_json(const VerifyRequest& request, const VerifyOutcome& outcome) {
  Json list = Json::array();
  if (outcome.not_compared.any_held) list.push_back(held_text(outcome.not_compared));
  for (const auto& pair : outcome.not_compared.excluded) {
    list.push_back(fmt::format("two cells of {}, which {}", pair_text(pair),
                               request.run ? "the run's scene excludes" : "--ignore leaves out"));
  }
  if (outcome.not_compared.baseline > 0) list.push_back(baseline_text(outcome.not_compared) + " (--only-new)");
  return list;
}

}  // namespace

Json statement_json(const VerifyRequest& request, const VerifyOutcome& outcome) {
  Json json = {
      {"claim", claimed(request)},
      {request.run ? "windows" : "frames", request.run ? outcome.steps_total : outcome.frame_count()},
      {"motion", motion_of(request)},
      {"time", request.run ? "seconds; each window, both ends included" : "[0, 1] in each step, both ends included"},
      {"numbers", "the doubles that the files give, taken exactly; real arithmetic on them, no tolerance"},
      {"dimension", outcome.dimension},
      {"cells",
       "faces, and the loose edges and points that the files list; their features are their vertices, edges and "
       "themselves"},
      {"contact", "closed simplices have a point in common; degenerate ones are what their hull is; touching counts"},
      {"neighbours",
       "features that share a vertex are not compared; vertices are identified by index and never merged unless asked"},
      {"initial_intersections", "pairs of cells whose vertex-disjoint parts meet at the first time of all"},
      {"excluded", excluded_json(request, outcome)},
      {"min_distance", request.min_distance},
      {"min_distance_from_ring", request.ring},
      {"strict", request.strict},
      {"points", request.points},
      {"static", request.constant_motion},
      {"only_new", request.only_new},
      {"keep_going", request.keep_going},
      {"first_only", request.first_only},
      {"merge_identical", request.merge_identical},
      {"merged_vertices", outcome.merged_vertices},
      {"unreferenced_vertices_left_out", outcome.unreferenced_vertices},
  };
  if (!request.run) {
    json["order"] = request.ordered;
    if (!outcome.bodies.empty()) json["bodies"] = bodies_json(outcome.bodies);
    json["polygons"] = polygons_text(request.reading.polygons);
  }
  json["notes"] = outcome.notes;
  return json;
}

}  // namespace noli::report
