// SPDX-License-Identifier: Apache-2.0
//
// Who did how much work: the energy and momentum books of a window.
//
// Notation
//   J      an impulse on a particle [N s]; v, v' its velocities before and after
//   work   J . (v + v') / 2, which is the change of kinetic energy, whatever the size of J; it is never a difference
//          of energies, which would lose the digits that matter
//
// The works of a window add up to the change of kinetic energy between its ends, that of pinned and scripted particles
// not being part of it. The impulses of an elastic force add up to zero (and so do their moments); what is booked is
// what pinned and scripted particles take out of the momentum of the others.
//
// What this does not do: it knows no potential energies (integrator/energy.h).
#pragma once

#include <array>

#include "integrator/force.h"
#include "integrator/vector.h"

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

/// One kind of force.
template <class S, int Dim>
struct Account {
  S work{};                                                 ///< of the conservative impulses [J]
  S damping_work{};                                         ///< of the damping impulses; never positive [J]
  Vec<S, Dim> impulse = Vec<S, Dim>::Zero();                ///< on the momentum of free particles [N s]
  Moment<S, Dim> angular_impulse = Moment<S, Dim>::Zero();  ///< the same of x cross J, about the origin [N m s]
  std::uint64_t events = 0;                                 ///< forces fired

  Account& operator+=(const Account& other) {
    work += other.work;
    damping_work += other.damping_work;
    impulse += other.impulse;
    angular_impulse += other.angular_impulse;
    events += other.events;
    return *this;
  }
};

template <class S, int Dim>
struct Books {
  std::array<Account<S, Dim>, force_kinds> accounts;

  Account<S, Dim>& of(ForceKind kind) { return accounts[static_cast<std::size_t>(kind)]; }
  const Account<S, Dim>& of(ForceKind kind) const { return accounts[static_cast<std::size_t>(kind)]; }

  S work() const {
    S sum{};
    for (const auto& account : accounts) sum += account.work + account.damping_work;
    return sum;
  }
};

}  // namespace noli::integrator
