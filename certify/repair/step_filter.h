// SPDX-License-Identifier: Apache-2.0
//
// The velocity filter: moves vertices from given positions towards given ones, under forces of contact alone.
//
// Notation: that of noli/repair.h, and
//   phase    a part of the step, at whose beginning the layers of contact are chosen anew, by the gaps there. Where
//            things are very near, layers are thin and their steps short: such a phase lasts only `most_firings` of the
//            shortest of these, as what parts needs them no longer
//   piece    a window of the integration; a phase has more than one where it has very many breakpoints
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <noli/mesh.h>
#include "certify/repair/near_gaps.h"
#include "certify/repair/step_contact.h"
#include "certify/simulate/model_run.h"
#include "certify/simulate/retries.h"
#include "integrator/contact_extremes.h"
#include "integrator/recording.h"
#include "integrator/simulation.h"
#include "trajectory/sample.h"
#include "trajectory/stop.h"

namespace noli {

/// A step whose motion takes more memory than it may.
struct StepTooLong : std::runtime_error {
  StepTooLong() : std::runtime_error("its motion has more than 2^26 changes of velocity; try another thickness") {}
};

/// The motion of one step, over the times [0, 1].
struct FilteredStep {
  struct Piece {
    double begin;  ///< of its phase
    WorldLines lines;
  };
  std::vector<Piece> pieces;
  std::vector<Position> end;  ///< the positions at time 1: those given, where nothing struck
  std::uint32_t deepest = 0;  ///< the deepest layer that acted
  std::size_t breakpoints = 0;
  Position momentum_into_fixed{};  ///< as in RepairOutcome

  /// The positions at a time in [0, 1], rounded.
  std::vector<Position> at(double t) const {
    if (t == 1) return end;
    const auto ends_later = [t](const Piece& piece) { return piece.begin + piece.lines.last_time() >= t; };
    const auto piece = std::find_if(pieces.begin(), pieces.end() - 1, ends_later);
    return sample(piece->lines, std::clamp(t - piece->begin, piece->lines.first_time(), piece->lines.last_time()));
  }
};

template <int Dim>
class StepFilter {
 public:
  /// `fixed`: by vertex, nonzero if it moves as given. `excluded`: keys of pairs on which no contact acts, ascending;
  /// beside those that `contact` excludes. `progress`: called with the share of the step that is done. The
  /// other arguments have to outlive this.
  StepFilter(const Mesh& mesh, std::span<const double> mass, std::span<const std::uint8_t> fixed,
             const StepContact& contact, const std::vector<certificates::PairKey>& excluded, NearGaps<Dim>& gaps,
             const integrator::Stop& stop, std::function<void(double)> progress)
      : mesh_(mesh),
        mass_(mass),
        fixed_(fixed),
        contact_(contact),
        excluded_(excluded),
        gaps_(gaps),
        stop_(stop),
        progress_(std::move(progress)) {}

  /// From x towards y. Nothing if a time or a coordinate can no longer be represented. In two dimensions third
  /// coordinates are 0. Throws integrator::ContactLimit, with the time in the step, for features that are too near for
  /// any layer; StepTooLong; Stopped.
  std::optional<FilteredStep> operator()(const std::vector<Position>& x, const std::vector<Position>& y,
                                         const Retry& how) {
    from_ = vectors_of<Dim>(x);
    to_ = vectors_of<Dim>(y);
    state_ = {0, 0, from_, {}, {}};
    for (std::size_t i = 0; i < x.size(); ++i) state_.v.push_back(to_[i] - from_[i]);
    FilteredStep step;
    double now = 0, longest = 1;
    std::optional<integrator::ContactLimit> limited;  ///< by what a phase was cut short, until one succeeds
    while (now < 1) {
      const std::vector<double> sizes = gaps_(state_.x, contact_.bounds());
      const StepContact::Settings settings = contact_.settings(sizes, speeds_of(state_.v));
      const double length = std::min({1 - now, longest, most_firings * settings.least_step});
      const double next = length < 1 - now ? now + length : 1;
      if (!(next > now)) {  // so fast, or so near, that doubles know no time in between
        if (limited) throw integrator::ContactLimit(*limited);
        return std::nullopt;
      }
      try {
        if (!run_phase(now, next, settings.contact, how, step)) return std::nullopt;
      } catch (const integrator::ContactLimit& limit) {
        // Thinner layers, from half way on, may have more room.
        longest = std::min(length, limit.time) / 2;
        limited.emplace(limit.pair, now + limit.time);
        if (!(longest > shortest_phase)) throw integrator::ContactLimit(*limited);
        continue;
      }
      limited.reset();
      longest = std::min(1.0, 8 * longest);
      now = next;
      progress_(now);
    }
    step.end = positions_of<Dim>(state_.x);
    for (std::size_t i = 0; i < step.end.size(); ++i) {
      // x + v may miss by a rounding where a vertex was given.
      if (fixed_[i] != 0 || state_.v[i] == to_[i] - from_[i]) step.end[i] = y[i];
    }
    return step;
  }

