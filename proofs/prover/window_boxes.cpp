// SPDX-License-Identifier: Apache-2.0
#include "noli/proofs/prover/window_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "noli/kernel/parallel.h"

namespace noli {

namespace {

/// phi, for one axis.
struct Phi {
  double middle = 0, scale = 1;

  float operator()(double x) const { return static_cast<float>((x - middle) * scale); }
};

/// Takes about [low, high] into [-1, 1].
Phi phi_onto_unit(double low, double high) {
  const double half = 0.5 * high - 0.5 * low;
  int exponent = 0;
  std::frexp(half, &exponent);
  return {0.5 * low + 0.5 * high, std::ldexp(1.0, std::clamp(-exponent, -1022, 1022))};
}

template <int Dim>
Phi phi_for(const std::vector<WindowCell<Dim>>& cells, std::size_t k) {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  for (const auto& cell : cells) {
    for (std::size_t e = 0; e < 2; ++e) {
      for (std::size_t i = 0; i < 3; ++i) {
        low = std::min(low, cell.x[e][k][i]);
        high = std::max(high, cell.x[e][k][i]);
      }
    }
  }
  return phi_onto_unit(low, high);
}

template <int Dim>
GroupBox box_of(const WindowCell<Dim>& cell, const std::array<Phi, Dim>& phi) {
  GroupBox box{};
  for (std::size_t k = 0; k < Dim; ++k) {
    const auto &a = cell.x[0][k], &b = cell.x[1][k];
    const double r = cell.radius[k];
    box.low_t0[k] = phi[k](std::min(a[0], std::min(a[1], a[2])) - r);
    box.low_t1[k] = phi[k](std::min(b[0], std::min(b[1], b[2])) - r);
    box.high_t0[k] = phi[k](std::max(a[0], std::max(a[1], a[2])) + r);
    box.high_t1[k] = phi[k](std::max(b[0], std::max(b[1], b[2])) + r);
  }
  return box;
}

Lanes lower(const Lanes& a, const Lanes& b) { return a < b ? a : b; }
Lanes higher(const Lanes& a, const Lanes& b) { return a > b ? a : b; }

GroupBox merged(const GroupBox& a, const GroupBox& b) {
  return {lower(a.low_t0, b.low_t0), lower(a.low_t1, b.low_t1), higher(a.high_t0, b.high_t0),
          higher(a.high_t1, b.high_t1)};
}

/// Fits the boxes of a group and of all below it.
template <int Dim>
struct Fitter {
  const std::vector<WindowCell<Dim>>& cells;
  std::array<Phi, Dim> phi;
  std::vector<GroupBox> boxes;

  void fit(Group g) {
    if (g.is_leaf()) {
      boxes[g.node] = box_of<Dim>(cells[g.begin], phi);
      return;
    }
    fit(g.left());
    fit(g.right());
    boxes[g.node] = merged(boxes[g.left().node], boxes[g.right().node]);
  }
};

}  // namespace

template <int Dim>
std::vector<GroupBox> window_boxes(const std::vector<WindowCell<Dim>>& cells, int threads) {
  Fitter<Dim> fitter{cells, {}, std::vector<GroupBox>(2 * cells.size() - 1)};
  for (std::size_t k = 0; k < Dim; ++k) fitter.phi[k] = phi_for(cells, k);
  std::vector<Group> level = {{0, 0, static_cast<std::uint32_t>(cells.size())}}, inner;
  while (level.size() < 64 && level.back().count >= 64) {
    inner.insert(inner.end(), level.begin(), level.end());
    std::vector<Group> next;
    for (const Group g : level) {
      next.push_back(g.left());
      next.push_back(g.right());
    }
    level = std::move(next);
  }
  parallel_for(level.size(), threads, [&](std::size_t i) { fitter.fit(level[i]); });
  for (auto g = inner.rbegin(); g != inner.rend(); ++g) {
    fitter.boxes[g->node] = merged(fitter.boxes[g->left().node], fitter.boxes[g->right().node]);
  }
  return std::move(fitter.boxes);
}

template std::vector<GroupBox> window_boxes(const std::vector<WindowCell<2>>&, int);
template std::vector<GroupBox> window_boxes(const std::vector<WindowCell<3>>&, int);

}  // namespace noli
