// SPDX-License-Identifier: Apache-2.0
//
// Verifies frames in files, or the windows of a run: did anything touch, where and when first? Writes proofs.
//
//   noli::VerifyRequest request;
//   request.frames = {"cloth_1.ply", "cloth_2.ply"};
//   const noli::VerifyOutcome outcome = noli::run_verify(request);
//   if (outcome.verdict == noli::Verdict::contact) ...  // outcome.first says what meets, when and how
//
// Notation
//   step k     from frame k to frame k + 1, between which each vertex moves along a line; or window k of a run.
//              Reports count from 1
//   proof      noli/proof.h; one is written where `open_proof` says
//
// Units: coordinates and distances in the unit of the files; times in [0, 1] of the step, in seconds for a run.
// Errors: as run_verify says. Thread safety: any number of verifications may run at once, each with its own stop;
// nothing is printed. Callbacks come from the calling thread or from threads of the verification, one at a time.
// Frames in memory: noli/sequence.h.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <noli/contact.h>
#include <noli/findings.h>
#include <noli/frames.h>
#include <noli/mesh.h>
#include <noli/proof.h>
#include <noli/time_of_impact.h>

namespace noli {

class Sink;

struct VerifyRequest {
  std::vector<std::filesystem::path> frames;  ///< files in the order of time, or the folder of one run
  FrameOrder order = FrameOrder::checked;     ///< how put_in_order() orders them
  std::string ordered;                        ///< one line: how they were ordered; set by put_in_order()
  std::vector<std::string> order_notes;
  FrameReading reading;
  bool run = false;              ///< it is a run: steps are its windows, times are seconds
  std::optional<int> dimension;  ///< nothing: 2 if all z of the first two frames are equal, else 3
  int threads = 0;               ///< 0: all there are
  std::size_t max_reports = 100;
  bool keep_going = false;       ///< all steps, instead of stopping after the first with a contact
  bool first_only = false;       ///< stop at any contact
  bool strict = false;           ///< also compare the vertex-disjoint features of one cell
  bool points = false;           ///< vertices that no cell refers to are particles
  bool constant_motion = false;  ///< --static: each frame by itself, at rest
  bool merge_identical = false;
  std::optional<std::filesystem::path> ignore;        ///< groups that are not compared: `noli verify --help`
  bool only_new = false;                              ///< cells that intersect in the first frame are not compared
  double min_distance = 0;                            ///< features must be more than this apart
  std::uint32_t ring = 1;                             ///< features fewer mesh edges apart may be nearer
  bool follow = false;                                ///< of a run: wait for windows that are still to come
  bool live = false;                                  ///< of a run: another process writes to it
  bool reproduce = false;                             ///< of a run: integrate its windows again
  std::optional<std::filesystem::path> scene_folder;  ///< where the run's scene file was; nothing: the run's folder
  std::optional<std::chrono::steady_clock::time_point> deadline;
  const std::atomic<bool>* stop = nullptr;  ///< polled; when it becomes true, the outcome has what is settled so far
  /// Called with what is done, and the share of it in [0, 1]: "look", then "verify"; "wait" for windows still to come.
  /// Calls do not overlap.
  std::function<void(std::string_view work, double share)> progress;
  std::optional<std::filesystem::path> trajectory;  ///< a file that all frames are written to, for checkers
  std::optional<std::filesystem::path> proof;       ///< the file where the user wants it, as reports name it
  bool check = true;                                ///< the checker looks at the proof: reports say whether it did
  /// Where the proof of a claim is written to, called once at most; empty: none is made. See proof_to_file(). The sink
  /// is called from any thread, one at a time, also while `progress` is.
  std::function<std::unique_ptr<Sink>(const Claim&)> open_proof;
  /// Call open_proof before the first step of frames is decided, and write the proof of this step while it is found
  /// (not with a least distance, exclusions, `only_new`, or frames in no file), so that a checker reads them meanwhile.
  /// If the step has no proof after all, the sink is truncated to the length that it had before.
  bool open_proof_at_once = false;

  /// Without a proof there is no answer.
  bool needs_proof() const { return proof || min_distance > 0; }
  /// What messages call a step: "window" of a run, "frame" at rest, "step".
  const char* step_word() const { return run ? "window" : constant_motion ? "frame" : "step"; }

  /// Puts `frames` into `order`. Throws InputError when they are given against their numbers.
  void put_in_order();
};

/// `too_near`: nothing touches, but something comes nearer than min_distance. `proved`: no contact, and the checker
/// accepted the proof.
enum class Verdict { no_contact, proved, contact, too_near, undecided };

/// The name used in JSON: "no_contact", "proved", "contact", "too_near", "undecided".
constexpr std::string_view name(Verdict verdict) {
  switch (verdict) {
    case Verdict::no_contact: return "no_contact";
    case Verdict::proved: return "proved";
    case Verdict::contact: return "contact";
    case Verdict::too_near: return "too_near";
    case Verdict::undecided: return "undecided";
  }
  return "";
}

/// "face shirt[17]" as the body counts its faces, "cell 17 (cloth)" of a run, "cell 17" where bodies have no names.
using CellNames = std::array<std::string, 2>;

struct ListedInitial {
  std::size_t step = 0;  ///< from 1
  InitialIntersection pair;
  CellNames names = {};
};

/// Two cells that come nearer than min_distance, and approximately when.
struct ListedNear {
  std::size_t step = 0;  ///< from 1
  TooNear pair;
  bool witnessed = false;  ///< a witness in the proof shows it exactly
  CellNames names = {};
};

/// What was found in one step.
struct StepCounts {
  ContactCounts contacts{};
  std::uint64_t initial_intersections = 0;
  bool goes_on = false;  ///< features meet at the beginning of the step, and were counted in the step before
  /// Of its contacts. Few steps have one, so it takes memory of its own, which copies share.
  std::shared_ptr<ListedContact> first;

