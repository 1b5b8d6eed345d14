// SPDX-License-Identifier: Apache-2.0
//
// Proofs: what they claim, where they are written, and separate programs that check them.
//
//   noli::VerifyRequest request;                       // noli/verify.h
//   request.frames = frames;
//   request.open_proof = noli::proof_to_file("p.noli");
//   const noli::VerifyOutcome outcome = noli::run_verify(request);
//   const noli::CheckerVerdict verdict = noli::check_proof(
//       {.proof = "p.noli", .trajectory = frames, .asked = noli::fields_of(outcome.claim)});
//   if (verdict.code == 0) ...                         // accepted: nothing touches
//
// Notation
//   claim     what is said of a motion, field by field (proofs/FORMAT.md, section 6). Which of two claims is the
//             stronger one is for checkers to decide
//   checker   a separate program: noli_check, or noli_check_verified, which is extracted from a proof in Coq
//
// Units: distances in the unit of the coordinates; times in steps of frames, in seconds of a run.
// Errors: as each function says. Thread safety: any thread; two checks may run at once.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace noli {

class Sink;

/// What is claimed of a motion.
struct Claim {
  std::string motion = "linear";  ///< or "rest", "run"
  int dimension = 3;
  std::uint64_t steps = 0;
  bool strict = false, points = false;
  double distance = 0;
  std::uint32_t ring = 1;
  std::uint64_t merged = 0;                         ///< vertices
  std::set<std::array<std::uint32_t, 2>> excluded;  ///< pairs of labels, the smaller first
  std::string cells;                                ///< their hash
  bool empty = false;                               ///< fewer than two cells can be compared
  double from = 0, to = 0;                          ///< T0 of the first step, T1 of the last

  friend bool operator==(const Claim&, const Claim&) = default;
};

/// As a checker's words have it behind the verdict's line; nothing if they have none, or another form.
std::optional<Claim> claim_of_words(const std::string& words);

/// The words of --require that ask for just this claim.
std::vector<std::string> fields_of(const Claim& claim);

/// Those of them that `noli check` does not ask by itself.
std::vector<std::string> fields_beyond_default(const Claim& claim);

/// The first field in which a checker's claim is another than the one that was asked, in words; nothing if none is. Of
/// a claim that is refuted, steps behind the witness count for nothing.
std::optional<std::string> difference(const Claim& asked, const Claim& checked, bool refuted);

/// What makes it weaker than what a checker asks by default: "frames at rest", "12 merged vertices", ...
std::vector<std::string> weakenings(const Claim& claim);

/// The words of --require that a file CLAIM.json asks for (`noli verify --claim-out`); members that are not there are
/// not asked by name. Throws InputError.
std::vector<std::string> read_claim_file(const std::filesystem::path& file);

/// For VerifyRequest::open_proof: makes the file of the proof. Throws std::system_error when it cannot be made, or
/// is there already.
std::function<std::unique_ptr<Sink>(const Claim&)> proof_to_file(std::filesystem::path file);

enum class Checker { plain, verified };

/// As it says itself: "noli_check", "0.1.0", the commit.
struct CheckerVersion {
  std::string name, version, commit;
};

/// Throws HelperError when it does not say; std::runtime_error when it is not there.
CheckerVersion version_of(Checker checker);

/// What a checker said, and how it ended.
struct CheckerVerdict {
  int code = 3;       ///< 0: accepted, 1: refuted, 3: rejected
  std::string words;  ///< its standard output, lines
};

/// What a checker is asked.
struct CheckRequest {
  Checker checker = Checker::plain;
  std::optional<std::filesystem::path> proof = {};  ///< nothing: it is written to the process
  std::vector<std::filesystem::path> trajectory =
      {};                                   ///< the frames in the order of time, or a run's trajectory.blocks
  std::vector<std::string> asked = {};      ///< fields as they follow its --require (proofs/FORMAT.md, section 6)
  const std::atomic<bool>* stop = nullptr;  ///< polled; when it becomes true the checker is ended
  std::filesystem::path programs = {};      ///< the folder that the checkers are in; empty: that of this program
};

/// Starts a checker on a proof in a file and waits for its end. Precondition: proof. Throws Stopped; HelperError
/// when the machine failed the checker (memory, a signal); std::runtime_error when the checker is not there, reads no
/// more, or ends with a code that it may not.
CheckerVerdict check_proof(const CheckRequest& request);

/// The file of a run that checkers read.
std::vector<std::filesystem::path> trajectory_for_checker(const std::vector<std::filesystem::path>& trajectory);

}  // namespace noli
