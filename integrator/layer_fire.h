// SPDX-License-Identifier: Apache-2.0
//
// Fires a layer for its pairs: one after the other, or, if the scene asks for it, so that a flat mesh acts like a plane
// (integrator/inclusion_exclusion.h, integrator/edge_excess.h).
//
// integrator/contact.h decides when a layer fires and for which pairs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "certificates/stencil.h"
#include "integrator/contact_blow.h"
#include "integrator/edge_excess.h"
#include "integrator/inclusion_exclusion.h"

namespace noli::integrator {

/// Joins adjacent cells: takes the pairs on which a layer acts, in the order of their keys, and makes contacts of them.
template <class S, int Dim>
class JoinedContacts {
 public:
  using Sites = std::span<const SiteOfContact<S, Dim>>;

  static bool joins(const certificates::Stencil& pair) { return pair.kind != FeaturePair::vertex_vertex; }

  /// Adds a pair. Calls each(sites of one contact) for contacts that are complete. Precondition: joins(pair).
  template <class PositionOf, class Each>
  void add(const certificates::Stencil& pair, const Approach<S, Dim>& approach, const S& thickness,
           const PositionOf& position, Each&& each) {
    if (!cells_.takes(pair)) take_cells(thickness, position, each);
    if (pair.kind != FeaturePair::edge_edge) return cells_.add(pair, approach);
    find_excess<S, Dim>({pair, approach, S(1)}, thickness, known_, contact_);
    if (!contact_.empty()) each(Sites(contact_));
  }

  /// Calls each() for the remaining contacts.
  template <class PositionOf, class Each>
  void finish(const S& thickness, const PositionOf& position, Each&& each) {
    if (!cells_.empty()) take_cells(thickness, position, each);
    known_.clear();
  }

 private:
  template <class PositionOf, class Each>
  void take_cells(const S& thickness, const PositionOf& position, Each&& each) {
    const bool of_faces = cells_.has_faces();
    cells_.take(thickness, position, contact_);
    if (contact_.empty()) return;
    if (of_faces) known_.add(contact_, thickness);
    each(Sites(contact_));
  }

  InclusionExclusion<S, Dim> cells_;
  SitesOfVertices<S, Dim> known_;
  std::vector<SiteOfContact<S, Dim>> contact_;
};

template <class S, int Dim>
class LayerFire {
 public:
  /// `joins`: adjacent cells count once.
  explicit LayerFire(bool joins) : joins_(joins) {}

  /// Fires for h seconds. `pairs`: in the order of their keys. Calls seen(i, approach, course) once for each pairs[i],
  /// and struck(pair, closest points) for pairs that get an impulse. For joined pairs, `course` only says whether the
  /// layer acts on them. Throws ContactLimit at distance 0. Precondition: the recording has room for all vertices of
  /// the pairs.
  template <class Recorder, class Seen, class Struck>
  void operator()(const Kicked<S, Dim, Recorder>& now, std::span<const certificates::Stencil> pairs,
                  const LayerTerms& layer, double h, Account<S, Dim>& account, Seen&& seen, Struck&& struck) {
    const S thickness(layer.thickness);
    const auto position = [&now](VertexId i) -> Vec<S, Dim> { return now.particles[i].at(now.t); };
    const auto contact = [&](std::span<const SiteOfContact<S, Dim>> sites) {
      fire(now, sites, layer, h, account, struck);
    };
    for (std::size_t begin = 0; begin < pairs.size(); begin += approaches_.size()) {
      const auto row = pairs.subspan(begin, std::min(approaches_.size(), pairs.size() - begin));
      for (std::size_t i = 0; i < row.size(); ++i) find_approach(now, row[i], approaches_[i]);
      for (std::size_t i = 0; i < row.size(); ++i) {
        const Approach<S, Dim>& approach = approaches_[i];
        if (joins_ && JoinedContacts<S, Dim>::joins(row[i])) {
          Course course;
          course.acts = approach.distance < thickness;
          if (course.acts) joined_.add(row[i], approach, thickness, position, contact);
          seen(begin + i, approach, course);
          continue;
        }
        const Blow blow = strike_pair(now, row[i], approach, layer, h, Strength<S>{}, anchors_, account);
        seen(begin + i, approach, blow.course);
        if (blow.struck) struck(row[i], approach.closest);
      }
    }
    if (joins_) joined_.finish(thickness, position, contact);
  }

