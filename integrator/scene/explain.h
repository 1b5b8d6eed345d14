// SPDX-License-Identifier: Apache-2.0
//
// Predicts what a scene will do, before it runs.
//
// Predictions: forces fire at 1/step. A vertex has a breakpoint whenever a force moves it: at most one for each step of
// its forces (steps that divide each other share theirs), one for each point of its script, and one at each window's
// end. The bytes are those of the blocks of trajectory.blocks (trajectory/FORMAT.md), without proofs.
//
// Resonance (integrator/resonance.h) is looked for vertex by vertex, with its neighbours at rest. Its forces of one
// step give it up to two or three directions of oscillation; along each of these, the forces of every longer step are
// the slow ones.
//
// Contact is not predicted: its layers fire as long as features are near. Only the layers that act at the start are
// known (integrator/scene/start_layers.h). Neither is the run time predicted. Everything is computed from the start
// positions.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "integrator/resonance.h"
#include "integrator/scene/build_model.h"
#include "integrator/scene/scene.h"

namespace noli::integrator {

struct LeftOut {
  std::string what, why;
};

/// One material of contact, and the pairs of bodies that have it.
struct PredictedContact {
  std::vector<std::array<std::string, 2>> pairs;
  ContactMaterial material;
  double stability = 0;  ///< c: h(1) / sqrt(m / (2 r(1))), m the least mass
  double bound = 0;      ///< of the thickness [m]; infinite if nothing bounds it
};

/// Forces that fire together; if forces have clocks of their own, all of one kind.
struct PredictedGroup {
  ForceKind kind{};
  std::size_t forces = 0;
  double shortest = 0, longest = 0;  ///< step [s]
  double events = 0;                 ///< per second of simulated time
};

/// A pair of steps of which one kicks in time with an oscillation of the other.
struct ResonanceWarning {
  ForceKind slow_kind{}, fast_kind{};
  double slow_step = 0, fast_step = 0;  ///< [s]
  std::size_t vertices = 0;             ///< the number of vertices with this resonance
  VertexId vertex = 0;                  ///< the one where the slow kicks are strongest
  Meeting meeting;                      ///< at that vertex
};

struct Explanation {
  std::string title;
  int dimension = 3;
  std::vector<DefaultTaken> defaults;
  std::vector<std::string> active;
  std::vector<LeftOut> left_out;
  std::vector<BuiltBody> bodies;
  std::vector<PredictedGroup> groups;
  std::vector<PredictedContact> contact;  ///< empty: none
  LayerSchedule layers;
  std::uint32_t most_layers = 0;
  double windows = 0;                             ///< of the whole run
  double events = 0, breakpoints = 0, bytes = 0;  ///< per second of simulated time
  double breakpoints_a_window = 0;
  double bytes_in_all = 0;
  std::vector<ResonanceWarning> resonances;
  std::vector<std::string> warnings;  ///< other than of resonance
  std::vector<std::string> hints;     ///< what would make the run faster
};

/// Throws InputError as build_model does.
Explanation explain(const Scene& scene);

/// Notes for the user before a run, each without a full stop: the warnings, then resonances.
std::vector<std::string> notes(const Explanation& explanation);

/// For people: several lines, a newline at the end.
std::string to_text(const Explanation& explanation);

/// The same as data, in a fixed order of fields.
Json to_json(const Explanation& explanation);

}  // namespace noli::integrator
