// SPDX-License-Identifier: Apache-2.0
//
// Counts the contact of a vertex with adjacent faces once, by inclusion and exclusion (Li, Ferguson, Schneider,
// Langlois, Zorin, Panozzo, Jiang, Kaufman, "Convergent Incremental Potential Contact", 2023, section 4). If each face
// gave a push of its own, a vertex above the inside of one face would also be pushed aside by the neighbours, whose
// nearest points are on the common border. A flat floor would have bumps along its edges.
//
// Notation
//   cells   the faces on which a layer acts for one vertex (in the plane, and among loose edges: the edges)
//   k       of a border between cells (edge or vertex): how many of the cells have it
//   B(x)    the potential of the layer between the vertex and x: r (d - eta)^2 / 2 if d < eta, else 0
//   weight  of a cell 1; of an edge of faces 1 - k; of a vertex such that the weights of everything that meets there
//           add up to 1. So if one edge or corner is the nearest point of all cells, it counts once
// The layer's potential for the vertex is the sum of weight * B. Cells on which the layer does not act need not be
// known: a border is no nearer than any cell that has it.
//
// The nearest point of each x is inside x, or on one of its edges or corners. So each term of the sum belongs to one of
// these `sites`. On a flat surface the weights of all sites but one add up to 0, without rounding. (Within rounding of
// a border, cells may disagree about the nearest point. Their weights still add up to 1.)
//
// All sites of a vertex are one contact: restitution and the bound of friction are decided for their sum.
//
// S is double; in audits also multiprecision numbers.
//
// integrator/edge_excess.h handles pairs of edges.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "certificates/stencil.h"
#include "integrator/contact_blow.h"

namespace noli::integrator {

/// A site on which a layer acts, and its weight.
template <class S, int Dim>
struct SiteOfContact {
  certificates::Stencil pair;  ///< the vertex and the site; its key is that of a cell that has the site
  Approach<S, Dim> approach;
  S weight = S(0);  ///< not 0

  /// The potential of a layer of stiffness 1. Precondition: it acts.
  S potential(const S& thickness) const {
    const S g = approach.distance - thickness;
    return S(0.5) * g * g;
  }
};

/// Collects the sites of one vertex. Reused for one vertex after another, to keep its memory.
template <class S, int Dim>
class InclusionExclusion {
 public:
  bool empty() const { return cells_.empty(); }
  /// Precondition: not empty.
  bool has_faces() const { return cells_.front().pair.kind == FeaturePair::vertex_face; }
  /// Precondition: not empty.
  VertexId vertex() const { return cells_.front().pair.vertices[0]; }
  /// Whether the pair belongs to the same vertex and kind as the pairs added so far.
  bool takes(const certificates::Stencil& pair) const {
    return empty() || (pair.kind == cells_.front().pair.kind && pair.vertices[0] == vertex());
  }

  /// Precondition: takes(pair); the layer acts on it.
  void add(const certificates::Stencil& pair, const Approach<S, Dim>& approach) {
    cells_.push_back({pair, approach, S(1)});
  }

  /// Replaces `result` by the sites whose weights do not add up to 0, and becomes empty. `position`: of a vertex of the
  /// mesh. The order depends only on the mesh. Precondition: not empty.
  template <class PositionOf>
  void take(const S& thickness, const PositionOf& position, std::vector<SiteOfContact<S, Dim>>& result) {
    result.clear();
    if (cells_.size() == 1) {
      result.push_back(cells_.front());
    } else {
      find_sites(thickness, position);
      for (const Site& site : sites_) {
        if (site.weight != 0) result.push_back(contact_at(site, position));
      }
    }
    cells_.clear();
  }

 private:
  static constexpr VertexId none = static_cast<VertexId>(-1);
  /// Ascending, `none` at the end.
  using Corners = std::array<VertexId, 3>;

  struct Site {
    Corners corners;
    int weight;
    std::size_t cell;  ///< a cell that has it; the first of several
  };
  struct Border {
    Corners corners;
    std::size_t cell;
  };

