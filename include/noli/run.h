// SPDX-License-Identifier: Apache-2.0
//
// What a run records about itself: energies, momenta, counts and steps of each window, and why it could not go on.
//
//   request.keep_going = [](const noli::SeriesRow& row) { return row.kinetic < 10; };   // noli/simulate.h
//
// Notation
//   window    a piece of simulated time, certified as a whole; counted from 1
//   layer     of contact: a penalty that acts on a pair of features below a distance of its own
//   step      of a vertex: the time between two consecutive breakpoints of it
//   bin b     the steps from 2^((2 b - 1) / 8) to 2^((2 b + 1) / 8) s, the upper end not included
//   B         kinetic energy and all potentials, less what damping, friction and scripts gave since the beginning
//
// Phases: what a run spends its time on
//   force        positions of a force's vertices and its impulse
//   kick         how impulses change velocities, and the breakpoints that result
//   layer        layers of contact: distances of the pairs for which they are active, impulses, friction
//   certificate  checks of vertices, slabs, activation
//   broad_phase  which cells are near each other
//   queue        the next event: clocks, the agenda of layers, the queue of certificates; scripts
//   recording    breakpoints at a window's ends; sorting all of them by vertex
//   proof        verifying a window, or waiting for it to be verified elsewhere
//   writing      blocks, frames, the log, series.h5
//   other        everything else: reading, building, energies
//
// Units: SI; each field names its own.
// Plain values: no errors except those named; several threads may read one.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <noli/mesh.h>
#include <noli/query.h>

namespace noli {

/// Kinds of forces, in the order in which events of one time happen (integrator/simulation.h).
enum class ForceKind : std::uint8_t { gravity, edge_spring, membrane, hinge, turning, contact };
inline constexpr std::size_t force_kinds = 6;

constexpr std::string_view name(ForceKind kind) {
  switch (kind) {
    case ForceKind::gravity: return "gravity";
    case ForceKind::edge_spring: return "edge_spring";
    case ForceKind::membrane: return "membrane";
    case ForceKind::hinge: return "hinge";
    case ForceKind::turning: return "turning";
    case ForceKind::contact: return "contact";
  }
  return "";
}

/// The number of the lowest bin.
inline constexpr std::int64_t least_step_bin = -4 * 1023;

/// The number of the bin that a step is in. Precondition: positive and finite. Subnormal steps are in the lowest bin.
std::int64_t step_bin(double step);

/// The lower end of a bin [s]. Its upper end is the lower end of the next bin; the highest bin ends at the greatest
/// double. Not for results that must be the same on every machine.
double bin_begin(std::int64_t bin);

struct StepHistogram {
  struct Bin {
    std::int64_t number;
    std::uint64_t ticks;  ///< of all free vertices, positive
    friend bool operator==(const Bin&, const Bin&) = default;
  };

  double smallest = 0;    ///< step [s]; 0: nothing is free. It can be as small as rounding when unrelated clocks fire
                          ///< at almost the same time
  std::vector<Bin> bins;  ///< ascending, without empty ones

  friend bool operator==(const StepHistogram&, const StepHistogram&) = default;

  std::uint64_t ticks() const;
  void add(const StepHistogram& other);
  /// The step [s] below which a free vertex spends this share of its time; 0.5 is the median. Within a bin, steps are
  /// taken to be spread evenly in their logarithm. Precondition: something is free, 0 <= share <= 1. Not for results
  /// that must be the same on every machine.
  double quantile(double share) const;
};

/// A layer of contact that acted.
struct ActingLayer {
  std::uint64_t layer = 0;  ///< 0: none did, and the other members have no meaning
  std::uint64_t material = 0;
  FeaturePair pair{};
  std::array<VertexId, 4> vertices{};
  double time = 0, distance = 0;

  friend bool operator==(const ActingLayer&, const ActingLayer&) = default;
};

/// What the layers of one material of contact did [J].
struct ContactWork {
  double potential = 0, friction = 0, restitution = 0;

  friend bool operator==(const ContactWork&, const ContactWork&) = default;
};

struct SeriesRow {
  double time = 0;  ///< the window's end [s]
  double kinetic = 0, kinetic_mean = 0;
  std::array<double, force_kinds> potential{};
  std::array<double, force_kinds> work{};          ///< of the conservative impulses within the window [J]
  std::array<double, force_kinds> damping_work{};  ///< of damping; of contact, of friction [J]
  std::array<double, force_kinds> held_work{};     ///< of scripts, against these forces [J]
  double restitution_work = 0;                     ///< what restitution withholds of contact's work [J]
  double held_ahead = 0;   ///< the part of the scripts' work so far that belongs to times after the window's end [J]
  double integration = 0;  ///< what finite steps did: the change of energy() less given() [J]
  std::array<double, 3> momentum{};                 ///< [N s]
  std::array<double, 3> angular_momentum{};         ///< in 2D only the third component is used [N m s]
  std::array<std::uint64_t, force_kinds> events{};  ///< forces fired; of contact, impulses of layers
  std::uint64_t breakpoints = 0;
  std::uint64_t halvings = 0;  ///< of the steps of all contact layers, after windows that had to be run again
  ActingLayer deepest, nearest;
  std::vector<ContactWork> contact_work;  ///< by material
  std::vector<double> script_work;        ///< by script [J]
  StepHistogram steps;

