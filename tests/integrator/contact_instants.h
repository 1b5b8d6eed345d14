// SPDX-License-Identifier: Apache-2.0
//
// Decides exactly whether any pair of features is nearer than its next layer at one instant of a run, over all pairs
// whose boxes are near.
//
// Notation
//   L        layers that are active for a pair; its next layer has thickness eta(L + 1)
//   box      of a cell: contains its vertices and half of the greatest eta(1) around them
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <span>
#include <vector>

#include "certificates/closest.h"
#include "certificates/features.h"
#include "integrator/model.h"
#include "kernel/thickness.h"

namespace noli::integrator::test {

struct InstantCounts {
  std::uint64_t instants = 0;
  std::uint64_t pairs = 0;   ///< pairs of features in near boxes
  std::uint64_t active = 0;  ///< those of them with a layer
  std::uint64_t exact = 0;   ///< pairs decided by the kernel
  std::uint64_t nearer = 0;  ///< pairs nearer than their next layer; must be 0
  double least = 1e300;      ///< least distance in units of the next layer's thickness
};

template <int Dim>
class Instants {
 public:
  using Layers = std::map<certificates::PairKey, std::uint32_t>;
  using Stencil = certificates::Stencil;

  /// The model must outlive this object and have contact.
  explicit Instants(const Model<double, Dim>& model)
      : model_(model), features_(model.mesh, Dim), immovable_(model.x.size(), false) {
    for (const VertexId v : model.pinned) immovable_[v] = true;
    for (const auto& script : model.scripts) immovable_[script.vertex] = true;
    for (const ContactMaterial& m : model.contact->materials) room_ = std::max(room_, 0.5 * m.thickness);
    order_.resize(features_.cells().size());
    std::iota(order_.begin(), order_.end(), 0U);
  }

  /// Examines all pairs at the positions x.
  void look(const std::vector<Vec<double, Dim>>& x, const Layers& layers) {
    ++counts_.instants;
    for_each_near(x, [&](std::uint32_t a, std::uint32_t b) {
      features_.for_each_pair(a, b, [&](const Stencil& s) { look(s, x, layers); });
    });
  }

  const InstantCounts& counts() const { return counts_; }

 private:
  struct Box {
    Vec<double, Dim> low, high;
    bool immovable;
  };

  /// Sweeps along the axis with the largest extent of the boxes.
  template <class Each>
  void for_each_near(const std::vector<Vec<double, Dim>>& x, const Each& each) {
    boxes_.clear();
    for (const auto& cell : features_.cells()) boxes_.push_back(box_of(cell, x));
    Vec<double, Dim> low = boxes_[0].low, high = boxes_[0].high;
    for (const Box& box : boxes_) {
      low = low.cwiseMin(box.low);
      high = high.cwiseMax(box.high);
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return boxes_[a].low[axis] != boxes_[b].low[axis] ? boxes_[a].low[axis] < boxes_[b].low[axis] : a < b;
    });
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const Box& box = boxes_[order_[i]];
      for (std::size_t j = i + 1; j < order_.size() && boxes_[order_[j]].low[axis] <= box.high[axis]; ++j) {
        const Box& other = boxes_[order_[j]];
        const bool apart = (box.low - other.high).maxCoeff() > 0 || (other.low - box.high).maxCoeff() > 0;
        if (!apart && !(box.immovable && other.immovable)) each(order_[i], order_[j]);
      }
    }
  }

  /// The box of a cell, slightly enlarged against rounding.
  Box box_of(const certificates::Features::Cell& cell, const std::vector<Vec<double, Dim>>& x) const {
    Box box{x[cell.vertices[0]], x[cell.vertices[0]], true};
    for (std::size_t k = 0; k < cell.size; ++k) {
      box.low = box.low.cwiseMin(x[cell.vertices[k]]);
      box.high = box.high.cwiseMax(x[cell.vertices[k]]);
      box.immovable = box.immovable && immovable_[cell.vertices[k]];
    }
    const double greatest = std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
    const auto room = Vec<double, Dim>::Constant(room_ * (1 + 0x1p-40) + 0x1p-50 * greatest);
    return {box.low - room, box.high + room, box.immovable};
  }

  void look(const Stencil& s, const std::vector<Vec<double, Dim>>& x, const Layers& layers) {
    bool moves = false;
    for (std::size_t k = 0; k < s.size(); ++k) moves = moves || !immovable_[s.vertices[k]];
    const std::span<const VertexId> vertices(s.vertices.data(), s.size());
    const ContactSettings& contact = *model_.contact;
    const std::uint16_t material = contact.material(vertices.first(s.first()), vertices.subspan(s.first()));
    if (!moves || material == ContactSettings::excluded) return;
    const auto found = layers.find(s.key);
    const std::uint32_t active = found == layers.end() ? 0 : found->second;
    ++counts_.pairs;
    counts_.active += active > 0 ? 1 : 0;
    const double eta = layer_thickness(contact.materials[material], contact.schedule, active + 1);
    if (!farther(s, x, eta)) ++counts_.nearer;
  }

  /// Whether the pair is farther apart than eta. Decided by the direction between closest points, with a bound for
  /// rounding, or else by the kernel.
  bool farther(const Stencil& s, const std::vector<Vec<double, Dim>>& x, double eta) {
    std::array<Vec<double, Dim>, 4> p;
    double greatest = 0;
    for (std::size_t k = 0; k < s.size(); ++k) {
      p[k] = x[s.vertices[k]];
      greatest = std::max(greatest, p[k].cwiseAbs().maxCoeff());
    }
    const auto c = certificates::closest<Dim>(s.kind, std::span<const Vec<double, Dim>>(p.data(), s.size()));
    counts_.least = std::min(counts_.least, c.distance() / eta);
    if (c.distance() > 0) {
      const Vec<double, Dim> n = c.r / c.distance();
      double gap = 1e300;
      for (std::size_t i = 0; i < s.first(); ++i) {
        for (std::size_t j = s.first(); j < s.size(); ++j) gap = std::min(gap, n.dot(p[i] - p[j]));
      }
      if (gap > (eta + 0x1p-48 * greatest) * (1 + 0x1p-40)) return true;
    }
    ++counts_.exact;
    return !within(s, x, eta);
  }

  bool within(const Stencil& s, const std::vector<Vec<double, Dim>>& x, double eta) const {
    if constexpr (Dim == 3) {
      if (s.kind == FeaturePair::vertex_face) return within_as<FeaturePair::vertex_face>(s, x, eta);
      if (s.kind == FeaturePair::edge_edge) return within_as<FeaturePair::edge_edge>(s, x, eta);
    }
    if (s.kind == FeaturePair::vertex_edge) return within_as<FeaturePair::vertex_edge>(s, x, eta);
    return within_as<FeaturePair::vertex_vertex>(s, x, eta);
  }

  template <FeaturePair Pair>
  bool within_as(const Stencil& s, const std::vector<Vec<double, Dim>>& x, double eta) const {
    Query<Pair, Dim> query;
    for (std::size_t k = 0; k < s.size(); ++k) {
      for (int d = 0; d < Dim; ++d) query.x_t0[k][static_cast<std::size_t>(d)] = x[s.vertices[k]][d];
    }
    query.x_t1 = query.x_t0;
    return within_distance(query, eta);
  }

  const Model<double, Dim>& model_;
  certificates::Features features_;
  std::vector<bool> immovable_;
  double room_ = 0;
  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_;  ///< cells in the order of the sweep
  InstantCounts counts_;
};

}  // namespace noli::integrator::test
