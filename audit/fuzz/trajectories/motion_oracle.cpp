// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/trajectories/motion_oracle.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <set>

namespace noli::audit {

namespace {

template <class Vertices>
Feature feature(const Vertices& vertices) {
  const std::set<VertexId> distinct(vertices.begin(), vertices.end());
  return {distinct.begin(), distinct.end()};
}

bool disjoint(const Feature& a, const Feature& b) {
  return std::ranges::none_of(a, [&](VertexId v) { return std::ranges::binary_search(b, v); });
}

bool part_of(const Feature& part, const Feature& whole) { return std::ranges::includes(whole, part); }

/// All parts of a cell that have a vertex.
std::vector<Feature> parts_of(const Feature& cell) {
  std::vector<Feature> parts;
  for (unsigned chosen = 1; chosen < 1U << cell.size(); ++chosen) {
    Feature part;
    for (std::size_t i = 0; i < cell.size(); ++i) {
      if ((chosen >> i & 1) != 0) part.push_back(cell[i]);
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

oracle::Pair pair_of(std::size_t first, std::size_t second) {
  if (first == 2) return oracle::Pair::edge_edge;
  return second == 3   ? oracle::Pair::vertex_face
         : second == 2 ? oracle::Pair::vertex_edge
                       : oracle::Pair::vertex_vertex;
}

/// Points where they are at the beginning and the end of a motion.
struct Ends {
  std::vector<Position> x_t0, x_t1;
};

oracle::Motion oracle_motion(int dimension, const Ends& first, const Ends& second) {
  if (first.x_t0.size() > second.x_t0.size()) return oracle_motion(dimension, second, first);
  oracle::Motion motion;
  motion.pair = pair_of(first.x_t0.size(), second.x_t0.size());
  motion.dimension = dimension;
  const std::size_t n = first.x_t0.size();
  for (std::size_t i = 0; i < oracle::point_count(motion.pair); ++i) {
    const Ends& ends = i < n ? first : second;
    motion.x_t0[i] = ends.x_t0[i < n ? i : i - n];
    motion.x_t1[i] = ends.x_t1[i < n ? i : i - n];
  }
  return motion;
}

Ends ends_of(const std::vector<Position>& begin, const std::vector<Position>& end, const Feature& vertices) {
  Ends ends;
  for (const VertexId v : vertices) {
    ends.x_t0.push_back(begin[v]);
    ends.x_t1.push_back(end[v]);
  }
  return ends;
}

/// In space, where the plane of a motion is one in it.
Ends at_rest(const std::vector<Position>& x, const Feature& vertices, bool flat) {
  Ends ends;
  for (const VertexId v : vertices) {
    Position place = x[v];
    if (flat) place[2] = 0;
    ends.x_t0.push_back(place);
  }
  ends.x_t1 = ends.x_t0;
  return ends;
}

bool cells_meet_at_begin(const FrameMotion& motion, std::size_t step, const Feature& a, const Feature& b) {
  const bool flat = motion.dimension() == 2;
  return std::ranges::any_of(largest(disjoint_pairs(a, b, 5)),
                             [&](const FeatureTwo& pair) { return meet_at_rest(motion.begin(step), pair, flat); });
}

/// Adds what two cells do in a step.
void add(const FrameMotion& motion, std::size_t step, const Feature& a, const Feature& b, MotionTruth& truth) {
  if (boxes_apart(motion.dimension(), motion.begin(step), motion.end(step), a, b, 0)) return;
  if ((step == 0 || motion.at_rest()) && !truth.initial) truth.initial = cells_meet_at_begin(motion, step, a, b);
  for (const FeatureTwo& pair : largest(disjoint_pairs(a, b, motion.dimension() == 2 ? 3 : 4))) {
    const oracle::Answer answer = answer_of(motion, step, pair);
    if (!answer.time) continue;
    const int order = truth.time ? answer.time->compare(*truth.time) : -1;
    if (order < 0) {
      truth.time = answer.time;
      truth.first.clear();
    }
    if (order <= 0) truth.first.push_back(pair);
  }
}

}  // namespace

bool boxes_apart(int dimension, const std::vector<Position>& begin, const std::vector<Position>& end, const Feature& a,
                 const Feature& b, double distance) {
  // Half of a gap, rounded, is less than the gap.
  const auto beyond = [&](double low, double high) { return low > high && (low - high) / 2 >= distance; };
  const auto order = [&](const std::vector<Position>& x, std::size_t axis) {
    const auto less = [&](VertexId v, VertexId w) { return x[v][axis] < x[w][axis]; };
    const auto [a_low, a_high] = std::ranges::minmax_element(a, less);
    const auto [b_low, b_high] = std::ranges::minmax_element(b, less);
    return beyond(x[*b_low][axis], x[*a_high][axis]) ? -1 : beyond(x[*a_low][axis], x[*b_high][axis]) ? 1 : 0;
  };
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis) {
    const int before = order(begin, axis);
    if (before != 0 && before == order(end, axis)) return true;
  }
  return false;
}

std::string words(const FeatureTwo& features) {
  return fmt::format("{} | {}", fmt::join(features[0], " "), fmt::join(features[1], " "));
}

std::vector<Feature> cells_of(const Mesh& mesh) {
  std::vector<Feature> cells;
  cells.reserve(mesh.cell_count());
  for (const auto& face : mesh.faces) cells.push_back(feature(face));
  for (const auto& edge : mesh.edges) cells.push_back(feature(edge));
  for (const VertexId v : mesh.points) cells.push_back({v});
  return cells;
}

std::vector<FeatureTwo> disjoint_pairs(const Feature& a, const Feature& b, std::size_t most) {
  std::vector<FeatureTwo> pairs;
  for (const Feature& p : parts_of(a)) {
    for (const Feature& q : parts_of(b)) {
      if (p.size() + q.size() <= most && disjoint(p, q)) pairs.push_back({p, q});
    }
  }
  return pairs;
}

std::vector<FeatureTwo> largest(const std::vector<FeatureTwo>& pairs) {
  std::vector<FeatureTwo> result;
  std::ranges::copy_if(pairs, std::back_inserter(result), [&](const FeatureTwo& pair) {
    return std::ranges::none_of(pairs, [&](const FeatureTwo& other) {
      return other != pair && part_of(pair[0], other[0]) && part_of(pair[1], other[1]);
    });
  });
  return result;
}

bool meet_at_rest(const std::vector<Position>& x, const FeatureTwo& features, bool flat) {
  const Feature &small = features[features[0].size() > features[1].size() ? 1 : 0],
                &large = features[features[0].size() > features[1].size() ? 0 : 1];
  Ends p = at_rest(x, small, flat), q = at_rest(x, large, flat);
  if (small.size() + large.size() == 5) {  // the edge as the path of a vertex
    p = {{p.x_t0[0]}, {p.x_t0[1]}};
  }
  return oracle::first_contact(oracle_motion(3, p, q)).time.has_value();
}

oracle::Answer answer_of(const FrameMotion& motion, std::size_t step, const FeatureTwo& features) {
  const auto ends = [&](std::size_t i) { return ends_of(motion.begin(step), motion.end(step), features[i]); };
  return oracle::first_contact(oracle_motion(motion.dimension(), ends(0), ends(1)));
}

std::optional<oracle::Time> first_within(int dimension, const std::vector<Position>& begin,
                                         const std::vector<Position>& end, const FeatureTwo& features,
                                         double distance) {
  const auto motion = oracle_motion(dimension, ends_of(begin, end, features[0]), ends_of(begin, end, features[1]));
  return distance > 0 ? oracle::first_within(motion, distance) : oracle::first_contact(motion).time;
}

bool are_compared(const Mesh& mesh, const FeatureTwo& features) {
  if (!disjoint(features[0], features[1])) return false;
  const std::vector<Feature> cells = cells_of(mesh);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t j = 0; j < cells.size(); ++j) {
      if (i != j && part_of(features[0], cells[i]) && part_of(features[1], cells[j])) return true;
    }
  }
  return false;
}

MotionTruth truth_of(const FrameMotion& motion, const std::atomic<bool>* stop) {
  const std::vector<Feature> cells = cells_of(motion.mesh);
  MotionTruth truth;
  for (; truth.step < motion.steps(); ++truth.step) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      truth.stopped = stop != nullptr && stop->load(std::memory_order_relaxed);
      if (truth.stopped) return truth;
      for (std::size_t j = i + 1; j < cells.size(); ++j) add(motion, truth.step, cells[i], cells[j], truth);
    }
    truth.contact = truth.initial || truth.time.has_value();
    if (truth.contact) return truth;
  }
  return truth;
}

}  // namespace noli::audit
