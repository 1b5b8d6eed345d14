// SPDX-License-Identifier: Apache-2.0
//
// What is found of a mesh in motion: features that meet or come too near, and what was not compared.
//
// Notation
//   step    a piece of the motion: between two frames, or a window of a run
//   pair    two features that share no vertex and belong to two different cells (with `strict`: or to one)
//
// Which pairs are counted, each once, and in a step or window if it meets anywhere in that closed time:
//   3D  vertex_face    every vertex of a cell (loose points included) against every face
//       edge_edge      every edge of a face and every loose edge, against every other
//       vertex_edge    a vertex of one cell against an edge of another, unless a larger pair of these two cells stands
//                      for it
//   2D  vertex_edge    every vertex of a cell against every edge
//   both vertex_vertex a vertex of one cell against one of another, unless a larger pair of these two cells stands
//                      for it
// A pair stands for another if its two features contain the two of the other.
//
// Plain values: no preconditions, no errors; several threads may read one.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <noli/contact.h>
#include <noli/mesh.h>
#include <noli/time_of_impact.h>

namespace noli {

/// Numbers of pairs that meet, by FeaturePair.
using ContactCounts = std::array<std::uint64_t, all_feature_pairs.size()>;

/// One pair of features that meets within a step.
struct FeatureContact {
  FeaturePair pair = FeaturePair::vertex_face;
  /// Vertex ids in the order of noli/query.h; the first point_count(pair) count. Canonical: each edge in ascending
  /// order, the smaller edge first, a face as the mesh lists it.
  std::array<VertexId, 4> vertices{};
  TimeEnclosure first;  ///< contains the first time at which they meet, in [0, 1] of the step; in seconds for a window

  friend bool operator==(const FeatureContact& a, const FeatureContact& b) {
    return a.pair == b.pair && a.vertices == b.vertices;
  }
};

/// A contact that is listed: what meets, when and where it begins.
struct ListedContact {
  FeatureContact contact;
  std::size_t step = 0;  ///< from 1
  ContactKind kind = ContactKind::touching;
  double time = 0;   ///< the largest double not above the exact time; in [0, 1] of its step, in seconds for a run
  Position point{};  ///< where they meet at that time, rounded
  /// The cells that each feature is part of, in ascending order, at most `most_cells` of them.
  std::array<std::vector<std::uint32_t>, 2> cells;
  std::array<std::string, 2> bodies;  ///< of each feature, by name; empty where bodies have no names
  /// The vertices of each feature as its body counts them, and the face; only of bodies that were joined (--body).
  std::array<std::vector<VertexId>, 2> own = {};
  std::optional<std::uint64_t> own_face = {};

  static constexpr std::size_t most_cells = 64;
};

/// Two cells (numbered as in Mesh) whose vertex-disjoint parts meet at the beginning of the step.
struct InitialIntersection {
  std::uint32_t first_cell = 0;
  std::uint32_t second_cell = 0;
  friend bool operator==(const InitialIntersection&, const InitialIntersection&) = default;
};

/// What is found in a step, or in a window.
struct Findings {
  bool complete = true;      ///< false: stopped early (stop, deadline, first_only); counts are then lower bounds
  ContactCounts contacts{};  ///< by FeaturePair: pairs that meet in the closed step
  std::uint64_t initial_intersections = 0;
  std::vector<FeatureContact> reports;               ///< the first max_reports in canonical order (pair, then vertices)
  std::vector<InitialIntersection> initial_reports;  ///< the first max_reports in ascending order
  StageCounters stages;           ///< which stage decided each pair of features that reached the kernel
  std::uint64_t obligations = 0;  ///< obligations closed by a direction
  std::uint64_t cell_pairs = 0;   ///< pairs of cells taken apart into features
  /// Pairs of features that meet at the beginning and were counted in the step before. They are not among `contacts`
  /// and `reports`.
  std::uint64_t going_on = 0;

  std::uint64_t contact_count() const { return contacts[0] + contacts[1] + contacts[2] + contacts[3]; }
  bool touches() const { return contact_count() + initial_intersections > 0; }
};

/// Two cells that come nearer to each other than the least distance, as far as doubles see, and a time at which they
/// are.
struct TooNear {
  std::uint32_t first_cell, second_cell;
  double time;  ///< in [0, 1] of the step
};

/// All features that are compared are more than `allowed` apart, but not all are more than `limit`, which is about a
/// millionth greater.
struct LargestDistance {
  double allowed, limit;
};

/// Which cells are not compared, by the names of their bodies.
struct NotCompared {
  bool any_held = false;                             ///< two cells are scripted or pinned throughout
  std::vector<std::string> held;                     ///< their bodies, as far as they are known
  std::vector<std::array<std::string, 2>> excluded;  ///< bodies that the scene lets pass through each other
  std::size_t baseline = 0;                          ///< pairs of cells that intersect in the first frame (--only-new)

  bool any() const { return any_held || !excluded.empty() || baseline > 0; }
};

}  // namespace noli