  std::uint64_t events_in_all() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t n : events) sum += n;
    return sum;
  }
  double potential_in_all() const {
    double sum = 0;
    for (const double p : potential) sum += p;
    return sum;
  }
  double damping_in_all() const {
    double sum = 0;
    for (const double w : damping_work) sum += w;
    return sum;
  }
  double held_in_all() const {
    double sum = 0;
    for (const double w : held_work) sum += w;
    return sum;
  }
  /// K + V at the window's end, plus the work of scripts that is booked in advance [J].
  double energy() const { return kinetic_mean + potential_in_all() + held_ahead; }
  /// Energy that damping, friction, restitution and scripts added within the window [J]; negative if they took it.
  double given() const {
    double sum = restitution_work;
    for (std::size_t k = 0; k < force_kinds; ++k) sum += damping_work[k] + held_work[k];
    return sum;
  }
  /// energy() at the window's beginning, up to rounding.
  double energy_before() const { return energy() - given() - integration; }

  friend bool operator==(const SeriesRow&, const SeriesRow&) = default;
};

/// What certificates cost.
struct CertificateCounts {
  std::uint64_t slices = 0;
  std::uint64_t tubes = 0;                           ///< around a vertex's expected path, left before the slice's end
  std::uint64_t plans = 0;                           ///< guards made
  std::uint64_t penned = 0;                          ///< of these, those inside a pen
  std::uint64_t repairs = 0;                         ///< slabs
  std::uint64_t events = 0;                          ///< slices after the first, and times due for a vertex
  std::uint64_t activations = 0, deactivations = 0;  ///< of layers
  std::uint64_t most_near = 0;                       ///< near pairs at a time
  std::uint32_t deepest = 0;                         ///< layer

  CertificateCounts& operator+=(const CertificateCounts& other) {
    slices += other.slices;
    tubes += other.tubes;
    plans += other.plans;
    penned += other.penned;
    repairs += other.repairs;
    events += other.events;
    activations += other.activations;
    deactivations += other.deactivations;
    most_near = std::max(most_near, other.most_near);
    deepest = std::max(deepest, other.deepest);
    return *this;
  }
};

enum class Phase : std::uint8_t {
  force,
  kick,
  layer,
  certificate,
  broad_phase,
  queue,
  recording,
  proof,
  writing,
  other
};
inline constexpr std::size_t phase_count = 10;

constexpr std::string_view name(Phase phase) {
  switch (phase) {
    case Phase::force: return "force";
    case Phase::kick: return "kick";
    case Phase::layer: return "layer";
    case Phase::certificate: return "certificate";
    case Phase::broad_phase: return "broad_phase";
    case Phase::queue: return "queue";
    case Phase::recording: return "recording";
    case Phase::proof: return "proof";
    case Phase::writing: return "writing";
    case Phase::other: return "other";
  }
  return "";
}

/// By Phase [s].
using PhaseSeconds = std::array<double, phase_count>;

/// A NaN or an infinity appeared.
struct NotFinite {
  double time;
  std::optional<ForceKind> kind;  ///< of the force that left it; nothing: free motion did
  std::vector<VertexId> force;    ///< that force's vertices
  VertexId vertex;                ///< whose velocity or position it is
};

/// A pair that came too near: it is at distance 0, needs more layers of contact than the scene allows, or needs a layer
/// whose steps are too short to tell one time from the next.
struct PairTooNear {
  FeaturePair kind{};
  std::array<VertexId, 4> vertices{};  ///< in the order of noli/query.h; the first point_count(kind) count
  double time = 0;                     ///< [s]
};

/// Where the energy balance is off most. If restitution, or on layers damping or friction, takes energy, B keeps what
/// they gave, so that it can only fall.
struct EnergyAstray {
  double begin = 0;       ///< B at the beginning [J]
  double there = 0;       ///< B where it is farthest from that [J]
  double time = 0;        ///< [s]
  double scale = 0;       ///< [J]
  bool may_fall = false;  ///< B keeps what damping, friction and restitution gave
};

enum class SeriesEnd : std::uint8_t {
  written,
  unavailable,  ///< there is no noli_series: Noli was built without HDF5
  stopped,      ///< no file is written, and an existing one stays as it is
  failed        ///< the same, because of the machine
};

/// The name used in the JSON and the log.
const char* name(SeriesEnd end);

}  // namespace noli
