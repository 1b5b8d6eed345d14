// SPDX-License-Identifier: Apache-2.0
//
// A layer fires for its pairs: one after the other, or, where the scene asks for it, so that a flat mesh acts as a
// plane (integrator/inclusion_exclusion.h, integrator/edge_excess.h).
//
// What this does not do: it says neither when a layer fires nor for which pairs (integrator/contact.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "certificates/stencil.h"
#include "integrator/contact_blow.h"
#include "integrator/edge_excess.h"
#include "integrator/inclusion_exclusion.h"

namespace noli::integrator {

template <class S, int Dim>
class LayerFire {
 public:
  /// `joins`: what lies side by side counts once.
  LayerFire(bool joins, const Mesh& mesh)
      : joins_(joins),
        faces_of_edges_(joins && Dim == 3 ? FacesOfEdges(mesh) : FacesOfEdges()),
        excess_(faces_of_edges_) {}
  LayerFire(const LayerFire&) = delete;
  LayerFire& operator=(const LayerFire&) = delete;

  /// Fires for h seconds. `pairs`: in the order of their keys. Calls seen(i, approach, course) for pairs[i], each once,
  /// and struck(pair, closest points) for what gets an impulse. Of pairs that are joined `course` says whether the
  /// layer acts on them and between which points. Throws ContactLimit at distance 0. Room in the recording is the caller's
  /// business.
  template <class Recorder, class Seen, class Struck>
  void operator()(const Kicked<S, Dim, Recorder>& now, std::span<const certificates::Stencil> pairs,
                  const LayerTerms& layer, double h, Account<S, Dim>& account, Seen&& seen, Struck&& struck) {
    for (std::size_t begin = 0; begin < pairs.size(); begin += approaches_.size()) {
      const auto row = pairs.subspan(begin, std::min(approaches_.size(), pairs.size() - begin));
      for (std::size_t i = 0; i < row.size(); ++i) find_approach(now, row[i], approaches_[i]);
      for (std::size_t i = 0; i < row.size(); ++i) {
        const Approach<S, Dim>& approach = approaches_[i];
        if (joins_ && row[i].kind != FeaturePair::vertex_vertex) {
          Course course;
          course.acts = approach.distance < S(layer.thickness);
          if (course.acts) join(now, row[i], approach, layer, h, account, struck);
          seen(begin + i, approach, course);
          continue;
        }
        const Blow blow = strike_pair(now, row[i], approach, layer, h, S(1), anchors_, account);
        seen(begin + i, approach, blow.course);
        if (blow.struck) struck(row[i], approach.closest);
      }
    }
    fire(joined_, now, layer, h, account, struck);
    fire(excess_, now, layer, h, account, struck);
  }

  const Anchors<S>& anchors() const { return anchors_; }
  Anchors<S>& anchors() { return anchors_; }

  /// Calls each(pair, closest points, g, weight) for what the layer acts on where things are: position(vertex).
  template <class PositionOf, class Each>
  void for_each_acting(std::span<const certificates::Stencil> pairs, const LayerTerms& layer,
                       const PositionOf& position, Each&& each) const {
    const S thickness(layer.thickness);
    InclusionExclusion<S, Dim> joined;
    EdgeExcess<S, Dim> excess(faces_of_edges_);
    const auto take = [&](auto& sites) {
      if (sites.empty()) return;
      sites.take(thickness, position, [&](const SiteOfContact<S, Dim>& site) {
        each(site.pair, site.approach.closest, S(site.approach.distance - thickness), site.weight);
      });
    };
    for (const certificates::Stencil& pair : pairs) {
      Approach<S, Dim> approach;
      find_approach_of<S, Dim>(pair, position, approach);
      if (!(approach.distance < thickness)) continue;
      if (!joins_ || pair.kind == FeaturePair::vertex_vertex) {
        each(pair, approach.closest, S(approach.distance - thickness), S(1));
      } else if (pair.kind == FeaturePair::edge_edge) {
        excess.add(pair, approach);
      } else {
        if (!joined.takes(pair)) take(joined);
        joined.add(pair, approach);
      }
    }
    take(joined);
    take(excess);
  }

 private:
  template <class Recorder, class Struck>
  void join(const Kicked<S, Dim, Recorder>& now, const certificates::Stencil& pair, const Approach<S, Dim>& approach,
            const LayerTerms& layer, double h, Account<S, Dim>& account, Struck&& struck) {
    if (pair.kind == FeaturePair::edge_edge) return excess_.add(pair, approach);
    if (!joined_.takes(pair)) fire(joined_, now, layer, h, account, struck);
    joined_.add(pair, approach);
  }

  /// Fires for all `sites` together.
  template <class Sites, class Recorder, class Struck>
  void fire(Sites& sites, const Kicked<S, Dim, Recorder>& now, const LayerTerms& layer, double h,
            Account<S, Dim>& account, Struck&& struck) {
    if (sites.empty()) return;
    const auto position = [&now](VertexId i) -> Vec<S, Dim> { return now.particles[i].at(now.t); };
    sites.take(S(layer.thickness), position, [&](const SiteOfContact<S, Dim>& site) {
      const Blow blow = strike_pair(now, site.pair, site.approach, layer, h, site.weight, anchors_, account);
      if (blow.struck) struck(site.pair, site.approach.closest);
    });
  }

  Anchors<S> anchors_;  ///< of all materials: a pair has one
  bool joins_;
  /// Of the pairs that fire next: all are found before any of them fires. One by one, each would wait for what the one
  /// before has just written.
  std::array<Approach<S, Dim>, 64> approaches_;
  InclusionExclusion<S, Dim> joined_;
  FacesOfEdges faces_of_edges_;
  EdgeExcess<S, Dim> excess_;
};

}  // namespace noli::integrator
