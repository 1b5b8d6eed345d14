// SPDX-License-Identifier: Apache-2.0
//
// The asynchronous variational integrator: Algorithm 1 of Harmon, Vouga, Smith, Tamstorf and Grinspun, "Asynchronous
// Contact Mechanics" (2009), without contact: its events are forces, gravity, breakpoints of scripts and the ends of
// windows.
//
// Notation
//   event    (time, kind, number), in ascending order; kinds: scripts, then forces as in ForceKind, then a window's
//            end. Gravity acts with forces, on what contact strikes behind them, and at a window's end
//            (integrator/falling.h).
//            All impulses of one time act on the positions of that time
//   kick     a force's impulse -h grad V on the velocities; at time 0 half of one, so that the scheme is of second
//            order from the start
//   window   from the end of the one before up to the next multiple of W, or up to the time at which it has as many
//            breakpoints as the model allows; its end advances every particle to it
//
// The state at a window's end (Snapshot) determines all that follows: clocks are multiples of their steps.
//
// What this does not do: contact (certificates/), and choosing steps (integrator/stable_step.h).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <noli/run.h>
#include "integrator/anchors.h"
#include "integrator/books.h"
#include "integrator/contact_extremes.h"
#include "integrator/model.h"
#include "integrator/phase.h"
#include "integrator/recording.h"

namespace noli::integrator {

/// Positions and velocities of all vertices at a window's end.
template <class S, int Dim>
struct Snapshot {
  std::uint64_t windows = 0;  ///< done
  double time = 0;            ///< [s]
  std::vector<Vec<S, Dim>> x, v;
  std::vector<Anchor<S>> anchors;  ///< of friction
};

/// Energies and momenta at a window's end. Those of pinned and scripted vertices are not in them.
template <class S, int Dim>
struct State {
  S kinetic{};       ///< of the velocities as they are, which is what the books add up to [J]
  S kinetic_mean{};  ///< of the velocities half way through the kicks of this time: the one to plot [J]
  std::array<S, force_kinds> potential{};  ///< by ForceKind; gravity's is measured from the origin [J]
  S held_ahead{};  ///< of the work of scripts in the books, what belongs to the time after this [J]
  Vec<S, Dim> momentum = Vec<S, Dim>::Zero();
  Moment<S, Dim> angular_momentum = Moment<S, Dim>::Zero();  ///< about the origin
  S speeds{};                                                ///< sum of m |v|, to measure drift of the momentum against
  S moments{};                                               ///< sum of m |x| |v|

  S potential_sum() const {
    S sum{};
    for (const S& p : potential) sum += p;
    return sum;
  }

  /// K + V, and what scripts have been booked in advance: it changes by the works of damping, friction, restitution and
  /// scripts, and by what finite steps do.
  S energy() const { return kinetic_mean + potential_sum() + held_ahead; }
};

/// Whether to stop.
using Stop = std::function<bool()>;
inline bool never_stop() { return false; }

/// integrator/engine.h. `Touching`: what knows of contact; void: integrator/contact.h
template <class S, int Dim, class Touching = void>
class Engine;

template <class S, int Dim>
class Simulation {
 public:
  /// At time 0. Throws std::invalid_argument when the model is none (sizes that differ, vertices out of range, masses
  /// or steps that are not positive): scenes are checked before, so this is for models made by hand.
  explicit Simulation(Model<S, Dim> model);
  /// At a window's end of an earlier run of the same model.
  Simulation(Model<S, Dim> model, const Snapshot<S, Dim>& snapshot);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  double time() const;            ///< the last window's end
  std::uint64_t windows() const;  ///< done

  /// Runs the next window. Records each vertex at both its ends and at each change of velocity between; books work and
  /// impulses. Asks `stop` every ten thousand events or so. Returns false if it said so: the simulation is then
  /// somewhere within the window, and must not be used again.
  bool run_window(Recording<S, Dim>& recording, Books<S, Dim>& books, const Stop& stop = never_stop);
  /// The same without a recording: the same numbers, as long as no window with a recording ends early. None does here.
  void run_window(Books<S, Dim>& books);

  Snapshot<S, Dim> snapshot() const;
  State<S, Dim> state() const;
  /// What state() at time 0 does not know: contact's potential there [J]. Known from the first window on, else 0.
  S contact_at_start() const;
  /// The velocities of this time: those of the snapshot less half of the kicks that act now. Without friction a run
  /// that begins with them goes on as this one does; with their negatives, back.
  std::vector<Vec<S, Dim>> mean_velocities() const;
  /// Forces fired since time 0 of this object, start kicks included.
  std::uint64_t events() const;
  /// What certificates have cost since time 0 of this object; nothing without contact.
  CertificateCounts certificates() const;
  /// How near layers of contact that acted in the last window have seen things; nothing without contact.
  ContactExtremes extremes() const;

  /// From now on, what it does is shown there, for as long as this object is used.
  void show(Activity& activity);

  /// Whether all positions and velocities are finite numbers.
  bool finite() const;
  /// Runs the next window, looking at each event, up to the first that leaves something that is not finite: to be asked
  /// when finite() has become false, of a simulation that starts from the snapshot before. Nothing when `stop` said so.
  /// Throws std::logic_error when there is none.
  std::optional<NotFinite> find_not_finite(const Stop& stop);

 private:
  std::unique_ptr<Engine<S, Dim>> engine_;
};

}  // namespace noli::integrator
