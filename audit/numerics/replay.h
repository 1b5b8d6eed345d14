// SPDX-License-Identifier: Apache-2.0
//
// Replays a run in double in numbers of any precision, event by event, and finds where the two runs diverge.
//
// Event times are the doubles of that run in all precisions; the time between two events is their difference, rounded
// once. The constants of the model are the doubles of the scene. Everything else is computed anew.
// audit/numerics/precision.h measures distances between runs.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "audit/numerics/divergence.h"
#include "audit/numerics/event_log.h"
#include "audit/numerics/mpfr_number.h"
#include "audit/numerics/precise_model.h"
#include "audit/numerics/replayed_contact.h"
#include "integrator/energy.h"
#include "integrator/engine.h"

namespace noli::audit {

/// True if both have the same bits; all NaNs count as the same.
inline bool same_bits(double a, const MpfrNumber& b) {
  if (std::isnan(a)) return b.is_nan();
  return b == MpfrNumber(a) && std::signbit(a) == b.negative();
}

/// same_bits for all components of two vectors.
template <class A, class B>
bool all_same_bits(const A& a, const B& b) {
  return std::equal(a.begin(), a.end(), b.begin(), same_bits);
}

/// The recorder of a replay. It compares each event with the log.
template <int Dim>
class Comparison : public integrator::Uncounted {
 public:
  /// `bits`: also compare breakpoints, number by number.
  explicit Comparison(bool bits) : bits_(bits) {}

  void follow(const EventLog<Dim>& log) {
    log_ = &log;
    next_breakpoint_ = next_examined_ = 0;
  }

  void reserve(std::size_t) {}
  void put(VertexId vertex, double t, const integrator::Vec<MpfrNumber, Dim>& x, bool wanted) {
    if (!bits_ || !wanted || difference_) return;
    if (next_breakpoint_ == log_->breakpoints().size()) return differ(t, vertex);
    const auto& expected = log_->breakpoints()[next_breakpoint_++];
    if (expected.vertex != vertex || expected.t != t || !all_same_bits(expected.x, x)) differ(t, vertex);
  }
  void layer_fires(const integrator::Firing& firing) { firing_ = firing; }
  void examined(const certificates::Stencil& pair, const integrator::Course& here) {
    const integrator::Course there = log_->examined()[next_examined_++].course;
    if (here == there) return;
    const CourseChange change{firing_.time, pair, firing_.terms.layer, there.acts};
    if (here.acts != there.acts) return changes_.acts.add(change);
    const bool corners_differ = here.corners != there.corners;
    if (corners_differ) changes_.corners.add(change);
    if (!here.acts) return;
    if (here.parts != there.parts && firing_.terms.restitution != 1) changes_.parts.add(change);
    if (here.sticks != there.sticks && !corners_differ) changes_.sticks.add(change);
  }

  /// Records a difference if a breakpoint of the log did not occur.
  void conclude(double end) {
    if (bits_ && !difference_ && next_breakpoint_ != log_->breakpoints().size()) {
      difference_ = {end, "breakpoints that never came"};
    }
  }

  void differ(double t, VertexId vertex) { differ(t, "position of vertex " + std::to_string(vertex)); }
  void differ(double t, const std::string& what) {
    if (!difference_) difference_ = {t, what};
  }

  const std::optional<BitDifference>& difference() const { return difference_; }
  const CourseChanges& changes() const { return changes_; }

 private:
  bool bits_;
  const EventLog<Dim>* log_ = nullptr;
  std::size_t next_breakpoint_ = 0, next_examined_ = 0;
  integrator::Firing firing_{};
  std::optional<BitDifference> difference_;
  CourseChanges changes_;
};

template <int Dim>
class Replay {
 public:
  using Number = MpfrNumber;
  using State = integrator::State<Number, Dim>;

  /// `bits`: expect the run in double, bit for bit.
  Replay(const Arithmetic& arithmetic, bool bits, const integrator::Model<double, Dim>& model)
      : arithmetic_(arithmetic), comparison_(bits), engine_(scoped(arithmetic, model)) {}
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  /// Runs the next window. After a stop, do not use this object again. Throws integrator::ContactLimit.
  void run_window(const EventLog<Dim>& log, const integrator::Stop& stop) {
    const MpfrScope scope(arithmetic_);
    comparison_.follow(log);
    if (engine_.contact() != nullptr) engine_.contact()->follow(log);
    if (!engine_.run_window(comparison_, books_, stop)) return;
    comparison_.conclude(engine_.time());
    state_ = integrator::Ledger<Number, Dim, ReplayedContact<Number, Dim>>(engine_).state();
    given_ = books_.given();
  }

  const auto& particles() const { return engine_.particles(); }
  /// The state at the end of the last window.
  const State& state() const { return state_; }
  const Number& given() const { return given_; }  ///< Books::given() since time 0 [J]

  Comparison<Dim>& comparison() { return comparison_; }

 private:
  using Engine = integrator::Engine<Number, Dim, ReplayedContact<Number, Dim>>;

  static Engine scoped(const Arithmetic& arithmetic, const integrator::Model<double, Dim>& model) {
    const MpfrScope scope(arithmetic);
    return Engine(precise(model));
  }

  Arithmetic arithmetic_;
  Comparison<Dim> comparison_;
  Engine engine_;
  integrator::Books<Number, Dim> books_;
  State state_;
  Number given_;
};

}  // namespace noli::audit
