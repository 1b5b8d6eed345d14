// SPDX-License-Identifier: Apache-2.0
//
// Anchors, the memory of friction. Friction that only stops slip lets bodies creep: each impulse is bounded by the
// normal force at its time, and slip that it could not stop remains. So where a layer has stopped the slip of a pair, the
// layer has an anchor for it: the points that were closest then. It pulls the pair back to them as by a damped spring
// (Cundall and Strack, "A discrete numerical model for granular assemblies", 1979), until that would take more than
// Coulomb's friction; then the anchor is dragged along.
//
// Each layer has anchors of its own. With one for all layers, a layer that begins to act on a pair already displaced
// would pull with a spring that nothing has stretched, and friction would create energy.
//
// An anchor begins when friction of its layer first stops the slip of a pair. It lasts as long as the layer acts again,
// each time within `life` of the previous time. It is a property of the motion, independent of certificates.
//
// integrator/contact_impulse.h computes the forces.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "certificates/stencil.h"

namespace noli::integrator {

template <class S>
struct Anchor {
  std::uint32_t layer = 0;  ///< of the pair's material
  FeaturePair kind{};
  std::array<VertexId, 4> vertices{};
  std::array<S, 4> weights{};  ///< of the closest points, as in certificates/closest.h
  double until = 0;            ///< when it ends unless it is renewed [s]

  friend bool operator==(const Anchor&, const Anchor&) = default;
};

template <class S>
class Anchors {
 public:
  /// The weights of the anchor of a pair in a layer that acts on it at time t, which now lasts longer. Null: it has
  /// none.
  std::array<S, 4>* renew(std::uint32_t layer, const certificates::Stencil& pair, double t, double life) {
    const auto found = all_.find(Key{layer, pair.kind, pair.vertices});
    if (found == all_.end() || found->second.until < t) return nullptr;
    found->second.until = std::max(found->second.until, t + life);
    return &found->second.weights;
  }

  /// Anchors a pair at its closest points in a layer. Precondition: it has no anchor there that lasts.
  void begin(std::uint32_t layer, const certificates::Stencil& pair, const std::array<S, 4>& closest, double t,
             double life) {
    if (all_.size() >= most_) forget(t);
    all_[Key{layer, pair.kind, pair.vertices}] = {closest, t + life};
  }

  /// The anchors that last beyond a time, in a fixed order.
  std::vector<Anchor<S>> after(double t) const {
    std::vector<Anchor<S>> result;
    for (const auto& [key, held] : all_) {
      if (t <= held.until) result.push_back({key.layer, key.kind, key.vertices, held.weights, held.until});
    }
    std::ranges::sort(result, {}, [](const Anchor<S>& a) { return Key{a.layer, a.kind, a.vertices}; });
    return result;
  }

  /// Replaces all anchors by these.
  void restore(std::span<const Anchor<S>> anchors) {
    all_.clear();
    for (const Anchor<S>& a : anchors) all_[Key{a.layer, a.kind, a.vertices}] = {a.weights, a.until};
  }

 private:
  struct Key {
    std::uint32_t layer;
    FeaturePair kind;
    std::array<VertexId, 4> vertices;
    friend auto operator<=>(const Key&, const Key&) = default;
  };
  struct Held {
    std::array<S, 4> weights;
    double until;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t hash = std::uint64_t{key.layer} << 2 | static_cast<std::uint64_t>(key.kind);
      for (const VertexId v : key.vertices) hash = (hash ^ v) * 0x9e3779b97f4a7c15;
      return hash ^ hash >> 32;
    }
  };

  void forget(double t) {
    std::erase_if(all_, [t](const auto& entry) { return entry.second.until < t; });
    most_ = std::max<std::size_t>(1024, 2 * all_.size());
  }

  std::unordered_map<Key, Held, Hash> all_;
  std::size_t most_ = 1024;  ///< the number at which old anchors are dropped
};

}  // namespace noli::integrator
