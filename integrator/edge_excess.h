// SPDX-License-Identifier: Apache-2.0
//
// What pairs of edges add to what vertices and faces already do. An edge that crosses another one above a flat mesh is
// no nearer to it than its ends are, or than those of the other one; all that its own push would do is to make bumps.
// On a ridge it is nearer, and nothing else keeps it away.
//
// Notation
//   a, e    the edges of a pair; u: an end of one, with the faces of the other one, and of edges within eta of the first
//           that hang together with it across such faces
//   b       the potential of the layer between a and e: r (d - eta)^2 / 2 if d < eta, else 0
//   B       the sum of the layer's potentials of all four ends, each by inclusion and exclusion over its faces
//           (integrator/inclusion_exclusion.h)
//   x       B / b
//   excess  b (1 - x)^2 if x < 1, else 0: what the layer has as its potential for the pair. It has continuous
//           derivatives, b by itself where no end is near, and 0 where an end is as near as the edges are
// It is homogeneous in the potentials that it is made of, so it is their sum, each times its derivative by it: 1 - x^2
// for b, -2 (1 - x) for those of the ends. These are the weights of the sites. None of it is less than 0, and it grows
// without end where the edges meet and no end does.
//
// Loose edges have no faces, and push for themselves.
//
// S is double; in audits also multiprecision numbers.
//
// What this does not do: vertices and faces.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <noli/mesh.h>
#include "certificates/features.h"
#include "certificates/stencil.h"
#include "integrator/contact_blow.h"
#include "integrator/inclusion_exclusion.h"

namespace noli::integrator {

/// Which faces have an edge, by the numbers that edges have in keys of pairs.
class FacesOfEdges {
 public:
  /// Has nothing to say.
  FacesOfEdges() = default;
  explicit FacesOfEdges(const Mesh& mesh) : faces_(mesh.faces) {
    const certificates::Features features(mesh, 3);
    edges_ = features.edges();
    begin_.assign(edges_.size() + 1, 0);
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      for (const std::uint32_t cell : features.cells_of(edges_[e][0])) {
        if (features.cells()[cell].size == 3 && has(faces_[cell], edges_[e][1])) of_edges_.push_back(cell);
      }
      begin_[e + 1] = of_edges_.size();
    }
  }

  const std::array<VertexId, 3>& face(std::uint32_t f) const { return faces_[f]; }
  const std::array<VertexId, 2>& edge(std::uint32_t e) const { return edges_[e]; }
  std::span<const std::uint32_t> faces_of(std::uint32_t e) const {
    return {of_edges_.data() + begin_[e], begin_[e + 1] - begin_[e]};
  }
  /// Whether face and edge have no vertex in common.
  bool apart(std::uint32_t f, std::uint32_t e) const {
    return !has(faces_[f], edges_[e][0]) && !has(faces_[f], edges_[e][1]);
  }

 private:
  static bool has(const std::array<VertexId, 3>& face, VertexId v) {
    return face[0] == v || face[1] == v || face[2] == v;
  }

  std::vector<std::array<VertexId, 3>> faces_;
  std::vector<std::array<VertexId, 2>> edges_;
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> of_edges_;
};

/// Adds up what happens to the pairs of edges that a layer acts on.
template <class S, int Dim>
class EdgeExcess {
 public:
  explicit EdgeExcess(const FacesOfEdges& mesh) : mesh_(&mesh) {}

  bool empty() const { return pairs_.empty(); }

  /// Precondition: a pair of edges, in the order of keys; the layer acts on it.
  void add(const certificates::Stencil& pair, const Approach<S, Dim>& approach) {
    pairs_.push_back({pair, approach, counts(pair, approach)});
  }

