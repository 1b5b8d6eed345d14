// SPDX-License-Identifier: Apache-2.0
//
// What a pair of edges adds to what vertices and faces already do. An edge that crosses another one above a flat mesh
// is no nearer to it than its ends are, or than those of the other one; all that its own push would do is to make
// bumps. On a ridge it is nearer, and nothing else keeps it away.
//
// Notation
//   b       the potential of the layer between the edges: r (d - eta)^2 / 2 if d < eta, else 0
//   B       the sum of the layer's potentials between their four ends and faces, each by inclusion and exclusion
//           (integrator/inclusion_exclusion.h)
//   x       B / b
//   excess  b (1 - x)^2 if x < 1, else 0: what the layer has as its potential for the pair. Its derivatives are
//           continuous where those of b and B are; it is b where no end is near anything, and 0 where an end is as near
//           as the edges are
// It is homogeneous in the potentials that it is made of, so it is their sum, each times its derivative by it: 1 - x^2
// for b, -2 (1 - x) for those of the ends. These are the weights of the sites. It is never less than 0, and grows
// without end where the edges meet and no end does.
//
// Faces count whose pairs with an end are of the same material, as they fire at the same times; so nothing is pulled
// that the same layer does not push. An end may be near faces that have nothing to do with the other edge; then less is
// left for the pair, until b is greater than all of that.
//
// S is double; in audits also multiprecision numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include <noli/mesh.h>
#include "certificates/stencil.h"
#include "integrator/inclusion_exclusion.h"

namespace noli::integrator {

/// The sites of vertices and faces that a layer acts on, by vertex.
template <class S, int Dim>
class SitesOfVertices {
 public:
  void clear() {
    vertices_.clear();
    sites_.clear();
  }

  /// Precondition: sites of a vertex that is greater than all before.
  void add(std::span<const SiteOfContact<S, Dim>> sites, const S& thickness) {
    OfVertex& of = vertices_.emplace_back(OfVertex{sites.front().pair.vertices[0], sites_.size(), 0, S(0)});
    for (const SiteOfContact<S, Dim>& site : sites) {
      of.potential += site.weight * site.potential(thickness);
      sites_.push_back(site);
    }
    of.end = sites_.size();
  }

  /// The sum of the potentials of a layer of stiffness 1.
  S potential(VertexId v) const {
    const OfVertex* of = find(v);
    return of == nullptr ? S(0) : of->potential;
  }
  std::span<const SiteOfContact<S, Dim>> sites(VertexId v) const {
    const OfVertex* of = find(v);
    if (of == nullptr) return {};
    return std::span(sites_).subspan(of->begin, of->end - of->begin);
  }

 private:
  struct OfVertex {
    VertexId vertex;
    std::size_t begin, end;  ///< in sites_
    S potential;
  };

  const OfVertex* find(VertexId v) const {
    const auto found = std::ranges::lower_bound(vertices_, v, {}, &OfVertex::vertex);
    return found != vertices_.end() && found->vertex == v ? &*found : nullptr;
  }

  std::vector<OfVertex> vertices_;
  std::vector<SiteOfContact<S, Dim>> sites_;
};

/// Puts the sites of a pair of edges that the layer acts on in place of what `result` has; none if there is no excess.
template <class S, int Dim>
void find_excess(const SiteOfContact<S, Dim>& edges, const S& thickness, const SitesOfVertices<S, Dim>& known,
                 std::vector<SiteOfContact<S, Dim>>& result) {
  result.clear();
  const S b = edges.potential(thickness);
  S all(0);
  for (const VertexId v : edges.pair.vertices) all += known.potential(v);
  if (!(all < b)) return;
  const S x = all / b;
  result.push_back({edges.pair, edges.approach, S(1) - x * x});
  for (const VertexId v : edges.pair.vertices) {
    for (SiteOfContact<S, Dim> site : known.sites(v)) {
      site.weight *= S(-2) * (S(1) - x);
      result.push_back(site);
    }
  }
}

}  // namespace noli::integrator
