// SPDX-License-Identifier: Apache-2.0
//
// Builds meshes whose vertices have individual breakpoints, and the answers that follow from the definitions.
#pragma once

#include <vector>

#include "brute_force.h"
#include "proofs/prover/windows/window_verifier.h"
#include "scenes.h"
#include "trajectory/world_lines.h"

namespace noli::testing {

struct Breakpoint {
  double t;
  Position x;
};

/// Verifies a single window; its cells are grouped by their positions at its beginning.
WindowResult verify_window(const Mesh& mesh, const WorldLines& lines, const WindowOptions& options);

/// A mesh over one window.
struct LineScene {
  Mesh mesh;
  std::vector<std::vector<Breakpoint>> paths;

  /// Adds a vertex; returns its id.
  VertexId vertex(std::vector<Breakpoint> path);
  /// Adds a vertex that rests, over the window of the vertices before it.
  VertexId vertex(const Position& x);
  /// Adds a face with three vertices of its own that rest.
  void face(const Position& a, const Position& b, const Position& c);
  WorldLines lines() const;
};

/// The same motion with two breakpoints per vertex, at 0 and 1.
LineScene line_scene_of(const Step& step);

/// A random scene. Each vertex has breakpoints at some of the integers from 0 to `steps`. Coordinates are multiples of
/// 60, so that with at most six steps all positions at integer times are integers.
LineScene random_line_scene(std::uint64_t seed, const SoupSize& size, int dimension, int steps);

/// The motion between two successive integer times, exact if all positions there are integers.
Step unit_step(const LineScene& scene, int k);

/// When and how a pair of features first meets: at `time` within unit step `step`, -1 if never.
struct WindowAnswer {
  int step = -1;
  oracle::Answer answer;
};

struct WindowTruth {
  std::map<PairKey, int> contacts;
  std::set<std::pair<std::uint32_t, std::uint32_t>> initial;
  WindowAnswer first_answer;
  std::set<PairKey> first;  ///< the pairs that meet at the first time
};

/// The answer by the definitions, in rational arithmetic. Precondition: breakpoints as in random_line_scene.
WindowTruth window_truth(const LineScene& scene, int dimension, int steps, bool strict = false);

/// The kind of the contact of a pair of features that first meets at `at`.
ContactKind kind_of(const PairKey& key, const LineScene& scene, int dimension, int steps, const WindowAnswer& at);

}  // namespace noli::testing