  void find_sites(const S& thickness, const auto& position) {
    sites_.clear();
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      sites_.push_back({nearest(cells_[i].pair, cells_[i].approach), 1, i});
    }
    const std::size_t cell_size = cells_.front().pair.size() - 1;
    if (cell_size == 3) add_edges(thickness, position);
    add_corners(thickness, position, cell_size == 3);
    std::ranges::stable_sort(sites_, {}, &Site::corners);
    auto last = sites_.begin();
    for (auto site = last + 1; site != sites_.end(); ++site) {
      if (site->corners == last->corners) {
        last->weight += site->weight;
      } else {
        *++last = *site;
      }
    }
    sites_.erase(last + 1, sites_.end());
  }

  /// Adds edges that several faces have. Leaves them, and their weights, in shared_.
  void add_edges(const S& thickness, const auto& position) {
    borders_.clear();
    shared_.clear();
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const auto& v = cells_[i].pair.vertices;
      for (const auto& [a, b] : {std::array{v[1], v[2]}, std::array{v[2], v[3]}, std::array{v[1], v[3]}}) {
        borders_.push_back({{std::min(a, b), std::max(a, b), none}, i});
      }
    }
    for_each_run([&](const Border& edge, int k) {
      if (k > 1 && add_if_near(edge, 1 - k, thickness, position)) shared_.push_back({edge.corners, 1 - k, edge.cell});
    });
  }

  /// Adds vertices that several cells have. A vertex is no nearer than any edge that has it, so if the vertex counts,
  /// those edges have been added.
  void add_corners(const S& thickness, const auto& position, bool of_faces) {
    borders_.clear();
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const certificates::Stencil& pair = cells_[i].pair;
      for (std::size_t k = 1; k < pair.size(); ++k) borders_.push_back({{pair.vertices[k], none, none}, i});
    }
    for_each_run([&](const Border& corner, int k) {
      int weight = 1 - k;
      if (of_faces) {
        for (const Site& edge : shared_) {
          const bool has = edge.corners[0] == corner.corners[0] || edge.corners[1] == corner.corners[0];
          if (has) weight -= edge.weight;
        }
      }
      if (weight != 0) add_if_near(corner, weight, thickness, position);
    });
  }

  /// Calls each(border, count) for each different border in borders_.
  template <class Each>
  void for_each_run(Each&& each) {
    std::ranges::stable_sort(borders_, {}, &Border::corners);
    for (auto begin = borders_.begin(); begin != borders_.end();) {
      auto end = begin;
      while (end != borders_.end() && end->corners == begin->corners) ++end;
      each(*begin, static_cast<int>(end - begin));
      begin = end;
    }
  }

  bool add_if_near(const Border& border, int weight, const S& thickness, const auto& position) {
    const certificates::Stencil pair = pair_with(border.corners, border.cell);
    Approach<S, Dim> approach;
    find_approach_of<S, Dim>(pair, position, approach);
    if (!(approach.distance < thickness)) return false;
    sites_.push_back({nearest(pair, approach), weight, border.cell});
    return true;
  }

  /// The corners with a nonzero weight in the closest point, which tell its site.
  static Corners nearest(const certificates::Stencil& pair, const Approach<S, Dim>& approach) {
    Corners corners{none, none, none};
    std::size_t count = 0;
    for (std::size_t i = 1; i < pair.size(); ++i) {
      if (approach.closest.weights[i] != S(0)) corners[count++] = pair.vertices[i];
    }
    std::ranges::sort(corners);
    return corners;
  }

  certificates::Stencil pair_with(const Corners& corners, std::size_t cell) const {
    const auto kind = corners[1] == none ? FeaturePair::vertex_vertex : FeaturePair::vertex_edge;
    return {kind, {vertex(), corners[0], corners[1] == none ? 0 : corners[1], 0}, cells_[cell].pair.key};
  }

  SiteOfContact<S, Dim> contact_at(const Site& site, const auto& position) const {
    const std::size_t cell_size = cells_.front().pair.size() - 1;
    SiteOfContact<S, Dim> contact{cells_[site.cell].pair, cells_[site.cell].approach, S(site.weight)};
    if (site.corners[cell_size - 1] != none) return contact;  // the inside of a cell
    contact.pair = pair_with(site.corners, site.cell);
    find_approach_of<S, Dim>(contact.pair, position, contact.approach);
    return contact;
  }

  std::vector<SiteOfContact<S, Dim>> cells_;
  std::vector<Site> sites_, shared_;
  std::vector<Border> borders_;
};

}  // namespace noli::integrator
