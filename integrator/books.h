// SPDX-License-Identifier: Apache-2.0
//
// The energy and momentum books of a window: which force did how much work.
//
// Notation
//   event  all groups of forces that strike at one time (integrator/instant.h); a force with a clock of its own;
//          gravity on one vertex, if it acts without a group; or a layer of contact, for one pair: all its impulses,
//          those of a potential and those that take energy
//   J      an impulse of an event on a particle [N s]; v, v' the particle's velocities before and after the event
//   work   J . (v + v') / 2. The works of all impulses of an event add up to the change of kinetic energy, for impulses
//          of any size. It is never computed as a difference of energies, which would lose digits
//
// Everything at one time is one event if possible: between the strikes of forces that nearly balance, a particle has
// velocities that are not part of the motion.
//
// Impulses on pinned and scripted particles do work too, with the velocity that the scene gives. The negative of that
// work is what the holder of the particles puts in; it is booked by script. Kinetic energy is that of free particles.
// So the works of a window, including those of scripts, add up to its change between the window's ends: the books are
// closed.
//
// When the features of a contact part, restitution withholds a part of the impulse that the layer's potential gives.
// The work of the full impulse is booked for the potential, and the negative work of the withheld part for restitution.
//
// The impulses of an elastic force add up to zero (and so do their moments). The books have the momentum that pinned
// and scripted particles take from the others.
//
// integrator/energy.h computes potential energies.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "integrator/force.h"

namespace noli::integrator {

/// x cross v: three numbers in space, one in the plane.
template <class S, int Dim>
using Moment = Eigen::Matrix<S, Dim == 3 ? 3 : 1, 1, Eigen::DontAlign>;

template <class S, int Dim>
Moment<S, Dim> moment(const Vec<S, Dim>& x, const Vec<S, Dim>& p) {
  if constexpr (Dim == 3) {
    return {x[1] * p[2] - x[2] * p[1], x[2] * p[0] - x[0] * p[2], x[0] * p[1] - x[1] * p[0]};
  } else {
    return Moment<S, Dim>(x[0] * p[1] - x[1] * p[0]);
  }
}

/// One kind of force, or one material of contact.
template <class S, int Dim>
struct Account {
  S work{};                                                 ///< of the impulses that potentials give [J]
  S damping_work{};                                         ///< of damping and friction [J]
  S restitution_work{};                                     ///< of what restitution withholds [J]
  S held_work{};                                            ///< of the holders of particles, all scripts [J]
  Vec<S, Dim> impulse = Vec<S, Dim>::Zero();                ///< on the momentum of free particles [N s]
  Moment<S, Dim> angular_impulse = Moment<S, Dim>::Zero();  ///< the same for x cross J, about the origin [N m s]
  std::uint64_t events = 0;                                 ///< forces fired

  Account& operator+=(const Account& other) {
    work += other.work;
    damping_work += other.damping_work;
    restitution_work += other.restitution_work;
    held_work += other.held_work;
    impulse += other.impulse;
    angular_impulse += other.angular_impulse;
    events += other.events;
    return *this;
  }
};

/// Which script moves a particle, and the work of each.
template <class S, int Dim>
class ScriptBook {
 public:
  struct ScriptedVertex {
    std::uint32_t script = none;
    double changed_at = -1;  ///< the time of its last change of velocity [s]
    Vec<S, Dim> before;      ///< its velocity before that
  };
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  ScriptBook() = default;
  /// `vertices`: by vertex; empty if there are no scripts. `works`: by script [J].
  ScriptBook(std::span<ScriptedVertex> vertices, std::span<S> works) : vertices_(vertices), works_(works) {}

  /// Call this before a scripted vertex changes its velocity, which has been `before`.
  void turn(VertexId vertex, double t, const Vec<S, Dim>& before) {
    if (vertices_.empty()) return;
    vertices_[vertex].changed_at = t;
    vertices_[vertex].before = before;
  }

  /// The mean of the velocities before and after t of a held vertex that moves with v from t on. At time 0 it is v.
  Vec<S, Dim> velocity(VertexId vertex, double t, const Vec<S, Dim>& v) const {
    if (vertices_.empty() || t <= 0 || vertices_[vertex].changed_at != t) return v;
    return S(0.5) * (vertices_[vertex].before + v);
  }

  void add(VertexId vertex, const S& work) {
    if (!vertices_.empty() && vertices_[vertex].script != none) works_[vertices_[vertex].script] += work;
  }

 private:
  std::span<ScriptedVertex> vertices_;
  std::span<S> works_;
};

template <class S, int Dim>
struct Books {
  std::array<Account<S, Dim>, force_kinds> accounts;
  std::vector<Account<S, Dim>> contact;  ///< accounts of contact, by material
  std::vector<S> scripts;                ///< work by script [J]

  Account<S, Dim>& of(ForceKind kind) { return accounts[static_cast<std::size_t>(kind)]; }
  const Account<S, Dim>& of(ForceKind kind) const { return accounts[static_cast<std::size_t>(kind)]; }

  /// The sum of all works: the change of the kinetic energy.
  S work() const {
    S sum{};
    for (const auto& a : accounts) sum += a.work + a.damping_work + a.restitution_work + a.held_work;
    return sum;
  }

  /// The works of damping, friction, restitution and scripts.
  S given() const {
    S sum{};
    for (const auto& a : accounts) sum += a.damping_work + a.restitution_work + a.held_work;
    return sum;
  }

  Books& operator+=(const Books& other) {
    for (std::size_t k = 0; k < accounts.size(); ++k) accounts[k] += other.accounts[k];
    make_room(other.contact.size(), other.scripts.size());
    for (std::size_t m = 0; m < other.contact.size(); ++m) contact[m] += other.contact[m];
    for (std::size_t s = 0; s < other.scripts.size(); ++s) scripts[s] += other.scripts[s];
    return *this;
  }

  /// Makes room for this many materials and scripts.
  void make_room(std::size_t materials, std::size_t script_count) {
    contact.resize(std::max(contact.size(), materials));
    scripts.resize(std::max(scripts.size(), script_count));
  }

  /// Sums the accounts of all materials into that of contact.
  void sum_contact() {
    of(ForceKind::contact) = {};
    for (const auto& account : contact) of(ForceKind::contact) += account;
  }
};

}  // namespace noli::integrator
