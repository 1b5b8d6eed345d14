// SPDX-License-Identifier: Apache-2.0
//
// Decides exactly whether anything touched between two frames, accounting for every pair of features.
//
// Notation
//   cell        a face, a loose edge or a loose point of the mesh; its features are its vertices, edges and itself
//   x_t0, x_t1  positions of the vertices at the beginning and at the end of the step; between them each moves linearly
//   obligation  a pair of groups of cells (or a group with itself) whose vertex-disjoint features must be shown apart
//
// The verifier walks a hierarchy of groups. A separating direction closes an obligation; without one, the groups are
// split. A pair of cells that no direction separates is taken apart into its pairs of features, and the exact kernel
// decides each. Which pairs of features are counted:
//   3D  vertex_face    every vertex of a cell (loose points included) against every face
//       edge_edge      every edge of a face and every loose edge, against every other
//       vertex_edge    a vertex of one cell against an edge of another, for which no vertex_face or edge_edge pair of
//                      these two cells stands
//   2D  vertex_edge    every vertex of a cell against every edge
//   both vertex_vertex a vertex of one cell against one of another, for which no larger pair of these two cells stands
// Each pair counts once; only pairs that share no vertex and belong to two different cells count. A pair stands for
// another if its two features contain the two of the other: whenever those meet, it meets too. So vertex_edge in 3D is
// a loose point against a loose edge. It is also c against ab, if ac and ab are loose edges (even if other cells have
// the edge_edge pair (cd, ab)), if one of the two is a loose cell and the other is in the face abc, or if the face abc
// is listed twice. vertex_vertex is two loose points. It is also p against q, for the loose edge pq and a loose point
// p, or if the edge is listed twice. A face that has a vertex twice is treated likewise
// (proofs/prover/cells/leftover.h). A closed or bordered mesh of faces, each with three vertices and listed once, has
// only vertex_face and edge_edge.
//
// With `strict` these count too, unless counted above: in 3D each corner of a face against the opposite edge, as
// vertex_edge; in 2D the pairs of one cell; the two ends of a loose edge, as vertex_vertex. An edge is a pair of vertex
// ids, no matter which cells list it and how often; a face that is listed twice is two faces. If two cells meet, some
// pair of features meets, or the cells meet from the beginning. Vertices are identified by index and never merged.
//
// It can give the tokens of a proof; proofs/prover/tokens/proof_file.h writes the file.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <noli/contact.h>
#include <noli/findings.h>
#include <noli/mesh.h>
#include <noli/query.h>
#include "proofs/prover/chain.h"
#include "proofs/prover/tokens/tokens.h"

namespace noli {

class Baseline;

/// Part `index` of `of` of the work on one step: about the same number of tasks (proofs/prover/task_walk.h) each.
/// Joined in order, the parts have the findings and the proof of the step.
struct StepPart {
  std::uint32_t index = 0, of = 1;
};

/// Takes the proof of a step while the step is decided: the tree, then the tokens in order. It is called from any
/// thread, one at a time. If the step turns out to have no proof, what it got counts for nothing.
class ProofReceiver {
 public:
  ProofReceiver() = default;
  virtual ~ProofReceiver() = default;
  ProofReceiver(const ProofReceiver&) = delete;
  ProofReceiver& operator=(const ProofReceiver&) = delete;

  /// See encoded_tree(). The cells stay where they are until the last call.
  virtual void tree(std::span<const std::uint32_t> leaf_cells) = 0;
  virtual void tokens(std::string_view bytes) = 0;
};

struct VerifyOptions {
  int dimension = 3;    ///< 2 or 3; in 2 the third coordinate is ignored
  int threads = 0;      ///< 0: all there are
  bool initial = true;  ///< look for intersections at the beginning of the step
  /// A step came before, and counted the pairs of features that meet at the beginning of this one: they are counted in
  /// `going_on` alone.
  bool after_step = false;
  bool first_only = false;  ///< stop at any contact or initial intersection, deterministically chosen
  bool strict = false;      ///< also compare the vertex-disjoint features of one cell (a face that degenerates)
  std::size_t max_reports =
      100;  ///< the most contacts and initial intersections that are listed; counts are always exact
  const std::atomic<bool>* stop = nullptr;  ///< polled; when it becomes true the result is incomplete
  std::optional<std::chrono::steady_clock::time_point> deadline;
  std::function<void(double)> progress;  ///< called from any thread, one at a time, with the share done in [0, 1]
  bool prove = false;                    ///< also writes the proof that nothing touches, if nothing does
  const Baseline* baseline = nullptr;    ///< pairs of cells that are not compared; not with `prove`
  /// What the step before left, and then this one leaves; nothing at the beginning of a chain. All steps of a chain
  /// have the same mesh, `dimension` and `strict`. It may change `obligations`, `cell_pairs`, `stages` and the proof.
  std::unique_ptr<ChainMemory>* chain = nullptr;
  /// Only this part of the step; not with `first_only`. `chain` then has what another part of the same step left.
  StepPart part = {};
  /// Takes the proof, piece by piece; with `prove`, and not with `part`.
  ProofReceiver* receiver = nullptr;
};

/// The proof that nothing touches in a step (proofs/FORMAT.md, TREE and TOKS).
struct StepProof {
  std::vector<std::uint32_t> leaf_cells;  ///< the tree: see encoded_tree(); empty in all parts but the first
  JoinedTokens tokens;
};

struct VerifyResult : Findings {
  /// The contact with the least first time, if there is any; ties: the first in canonical order.
  std::optional<FeatureContact> first;
  /// Set if `prove` was set, the step, or the part, is complete, and nothing meets in it; unless parts come so near
  /// each other that no proof was found. Not set if a receiver took the proof.
  std::shared_ptr<const StepProof> proof;
  bool receiver_has_proof = false;  ///< the receiver took the whole proof
};

/// Verifies one step. Preconditions: both spans have mesh.vertex_count finite positions, every index of the mesh is
/// below that, and there are fewer than 2^31 cells. Deterministic: the result depends only on the input and on
/// `dimension`, `initial`, `after_step`, `first_only`, `strict`, `max_reports`, `part`, `chain` (unless stopped by
/// `stop` or `deadline`), not on the number of threads. With `prove`, directions are rounded to the bits of short
/// tokens; this may change `obligations`, `cell_pairs` and `stages`, and nothing else. Memory is linear in the mesh and
/// the proof. Throws std::bad_alloc, and what `progress` and `receiver` throw.
VerifyResult verify_step(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1,
                         const VerifyOptions& options);

}  // namespace noli
