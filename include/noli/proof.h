// SPDX-License-Identifier: Apache-2.0
//
// Proofs: what they claim, where they are written, what is in them, and the separate programs that check them.
//
//   noli::VerifyRequest request;                       // noli/verify.h
//   request.frames = frames;
//   request.open_proof = noli::proof_to_file("p.noli");
//   const noli::VerifyOutcome outcome = noli::run_verify(request);
//   const noli::CheckerVerdict verdict = noli::check_proof(
//       {.proof = "p.noli", .trajectory = frames, .asked = noli::fields_of(outcome.claim)});
//   if (verdict.code == 0) ...                         // accepted: nothing touches
//   const noli::ProofInfo info = noli::inspect_proof("p.noli");  // what it is about, and its size; checks nothing
//
// Notation
//   claim     a statement about a motion, field by field (proofs/FORMAT.md, section 6). Checkers decide which of two
//             claims is stronger
//   checker   a separate program: noli_check, or noli_check_verified, which is extracted from a proof in Coq
//
// Units: distances in the unit of the coordinates; times in steps of frames, in seconds of a run.
// Errors: as each function says. Thread safety: any thread; any number of checks may run at once, each with its own
// stop; nothing is printed.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
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

/// Steps that a claim is about, where it is about a part of a proof alone.
struct ClaimPart {
  std::uint64_t first = 0, last = 0;  ///< from 1
  std::string proof;                  ///< the last running hash of the proof's file
  friend bool operator==(const ClaimPart&, const ClaimPart&) = default;
};

/// A claim, by the fields of proofs/FORMAT.md, section 6.
struct Claim {
  std::string motion = "linear";  ///< or "rest", "run"
  int dimension = 3;
  std::uint64_t steps = 0;
  bool strict = false, points = false;
  double distance = 0;
  std::uint32_t ring = 1;
  std::uint64_t merged = 0;                         ///< number of merged vertices
  std::set<std::array<std::uint32_t, 2>> excluded;  ///< pairs of labels, the smaller first
  std::string cells;                                ///< their hash
  bool empty = false;                               ///< fewer than two cells can be compared
  double from = 0, to = 0;                          ///< T0 of the first step, T1 of the last
  std::optional<ClaimPart> part;                    ///< nothing: all steps, or the first ones

  friend bool operator==(const Claim&, const Claim&) = default;
};

/// The claim that a checker prints after its line of the verdict; nothing if it prints none, or one of another form.
std::optional<Claim> claim_of_words(const std::string& words);

/// The fields for --require that ask for exactly this claim. A long list of excluded pairs takes several.
std::vector<std::string> fields_of(const Claim& claim);

/// Those of fields_of() that `noli check` does not ask for by default.
std::vector<std::string> fields_beyond_default(const Claim& claim);

/// Names the first field in which a checker's claim differs from the claim that was asked for; nothing if they agree.
/// If the claim was refuted, steps after the witness are not compared.
std::optional<std::string> difference(const Claim& asked, const Claim& checked, bool refuted);

/// What makes a claim weaker than a checker's default: "frames at rest", "12 merged vertices", ...
std::vector<std::string> weakenings(const Claim& claim);

/// What a claim says of its least distance: ", and all is more than 0.1 apart"; empty if it has none.
std::string distance_phrase(const Claim& claim);

/// The fields for --require that a file CLAIM.json asks for (`noli verify --claim-out`); absent members are not asked
/// for. Throws InputError.
std::vector<std::string> read_claim_file(const std::filesystem::path& file);

/// For VerifyRequest::open_proof: creates the file of the proof. Throws std::system_error when it cannot be created or
/// already exists.
std::function<std::unique_ptr<Sink>(const Claim&)> proof_to_file(std::filesystem::path file);

/// What a proof says of itself. Only a checker knows whether it is true.
struct ProofInfo {
  std::string motion;  ///< as in Claim; empty: of a kind that this version does not know
  int dimension = 3;
  bool strict = false;         ///< the vertex-disjoint features of one cell are compared too
  bool points = false;         ///< vertices that no cell refers to are particles
  double distance = 0;         ///< features are more than this apart, in the unit of the coordinates
  std::uint32_t ring = 1;      ///< features fewer mesh edges apart may be nearer
  std::uint64_t merged = 0;    ///< number of merged vertices
  std::uint64_t excluded = 0;  ///< number of pairs of labels that are not compared
  std::uint64_t steps = 0;     ///< committed; `contacts`, `from`, `to` and `token_bytes` are about these
  std::uint64_t contacts = 0;  ///< of these, steps with a witness of contact
  double from = 0, to = 0;     ///< T0 of the first step, T1 of the last, as in Claim; 0 without steps
  std::uint64_t token_bytes = 0;
  std::uint64_t bytes = 0;  ///< of the file
  bool open_group = false;  ///< the file ends in a part that was never committed: its writer was stopped
};

/// Whether the file begins like a proof. False if it cannot be read, and for a pipe.
bool is_proof(const std::filesystem::path& file);

/// Reads a proof, one block in memory at a time, and checks only that its blocks are whole. `stop` is polled; when it
/// becomes true, Stopped is thrown. `progress` is called now and then with the share of the file that is read, in
/// [0, 1]. Throws InputError when the file is damaged, or its blocks are not those of a proof; std::system_error.
ProofInfo inspect_proof(const std::filesystem::path& file, const std::atomic<bool>* stop = nullptr,
                        const std::function<void(double share)>& progress = {});

enum class Checker { plain, verified };

/// As the checker reports it: "noli_check", "0.1.0", the commit.
struct CheckerVersion {
  std::string name, version, commit;
};

/// Throws HelperError when the checker does not report its version; std::runtime_error when there is no such program.
CheckerVersion version_of(Checker checker);

/// A checker's output, and its exit code.
struct CheckerVerdict {
  int code = 3;       ///< 0: accepted, 1: refuted, 3: rejected
  std::string words;  ///< its standard output
};

/// What a checker has to check, and where.
struct CheckRequest {
  Checker checker = Checker::plain;
  std::optional<std::filesystem::path> proof = {};  ///< nothing: it is piped to the process
  std::vector<std::filesystem::path> trajectory =
      {};                                   ///< the frames in the order of time, or a run's trajectory.blocks
  std::vector<std::string> asked = {};      ///< the fields after --require (proofs/FORMAT.md, section 6)
  const std::atomic<bool>* stop = nullptr;  ///< polled; when it becomes true the checker is ended
  std::optional<std::chrono::steady_clock::time_point> deadline = {};  ///< the checker is ended then
  std::filesystem::path programs = {};  ///< the checkers' folder; empty: that of this program
  /// At most so many processes at once, each for a part of the steps, if `proof` and `trajectory` are files; 0: as many
  /// as the machine has threads. Each has a mesh and frames of its own in memory. What they say is the same.
  int checkers = 1;
  /// Called now and then, from any thread but one at a time, with the share of `proof` that the checker has read, in
  /// [0, 1], if the system reports it.
  std::function<void(double share)> progress = {};
};

/// Starts a checker on a proof in a file and waits until it ends. Precondition: `proof` is set. Throws Stopped;
/// UsageError when this library was built without the verified checker; HelperError when the machine failed the checker
/// (memory, a signal); std::runtime_error when there is no such program, it stops reading, or it ends with an
/// unexpected exit code.
CheckerVerdict check_proof(const CheckRequest& request);

/// The files that checkers read: for a run its trajectory.blocks, otherwise the frames as they are.
std::vector<std::filesystem::path> trajectory_for_checker(const std::vector<std::filesystem::path>& trajectory);

}  // namespace noli
