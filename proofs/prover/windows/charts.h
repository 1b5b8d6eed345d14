// SPDX-License-Identifier: Apache-2.0
//
// Charts: layouts of small groups of faces, for parts of a mesh that are not sheets (proofs/prover/windows/sheet.h).
// Each has enough faces around the group that it settles the group's neighbours too.
//
// Notation
//   group    a node of a tree whose leaves are faces
//   r        here: the projection of the given positions along the mean normal of the group's faces, rounded, linear on
//            each face; its values at the vertices are the layout
//   Q        the least rectangle that contains the layout of the group and of all faces that share a vertex with it
//   S        a set of faces with the group: all faces reached over shared vertices, going only through faces whose own
//            rectangle overlaps Q, that is, has points in common with the interior of Q
//
// Claim: r maps the points of S that are laid out in Q one to one to Q if (1) each face of S is laid out strictly
// counterclockwise; (2) S has no edge twice in one direction; (3) the edges without an opposite do not overlap Q; (4)
// some point inside Q is inside exactly one face and on no other. Proof. As in proofs/prover/windows/sheet.h, a point
// off all edges is covered as often as the edges of (3) wind around it. Inside Q this number is constant; by (4) it is
// 1. So the faces cover Q, and do not overlap in it. Around a point in Q (on its border: in the half or quarter disc
// around it that is in Q) the faces are sectors. Each is joined to the next by an edge that overlaps Q and so has both
// of its faces: they share the point. So no other point of S is laid out there. All four conditions are decided
// exactly. (An edge whose face beyond is not in S does not overlap Q, as the rectangle of that face does not.)
//
// Then the claim of proofs/prover/windows/monotone.h holds for the faces of S and Q: its proof needs only that a
// segment in Q is the layout of a path. So if S is monotone, nothing that is laid out in Q meets: the group, all faces
// next to it, and the rest of S in Q.
//
// Borders of the mesh usually have no charts. Neither do places where it bends by more than about a right angle within
// a few faces, or where faces are not oriented alike.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <noli/mesh.h>
#include "proofs/prover/windows/monotone.h"

namespace noli {

class Charts {
 public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  /// `cells`: by leaf. `roots`: the trees that get charts; all leaves below them are faces.
  Charts(const Mesh& mesh, std::span<const Position> x, int dimension, std::span<const std::uint32_t> cells,
         std::span<const Group> roots);

  std::size_t size() const { return groups_.size(); }
  /// The faces S of a chart.
  std::span<const LaidFace> faces(std::size_t chart) const {
    return std::span(faces_).subspan(first_face_[chart], first_face_[chart + 1] - first_face_[chart]);
  }
  /// The chart of a group, or of the larger group that contains it; `none` if there is none.
  std::uint32_t chart_of(Group g) const;
  /// Whether all of a group is laid out in Q.
  bool covers(std::uint32_t chart, Group g) const;

 private:
  friend class ChartMaker;

  /// Successive leaves.
  struct Run {
    std::uint32_t begin, end;
  };

  std::vector<Group> groups_;
  std::vector<std::size_t> first_face_ = {0}, first_run_ = {0};
  std::vector<LaidFace> faces_;
  std::vector<Run> runs_;  ///< for each chart, the leaves that are laid out in Q, ascending
  std::vector<std::uint32_t> chart_of_leaf_;
};

}  // namespace noli