 private:
  static constexpr double most_firings = 5000, shortest_phase = 0x1p-60;
  /// Beyond, a new phase with thinner layers is cheaper.
  static constexpr std::uint32_t most_layers = 64;

  /// Goes on from state_ at the time `now` to `next`. False if numbers are no longer finite. If it throws,
  /// nothing has changed.
  bool run_phase(double now, double next, const integrator::ContactSettings& contact, const Retry& how,
                 FilteredStep& step) {
    const integrator::Model<double, Dim> model = model_of(now, next, contact);
    integrator::Simulation<double, Dim> simulation = simulation_at<Dim>(model, {}, how.halvings, how.least_layers);
    std::vector<FilteredStep::Piece> pieces;
    Position into_fixed{};
    std::size_t breakpoints = step.breakpoints;
    integrator::Recording<double, Dim> recording;
    while (simulation.time() < model.window_length) {
      recording.clear();
      integrator::Books<double, Dim> books;
      if (!simulation.run_window(recording, books, stop_)) {
        throw Stopped(stop_asked().value_or(StopReason::interrupted), "a step that is repaired");
      }
      if (!simulation.finite()) return false;
      for (int k = 0; k < Dim; ++k) {
        into_fixed[static_cast<std::size_t>(k)] -= books.of(integrator::ForceKind::contact).impulse[k];
      }
      pieces.push_back({now, integrator::world_lines<Dim>(recording, model.x.size())});
      breakpoints += recording.size();
      if (breakpoints > std::size_t{1} << 26) throw StepTooLong();
    }
    std::move(pieces.begin(), pieces.end(), std::back_inserter(step.pieces));
    step.deepest = std::max(step.deepest, simulation.certificates().deepest);
    step.breakpoints = breakpoints;
    for (std::size_t k = 0; k < 3; ++k) step.momentum_into_fixed[k] += into_fixed[k];
    state_ = simulation.snapshot();
    for (std::size_t i = 0; i < model.x.size(); ++i) {
      if (fixed_[i] != 0) state_.v[i] = to_[i] - from_[i];
    }
    return true;
  }

  integrator::Model<double, Dim> model_of(double now, double next, const integrator::ContactSettings& contact) const {
    integrator::Model<double, Dim> model;
    model.mesh = mesh_;
    model.x = state_.x;
    model.v = state_.v;
    model.mass.assign(mass_.begin(), mass_.end());
    model.window_length = next - now;
    for (VertexId i = 0; i < model.x.size(); ++i) {
      if (fixed_[i] != 0) model.scripts.push_back({i, {0, next - now}, {model.x[i], given_at(i, next)}, 0});
    }
    model.most_breakpoints = std::max<std::size_t>(4'000'000, 8 * model.x.size());
    model.contact = contact;
    model.contact->most_layers = most_layers;
    model.contact->excluded_pairs = excluded_;
    return model;
  }

  /// Where a vertex that moves as given is at a time.
  integrator::Vec<double, Dim> given_at(VertexId i, double t) const {
    return t == 1 ? to_[i] : integrator::Vec<double, Dim>(from_[i] + t * (to_[i] - from_[i]));
  }

  /// Of each vertex, seen from their mean velocity.
  static std::vector<double> speeds_of(const std::vector<integrator::Vec<double, Dim>>& velocities) {
    integrator::Vec<double, Dim> mean = integrator::Vec<double, Dim>::Zero();
    for (const auto& v : velocities) mean += v / static_cast<double>(velocities.size());
    std::vector<double> speeds;
    for (const auto& v : velocities) speeds.push_back((v - mean).norm());
    return speeds;
  }

  const Mesh& mesh_;
  std::span<const double> mass_;
  std::span<const std::uint8_t> fixed_;
  const StepContact& contact_;
  const std::vector<certificates::PairKey>& excluded_;
  NearGaps<Dim>& gaps_;
  const integrator::Stop& stop_;
  std::function<void(double)> progress_;
  std::vector<integrator::Vec<double, Dim>> from_, to_;
  integrator::Snapshot<double, Dim> state_;
};

}  // namespace noli
