// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/proofs/proof_cases.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>

#include <noli/errors.h>
#include "audit/fuzz/proofs/proof_checkers.h"
#include "audit/fuzz/trajectories/motion_generators.h"
#include "certify/process/run_program.h"
#include "certify/process/scratch_folder.h"
#include "certify/process/this_program.h"
#include "certify/proofs/checker.h"
#include "trajectory/text.h"

namespace noli::audit {
namespace {

namespace fs = std::filesystem;

/// Throws InputError unless the checker accepts the proof, or the witness in it.
ProofCase read_case(const fs::path& proof, const std::vector<fs::path>& trajectory, const std::atomic<bool>& stop) {
  const std::string bytes = read_whole_file(proof);
  const CheckerVerdict said =
      check_proof({.proof = proof, .trajectory = trajectory, .asked = own_claim(bytes), .stop = &stop});
  if (said.code == 3) {
    throw InputError(proof.string(), "", "expected a proof that holds: " + first_line(said.words));
  }
  ProofCase made;
  made.name = proof.filename().string();
  made.proof = bytes;
  made.groups = parse_proof(made.proof, proof.string());
  made.extension = trajectory[0].extension().string().substr(1);
  for (const fs::path& file : trajectory) made.files.push_back(read_whole_file(file));
  made.refutes = said.code == 1;
  return made;
}

/// The proof or witness that `noli verify` writes about a motion with this claim; nothing if it writes none, as for
/// some degenerate contacts, or once `stop` is set.
std::optional<ProofCase> made_case(const FrameMotion& motion, const std::vector<std::string>& claimed,
                                   const std::atomic<bool>& stop) {
  const ScratchFolder work_folder(ScratchFolder::Place::memory);
  const fs::path proof = work_folder.path() / "proof.noli";
  const std::vector<fs::path> files = write_frames(motion, work_folder.path());
  std::vector<std::string> words = {
      this_program_file().string(), "verify", "--threads", "1", "--no-check", "--force", "--proof", proof};
  if (motion.at_rest()) words.emplace_back("--static");
  words.insert(words.end(), claimed.begin(), claimed.end());
  for (const fs::path& file : files) words.push_back(file);
  ProgramLimits limits;
  limits.stop = stop_by(&stop);
  const ProgramEnd end = run_program(words, limits);
  if (!end.exited_with(0) && !end.exited_with(1)) return std::nullopt;
  try {
    return read_case(proof, files, stop);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// Proofs and witnesses of small motions, with various claims.
std::vector<ProofCase> made_cases(const std::atomic<bool>& stop) {
  const std::vector<std::vector<std::string>> claims = {{},
                                                        {"--strict"},
                                                        {"--points"},
                                                        {"--min-distance", "1e-9"},
                                                        {"--min-distance", "1e-6", "--min-distance-from-ring", "2"}};
  constexpr std::size_t motions = 60, most_cells = 12;
  const auto generators = motion_generators();
  Random random(1);
  std::vector<ProofCase> cases;
  for (std::size_t i = 0; i < motions && !stop; ++i) {
    const MotionGenerator& generator = generators[i % generators.size()];
    const FrameMotion motion = generator.make(random).motion;
    if (motion.mesh.cell_count() > most_cells) continue;
    auto made = made_case(motion, claims[i % claims.size()], stop);
    if (!made) continue;
    made->name = fmt::format("{} {}", generator.name, i);
    cases.push_back(std::move(*made));
  }
  return cases;
}

}  // namespace

std::vector<ProofCase> proof_cases(const std::vector<fs::path>& files, const std::atomic<bool>& stop) {
  try {
    if (files.empty()) return made_cases(stop);
    return {read_case(files[0], trajectory_for_checker({files.begin() + 1, files.end()}), stop)};
  } catch (const Stopped&) {
    return {};
  }
}

}  // namespace noli::audit
