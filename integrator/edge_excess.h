// SPDX-License-Identifier: Apache-2.0
//
// The potential that a pair of edges adds to those of vertices and faces. If an edge crosses another one above a flat
// mesh, the edges are no nearer to each other than their ends are to the mesh, and a push of their own would only make
// bumps. On a ridge the edges are nearer, and nothing else keeps them apart.
//
// Notation
//   b       the potential of the layer between the edges: r (d - eta)^2 / 2 if d < eta, else 0
//   B       the sum of the layer's potentials between their four ends and faces, each by inclusion and exclusion
//           (integrator/inclusion_exclusion.h)
//   x       B / b
//   excess  b (1 - x)^2 if x < 1, else 0: the layer's potential for the pair. Its derivatives are continuous where
//           those of b and B are. It is b if no end is near anything, and 0 if an end is as near as the edges are
// The excess is homogeneous in the potentials b and those of the ends. So it is the sum of these, each times the
// derivative of the excess by it: 1 - x^2 for b, -2 (1 - x) for those of the ends. These are the weights of the sites.
// The excess is never below 0, and grows without bound where the edges meet and their ends do not.
//
// Only faces whose pairs with an end have the same material count, as they fire at the same times; so a layer pulls
// only what it also pushes. An end may be near faces that have nothing to do with the other edge; then the pair gets
// less, until b is greater than all of their potentials.
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

  /// Precondition: these are sites of a vertex greater than all before.
  void add(std::span<const SiteOfContact<S, Dim>> sites, const S& thickness) {
    OfVertex& of = vertices_.emplace_back(OfVertex{sites.front().pair.vertices[0], sites_.size(), 0, S(0)});
    for (const SiteOfContact<S, Dim>& site : sites) {
      of.potential += site.weight * site.potential(thickness);
      sites_.push_back(site);
    }
    of.end = sites_.size();
  }

  /// The sum of the potentials at a vertex, for a layer of stiffness 1.
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

/// Replaces `result` by the sites of a pair of edges on which the layer acts; empty if there is no excess.
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
