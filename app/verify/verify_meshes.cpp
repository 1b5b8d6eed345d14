// SPDX-License-Identifier: Apache-2.0
#include "app/verify/verify_meshes.h"

#include <fmt/format.h>

#include <utility>

#include "app/process.h"
#include "app/progress.h"
#include "certify/proofs/proof_route.h"
#include "report/verify_report.h"

namespace noli::app {
namespace {

report::MeshVerdict verify_mesh(VerifyRequest request, MeshesWanted wanted, ProgressBars& bars, double done,
                                double share) {
  const std::string file = request.frames[0].string();
  ProofRoute route(request);
  request.progress = [&](std::string_view work, double part) { bars.show(work, done + share * part, file); };
  VerifyOutcome outcome = run_verify(request);
  route.check(outcome);
  Json json = wanted.json ? report::verify_json(request, outcome) : Json();
  report::Answer answer = report::verify_answer(request, outcome, {.result = "", .details = wanted.details});
  return {file, outcome.verdict, std::move(answer), std::move(outcome.notes), outcome.claim.empty, std::move(json)};
}

}  // namespace

std::vector<report::MeshVerdict> verify_meshes(VerifyRequest request, MeshesWanted wanted) {
  std::vector<report::MeshVerdict> meshes;
  ProgressBars bars;
  const auto files = std::exchange(request.frames, {});  // not copied for each of them
  const double share = 1 / static_cast<double>(files.size());
  request.stop = &interrupted();
  for (const auto& file : files) {
    VerifyRequest one = request;
    one.frames = {file};
    meshes.push_back(verify_mesh(std::move(one), wanted, bars, share * static_cast<double>(meshes.size()), share));
  }
  return meshes;
}

}  // namespace noli::app
