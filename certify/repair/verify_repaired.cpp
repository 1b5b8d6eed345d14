// SPDX-License-Identifier: Apache-2.0
#include "certify/repair/verify_repaired.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "certify/groups.h"
#include "certify/json.h"
#include "certify/process/scratch_folder.h"
#include "certify/proofs/proof_route.h"
#include "trajectory/formats/frame_order.h"
#include "trajectory/write_file.h"

namespace noli {
namespace {

/// The file of --ignore for frames whose bodies are one mesh without names.
std::filesystem::path groups_by_number(const std::filesystem::path& ignore, const std::vector<FrameBody>& bodies,
                                       const std::filesystem::path& folder) {
  const Groups named =
      read_groups(ignore, bodies.back().first_vertex + bodies.back().vertices, names_of_frames(bodies));
  Json json = {{"groups", Json::object()}, {"ignore", Json::array()}};
  for (const FrameBody& body : bodies) {
    json["groups"][body.name] = Json::array({{body.first_vertex, body.first_vertex + body.vertices - 1}});
  }
  for (const auto& [a, b] : named.exclusions.pairs) json["ignore"].push_back({named.names[a], named.names[b]});
  write_file(folder / "groups.json", json.dump());
  return folder / "groups.json";
}

/// What was verified last has to be what was written.
void require_written(const RepairOutcome& outcome) {
  const std::vector<FrameFacts>& read = outcome.verified->inputs;
  for (std::size_t k = 0; k < std::min(read.size(), outcome.written.size()); ++k) {
    const FrameFacts& written = outcome.written[k].facts;
    if (!read[k].looked_at || read[k].sha256 == written.sha256) continue;
    throw std::runtime_error(written.file + " has changed since it was written");
  }
}

}  // namespace

void verify_repaired(const RepairRequest& request, RepairOutcome& outcome) {
  VerifyWork again;
  for (const RepairedFrame& frame : outcome.written) again.frames.emplace_back(frame.facts.file);
  again.order = FrameOrder::given;
  again.put_in_order();
  again.dimension = request.dimension;
  again.threads = request.threads;
  again.points = request.points;
  again.only_new = request.only_new;
  again.proof = request.proof;
  again.check = request.check;
  again.deadline = request.deadline;
  again.stop = request.stop;
  again.progress = request.progress;
  std::optional<ScratchFolder> folder;
  again.ignore = request.ignore;
  if (request.ignore && !outcome.bodies.empty()) {
    again.ignore = groups_by_number(*request.ignore, outcome.bodies, folder.emplace().path());
  }
  ProofRoute route(again);
  outcome.verified = run_verify(again);
  route.check(*outcome.verified);
  require_written(outcome);
  for (const std::string& note : outcome.verified->notes) outcome.notes.push_back("of the new frames: " + note);
  if (outcome.verified->not_checked) outcome.notes.push_back("not checked: " + *outcome.verified->not_checked);
  if (!outcome.verified->touches()) return;
  const std::string step = outcome.verified->first ? fmt::format(" in step {}", outcome.verified->first->step) : "";
  throw std::runtime_error(fmt::format(
      "the new frames touch{}, although each step was decided when it was written: was a file changed?", step));
}

}  // namespace noli