  /// Calls each(site) for all sites with a weight that is not 0, and forgets all. `position`: of a vertex of the mesh.
  template <class PositionOf, class Each>
  void take(const S& thickness, const PositionOf& position, Each&& each) {
    find_near(thickness, position);
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      if (!pairs_[i].counts) continue;
      const S b = potential(pairs_[i].approach, thickness);
      const std::span<const Near> halves(near_of_.data() + 2 * i, 2);
      // The potential of an end is no less than that of its nearest face.
      if (!(halves[0].greatest < b && halves[1].greatest < b)) continue;
      sites_.clear();
      S all(0);
      for (const Near& half : halves) all += add_sites(half, thickness, position);
      if (!(all < b)) continue;
      const S x = all / b;
      each(SiteOfContact<S, Dim>{pairs_[i].pair, pairs_[i].approach, S(1) - x * x});
      for (SiteOfContact<S, Dim>& site : sites_) {
        site.weight *= S(-2) * (S(1) - x);
        each(site);
      }
    }
    pairs_.clear();
  }

 private:
  struct Pair {
    certificates::Stencil pair;
    Approach<S, Dim> approach;
    bool counts;  ///< the nearest points are inside of both edges, or an end has no face to be near to
  };
  /// One edge of a pair, with the faces of the other one.
  struct Half {
    std::uint32_t edge, other;
    std::size_t number;  ///< in near_of_
  };
  /// The faces that the ends of an edge are near to: [begin, end) of near_.
  struct Near {
    std::size_t begin = 0, end = 0;
    S greatest = S(0);  ///< potential, of a layer of stiffness 1
  };
  struct Patch {
    std::uint32_t face;
    std::size_t part;  ///< the same for what hangs together
  };

  static S potential(const Approach<S, Dim>& approach, const S& thickness) {
    const S g = approach.distance - thickness;
    return S(0.5) * g * g;
  }

  static std::uint32_t edge_of(const certificates::Stencil& pair, int which) {
    return static_cast<std::uint32_t>(pair.key >> (which == 0 ? 31 : 0)) & 0x7fffffff;
  }

  /// Where the nearest points are at an end, that end is as near to a face of the other edge, if it has one.
  bool counts(const certificates::Stencil& pair, const Approach<S, Dim>& approach) const {
    const auto& w = approach.closest.weights;
    const std::uint32_t a = edge_of(pair, 0), e = edge_of(pair, 1);
    const bool at_end_of_a = w[0] == S(0) || w[1] == S(0), at_end_of_e = w[2] == S(0) || w[3] == S(0);
    return !(at_end_of_a && has_face(e, a)) && !(at_end_of_e && has_face(a, e));
  }

  /// Whether the edge has a face that has no vertex in common with the other one.
  bool has_face(std::uint32_t edge, std::uint32_t other) const {
    return std::ranges::any_of(mesh_->faces_of(edge), [&](std::uint32_t f) { return mesh_->apart(f, other); });
  }

  void find_near(const S& thickness, const auto& position) {
    halves_.clear();
    near_.clear();
    near_of_.assign(2 * pairs_.size(), {});
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const std::uint32_t a = edge_of(pairs_[i].pair, 0), e = edge_of(pairs_[i].pair, 1);
      halves_.push_back({a, e, 2 * i});
      halves_.push_back({e, a, 2 * i + 1});
    }
    std::ranges::stable_sort(halves_, {}, &Half::edge);
    for (auto begin = halves_.begin(); begin != halves_.end();) {
      auto end = begin;
      while (end != halves_.end() && end->edge == begin->edge) ++end;
      find_near_of(std::span<const Half>(begin, end), thickness, position);
      begin = end;
    }
  }

  /// Of one edge, near several others.
  void find_near_of(std::span<const Half> halves, const S& thickness, const auto& position) {
    const auto counts = [this](const Half& half) { return pairs_[half.number / 2].counts; };
    if (std::ranges::none_of(halves, counts)) return;
    find_patches(halves);
    done_.clear();
    for (const Half& half : halves) {
      const std::size_t part = counts(half) ? part_of(half) : none;
      if (part == none) continue;
      const auto known = std::ranges::find(done_, part, &Done::part);
      if (known != done_.end()) {
        near_of_[half.number] = near_of_[known->number];
        continue;
      }
      near_of_[half.number] = near_part(half.edge, part, thickness, position);
      done_.push_back({part, half.number});
    }
  }

  /// The faces of all others that have no vertex in common with the edge.
  void find_patches(std::span<const Half> halves) {
    patches_.clear();
    for (const Half& half : halves) {
      std::size_t part = none;
      for (const std::uint32_t face : mesh_->faces_of(half.other)) {
        if (!mesh_->apart(face, half.edge)) continue;
        auto found = std::ranges::find(patches_, face, &Patch::face);
        if (found == patches_.end()) found = patches_.insert(found, {face, patches_.size()});
        if (part == none) part = found->part;
        join(found->part, part);
      }
    }
  }

  void join(std::size_t part, std::size_t with) {
    if (part == with) return;
    for (Patch& patch : patches_) {
      if (patch.part == part) patch.part = with;
    }
  }

  std::size_t part_of(const Half& half) const {
    for (const std::uint32_t face : mesh_->faces_of(half.other)) {
      const auto found = std::ranges::find(patches_, face, &Patch::face);
      if (found != patches_.end()) return found->part;
    }
    return none;
  }

  Near near_part(std::uint32_t edge, std::size_t part, const S& thickness, const auto& position) {
    Near near{near_.size(), near_.size(), S(0)};
    for (const VertexId u : mesh_->edge(edge)) {
      for (const Patch& patch : patches_) {
        if (patch.part != part) continue;
        const auto& [a, b, c] = mesh_->face(patch.face);
        Pair pair{
            {FeaturePair::vertex_face, {u, a, b, c}, certificates::pair_key(FeaturePair::vertex_face, u, patch.face)},
            {},
            true};
        find_approach_of<S, Dim>(pair.pair, position, pair.approach);
        if (!(pair.approach.distance < thickness)) continue;
        near.greatest = std::max<S>(near.greatest, potential(pair.approach, thickness));
        near_.push_back(pair);
      }
    }
    near.end = near_.size();
    return near;
  }

  /// Adds the sites of both ends to sites_. Returns the sum of their potentials.
  S add_sites(const Near& near, const S& thickness, const auto& position) {
    S sum(0);
    const auto take = [&] {
      if (joined_.empty()) return;
      joined_.take(thickness, position, [&](const SiteOfContact<S, Dim>& site) {
        sum += site.weight * potential(site.approach, thickness);
        sites_.push_back(site);
      });
    };
    for (const Pair& pair : std::span(near_).subspan(near.begin, near.end - near.begin)) {
      if (!joined_.takes(pair.pair)) take();
      joined_.add(pair.pair, pair.approach);
    }
    take();
    return sum;
  }

  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  struct Done {
    std::size_t part, number;
  };

  const FacesOfEdges* mesh_;
  std::vector<Pair> pairs_;
  std::vector<Half> halves_;
  std::vector<Near> near_of_;  ///< [2 * pair + which edge]
  std::vector<Pair> near_;     ///< ends and faces
  std::vector<Patch> patches_;
  std::vector<Done> done_;
  std::vector<SiteOfContact<S, Dim>> sites_;  ///< of the ends of one pair
  InclusionExclusion<S, Dim> joined_;
};

}  // namespace noli::integrator
