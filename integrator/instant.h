// SPDX-License-Identifier: Apache-2.0
//
// Books the work of groups of forces that strike at one time, after all of them have struck.
//
// Notation
//   v0, v1   a particle's velocity before and after everything that strikes at this time
//   J        the impulse of one group on a particle [N s]; D the part of it that is damping
//
// When forces nearly balance, each of them alone would throw a particle far off, and the next one throws it back. The
// velocities in between are meaningless. So each group does the work J . (v0 + v1) / 2, of which D . (v0 + v1) / 2 is
// damping. The works of all groups still add up to the change of kinetic energy.
//
// Held particles, whose velocity no force changes, are booked elsewhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "integrator/books.h"
#include "integrator/force.h"

namespace noli::integrator {

template <class S, int Dim>
class Instant {
 public:
  Instant() = default;
  explicit Instant(std::size_t particles) : begun_(particles, 0), before_(particles) {}

  /// Call this before a group strikes `vertices`, which must outlive this time; `last`: it is the last group.
  /// `velocity` returns that of a vertex, and is called for each, in order. Call end() afterwards.
  template <bool Damped, class Velocity>
  void begin(ForceKind kind, bool last, std::span<const VertexId> vertices, Velocity&& velocity) {
    groups_.push_back({kind, Damped, vertices, changes_.size(), dampings_.size()});
    last_ = last;
    alone_ = last && groups_.size() == 1;
    const std::size_t first = changes_.size();
    changes_.resize(first + vertices.size());
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const VertexId i = vertices[k];
      const Vec<S, Dim>& v = velocity(i);
      changes_[first + k] = v;
      if (alone_ || begun_[i] == number_) continue;
      begun_[i] = number_;
      before_[i] = v;
    }
  }

  /// Call this after the group has struck. `settled` settles a vertex and returns an object with its `v` and
  /// `inverse_mass`, which is 0 if it is held; called for each, in order. `damping`: D of a vertex, if the group is
  /// damped.
  template <bool Damped, class Settled, class Damping = std::nullptr_t>
  void end(Settled&& settled, Damping&& damping = {}) {
    const Group& group = groups_.back();
    Vec<S, Dim>* const changes = changes_.data() + group.first;
    if (!last_) {
      for (std::size_t k = 0; k < group.vertices.size(); ++k) {
        changes[k] = settled(group.vertices[k]).v - changes[k];
        if constexpr (Damped) dampings_.push_back(damping(group.vertices[k]));
      }
      return;
    }
    S twice_work(0), twice_damping(0);
    for (std::size_t k = 0; k < group.vertices.size(); ++k) {
      const VertexId i = group.vertices[k];
      const auto& particle = settled(i);
      if (particle.inverse_mass == S(0)) continue;
      const Vec<S, Dim> twice_mean = (alone_ ? changes[k] : before_[i]) + particle.v;
      twice_work += Vec<S, Dim>(particle.v - changes[k]).dot(twice_mean) / particle.inverse_mass;
      if constexpr (Damped) twice_damping += damping(i).dot(twice_mean);
    }
    twice_work_ = twice_work;
    twice_damping_ = twice_damping;
  }

  /// Call this after the last group has struck. `particles`: objects with `v` and `inverse_mass`.
  template <class Particles>
  void close(const Particles& particles, Books<S, Dim>& books) {
    if (groups_.empty()) return;
    if (last_) {
      book(books.of(groups_.back().kind), twice_work_, twice_damping_);
      groups_.pop_back();
    }
    for (const Group& group : groups_) close_early(group, particles, books.of(group.kind));
    groups_.clear();
    changes_.clear();
    dampings_.clear();
    ++number_;
  }

 private:
  struct Group {
    ForceKind kind;
    bool damped;
    std::span<const VertexId> vertices;
    std::size_t first;          ///< of changes_
    std::size_t first_damping;  ///< of dampings_
  };

  /// Books a group that was not the last.
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

  bool last_ = false, alone_ = false;  ///< the last group of groups_
  S twice_work_{}, twice_damping_{};   ///< of the last group
  std::vector<Group> groups_;
  std::vector<Vec<S, Dim>> changes_;   ///< J / m of the groups' vertices, one after another; before end(), velocities
  std::vector<Vec<S, Dim>> dampings_;  ///< D, of the vertices of damped groups
  std::uint64_t number_ = 1;           ///< of this time
  std::vector<std::uint64_t> begun_;   ///< by particle: the number of the time to which before_ belongs
  std::vector<Vec<S, Dim>> before_;    ///< v0, by particle
};

}  // namespace noli::integrator
