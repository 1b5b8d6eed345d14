// SPDX-License-Identifier: Apache-2.0
//
// Did anything touch in this window of a run? Exact, for vertices with breakpoints of their own.
//
// Notation
//   window   [T0, T1], the common first and last time of all world lines; between its own breakpoints each vertex
//            moves linearly
//   chord    a straight line near a world line over a while, with the radius by which it strays (proofs/prover/chord.h)
//   scripted pairs   pairs of cells all of whose vertices are scripted: not looked at
//
// Which pairs of features are counted: as in proofs/prover/verifier.h, each once if it meets anywhere in the closed
// window. The same walk over pairs of groups, but over chords: boxes and directions have to hold with the radii added.
// Where they do not, time is cut for the pair of cells in question, until a direction holds or no breakpoint is left
// inside; then each of its pairs of features is cut further in the same way, and what resists in a piece without
// breakpoints is decided exactly (kernel/contact.h, kernel/motion.h).
//
// What this does not do: it writes no proof, knows no thickness, and reads no files.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "noli/kernel/first_contact.h"
#include "noli/kernel/moment.h"
#include "noli/proofs/prover/verifier.h"
#include "noli/trajectory/mesh.h"
#include "noli/trajectory/world_lines.h"

namespace noli {

/// Fields as in VerifyOptions where they are called so.
struct WindowOptions {
  int dimension = 3;
  int threads = 0;
  bool initial = true;  ///< look for intersections at T0
  bool first_only = false;
  bool strict = false;
  std::size_t max_reports = 100;
  std::span<const std::uint8_t> scripted;  ///< one per vertex, not 0 if scripted; empty: none is
  const std::atomic<bool>* stop = nullptr;
  std::optional<std::chrono::steady_clock::time_point> deadline;
  std::function<void(double)> progress;
};

/// The first contact of a window.
struct FirstInWindow {
  FeatureContact contact;  ///< `first` are neighbouring doubles, or equal if the time is a double
  ContactKind kind;
  Moment time;

  /// The largest double that is not greater than the exact time.
  double lower() const { return contact.first.begin; }
};

/// As VerifyResult; times are in the unit of the world lines.
struct WindowResult {
  bool complete = true;
  std::array<std::uint64_t, all_feature_pairs.size()> contacts{};
  std::uint64_t initial_intersections = 0;
  std::vector<FeatureContact> reports;  ///< `first` contains the first time at which they meet, in [T0, T1]
  std::vector<InitialIntersection> initial_reports;
  std::optional<FirstInWindow> first;
  StageCounters stages;  ///< counts each pair of features once for each piece in which it reached the kernel
  std::uint64_t obligations = 0;
  std::uint64_t cell_pairs = 0;

  std::uint64_t contact_count() const { return contacts[0] + contacts[1] + contacts[2] + contacts[3]; }
};

/// Verifies one window. Preconditions: the lines have mesh.vertex_count vertices, every index of the mesh is below that,
/// there are fewer than 2^31 cells, `scripted` is empty or has an entry for each vertex. In two dimensions the third
/// coordinate is not looked at. Deterministic, for any number of threads, as verify_step is. Memory is linear in the
/// mesh, beside the lines. Throws std::bad_alloc, and what `progress` throws.
WindowResult verify_window(const Mesh& mesh, const WorldLines& lines, const WindowOptions& options);

}  // namespace noli
