// SPDX-License-Identifier: Apache-2.0
//
// The asynchronous variational integrator: Algorithm 1 of Harmon, Vouga, Smith, Tamstorf and Grinspun, "Asynchronous
// Contact Mechanics" (2009). Its events are forces, gravity, breakpoints of scripts and the ends of windows; if the
// model has contact, also certificates and layers of contact (integrator/contact.h).
//
// Notation
//   event    (time, kind, number), in ascending order; kinds: scripts, then forces as in ForceKind, then a window's
//            end. Gravity acts with forces, after them on vertices that contact strikes, and at a window's end
//            (integrator/falling.h). All impulses of one time act on the positions of that time
//   kick     a force's impulse -h grad V on the velocities; at time 0 half of one, so that the scheme is of second
//            order from the start
//   window   from the end of the previous one up to the next multiple of W, or up to the time at which it has as many
//            breakpoints as the model allows; its end advances every particle to that time
//
// The state at a window's end (Snapshot) determines the rest of the run: clocks are multiples of their steps.
//
// integrator/stable_step.h chooses steps.
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

/// Energies and momenta at a window's end, without those of pinned and scripted vertices.
template <class S, int Dim>
struct State {
  S kinetic{};       ///< of the present velocities, to which the books add up [J]
  S kinetic_mean{};  ///< of the velocities half way through the kicks of this time: the one to plot [J]
  std::array<S, force_kinds> potential{};  ///< by ForceKind; gravity's is measured from the origin [J]
  S held_ahead{};                          ///< the part of the booked work of scripts that belongs to later times [J]
  Vec<S, Dim> momentum = Vec<S, Dim>::Zero();
  Moment<S, Dim> angular_momentum = Moment<S, Dim>::Zero();  ///< about the origin
  S speeds{};                                                ///< sum of m |v|, a scale for drift of the momentum
  S moments{};                                               ///< sum of m |x| |v|, the same for the angular momentum

  S potential_sum() const {
    S sum{};
    for (const S& p : potential) sum += p;
    return sum;
  }

  /// K + V plus the work of scripts that is booked in advance. It changes by the works of damping, friction,
  /// restitution and scripts, and by the effect of finite steps.
  S energy() const { return kinetic_mean + potential_sum() + held_ahead; }
};

/// Whether to stop.
using Stop = std::function<bool()>;
inline bool never_stop() { return false; }

/// See integrator/engine.h. `Touching`: the implementation of contact; void: integrator/contact.h.
template <class S, int Dim, class Touching = void>
class Engine;

template <class S, int Dim>
class Simulation {
 public:
  /// Begins at time 0. Throws std::invalid_argument when the model is invalid (sizes that differ, vertices out of
  /// range, masses or steps that are not positive). Scenes are checked before, so this concerns models made by hand.
  explicit Simulation(Model<S, Dim> model);
  /// Begins at a window's end of an earlier run of the same model.
  Simulation(Model<S, Dim> model, const Snapshot<S, Dim>& snapshot);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  double time() const;            ///< the last window's end
  std::uint64_t windows() const;  ///< done

  /// Runs the next window. Records each vertex at both ends of the window and at each change of velocity in between;
  /// books work and impulses. Calls `stop` about every 16,000 events. Returns false if that returned true: the
  /// simulation is then somewhere within the window, and must not be used again.
  bool run_window(Recording<S, Dim>& recording, Books<S, Dim>& books, const Stop& stop = never_stop);
  /// The same without a recording. No window ends early here, so the numbers are the same only if none would with a
  /// recording.
  void run_window(Books<S, Dim>& books);

  Snapshot<S, Dim> snapshot() const;
  State<S, Dim> state() const;
  /// Contact's potential at time 0 [J], which state() at time 0 lacks. Known from the first window on; before it is 0.
  S contact_at_start() const;
  /// The velocities at this time: those of the snapshot less half of the kicks that act now. Without friction, a run
  /// that begins with them goes on as this one does; with their negatives, it goes back.
  std::vector<Vec<S, Dim>> mean_velocities() const;
  /// Forces fired since time 0 of this object, start kicks included.
  std::uint64_t events() const;
  /// The cost of certificates since time 0 of this object; all zero without contact.
  CertificateCounts certificates() const;
  /// The extreme actions of layers of contact in the last window; empty without contact.
  ContactExtremes extremes() const;

  /// From now on shows its phases in `activity`, which must outlive the use of this object.
  void show(Activity& activity);

  /// Whether all positions and velocities are finite numbers.
  bool finite() const;
  /// Runs the next window up to the first event that leaves a NaN or an infinity. Call it when finite() has become
  /// false, on a simulation that starts from the snapshot before. Nothing if `stop` returned true. Throws
  /// std::logic_error when there is no such event.
  std::optional<NotFinite> find_not_finite(const Stop& stop);

 private:
  std::unique_ptr<Engine<S, Dim>> engine_;
};

}  // namespace noli::integrator
