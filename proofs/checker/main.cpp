// SPDX-License-Identifier: Apache-2.0
//
// noli_check [--require FIELD[=VALUE]]... PROOF FRAME...
// noli_check [--require FIELD[=VALUE]]... PROOF TRAJECTORY
// noli_check --version
//
// Checks a proof that nothing touches, or that something does (proofs/FORMAT.md). Sections 6 and 7 there define the
// fields of --require, the output and the exit codes. The name - stands for the standard input, for the proof or the
// block file of a run.
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <map>
#include <new>

#include "check.h"

namespace noli::checker {

extern const char* const version;  // version.cpp

/// Prints the claim for programs.
static void print_fields(const Check& check) {
  const Claim& claim = check.claim();
  std::printf("claim motion=%s dimension=%u steps=%s strict=%d points=%d distance=%s ring=%u merged=%u",
              motions[claim.source], claim.dimension, check.steps().c_str(), claim.strict ? 1 : 0, claim.points ? 1 : 0,
              text_of(claim.eta).c_str(), claim.ring, claim.merged);
  std::printf(" excluded=%s cells=%s empty=%d from=%s to=%s", text_of(claim.excluded).c_str(),
              text_of(claim.hash).c_str(), compares_any(claim, claim.strict) ? 0 : 1, text_of(check.times()[0]).c_str(),
              text_of(check.times()[1]).c_str());
  std::printf("%s\n", check.part() ? (" proof=" + text_of(check.proof())).c_str() : "");
}

/// Prints the claim for people.
static void print_claim(const Check& check) {
  const Claim& claim = check.claim();
  constexpr std::array sources = {"frames, straight lines between them", "frames at rest", "a run"};
  std::printf(check.part() ? "Steps %s" : "%s steps", check.steps().c_str());
  std::printf(" of %s; from %.17g to %.17g; dimension %u; %zu cells of %zu vertices.\n", sources[claim.source],
              check.times()[0] + 0.0, check.times()[1] + 0.0, claim.dimension, claim.cells.size(), claim.same.size());
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

static int run(std::vector<std::string> words) {
  if (words == std::vector<std::string>{"--version"}) {
    std::printf("noli_check %s\n", version);
    return 0;
  }
  std::vector<std::string> fields;
  for (; words.size() >= 2 && words[0] == "--require"; words.erase(words.begin(), words.begin() + 2))
    fields.push_back(words[1]);
  require(words.size() >= 2, "the command line", "expected a proof, and frames or a trajectory.blocks");
  Check check(words[0], {words.begin() + 1, words.end()}, Asked(fields));
  const auto refuted = check.go();
  const char* what = check.claim().excluded.empty() ? "nothing touches" : "nothing that is compared touches";
  std::printf("%s\n", refuted ? ("refuted: " + *refuted).c_str() : ("accepted: " + (what + check.weaker())).c_str());
  print_fields(check);
  print_claim(check);
  require(std::fflush(stdout) == 0 && std::ferror(stdout) == 0, "standard output", "cannot be written");
  return refuted ? 1 : 0;
}

}  // namespace noli::checker

/// Gives no verdict on the proof, and allocates nothing.
[[noreturn]] static void end_without_memory() {
  constexpr std::string_view words = "failed: out of memory; nothing is said of the proof\n";
  [[maybe_unused]] const ssize_t written = ::write(STDOUT_FILENO, words.data(), words.size());
  std::_Exit(4);
}

static void* or_end(void* memory) {
  if (memory == nullptr) end_without_memory();
  return memory;
}

/// Without this, GMP would abort the program when memory runs out.
static void watch_memory_of_gmp() {
  mp_set_memory_functions([](std::size_t size) { return or_end(std::malloc(size)); },
                          [](void* old, std::size_t, std::size_t size) { return or_end(std::realloc(old, size)); },
                          [](void* memory, std::size_t) { std::free(memory); });
}

int main(int argc, char** argv) {
  watch_memory_of_gmp();
  try {
    return noli::checker::run({argv + std::min(argc, 1), argv + argc});
  } catch (const std::bad_alloc&) {
    end_without_memory();
  } catch (const noli::checker::Rejected& r) {
    std::printf("rejected: %s: %s\n", r.where.c_str(), r.why.c_str());
  } catch (const std::exception& e) {
    std::printf("rejected: %s\n", e.what());
  }
  return 3;
}
