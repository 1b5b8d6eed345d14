// SPDX-License-Identifier: Apache-2.0
//
// The work of groups of forces that strike at one time, booked when all of them have struck.
//
// Notation
//   v0, v1   a particle's velocity before and after all that strikes at this time
//   J        what one group gives a particle [N s]; of it D is damping
//
// Where forces nearly balance, each of them alone would throw a particle far off, and the next one throws it back.
// Velocities in between mean nothing: each group works with (v0 + v1) / 2, J . (v0 + v1) / 2 in all and D . (v0 + v1) /
// 2 of it by damping. The works of all groups still add up to the change of kinetic energy.
//
// What this does not do: it knows nothing of particles that are held, whose velocity no force changes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "integrator/books.h"
#include "integrator/vector.h"

namespace noli::integrator {

template <class S, int Dim>
class Instant {
 public:
  Instant() = default;
  explicit Instant(std::size_t particles) : begun_(particles, 0), before_(particles), damping_(particles) {}

  /// A group is about to strike `vertices`, which outlive this time; `last`: no other does after it. For each of them,
  /// in order, before() is called; then the group, if it is damped, adds up damping(); then after() is called for each.
  void begin(ForceKind kind, bool damped, bool last, std::span<const VertexId> vertices) {
    groups_.push_back({kind, damped, vertices, changes_.size(), dampings_.size()});
    last_ = last;
    alone_ = last && groups_.size() == 1;
  }

  /// A vertex moves with v.
  void before(VertexId i, const Vec<S, Dim>& v) {
    changes_.push_back(v);
    if (groups_.back().damped) damping_[i].setZero();
    if (alone_ || begun_[i] != 0) return;
    begun_[i] = 1;
    before_[i] = v;
  }

  /// J of damping, by particle.
  std::span<Vec<S, Dim>> damping() { return damping_; }

  /// The k-th vertex of the group moves with v. `inverse_mass`: 0 if it is held.
  void after(std::size_t k, VertexId i, const Vec<S, Dim>& v, const S& inverse_mass) {
    const Group& group = groups_.back();
    Vec<S, Dim>& change = changes_[group.first + k];
    if (!last_) {
      change = v - change;
      if (group.damped) dampings_.push_back(damping_[i]);
    } else if (inverse_mass != S(0)) {
      const Vec<S, Dim> twice_mean = (alone_ ? change : before_[i]) + v;
      twice_work_ += Vec<S, Dim>(v - change).dot(twice_mean) / inverse_mass;
      if (group.damped) twice_damping_ += damping_[i].dot(twice_mean);
    }
  }

  /// The last group has struck, or no other will. `particles`: of what has `v` and `inverse_mass`.
  template <class Particles>
  void close(const Particles& particles, Books<S, Dim>& books) {
    if (groups_.empty()) return;
    if (last_) {
      book(books.of(groups_.back().kind), twice_work_, twice_damping_);
      if (!alone_) forget(groups_.back());
      groups_.pop_back();
    }
    for (const Group& group : groups_) close_early(group, particles, books.of(group.kind));
    for (const Group& group : groups_) forget(group);
    groups_.clear();
    changes_.clear();
    dampings_.clear();
    twice_work_ = twice_damping_ = S(0);
  }

 private:
  struct Group {
    ForceKind kind;
    bool damped;
    std::span<const VertexId> vertices;
    std::size_t first;          ///< of changes_
    std::size_t first_damping;  ///< of dampings_
  };

  /// One that was not the last.
  template <class Particles>
  void close_early(const Group& group, const Particles& particles, Account<S, Dim>& account) const {
    S twice_work(0), twice_damping(0);
    for (std::size_t k = 0; k < group.vertices.size(); ++k) {
      const auto& particle = particles[group.vertices[k]];
      if (particle.inverse_mass == S(0)) continue;
      const Vec<S, Dim> twice_mean = before_[group.vertices[k]] + particle.v;
      twice_work += changes_[group.first + k].dot(twice_mean) / particle.inverse_mass;
      if (group.damped) twice_damping += dampings_[group.first_damping + k].dot(twice_mean);
    }
    book(account, twice_work, twice_damping);
  }

  static void book(Account<S, Dim>& account, const S& twice_work, const S& twice_damping) {
    account.work += S(0.5) * (twice_work - twice_damping);
    account.damping_work += S(0.5) * twice_damping;
  }

  void forget(const Group& group) {
    for (const VertexId i : group.vertices) begun_[i] = 0;
  }

  bool last_ = false, alone_ = false;  ///< the last group of groups_
  S twice_work_{}, twice_damping_{};   ///< of the last group, so far
  std::vector<Group> groups_;
  std::vector<Vec<S, Dim>> changes_;  ///< J / m, of the groups' vertices, one after another; before after(), velocities
  std::vector<Vec<S, Dim>> dampings_;  ///< D, of those of damped groups
  std::vector<std::uint8_t> begun_;
  std::vector<Vec<S, Dim>> before_, damping_;  ///< by particle
};

}  // namespace noli::integrator
