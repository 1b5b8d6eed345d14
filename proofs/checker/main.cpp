// SPDX-License-Identifier: Apache-2.0
//
// noli_check PROOF FRAME... | noli_check PROOF TRAJECTORY
//
// Checks a proof that nothing touches, or that something does (proofs/FORMAT.md). What it says and its exit codes are
// in section 6 there. A proof, or the block file of a run, that is named - is read from the standard input.
#include <exception>
#include <map>

#include "check.h"

namespace noli::checker {

static void print_claim(const Claim& claim, std::uint64_t steps, const std::array<double, 2>& times) {
  constexpr std::array sources = {"frames, straight lines between them", "frames at rest", "a run"};
  std::printf("%llu steps of %s; from %.17g to %.17g; dimension %u; %zu cells of %zu vertices.\n",
              static_cast<unsigned long long>(steps), sources[claim.source], times[0] + 0.0, times[1] + 0.0,
              claim.dimension, claim.cells.size(), claim.same.size());
  std::printf("Compared: features of two different cells%s.\n", claim.strict ? ", and of one" : "");
  if (claim.points) std::printf("Vertices without a cell are points.\n");
  if (claim.merged > 0) std::printf("Merged: %u vertices, each always where another is.\n", claim.merged);
  if (claim.eta > 0) std::printf("Least distance %.17g, ring %u.\n", claim.eta, claim.ring);
  if (claim.excluded.empty()) return;
  std::printf("Not compared, pairs of labels:");
  for (const auto& [a, b] : claim.excluded) std::printf(" %u-%u", a, b);
  std::map<std::uint32_t, std::size_t> cells;
  for (const Cell& cell : claim.cells) ++cells[cell.label];
  std::printf("\nCells with a label:");
  for (const auto& [label, count] : cells) std::printf(" %zu with %u;", count, label);
  std::printf(" no others.\n");
}

static int run(const std::vector<std::string>& arguments) {
  require(arguments.size() >= 2, "the command line", "expected a proof, and frames or a trajectory.blocks");
  Check check(arguments[0], {arguments.begin() + 1, arguments.end()});
  const auto refuted = check.go();
  const char* what = check.claim().excluded.empty() ? "nothing touches" : "nothing that is compared touches";
  std::printf("%s%s\n", refuted ? "refuted: " : "accepted: ", refuted.value_or(what).c_str());
  print_claim(check.claim(), check.steps(), check.times());
  require(std::fflush(stdout) == 0 && std::ferror(stdout) == 0, "standard output", "cannot be written");
  return refuted ? 1 : 0;
}

}  // namespace noli::checker

int main(int argc, char** argv) {
  try {
    return noli::checker::run({argv + std::min(argc, 1), argv + argc});
  } catch (const noli::checker::Rejected& r) {
    std::printf("rejected: %s: %s\n", r.where.c_str(), r.why.c_str());
  } catch (const std::exception& e) {
    std::printf("rejected: %s\n", e.what());
  }
  return 3;
}
