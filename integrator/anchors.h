// SPDX-License-Identifier: Apache-2.0
//
// Anchors, the memory of friction. Friction that only stops slip lets bodies creep: each impulse is bounded by the
// normal force at its time, and slip that it could not stop remains. So a layer that has stopped the slip of a pair has
// an anchor for it: the points that were closest then. It pulls the pair back to them as by a damped spring (Cundall
// and Strack, "A discrete numerical model for granular assemblies", 1979), until that would take more than Coulomb's
// friction; then the anchor is dragged along.
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
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <noli/mesh.h>
#include <noli/query.h>

namespace noli::integrator {

/// A pair in a layer. Of joined pairs (integrator/inclusion_exclusion.h), layers of two materials may act on one.
struct PairInLayer {
  std::uint16_t material = 0;
  std::uint32_t layer = 0;
  FeaturePair kind{};
  std::array<VertexId, 4> vertices{};

  friend auto operator<=>(const PairInLayer&, const PairInLayer&) = default;
};

template <class S>
struct Anchor {
  PairInLayer of;
  std::array<S, 4> weights{};  ///< of the closest points, as in certificates/closest.h
  double until = 0;            ///< when it ends unless it is renewed [s]

  friend bool operator==(const Anchor&, const Anchor&) = default;
};

template <class S>
class Anchors {
 public:
  /// Extends the anchor of a pair on which its layer acts at time t, and returns its weights; or null.
  std::array<S, 4>* renew(const PairInLayer& pair, double t, double life) {
    const auto found = all_.find(pair);
    if (found == all_.end() || found->second.until < t) return nullptr;
    found->second.until = t + life;
    return &found->second.weights;
  }

  /// Anchors a pair at its closest points. Precondition: it has no anchor in this layer that lasts.
  void begin(const PairInLayer& pair, const std::array<S, 4>& closest, double t, double life) {
    if (all_.size() >= most_) forget(t);
    all_[pair] = {closest, t + life};
  }

  /// The anchors that last beyond a time, in ascending order of their pairs.
  std::vector<Anchor<S>> after(double t) const {
    std::vector<Anchor<S>> result;
    for (const auto& [pair, held] : all_) {
      if (t <= held.until) result.push_back({pair, held.weights, held.until});
    }
    std::ranges::sort(result, {}, &Anchor<S>::of);
    return result;
  }

  /// Replaces all anchors by these.
  void restore(std::span<const Anchor<S>> anchors) {
    all_.clear();
    for (const Anchor<S>& a : anchors) all_[a.of] = {a.weights, a.until};
  }

 private:
  struct Held {
    std::array<S, 4> weights;
    double until;
  };
  struct Hash {
    std::size_t operator()(const PairInLayer& pair) const {
      std::uint64_t hash = std::uint64_t{pair.material} << 32 | pair.layer;
      for (const VertexId v : pair.vertices) hash = (hash ^ v) * 0x9e3779b97f4a7c15;
      return hash ^ hash >> 32;
    }
  };

  void forget(double t) {
    std::erase_if(all_, [t](const auto& entry) { return entry.second.until < t; });
    most_ = std::max<std::size_t>(1024, 2 * all_.size());
  }

  std::unordered_map<PairInLayer, Held, Hash> all_;
  std::size_t most_ = 1024;  ///< the number at which old anchors are dropped
};

}  // namespace noli::integrator
