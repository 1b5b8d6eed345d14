// SPDX-License-Identifier: Apache-2.0
//
// Charts: where a part of a mesh is no sheet (proofs/prover/windows/sheet.h), small groups of its faces laid out by
// themselves, with enough around them that faces next to a group are settled with it.
//
// Notation
//   group    a node of a tree whose leaves are faces
//   r        here: the projection of the given positions along the mean normal of the group's faces, rounded, linear on
//            each face; its values at the vertices are the layout
//   Q        the least rectangle that holds the layout of the group and of all faces that share a vertex with it
//   S        faces, the group's among them: all that are reached over shared vertices by way of faces whose own
//            rectangle overlaps Q, that is, has points inside Q in common with it
//
// Claim: r maps the points of S that are laid out in Q one to one to Q if (1) each face of S is laid out strictly
// counterclockwise; (2) S has no edge twice in one direction; (3) the edges without an opposite do not overlap Q; (4)
// some point inside Q is inside exactly one face and on no other. Proof. As in proofs/prover/windows/sheet.h: a point
// off all edges is covered as often as the edges of (3) wind around it, which inside Q is always the same, by (4) once.
// So the faces cover Q, and do not overlap in it. Around a point in Q (on its border: in the half or quarter disc
// around it that is in Q) the faces are sectors, each joined to the next by an edge that overlaps Q and so has both of
// its faces: they share the point.
// So no other point of S is laid out there. All four are decided exactly. (An edge whose face beyond is not in S does
// not overlap Q, as the rectangle of that face does not.)
//
// Then the claim of proofs/prover/windows/monotone.h holds for the faces of S and Q: its proof needs no more than that
// a segment in Q is the layout of a path. So where S is monotone, nothing that is laid out in Q meets: the group, all
// faces next to it, and what else of S is in Q.
//
// What this does not do: borders of the mesh mostly have no charts, nor have places where it bends by more than about a
// right angle within a few faces, or where faces are not oriented alike.
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

  /// `cells`: by leaf. `roots`: the trees that are to have charts; all leaves below them are faces.
  Charts(const Mesh& mesh, std::span<const Position> x, int dimension, std::span<const std::uint32_t> cells,
         std::span<const Group> roots);

  std::size_t size() const { return groups_.size(); }
  /// S of a chart.
  std::span<const LaidFace> faces(std::size_t chart) const {
    return std::span(faces_).subspan(first_face_[chart], first_face_[chart + 1] - first_face_[chart]);
  }
  /// The chart of the group that a group is, or is a part of; `none` if it has none.
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
  std::vector<Run> runs_;  ///< for each chart the leaves that are laid out in Q, ascending
  std::vector<std::uint32_t> chart_of_leaf_;
};

}  // namespace noli
