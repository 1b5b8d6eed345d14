// SPDX-License-Identifier: Apache-2.0
//
// Predicts what a scene will do, and summarises what happened in a run, from its files alone.
//
//   const noli::ScenePrediction scene = noli::prediction_of_scene("scenes/swinging_cloth.json");
//   std::printf("%g bytes\n", scene.bytes);
//
//   const noli::RunSummary run = noli::summary_of_run("run");
//   if (run.gap) std::printf("nearest: %g m\n", run.gap->up_to);
//
// Notation
//   deepest, nearest   the deepest layer of contact that acted, and the layer that acted at the least distance. A layer
//                      samples distances only at its own times
//   gap                how near the pair of `nearest` came in that window, between those times too: decided exactly,
//                      if the run recorded its world lines
//
// Units: SI; each field names its own.
// Errors: as each function says. Thread safety: any thread; the files are only read, and nothing is printed.
// Nothing is simulated or verified here: run_simulate in noli/simulate.h and run_verify in noli/verify.h do.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <noli/run.h>

namespace noli {

/// A body of a scene.
struct BodyPrediction {
  std::string name;
  std::size_t vertices = 0, faces = 0;
  std::size_t edges = 0;                 ///< those without a face
  double mass = 0;                       ///< [kg]
  std::size_t pinned = 0, scripted = 0;  ///< vertices
};

/// Forces of a scene that fire together; if forces have clocks of their own, all of one kind.
struct ForcesPrediction {
  ForceKind kind{};
  std::size_t forces = 0;
  double shortest = 0, longest = 0;  ///< step [s]
  double events = 0;                 ///< per second of simulated time
};

/// One material of contact, and the pairs of bodies that have it.
struct ContactPrediction {
  std::vector<std::array<std::string, 2>> pairs;
  double thickness = 0;        ///< of the first layer [m]
  double thickness_below = 0;  ///< what bounds it [m]; infinite if nothing does
  double stiffness = 0;        ///< of the first layer [N/m]
  double step = 0;             ///< of the first layer [s]
  double restitution = 1;      ///< share of the energy of an approach that comes back
  double friction = 0;         ///< Coulomb's coefficient
};

/// What a scene will do, computed from the positions at its start. Events of contact and the run time are not
/// predicted.
struct ScenePrediction {
  std::string title;
  int dimension = 3;
  std::vector<BodyPrediction> bodies;
  std::vector<ForcesPrediction> forces;
  std::vector<ContactPrediction> contact;  ///< empty: a contact ends the run
  std::vector<std::string> active;         ///< "8 membranes", "gravity", ...
  std::vector<std::string> left_out;       ///< each with its reason: "scripts: the scene has none"
  std::vector<std::string> defaults;       ///< fields that the scene leaves out: "/window = 0.01"
  std::vector<std::string> warnings;       ///< also of resonance
  std::vector<std::string> hints;          ///< what would make the run faster
  std::string contact_at_start;       ///< what meets at the beginning, so that run_simulate refuses; empty: nothing
  double windows = 0;                 ///< of the whole run
  double events_per_second = 0;       ///< of simulated time
  double breakpoints_per_second = 0;  ///< of simulated time
  double bytes = 0;                   ///< of the whole run, without proofs
};

/// Nothing is simulated; whether the scene begins in contact is decided exactly. `brief`: the scene's short form.
/// `stop` is polled; when it becomes true, Stopped is thrown. Throws InputError (the scene, a file that it names),
/// Stopped, std::bad_alloc.
ScenePrediction prediction_of_scene(const std::filesystem::path& scene, bool brief = false,
                                    const std::atomic<bool>* stop = nullptr);

/// A layer that acted, and in which window.
struct ActingMoment {
  std::uint64_t window = 1;  ///< from 1
  ActingLayer action;
};

/// The energy terms of one kind of force [J], as in SeriesRow for a window.
struct ForceWork {
  double potential = 0, damping = 0, held = 0;
};

/// Energies are kinetic energy plus all potentials at the ends of windows [J]; kinetic energy takes velocities half way
/// through the kicks. Works are sums over all windows. last - begin = damping_work + restitution_work + held_work +
/// integration, except for the work of scripts that is booked in advance (SeriesRow::held_ahead).
struct EnergySummary {
  double begin = 0;  ///< at time 0
  double first = 0, last = 0, least = 0, greatest = 0;
  double damping_work = 0;  ///< of damping and friction
  double restitution_work = 0, held_work = 0, integration = 0;
  std::array<ForceWork, force_kinds> kinds{};
  std::vector<ContactWork> materials;  ///< of contact
  std::vector<double> scripts;
};

/// above < gap <= up_to with no double in between; or both are 0, which is contact.
struct ExactGap {
  double above = 0, up_to = 0;
  double time = 0;  ///< approximately the first time at which the pair is within up_to

  friend bool operator==(const ExactGap&, const ExactGap&) = default;
};

struct RunSummary {
  std::string title;
  std::uint32_t dimension = 3;
  bool full = true;  ///< world lines were recorded
  bool open_window = false;
  std::uint64_t windows = 0;
  double time = 0;  ///< of the last window's end [s]
  std::uint64_t breakpoints = 0, halvings = 0;
  std::array<std::uint64_t, force_kinds> events{};
  double smallest_step = 0;             ///< of a free vertex [s]; 0: no vertex is free
  std::optional<EnergySummary> energy;  ///< nothing: no windows
  std::optional<ActingMoment> deepest, nearest;
  std::optional<ExactGap> gap;
  std::vector<ActingMoment> worst;  ///< the windows with the deepest layers, deepest first; at most five
};

/// `stop` is polled; when it becomes true, Stopped is thrown. Throws InputError (no run, a damaged one, of an earlier
/// version), Stopped.
RunSummary summary_of_run(const std::filesystem::path& run, const std::atomic<bool>* stop = nullptr);

}  // namespace noli
