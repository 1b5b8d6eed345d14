// SPDX-License-Identifier: Apache-2.0
//
// A near pair: how many layers it needs, and the slab that keeps its features apart. A side of the slab is a wall for
// each vertex of the pair.
//
// Notation (Harmon et al. 2009, section 5): that of certificates/cells.h, and
//   slab        n . x = s(t) +- half, s(t) = offset + rate (t - since), |n| <= 1 and nearly 1: A stays above, B below,
//               so they are at least 2 half apart. The slab moves with the features
//   clearance   of a vertex: how far it is beyond its wall; linear in time between changes of velocity
//   slack       the least clearance when the slab was put up
//   recording   how far recorded positions may be off (certificates/decisions.h)
//
// When a slab fails is decided by vertex, for all its walls at once (certificates/cells.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>

#include <noli/run.h>
#include "certificates/closest.h"

namespace noli::certificates {

template <int Dim>
struct Slab {
  Vector<Dim> normal = Vector<Dim>::Zero();  ///< from B to A
  double offset = 0, rate = 0, since = 0;
  double half = 0;
  double slack = 0;

  /// The clearance of a vertex of A or of B that is at x at time t.
  double clearance(bool of_a, const Vector<Dim>& x, double t) const {
    const double height = normal.dot(x) - (offset + rate * (t - since));
    return (of_a ? height : -height) - half;
  }
  /// How fast the clearance of a vertex with velocity v falls.
  double closing(bool of_a, const Vector<Dim>& v) const {
    const double rise = normal.dot(v) - rate;
    return of_a ? -rise : rise;
  }
};

/// The direction of a vector with this length, not 0. Its length is at most 1, despite rounding.
template <int Dim>
Vector<Dim> direction(const Vector<Dim>& r, double length) {
  return r / (length * (1 + 0x1p-48));
}

/// A slab half way between the closest points, moving at their mean velocity. Precondition: the distance is positive.
/// The slack may be negative, if the distance is less than 2 half, or is not known well enough because the features are
/// thin. Then the slab certifies nothing.
template <int Dim>
Slab<Dim> slab_between(const Stencil& pair, const Closest<Dim>& closest, std::span<const Vector<Dim>> x,
                       std::span<const Vector<Dim>> v, double t, double half) {
  Slab<Dim> slab;
  slab.normal = direction<Dim>(closest.r, closest.distance());
  slab.since = t;
  slab.half = half;
  for (std::size_t i = 0; i < pair.size(); ++i) {
    const double part = 0.5 * std::abs(closest.weights[i]);
    slab.offset += part * slab.normal.dot(x[i]);
    slab.rate += part * slab.normal.dot(v[i]);
  }
  slab.slack = slab.clearance(true, x[0], t);
  for (std::size_t i = 1; i < pair.size(); ++i) {
    slab.slack = std::min(slab.slack, slab.clearance(i < pair.first(), x[i], t));
  }
  return slab;
}

constexpr std::uint16_t no_material = 0xffff;

/// A pair and how many layers it needs.
struct LayeredPair {
  Stencil stencil;
  std::uint16_t material = 0;
  std::uint32_t layers = 0;  ///< L
};

/// Aligned, so that the slab, which is read far more often than the rest, is one cache line.
template <int Dim>
struct NearPair : LayeredPair {
  alignas(64) Slab<Dim> slab;

  NearPair(const Stencil& s, std::uint16_t of_material) : LayeredPair{s, of_material} {}
};

/// A pair that a vertex is part of.
class Side {
 public:
  /// Precondition: near < 2^31.
  Side(std::uint32_t near, bool of_a) : packed_(near << 1 | (of_a ? 1U : 0U)) {}

  std::uint32_t near() const { return packed_ >> 1; }  ///< number of the pair
  bool of_a() const { return (packed_ & 1) != 0; }     ///< whether the vertex is of A
  bool operator==(const Side&) const = default;

 private:
  std::uint32_t packed_;
};

/// Guards against Zeno behaviour: throws if there are too many repairs at one instant, compared with the number of
/// things that can be repaired.
inline void require_progress(std::size_t repairs_at_once, std::size_t things) {
  constexpr std::size_t most = 1000;
  if (repairs_at_once <= most * (things + 1)) return;
  throw std::runtime_error("certificates: no end of repairs at one instant");
}

/// The material of a pair, or no_material if it is excluded from contact.
template <class Host>
std::uint16_t material_of(const Host& host, const Stencil& s) {
  bool moves = false;
  for (std::size_t k = 0; k < s.size(); ++k) moves |= !host.immovable(s.vertices[k]);
  return moves ? host.material(s) : no_material;
}

/// Gives a pair one more layer.
template <class Host>
void gain_layer(Host& host, LayeredPair& pair, double t, CertificateCounts& counts) {
  ++pair.layers;
  ++counts.activations;
  counts.deepest = std::max(counts.deepest, pair.layers);
  host.activate(pair.stencil, pair.material, pair.layers, t);
}

template <class Host>
void lose_layer(Host& host, LayeredPair& pair, CertificateCounts& counts) {
  ++counts.deactivations;
  host.deactivate(pair.stencil, pair.material, pair.layers--);
}

/// Puts up a slab of thickness eta(L + 1) at the pair's position at time t, after adding as many layers as needed. A
/// layer is added when the remaining room is less than half of the next one's width. Returns the distance.
template <int Dim, class Host>
double fit_slab(Host& host, NearPair<Dim>& pair, double t, double recording, CertificateCounts& counts) {
  const Stencil& s = pair.stencil;
  std::array<Vector<Dim>, 4> x, v;
  for (std::size_t k = 0; k < s.size(); ++k) {
    const Line<Dim> line = host.line(s.vertices[k]);
    x[k] = line.at(t);
    v[k] = line.v;
  }
  const std::span<const Vector<Dim>> xs(x.data(), s.size()), vs(v.data(), s.size());
  const Closest<Dim> c = closest<Dim>(s.kind, xs);
  ++counts.repairs;
  while (pair.layers < host.least_layers()) gain_layer(host, pair, t, counts);
  for (;; gain_layer(host, pair, t, counts)) {
    const double eta = host.thickness(pair.material, pair.layers + 1);
    const double room = 0.5 * (eta - host.thickness(pair.material, pair.layers + 2)) + 64 * recording;
    if (!(c.distance() - eta > room)) continue;
    pair.slab = slab_between<Dim>(s, c, xs, vs, t, 0.5 * eta);
    if (pair.slab.slack > 0.25 * room) return c.distance();
  }
}

/// Whether a pair is so far apart that layer l, if it is the deepest, may be dropped: twice as far outside the layer as
/// where it would be added again.
template <class Host>
bool is_clear(const Host& host, std::uint16_t material, std::uint32_t l, double distance, double recording) {
  const double eta = host.thickness(material, l);
  return l > host.least_layers() && distance > eta + (eta - host.thickness(material, l + 1)) + 128 * recording;
}

}  // namespace noli::certificates
