// SPDX-License-Identifier: Apache-2.0
//
// Did anything touch in this window of a run? Exact, for vertices with breakpoints of their own.
//
// Notation
//   window   [T0, T1], the common first and last time of all world lines; between its own breakpoints each vertex moves
//            linearly
//   span     a part of the window. Where many vertices stray far from straight lines the window is cut in spans, unless
//            something meets: then it is walked through once more in one, so that each pair counts once
//   chord    a straight line near a world line over a while, with the radius by which it strays
//            (proofs/prover/windows/chord.h)
//   scripted pairs   pairs of cells all of whose vertices are scripted: not looked at; nor are excluded ones
//
// Which pairs of features are counted: as in proofs/prover/verifier.h, each once if it meets anywhere in the closed
// window. In order of cost: sheets that are monotone as a whole (proofs/prover/windows/monotone.h); the walk over pairs
// of groups, over chords, where boxes and directions have to hold with the radii added, and where what is monotone
// around both (proofs/prover/windows/chords.h) is settled at once; time cut for the pair of cells in
// question, until a direction holds or no breakpoint is left inside; each of its pairs of features the same way; and
// what resists in a piece without breakpoints is decided exactly (include/noli/contact.h, kernel/motion.h).
//
// What this does not do: it writes no files (proofs/prover/tokens/proof_file.h), and reads none.
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

class Forest;
class MeshPaths;

/// `prove` is not looked at.
struct WindowOptions : VerifyOptions {
  std::span<const std::uint8_t> scripted;  ///< one per vertex, not 0 if scripted; empty: none is
  const Exclusions* exclusions = nullptr;  ///< or none; for the mesh's vertices
};

/// The first contact of a window.
struct FirstInWindow {
  FeatureContact contact;  ///< `first` are neighbouring doubles, or equal if the time is a double
  ContactKind kind;
  Moment time;

  /// The largest double that is not greater than the exact time.
  double lower() const { return contact.first.begin; }
};

/// Times are in the unit of the world lines. A pair of features is counted in `stages` once for each piece in which it
/// reached the kernel.
struct WindowResult : Findings {
  std::optional<FirstInWindow> first;
};

/// What is claimed of distances beside that nothing touches.
struct LeastDistance {
  double eta = 0;                    ///< features are more than that apart
  const MeshPaths* paths = nullptr;  ///< except those that a short path joins; not needed where `eta` is 0
};

/// Verifies windows of one run, one after another.
class WindowVerifier {
 public:
  /// Takes what does not change from window to window: `x`, a position for each vertex, decides how cells are grouped
  /// and laid out, not what is answered; best is where the run begins, or a rest shape. Of the options it takes
  /// dimension, strict, scripted and exclusions, which hold from now on. Preconditions: there are x.size() =
  /// mesh.vertex_count vertices, every index of the mesh is below that, there are fewer than 2^31 cells, `scripted` is
  /// empty or has an entry for each vertex. O(n log n).
  WindowVerifier(const Mesh& mesh, std::span<const Position> x, const WindowOptions& options);

  /// Precondition: the lines have as many vertices as the mesh. In two dimensions the third coordinate is not looked
  /// at.
  /// Deterministic, for any number of threads, as verify_step is. Memory is linear in the mesh, beside the lines. May
  /// be called from several threads at once. Throws std::bad_alloc, and what `progress` throws.
  WindowResult verify(const WorldLines& lines, const WindowOptions& options) const;

  /// The tree of its proofs: the payload of block TREE (proofs/FORMAT.md). Precondition, here and below: there are
  /// cells.
  std::string encoded_tree() const;

  /// Writes the proof of a window in which nothing touches: gives `take` payloads of blocks TOKS, in order, from one
  /// thread at a time. They depend on the lines, the mesh and the claim alone. Tokens are made by several threads and
  /// given away in order: what is behind the slowest task waits in memory. False if it was stopped (stop,
  /// deadline). Ask verify() first: where there is a contact, this gives up only after a long time. Throws TooNear,
  /// NoProof, std::bad_alloc, and what `take` throws. Of the options only threads, stop and deadline count.
  bool prove(const WorldLines& lines, const VerifyOptions& options, const LeastDistance& distance,
             const std::function<void(std::string_view)>& take) const;

 private:
  std::shared_ptr<const Forest> forest_;  ///< nullptr if there are no cells
  int dimension_;
  bool strict_;
};

}  // namespace noli