  const Anchors<S>& anchors() const { return anchors_; }
  Anchors<S>& anchors() { return anchors_; }

  /// Calls each(pair, closest points, g, weight) for the pairs on which the layer acts, with vertices at
  /// position(vertex).
  template <class PositionOf, class Each>
  void for_each_acting(std::span<const certificates::Stencil> pairs, const LayerTerms& layer,
                       const PositionOf& position, Each&& each) const {
    const S thickness(layer.thickness);
    JoinedContacts<S, Dim> joined;
    const auto contact = [&](std::span<const SiteOfContact<S, Dim>> sites) {
      for (const SiteOfContact<S, Dim>& site : sites) {
        each(site.pair, site.approach.closest, S(site.approach.distance - thickness), site.weight);
      }
    };
    for (const certificates::Stencil& pair : pairs) {
      Approach<S, Dim> approach;
      find_approach_of<S, Dim>(pair, position, approach);
      if (!(approach.distance < thickness)) continue;
      if (joins_ && JoinedContacts<S, Dim>::joins(pair)) {
        joined.add(pair, approach, thickness, position, contact);
      } else {
        each(pair, approach.closest, S(approach.distance - thickness), S(1));
      }
    }
    if (joins_) joined.finish(thickness, position, contact);
  }

 private:
  /// Fires for the sites of one contact.
  template <class Recorder, class Struck>
  void fire(const Kicked<S, Dim, Recorder>& now, std::span<const SiteOfContact<S, Dim>> sites, const LayerTerms& layer,
            double h, Account<S, Dim>& account, Struck&& struck) {
    Strength<S> strength = strength_of_all(now, sites, S(layer.thickness));
    for (const SiteOfContact<S, Dim>& site : sites) {
      strength.weight = site.weight;
      const Blow blow = strike_pair(now, site.pair, site.approach, layer, h, strength, anchors_, account);
      if (blow.struck) struck(site.pair, site.approach.closest);
    }
  }

  /// Decides whether the sites part as a whole: whether the layer's potential falls. And computes which share of the
  /// push remains after the pull is subtracted.
  template <class Recorder>
  static Strength<S> strength_of_all(const Kicked<S, Dim, Recorder>& now, std::span<const SiteOfContact<S, Dim>> sites,
                                     const S& thickness) {
    using std::sqrt;
    Strength<S> all;
    if (sites.size() == 1) return all;
    S power(0), pushes(0);
    Vec<S, Dim> net = Vec<S, Dim>::Zero();
    const certificates::Stencil& of = sites.front().pair;
    for (const SiteOfContact<S, Dim>& site : sites) {
      const auto& [closest, distance] = site.approach;
      if (!(distance > S(0))) throw ContactLimit(site.pair, now.t);
      const S push = site.weight * (thickness - distance), along = push / distance;
      power += along * opening<Dim, S>(closest, site.pair.size(), [&](std::size_t i) -> const Vec<S, Dim>& {
                 return now.particles[site.pair.vertices[i]].v;
               });
      if (push > S(0)) pushes += push;
      // In a pair of edges, an end of the second edge is on the other side.
      const VertexId v = site.pair.vertices[0];
      const bool turned = of.kind == FeaturePair::edge_edge && (v == of.vertices[2] || v == of.vertices[3]);
      net += (turned ? S(-along) : along) * closest.r;
    }
    all.parts = power > S(0);
    if (pushes > S(0)) all.rubbing = std::min<S>(S(1), sqrt(net.squaredNorm()) / pushes);
    return all;
  }

  Anchors<S> anchors_;  ///< of all materials
  bool joins_;
  /// Of the pairs that fire next. All are computed before any pair fires: one by one, each would wait for what the
  /// previous one has just written.
  std::array<Approach<S, Dim>, 64> approaches_;
  JoinedContacts<S, Dim> joined_;
};

}  // namespace noli::integrator
