// SPDX-License-Identifier: Apache-2.0
#include "report/proof_report.h"

#include <string>

namespace noli::report {
namespace {

const char* what_moves(const std::string& motion) {
  if (motion == "linear") return "frames";
  if (motion == "rest") return "frames at rest";
  return motion == "run" ? "a run" : "something unknown";
}

}  // namespace

Json proof_info_json(const std::filesystem::path& file, const ProofInfo& info) {
  return {{"file", file.string()},
          {"format", "Noli proof"},
          {"about", what_moves(info.motion)},
          {"dimension", info.dimension},
          {"strict", info.strict},
          {"unreferenced_vertices_count", info.points},
          {"least_distance", info.distance},
          {"ring", info.ring},
          {"merged_vertices", info.merged},
          {"excluded_pairs_of_labels", info.excluded},
          {"steps", info.steps},
          {"steps_with_a_witness_of_contact", info.contacts},
          {"token_bytes", info.token_bytes},
          {"open_group", info.open_group},
          {"bytes", info.bytes},
          {"begin", info.steps > 0 ? Json(info.from) : Json()},
          {"end", info.steps > 0 ? Json(info.to) : Json()}};
}

}  // namespace noli::report