  std::uint64_t contact_count() const { return contacts[0] + contacts[1] + contacts[2] + contacts[3]; }
  bool touches() const { return contact_count() + initial_intersections > 0; }
};

/// How a run ended, according to its log and its scene. No verdict depends on it.
struct RunEnding {
  std::optional<std::string> why;  ///< why the last part ended ("done", "contact", ...), if no other began after it
  bool going_on = false;           ///< the last part has not ended, or was killed
  bool being_written = false;      ///< it has not ended: another process writes to it
  double time = 0;                 ///< of the last window [s]
  std::optional<double> duration;  ///< of the scene [s]
  std::optional<std::uint64_t> windows_total;  ///< those written, plus the least number still to come
  bool some_ended_early = false;               ///< some windows are short, so more may follow

  bool whole() const { return duration && time >= *duration; }
};

struct VerifyOutcome {
  Verdict verdict = Verdict::undecided;
  int dimension = 3;
  std::size_t vertices = 0, faces = 0, edges = 0, points = 0;
  std::size_t merged_vertices = 0;
  NotCompared not_compared;               ///< of a run, or --ignore
  std::size_t unreferenced_vertices = 0;  ///< and therefore ignored
  std::size_t steps_total = 0;            ///< of the frames or the run, decided or not
  std::vector<StepCounts> steps;          ///< of the steps that were begun, in order
  bool complete = true;                   ///< everything was decided; otherwise the counts are lower bounds
  bool interrupted = false;               ///< by the user
  bool out_of_time = false;
  bool open_window = false;         ///< a run that ends in a window which was never committed
  bool only_frames = false;         ///< a run that recorded only frames: no file has its world lines
  std::optional<RunEnding> ending;  ///< of a run
  ContactCounts contacts{};
  std::uint64_t initial_intersections = 0;
  std::vector<InitialIntersection> baseline;  ///< with only_new: pairs of cells that intersect in the first frame
  std::optional<ListedContact> first;
  /// At most max_reports contacts, shared as evenly as possible among the steps that have any. Each step lists its
  /// first contact first, if that is known, then others in the order of noli/findings.h.
  std::vector<ListedContact> reports;
  std::vector<ListedInitial> initial_reports;
  StageCounters stages;
  std::uint64_t obligations = 0;
  std::uint64_t cell_pairs = 0;
  double seconds = 0;                               ///< wall clock without reading
  double read_seconds = 0;                          ///< wall clock of reading
  bool reproduced = false;                          ///< the windows were integrated again, with the run's hashes
  double reproduce_seconds = 0;                     ///< wall clock of that
  bool no_proof = false;                            ///< nothing touches, but no proof of it was found
  std::optional<ListedNear> near;                   ///< which cells come too near
  std::optional<LargestDistance> largest_distance;  ///< what the first time allows, if it is less than was asked for
  bool proof_begun = false;                         ///< something was written where the proof goes
  std::size_t witnesses = 0;                        ///< written to the proof
  Claim claim;                                      ///< what is asked; not known yet while its hash of cells is empty
  std::optional<CheckerVersion> checker;            ///< which checker checked the proof
  std::optional<std::string> checked;               ///< what the checker said about the proof
  std::optional<std::string> not_checked;           ///< why it was not checked although the user did not forbid it
  double proof_seconds = 0;                         ///< wall clock of making the proof
  double check_seconds = 0;                         ///< wall clock of waiting for the checker
  std::vector<FrameBody> bodies;                    ///< where they are in the mesh; empty if frames have no bodies
  std::vector<FrameFacts> inputs;                   ///< files that were read: frames in the order of time, or a run's
  std::vector<std::string> notes;                   ///< remarks, one line each

  /// Of frames: how many there are, as far as is known, and what messages call the k-th.
  std::uint64_t frame_count() const;
  std::string frame_name(std::size_t k) const;
  std::uint64_t contact_count() const { return contacts[0] + contacts[1] + contacts[2] + contacts[3]; }
  bool touches() const { return contact_count() + initial_intersections > 0; }
  /// Whether a witness shows that something comes too near.
  bool is_too_near() const { return near && near->witnessed; }
  /// The first step, from 1, in which something touches, or is or may be too near: the last one that was looked at for
  /// the least distance. Empty if there is no such step.
  std::optional<std::size_t> last_for_distance() const;
  /// Whether to stop, because of a request or the time limit; notes which.
  bool stop_for(const VerifyRequest& request);
};

/// Verifies frames, or a run (request.run) window by window; of a run also that each window begins where the last one
/// ended. When it is asked to stop or at the deadline, it returns what was settled so far. Throws InputError,
/// Stopped (a stop while the frames are opened), UsageError (options that do not go together), HelperError (what reads
/// HDF5), std::system_error (the proof), std::bad_alloc.
VerifyOutcome run_verify(const VerifyRequest& request);

}  // namespace noli
