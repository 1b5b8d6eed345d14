// SPDX-License-Identifier: Apache-2.0
//
// Logs what a window of a run in double did, so that a run in another precision can do the same in the same order.
//
// Forces and scripts need no log: their times follow from their steps in every precision. Gravity needs none either:
// its times follow from those of forces and from the run's own impulses. Contact needs one: which pairs a layer fires
// for depends on the positions. Only pairs that a certificate passed on to the layers are logged.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "integrator/contact.h"
#include "integrator/recording.h"

namespace noli::audit {

/// A pair for which a layer fired, and the branches that the formulas took in double.
struct Examined {
  certificates::Stencil pair;
  integrator::Course course;
};

/// A layer that fired for the pairs [begin, end) of the log.
struct LoggedFiring {
  integrator::Firing firing;
  std::size_t begin = 0, end = 0;
};

/// A layer and the pairs for which it is active at the window's end.
struct ActiveLayer {
  integrator::LayerTerms terms;
  double step;  ///< h(l) [s]
  std::vector<certificates::Stencil> pairs;
};

/// A recorder of Engine<double, Dim>.
template <int Dim>
class EventLog : public integrator::Uncounted {
 public:
  void reserve(std::size_t count) { recording_.reserve(count); }
  void put(VertexId vertex, double t, const integrator::Vec<double, Dim>& x, bool wanted) {
    recording_.put(vertex, t, x, wanted);
  }
  void layer_fires(const integrator::Firing& firing) {
    firings_.push_back({firing, examined_.size(), examined_.size()});
  }
  void examined(const certificates::Stencil& pair, const integrator::Course& course) {
    examined_.push_back({pair, course});
    firings_.back().end = examined_.size();
  }

  /// Call at the window's end.
  void add_active(ActiveLayer layer) { active_.push_back(std::move(layer)); }

  void clear() {
    recording_.clear();
    firings_.clear();
    examined_.clear();
    active_.clear();
  }

  std::span<const integrator::Breakpoint<double, Dim>> breakpoints() const { return recording_.stream(); }
  std::span<const LoggedFiring> firings() const { return firings_; }
  std::span<const Examined> examined() const { return examined_; }
  std::span<const ActiveLayer> active() const { return active_; }

 private:
  integrator::Recording<double, Dim> recording_;
  std::vector<LoggedFiring> firings_;
  std::vector<Examined> examined_;
  std::vector<ActiveLayer> active_;
};

}  // namespace noli::audit
