// SPDX-License-Identifier: Apache-2.0
#include "noli/proofs/prover/window_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "noli/kernel/parallel.h"

namespace noli {

namespace {

/// Takes about [low, high] into [-1, 1].
Phi phi_onto_unit(double low, double high) {
  const double half = 0.5 * high - 0.5 * low;
  int exponent = 0;
  std::frexp(half, &exponent);
  return {0.5 * low + 0.5 * high, std::ldexp(1.0, std::clamp(-exponent, -1022, 1022))};
}

constexpr float infinity = std::numeric_limits<float>::infinity();

GroupBox empty_box() { return {lanes(infinity), lanes(infinity), lanes(-infinity), lanes(-infinity)}; }

GroupBox merged(const GroupBox& a, const GroupBox& b) {
  return {least(a.low_t0, b.low_t0), least(a.low_t1, b.low_t1), greatest(a.high_t0, b.high_t0),
          greatest(a.high_t1, b.high_t1)};
}

/// Bounds of [0, count), made piece by piece in parallel and merged in order.
template <class Bounds, class Of>
Bounds merged_over(std::size_t count, int threads, const Bounds& none, const Of& of) {
  constexpr std::size_t piece = 1024;
  std::vector<Bounds> parts((count + piece - 1) / piece, none);
  parallel_for(parts.size(), threads, [&](std::size_t p) {
    Bounds sum = none;
    for (std::size_t i = p * piece; i < std::min(count, (p + 1) * piece); ++i) sum = merged(sum, of(i));
    parts[p] = sum;
  });
  Bounds sum = none;
  for (const Bounds& part : parts) sum = merged(sum, part);
  return sum;
}

}  // namespace

template <int Dim>
WindowBoxes<Dim>::WindowBoxes(const Forest& forest, const WindowChords<Dim>& chords, int threads)
    : forest_(forest), chords_(chords), threads_(threads) {
  find_phi();
  bound_roots();
}

template <int Dim>
void WindowBoxes<Dim>::find_phi() {
  for (std::size_t k = 0; k < Dim; ++k) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (const auto& chord : chords_.of) {
      low = std::min(low, std::min(chord.x_t0[k], chord.x_t1[k]));
      high = std::max(high, std::max(chord.x_t0[k], chord.x_t1[k]));
    }
    phi_[k] = phi_onto_unit(low, high);
  }
}

template <int Dim>
void WindowBoxes<Dim>::bound_roots() {
  const auto& trees = forest_.trees();
  for (const Tree& tree : trees) {
    const auto box = [&](std::size_t i) { return box_of(chords_.of[tree.vertices[i]]); };
    root_boxes_.push_back(trees.size() == 1 ? GroupBox{}
                                            : merged_over(tree.vertices.size(), threads_, empty_box(), box));
    const auto tangents = [&](std::size_t i) { return tangents_of_leaf(tree.root.begin + i); };
    root_tangents_.push_back(
        tree.sheet ? merged_over(tree.root.count, threads_, empty_tangents(), tangents) : empty_tangents());
  }
}

/// The radius has room for rounding (proofs/prover/chord.h).
template <int Dim>
GroupBox WindowBoxes<Dim>::box_of(const VertexChord<Dim>& chord) const {
  GroupBox box{};
  for (std::size_t k = 0; k < Dim; ++k) {
    const double r = chord.radius[k];
    box.low_t0[k] = phi_[k](chord.x_t0[k] - r);
    box.low_t1[k] = phi_[k](chord.x_t1[k] - r);
    box.high_t0[k] = phi_[k](chord.x_t0[k] + r);
    box.high_t1[k] = phi_[k](chord.x_t1[k] + r);
  }
  return box;
}

template <int Dim>
TangentBox WindowBoxes<Dim>::tangents_of_leaf(std::size_t leaf) const {
  const LaidFace& face = forest_.laid_face(leaf);
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
  boxes_[g.node] = merged(merged(box_of(chords_.of[a]), box_of(chords_.of[b])), box_of(chords_.of[c]));
  if (sheet) tangents_[g.node] = tangents_of_leaf(g.begin);
}

template <int Dim>
void WindowBoxes<Dim>::make(const std::vector<std::size_t>& trees) {
  if (trees.empty()) return;
  boxes_.resize(forest_.node_count());
  for (const std::size_t t : trees) {
    const Tree& tree = forest_.trees()[t];
    if (tree.sheet && tangents_.empty()) tangents_.resize(forest_.node_count());
    std::vector<Group> level = {tree.root}, inner;
    while (level.size() < 64 && level.back().count >= 64) {
      inner.insert(inner.end(), level.begin(), level.end());
      std::vector<Group> next;
      for (const Group g : level) {
        next.push_back(g.left());
        next.push_back(g.right());
      }
      level = std::move(next);
    }
    parallel_for(level.size(), threads_, [&](std::size_t i) { fit(level[i], tree.sheet); });
    for (auto g = inner.rbegin(); g != inner.rend(); ++g) join(*g, tree.sheet);
  }
}

template class WindowBoxes<2>;
template class WindowBoxes<3>;

}  // namespace noli
