// SPDX-License-Identifier: Apache-2.0
//
// Decides exactly whether anything touched in a window of a run, in which vertices have breakpoints of their own.
//
// Notation
//   window   [T0, T1], the common first and last time of all world lines; between its own breakpoints each vertex moves
//            linearly
//   span     a part of the window. If many vertices stray far from straight lines, the window is cut into spans. If
//            something meets, the window is walked once more as one span, so that each pair counts once
//   chord    a straight line near a world line over a time interval, with the radius by which it strays
//            (proofs/prover/windows/chord.h)
//   scripted pairs   pairs of cells whose vertices are all scripted. They are not compared, and neither are excluded
//                    ones
//
// Which pairs of features are counted: as in proofs/prover/verifier.h, each once if it meets anywhere in the closed
// window. The steps, in order of cost:
//   1. Sheets that are monotone as a whole (proofs/prover/windows/monotone.h).
//   2. The walk over pairs of groups, over chords: boxes and directions must hold with the radii added. Groups with a
//      monotone surface around both (proofs/prover/windows/chords.h) are settled at once.
//   3. For a pair of cells, time is cut until a direction holds or no breakpoint is left inside.
//   4. The same for each of its pairs of features.
//   5. Pairs that resist in a piece without breakpoints are decided exactly (include/noli/contact.h, kernel/motion.h).
//
// proofs/prover/tokens/proof_file.h writes proof files.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <noli/mesh.h>
#include <noli/time_of_impact.h>
#include "kernel/moment.h"
#include "proofs/prover/verifier.h"
#include "trajectory/world_lines.h"

namespace noli {

struct CellLabels;
class Forest;
class MeshPaths;

/// `prove` is ignored.
struct WindowOptions : VerifyOptions {
  std::span<const std::uint8_t> scripted;  ///< one per vertex, nonzero if scripted; empty: none is
  const Exclusions* exclusions = nullptr;  ///< for the mesh's vertices; nothing: none
  const CellLabels* labels = nullptr;      ///< instead of these two, for proofs alone
};

/// The first contact of a window.
struct FirstInWindow {
  FeatureContact contact;  ///< the ends of `first` are neighbouring doubles, or equal if the time is a double
  ContactKind kind;
  Moment time;

  /// The largest double that is not greater than the exact time.
  double lower() const { return contact.first.begin; }
};

/// Times are in the unit of the world lines. `stages` counts a pair of features once for each piece in which it reached
/// the kernel.
struct WindowResult : Findings {
  std::optional<FirstInWindow> first;
};

/// What is claimed about distances, besides that nothing touches.
struct LeastDistance {
  double eta = 0;                    ///< features are more than this apart
  const MeshPaths* paths = nullptr;  ///< except those joined by a short path; not needed if `eta` is 0
};

/// Verifies windows of one run, one after another.
class WindowVerifier {
 public:
  /// Takes what does not change from window to window. `x`, a position for each vertex, decides how cells are grouped
  /// and laid out, but not the answer; best are the first positions of the run, or a rest shape. Of the options it
  /// takes dimension, strict, scripted and exclusions, for all windows. Preconditions: x.size() = mesh.vertex_count,
  /// every index of the mesh is below that, there are fewer than 2^31 cells, `scripted` is empty or has an entry for
  /// each vertex. O(n log n).
  WindowVerifier(const Mesh& mesh, std::span<const Position> x, const WindowOptions& options);

  /// Precondition: the lines have as many vertices as the mesh. In two dimensions the third coordinate is ignored.
  /// Deterministic for any number of threads, like verify_step. Memory is linear in the mesh, besides the lines. May be
  /// called from several threads at once. Throws std::bad_alloc, and what `progress` throws.
  WindowResult verify(const WorldLines& lines, const WindowOptions& options) const;

  /// The tree of its proofs: the payload of block TREE (proofs/FORMAT.md). Precondition of this and below: there are
  /// cells.
  std::string encoded_tree() const;

  /// Writes the proof of a window in which nothing touches: passes payloads of blocks TOKS to `take`, in order, from
  /// one thread at a time. They depend only on the lines, the mesh and the claim. Several threads make tokens; those
  /// after the slowest task wait in memory. False if it was stopped (stop, deadline). Call verify() first: if there is
  /// a contact, this gives up only after a long time. Throws TooNear, NoProof, std::bad_alloc, and what `take` throws.
  /// Of the options only threads, stop and deadline count.
  bool prove(const WorldLines& lines, const VerifyOptions& options, const LeastDistance& distance,
             const std::function<void(std::string_view)>& take) const;

 private:
  std::shared_ptr<const Forest> forest_;  ///< nullptr if there are no cells
  int dimension_;
  bool strict_;
};

}  // namespace noli
