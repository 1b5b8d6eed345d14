// SPDX-License-Identifier: Apache-2.0
//
// Repairs a sequence of frames that touches: gives another one, near it, in which nothing does.
//
//   noli::RepairRequest request;
//   request.frames = {"cloth_1.ply", "cloth_2.ply"};
//   request.pattern = "out/cloth_%03d.ply";
//   const noli::RepairOutcome outcome = noli::run_repair(request);
//   if (outcome.end == noli::RepairEnd::done) ...  // outcome.verified is what noli/verify.h says of the new frames
//
// Notation
//   y_k     the given frame k
//   x_k     the repaired one. x_0 = y_0; each step goes from x_k towards y_(k+1)
//   step    takes one unit of time; steps count from 1
//
// A step whose straight lines touch nothing ends in y_(k+1). In any other step vertices are masses with the velocities
// y_(k+1) - x_k, on which contact alone acts, by the method of Harmon et al., "Asynchronous Contact Mechanics" (2009):
// a velocity filter. A vertex that nothing strikes ends in y_(k+1), bit for bit. Where the straight lines from x_k to
// x_(k+1) touch although the motion in between does not, frames are inserted.
//
// Thickness, stiffness and step of the layers of contact decide how far vertices are moved and how long that takes,
// never whether the answer is true: every step that is written has been decided in exact arithmetic.
//
// Units: those of the files; times in steps (in a run, seconds). Errors: as run_repair says. Thread safety: any number
// of repairs may run at once, each with its own folders and stop; nothing is printed.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <noli/findings.h>
#include <noli/frames.h>
#include <noli/verify.h>

