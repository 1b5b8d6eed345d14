// SPDX-License-Identifier: Apache-2.0
//
// Meshes whose vertices have breakpoints of their own, and what the definitions say about them.
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

/// One window only, its cells grouped by where it begins.
WindowResult verify_window(const Mesh& mesh, const WorldLines& lines, const WindowOptions& options);

/// A mesh over one window.
struct LineScene {
  Mesh mesh;
  std::vector<std::vector<Breakpoint>> paths;

  /// Adds a vertex; returns its id.
  VertexId vertex(std::vector<Breakpoint> path);
  /// Adds one that stays, over the window of the vertices before it.
  VertexId vertex(const Position& x);
  /// Adds a face with three vertices of its own that stay.
  void face(const Position& a, const Position& b, const Position& c);
  WorldLines lines() const;
};

/// The same with two breakpoints a vertex, at 0 and 1.
LineScene line_scene_of(const Step& step);

/// Times are the integers from 0 to `steps`, of which each vertex has some; coordinates are multiples of 60, so that
/// with at most six steps the places at all integer times are integers.
LineScene random_line_scene(std::uint64_t seed, const SoupSize& size, int dimension, int steps);

/// The motion between two successive integer times, exact where all places are integers then.
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
  std::set<PairKey> first;  ///< those that meet at the first time
};

/// By the definitions, in rational arithmetic. Precondition: as random_line_scene makes it.
WindowTruth window_truth(const LineScene& scene, int dimension, int steps, bool strict = false);

/// The kind of the contact of a pair of features that first meets at `at`.
ContactKind kind_of(const PairKey& key, const LineScene& scene, int dimension, int steps, const WindowAnswer& at);

}  // namespace noli::testing
