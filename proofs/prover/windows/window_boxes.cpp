// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/windows/window_boxes.h"

#include <algorithm>
#include <limits>

#include "kernel/parallel.h"

namespace noli {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

GroupBox empty_box() { return {lanes(infinity), lanes(infinity), lanes(-infinity), lanes(-infinity)}; }

}  // namespace

template <int Dim>
WindowBoxes<Dim>::WindowBoxes(const Forest& forest, const WindowChords<Dim>& chords, int threads, bool monotone)
    : forest_(forest), chords_(chords), threads_(threads), asked_monotone_(monotone) {
  if (forest.trees().size() > 1) find_phi();
  bound_roots();
}

template <int Dim>
void WindowBoxes<Dim>::find_phi() {
  for (std::size_t k = 0; k < Dim; ++k) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (const auto& chord : chords_.of) {
      low = std::min(low, std::min(chord.x[k].at_t0(), chord.x[k].at_t1()));
      high = std::max(high, std::max(chord.x[k].at_t0(), chord.x[k].at_t1()));
    }
    phi_[k] = Phi::onto_unit(low, high);
  }
}

template <int Dim>
void WindowBoxes<Dim>::bound_roots() {
  const auto& trees = forest_.trees();
  for (const Tree& tree : trees) {
    const auto box = [&](std::size_t i) { return box_around(chords_.of[tree.vertices[i]]); };
    root_boxes_.push_back(trees.size() == 1 ? GroupBox{}
                                            : merged_over(tree.vertices.size(), threads_, empty_box(), box));
    root_monotone_.push_back(asked_monotone_ && tree.sheet && sheet_monotone(tree) ? 1 : 0);
  }
}

/// The box of all faces is quick. The box of each face, with the same functionals, is sharper if the sheet is bent and
/// askew.
template <int Dim>
bool WindowBoxes<Dim>::sheet_monotone(const Tree& tree) const {
  const auto tangents = [&](std::size_t i) { return tangents_at(forest_.laid_face(tree.root.begin + i)); };
  const TangentBox box = merged_over(tree.root.count, threads_, empty_tangents(), tangents);
  const Functionals functionals = functionals_for(box, Dim);
  if (hold(products(functionals, box, Dim))) return true;
  const auto of_face = [&](std::size_t i) { return products(functionals, tangents(i), Dim); };
  return hold(merged_over(tree.root.count, threads_, of_face(0), of_face));
}

/// Uses the functionals for the mean of a few faces.
template <int Dim>
bool WindowBoxes<Dim>::chart_monotone(std::span<const LaidFace> faces) const {
  Lanes u{}, v{};
  for (std::size_t i = 0; i < faces.size(); i += 1 + faces.size() / 32) {
    const TangentBox box = tangents_at(faces[i]);
    u += box.low_u + box.high_u;
    v += box.low_v + box.high_v;
  }
  // Their length does not matter.
  const Functionals functionals = functionals_for({u, u, v, v}, Dim);
  Products all = products(functionals, tangents_at(faces[0]), Dim);
  for (const LaidFace& face : faces) all = merged(all, products(functionals, tangents_at(face), Dim));
  return hold(all);
}

/// The radius includes rounding (proofs/prover/windows/chord.h).
template <int Dim>
GroupBox WindowBoxes<Dim>::box_around(const VertexChord<Dim>& chord) const {
  GroupBox box{};
  for (std::size_t k = 0; k < Dim; ++k) {
    const double r = chord.radius[k];
    box.low_t0[k] = phi_[k](chord.x[k].at_t0() - r);
    box.low_t1[k] = phi_[k](chord.x[k].at_t1() - r);
    box.high_t0[k] = phi_[k](chord.x[k].at_t0() + r);
    box.high_t1[k] = phi_[k](chord.x[k].at_t1() + r);
  }
  return box;
}

template <int Dim>
TangentBox WindowBoxes<Dim>::tangents_at(const LaidFace& face) const {
  const auto& near = chords_.near;
  return tangents_of(face, near[face.vertices[0]], near[face.vertices[1]], near[face.vertices[2]]);
}

template <int Dim>
void WindowBoxes<Dim>::join(Group g, bool sheet) {
  boxes_[g.node] = merged(box(g.left()), box(g.right()));
  if (sheet) tangents_[g.node] = merged(tangents(g.left()), tangents(g.right()));
}

template <int Dim>
void WindowBoxes<Dim>::fit(Group g, bool sheet) {
  if (!g.is_leaf()) {
    fit(g.left(), sheet);
    fit(g.right(), sheet);
    return join(g, sheet);
  }
  const auto& [a, b, c] = forest_.leaf(g).vertices;
  boxes_[g.node] = merged(merged(box_around(chords_.of[a]), box_around(chords_.of[b])), box_around(chords_.of[c]));
  if (sheet) tangents_[g.node] = tangents_at(forest_.laid_face(g.begin));
}

template <int Dim>
void WindowBoxes<Dim>::look_at_charts() {
  const Charts& charts = forest_.charts();
  monotone_.resize(charts.size());
  const auto look = [&](std::size_t c) { monotone_[c] = chart_monotone(charts.faces(c)) ? 1 : 0; };
  for_each_in_pieces(charts.size(), threads_, look, 16);
}

template <int Dim>
void WindowBoxes<Dim>::make(const std::vector<std::size_t>& trees) {
  if (trees.empty()) return;
  if (forest_.trees().size() == 1) find_phi();
  boxes_.resize(forest_.node_count());
  for (const std::size_t t : trees) {
    const Tree& tree = forest_.trees()[t];
    const bool sheet = asked_monotone_ && tree.sheet;
    if (asked_monotone_ && tree.part && !tree.sheet && monotone_.empty()) look_at_charts();
    if (sheet && tangents_.empty()) tangents_.resize(forest_.node_count());
    std::vector<Group> inner;
    const std::vector<Group> level = top_groups(
        tree.root, [&](const std::vector<Group>& above) { inner.insert(inner.end(), above.begin(), above.end()); });
    parallel_for(level.size(), threads_, [&](std::size_t i) { fit(level[i], sheet); });
    std::ranges::reverse(inner);  // children before parents
    for (const Group g : inner) join(g, sheet);
  }
}

template class WindowBoxes<2>;
template class WindowBoxes<3>;

}  // namespace noli