namespace noli {

struct RepairRequest {
  std::vector<std::filesystem::path> frames;  ///< files in the order of time, or all files of `reading.bodies`
  FrameOrder order = FrameOrder::checked;     ///< as in VerifyRequest
  FrameReading reading;                       ///< bodies are joined: the new frames are of one mesh
  std::string pattern;  ///< of the new frames, with one %d or %0Nd; its ending names the format: .ply, .obj, .vtu
  bool force = false;   ///< existing files of that pattern may be replaced or removed
  bool resume =
      false;  ///< continue an earlier repair of the same frames with the same options, also one that was killed
  std::optional<int> dimension;                     ///< as in VerifyRequest
  int threads = 0;                                  ///< threads of the exact decisions; 0: all there are
  bool points = false;                              ///< vertices that no cell refers to are particles
  std::optional<std::filesystem::path> ignore;      ///< groups that are not compared, and may pass through each other
  bool only_new = false;                            ///< cells that intersect in the first frame may go on so
  std::uint64_t fixed_first = 0;                    ///< the first N vertices move as given
  std::vector<VertexId> fixed_listed;               ///< these too
  std::optional<std::filesystem::path> fixed_file;  ///< the file that lists them: no output may replace it
  std::vector<std::string> fixed_bodies;            ///< these too, by name; bodies that stand still always do
  std::optional<double> thickness;                  ///< the gap that is aimed at; nothing: from the mesh
  /// "size": by area and length; "uniform"; else the name of a text file with a positive number for each vertex.
  std::string masses = "size";
  double restitution = 0.1;  ///< share of the energy of an approach that comes back, 0 to 1
  double friction = 0;       ///< Coulomb's coefficient
  /// What is moved takes its surroundings along, over about so many edges; 0: contact alone decides where vertices go.
  std::uint64_t spread = 0;
  /// Also write the motion to this folder, as a run: each step is a window of one second, in which vertices move as
  /// contact moved them, or on straight lines between the new frames (straight_windows). Not with only_new.
  std::optional<std::filesystem::path> run;
  std::optional<std::filesystem::path> proof;  ///< where the proof about the new frames goes
  bool check = true;                           ///< the checker looks at it
  std::optional<std::chrono::steady_clock::time_point> deadline;
  const std::atomic<bool>* stop = nullptr;  ///< polled
  /// Called with what is done, and the share of it in [0, 1]: "repair", then those of run_verify. Calls do not overlap.
  std::function<void(std::string_view work, double share)> progress;
};

enum class RepairEnd : std::uint8_t {
  done,           ///< all frames are written
  start_touches,  ///< something meets in the first frame
  blocked,        ///< vertices that move as given pass through each other
  undecided,  ///< no way was found for a step: `obstacle` may say which features came too close for double precision
  interrupted,
  out_of_time
};

/// The name used in JSON.
const char* name(RepairEnd end);

/// A step that was changed, or could not be.
struct RepairedStep {
  std::size_t step = 0;         ///< from 1
  std::size_t inserted = 0;     ///< frames between its first and its last
  std::uint64_t moved = 0;      ///< vertices that do not end where they were given
  double largest = 0, rms = 0;  ///< distance of these from where they were given
  VertexId vertex = 0;          ///< the one with the largest
  std::uint32_t deepest = 0;    ///< the deepest layer that acted
};

/// How much a body was moved.
struct RepairedBody {
  std::string name;
  bool fixed = false;           ///< moves as given
  std::uint64_t moved = 0;      ///< vertices that did not end where they were given, counted anew in each step
  double largest = 0, rms = 0;  ///< distance of these from where they were given
};

/// Features that cannot be kept apart, and when.
struct RepairObstacle {
  std::size_t step = 0;  ///< from 1; 0: the first frame
  double time = 0;       ///< in [0, 1] of the step
  FeaturePair kind = FeaturePair::vertex_face;
  std::array<VertexId, 4> vertices{};  ///< as in FeatureContact
  bool cells = false;                  ///< vertices[0] and [1] are cells, which intersect in the first frame
  CellNames names = {};                ///< of these cells
};

/// A frame that was written.
struct RepairedFrame {
  double time = 0;   ///< in steps
  std::string what;  ///< "copied", byte for byte from the given file; "given", the same numbers; "repaired"; "inserted"
  FrameFacts facts;  ///< name, bytes and hash alone
};

struct RepairOutcome {
  RepairEnd end = RepairEnd::done;
  int dimension = 3;
  std::size_t vertices = 0, cells = 0, frames_given = 0, steps_total = 0;
  std::size_t steps = 0;              ///< repaired or passed on
  std::size_t steps_before = 0;       ///< of these, by earlier calls (resume)
  std::vector<RepairedStep> changed;  ///< in the order of time
  std::vector<RepairedBody> by_body;  ///< of bodies with names
  std::vector<FrameBody> bodies;      ///< where they are in the mesh; empty if frames have no bodies
  std::uint64_t fixed = 0;            ///< vertices that move as given
  std::uint64_t baseline = 0;         ///< with only_new: pairs of cells that intersect in the first frame
  /// What fixed vertices took: relative to the mean mass of a vertex, times length per step.
  Position momentum_into_fixed{};
  std::size_t frames = 0;    ///< that are written
  std::size_t inserted = 0;  ///< of these, between given ones
  std::size_t as_given = 0;  ///< of these, with the positions that were given
  std::size_t copied = 0;    ///< of these, byte for byte the given files
  double thickness = 0;      ///< of the first layer, where the mesh is coarse
  double mean_edge = 0;      ///< of the first frame: a scale for distances
  std::optional<RepairObstacle> obstacle;
  std::filesystem::path times;            ///< the table of frames and their times
  std::uint64_t removed = 0;              ///< files of an earlier repair that were not replaced
  std::optional<VerifyOutcome> verified;  ///< what `noli verify` says of the new frames, if all are written
  std::vector<FrameFacts> inputs;         ///< the given files
  std::vector<RepairedFrame> written;     ///< by this call and those before it (resume), in the order of time
  bool run_begun = false;                 ///< `run` of the request has the motion so far
  /// Of the run's windows by this call, those that have the straight lines between the new frames, since the motion
  /// that was filtered touches once its times are rounded.
  std::uint64_t straight_windows = 0;
  std::vector<std::string> notes;
  double seconds = 0;  ///< wall clock
};

/// Throws InputError, Stopped (a stop while the frames are opened), UsageError (the pattern; the folder of the run;
/// options that do not go together), HelperError (what reads HDF5; the checker), WriteError and std::system_error (the
/// disk), std::runtime_error (there is no checker), std::bad_alloc.
RepairOutcome run_repair(const RepairRequest& request);

}  // namespace noli
