// SPDX-License-Identifier: Apache-2.0
#include "window_scenes.h"

#include <algorithm>

#include "oracle/features.h"

namespace noli::testing {

WindowResult verify_window(const Mesh& mesh, const WorldLines& lines, const WindowOptions& options) {
  std::vector<Position> begin;
  for (std::size_t v = 0; v < lines.vertex_count(); ++v) {
    begin.push_back(lines.positions(static_cast<VertexId>(v)).front());
  }
  return WindowVerifier(mesh, begin, options).verify(lines, options);
}

VertexId LineScene::vertex(std::vector<Breakpoint> path) {
  paths.push_back(std::move(path));
  return static_cast<VertexId>(mesh.vertex_count++);
}

VertexId LineScene::vertex(const Position& x) {
  return vertex({{paths.front().front().t, x}, {paths.front().back().t, x}});
}

void LineScene::face(const Position& a, const Position& b, const Position& c) {
  const VertexId i = vertex(a), j = vertex(b), k = vertex(c);
  mesh.faces.push_back({i, j, k});
}

WorldLines LineScene::lines() const {
  std::vector<std::size_t> offsets = {0};
  std::vector<double> times;
  std::vector<Position> positions;
  for (const auto& path : paths) {
    for (const Breakpoint& b : path) {
      times.push_back(b.t);
      positions.push_back(b.x);
    }
    offsets.push_back(times.size());
  }
  return WorldLines::from_breakpoints(offsets, times, positions, "test");
}

LineScene line_scene_of(const Step& step) {
  LineScene scene;
  for (std::size_t v = 0; v < step.x_t0.size(); ++v) scene.vertex({{0, step.x_t0[v]}, {1, step.x_t1[v]}});
  scene.mesh = step.mesh;
  return scene;
}

LineScene random_line_scene(std::uint64_t seed, const SoupSize& size, int dimension, int steps) {
  const Step step = random_soup(seed, size, dimension);
  Random random(seed + 1000000);
  LineScene scene;
  const auto place = [&](const Position& near) {
    Position x = near;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
      x[k] = 60 * (static_cast<double>(random.below(2 * size.span + 1)) - size.span);
    }
    return x;
  };
  for (const Position& x_t0 : step.x_t0) {
    std::vector<Breakpoint> path = {{0, place(x_t0)}};
    for (int t = 1; t <= steps; ++t) {
      const bool kept = t == steps || random.below(2) == 0;
      if (kept) path.push_back({static_cast<double>(t), random.below(4) == 0 ? path.back().x : place(x_t0)});
    }
    scene.vertex(path);
  }
  scene.mesh = step.mesh;
  return scene;
}

namespace {

Position place_at(const std::vector<Breakpoint>& path, double t) {
  const auto after = std::find_if(path.begin(), path.end(), [t](const Breakpoint& b) { return b.t >= t; });
  if (after->t == t) return after->x;
  const Breakpoint &p = *(after - 1), &q = *after;
  Position x;
  for (std::size_t k = 0; k < 3; ++k) x[k] = (p.x[k] * (q.t - t) + q.x[k] * (t - p.t)) / (q.t - p.t);
  return x;
}

WindowAnswer first_answer(const PairKey& key, const std::vector<Step>& steps, int dimension) {
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const oracle::Answer answer = decide(key, steps[k], dimension);
    if (answer.time) return {static_cast<int>(k), answer};
  }
  return {};
}

int order(const WindowAnswer& a, const WindowAnswer& b) {
  return a.step != b.step ? (a.step < b.step ? -1 : 1) : a.answer.time->compare(*b.answer.time);
}

std::vector<Step> unit_steps(const LineScene& scene, int steps) {
  std::vector<Step> result;
  for (int k = 0; k < steps; ++k) result.push_back(unit_step(scene, k));
  return result;
}

oracle::Motion motion_of(const PairKey& key, const Step& step, int dimension) {
  oracle::Motion motion;
  motion.pair = static_cast<oracle::Pair>(key.first);
  motion.dimension = dimension;
  for (std::size_t i = 0; i < point_count(key.first); ++i) {
    motion.x_t0[i] = step.x_t0[key.second[i]];
    motion.x_t1[i] = step.x_t1[key.second[i]];
  }
  return motion;
}

/// The sign of the orientation just after the beginning of a motion; 0 if it has none.
int orientation_after(const oracle::Motion& motion) {
  const auto form = oracle::orientation(motion, oracle::integer_paths(motion, oracle::Unit::per_axis).x);
  return form ? oracle::Time().sign_after(*form) : 0;
}

bool interior_at_begin(const oracle::Motion& motion) {
  const auto x = oracle::integer_paths(motion, oracle::Unit::per_axis).x;
  const auto contact = oracle::contact_condition(motion, x, oracle::orientation(motion, x));
  return std::all_of(contact.interior.begin(), contact.interior.end(),
                     [](const auto& p) { return oracle::Time().sign_of(p) > 0; });
}

/// The kind of a contact at the border between two unit steps.
ContactKind kind_at_border(const PairKey& key, const Step& before, const Step& after, int dimension) {
  const oracle::Motion next = motion_of(key, after, dimension);
  if (oracle::first_contact(next).kind == oracle::Kind::persistent) return ContactKind::persistent;
  oracle::Motion reversed = motion_of(key, before, dimension);
  std::swap(reversed.x_t0, reversed.x_t1);
  const bool changes = orientation_after(reversed) * orientation_after(next) < 0;
  return changes && interior_at_begin(next) ? ContactKind::crossing : ContactKind::touching;
}

}  // namespace

Step unit_step(const LineScene& scene, int k) {
  Step step;
  for (const auto& path : scene.paths) step.vertex(place_at(path, k), place_at(path, k + 1));
  step.mesh = scene.mesh;
  return step;
}

WindowTruth window_truth(const LineScene& scene, int dimension, int steps, bool strict) {
  const std::vector<Step> unit = unit_steps(scene, steps);
  WindowTruth truth;
  for (const auto& [key, count] : all_pairs(scene.mesh, dimension, strict)) {
    const WindowAnswer answer = first_answer(key, unit, dimension);
    if (answer.step < 0) continue;
    truth.contacts[key] = count;
    const int earlier = truth.first.empty() ? -1 : order(answer, truth.first_answer);
    if (earlier < 0) {
      truth.first_answer = answer;
      truth.first.clear();
    }
    if (earlier <= 0) truth.first.insert(key);
  }
  for (std::uint32_t b = 0; b < scene.mesh.cell_count(); ++b) {
    for (std::uint32_t a = 0; a < b; ++a) {
      if (cells_meet_at_begin(unit[0], dimension, a, b)) truth.initial.insert({a, b});
    }
  }
  return truth;
}

ContactKind kind_of(const PairKey& key, const LineScene& scene, int dimension, int steps, const WindowAnswer& at) {
  const bool begins = at.answer.time->compare(0.0) == 0, ends = at.answer.time->compare(1.0) == 0;
  if (begins && at.step > 0) {
    return kind_at_border(key, unit_step(scene, at.step - 1), unit_step(scene, at.step), dimension);
  }
  if (ends && at.step + 1 < steps) {
    return kind_at_border(key, unit_step(scene, at.step), unit_step(scene, at.step + 1), dimension);
  }
  return static_cast<ContactKind>(decide(key, unit_step(scene, at.step), dimension).kind);
}

}  // namespace noli::testing
