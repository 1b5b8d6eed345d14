// SPDX-License-Identifier: Apache-2.0
//
// Tests sheets in windows: compares answers that use monotone sheets with those without a layout, and with the
// definitions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sheets.h"
#include "window_scenes.h"

namespace noli::testing {
namespace {

/// A surface whose vertices have individual breakpoints within [0, 6].
struct Motion {
  Surface surface;
  std::vector<std::vector<Breakpoint>> paths;

  LineScene scene() const {
    LineScene result;
    for (const auto& path : paths) result.vertex(path);
    result.mesh = surface.mesh;
    return result;
  }
};

/// Every vertex v of the surface is at place(v, t) at some of the times 0, 1, ..., 6, always at the first and the last.
template <class Place>
Motion moving(const Surface& surface, std::uint64_t seed, const Place& place) {
  Random random(seed);
  Motion motion{surface, {}};
  for (VertexId v = 0; v < surface.x.size(); ++v) {
    std::vector<Breakpoint> path;
    for (int t = 0; t <= 6; ++t) {
      if (t == 0 || t == 6 || random.below(2) == 0) path.push_back({static_cast<double>(t), place(v, t)});
    }
    motion.paths.push_back(path);
  }
  return motion;
}

/// A wave that runs through the surface.
Motion wave(const Surface& surface, double height) {
  return moving(surface, 1, [&](VertexId v, double t) {
    const Position& x = surface.x[v];
    return Position{x[0] + 0.3 * t, x[1], height * std::sin(0.6 * x[0] + 0.2 * x[1] - 0.1 * t)};
  });
}

/// Rolls the surface up along its first axis, with a radius that changes from `from` to `to`.
Motion roll(const Surface& surface, double from, double to) {
  return moving(surface, 2, [&](VertexId v, double t) {
    const Position& x = surface.x[v];
    const double radius = from + (to - from) * t / 6;
    return Position{radius * std::sin(x[0] / radius), x[1], radius * (1 - std::cos(x[0] / radius))};
  });
}

/// Random steps of up to `rough`, to integer multiples of 60 / 64, so that positions at all integer times are doubles.
Motion shaken(const Surface& surface, std::uint64_t seed, double rough, std::size_t axes = 3) {
  Random random(seed + 77);
  return moving(surface, seed, [&](VertexId v, double) {
    Position x{};
    for (std::size_t k = 0; k < axes; ++k) x[k] = 60 * std::round(64 * (surface.x[v][k] + rough * random.unit())) / 64;
    return x;
  });
}

WindowOptions plain(int threads = 1) {
  WindowOptions options;
  options.threads = threads;
  options.max_reports = 100000;
  return options;
}

WindowResult with_layout(const Motion& motion, const WindowOptions& options = plain()) {
  return WindowVerifier(motion.surface.mesh, motion.surface.x, options).verify(motion.scene().lines(), options);
}

/// Verifies without a layout: a surface with all vertices at one position has none.
WindowResult without_layout(const Motion& motion, const WindowOptions& options = plain()) {
  const std::vector<Position> nowhere(motion.surface.x.size());
  return WindowVerifier(motion.surface.mesh, nowhere, options).verify(motion.scene().lines(), options);
}

void expect_equal(const WindowResult& a, const WindowResult& b) {
  EXPECT_EQ(a.complete, b.complete);
  EXPECT_EQ(a.contacts, b.contacts);
  EXPECT_EQ(a.reports, b.reports);
  EXPECT_EQ(a.initial_reports, b.initial_reports);
  ASSERT_EQ(a.first.has_value(), b.first.has_value());
  if (!a.first) return;
  EXPECT_EQ(a.first->contact, b.first->contact);
  EXPECT_EQ(a.first->lower(), b.first->lower());
  EXPECT_EQ(a.first->kind, b.first->kind);
}

TEST(WindowSheets, ACalmSheetIsSettledAtOnce) {
  const Motion motion = wave(grid(20, 15), 0.8);
  const WindowResult result = with_layout(motion);
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.contact_count() + result.initial_intersections, 0u);
  EXPECT_LE(result.obligations, 2u);
  const WindowResult other = without_layout(motion);
  expect_equal(result, other);
  EXPECT_GT(other.obligations, 600u);
}

TEST(WindowSheets, ATurnedSheetIsSettledAtOnce) {
  Motion motion = wave(grid(12, 12), 0.3);
  for (auto& path : motion.paths) {
    for (Breakpoint& b : path) b.x = {b.x[2] + 5, b.x[0], -b.x[1]};
  }
  EXPECT_LE(with_layout(motion).obligations, 2u);
}

TEST(WindowSheets, ARolledSheetIsSettledInParts) {
  const Motion open = roll(grid(24, 6), 5, 4.8);  // less than once around: 24 < 2 pi 4.8
  const WindowResult result = with_layout(open);
  EXPECT_EQ(result.contact_count() + result.initial_intersections, 0u);
  EXPECT_GT(result.obligations, 2u);
  EXPECT_LT(result.obligations, without_layout(open).obligations / 4);
  expect_equal(result, without_layout(open));
}

TEST(WindowSheets, ASheetRolledOntoItselfMeets) {
  const Motion closed = roll(grid(24, 6), 6, 3);
  const WindowResult result = with_layout(closed);
  EXPECT_GT(result.contact_count(), 0u);
  EXPECT_EQ(result.initial_intersections, 0u);
  expect_equal(result, without_layout(closed));
}

TEST(WindowSheets, ASheetThatIsFoldedFromTheBeginningIntersects) {
  const Motion closed = roll(grid(24, 6), 3, 2.8);
  const WindowResult result = with_layout(closed);
  EXPECT_GT(result.initial_intersections, 0u);
  expect_equal(result, without_layout(closed));
}

TEST(WindowSheets, InThePlane) {
  const auto motion = [](double swing) {
    const Surface surface = grid(10, 10);
    return moving(surface, 3, [&](VertexId v, double t) {
      const Position& x = surface.x[v];
      return Position{x[0] + 0.2 * t + swing * std::sin(x[0] + x[1] + t), x[1] - 0.1 * x[0], 1e9 * t};
    });
  };
  WindowOptions options = plain();
  options.dimension = 2;
  const WindowResult calm = with_layout(motion(0.1), options);
  EXPECT_LE(calm.obligations, 2u);
  expect_equal(calm, without_layout(motion(0.1), options));
  EXPECT_EQ(calm.contact_count() + calm.initial_intersections, 0u);
  const WindowResult wild = with_layout(motion(0.9), options);
  EXPECT_GT(wild.contact_count(), 0u);
  expect_equal(wild, without_layout(motion(0.9), options));
}

TEST(WindowSheets, RandomOnesAreAnsweredAlikeWithAndWithoutLayout) {
  int touching = 0, apart = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const Motion motion = shaken(grid(5, 5), seed, 0.05 + 0.01 * static_cast<double>(seed));
    const WindowResult result = with_layout(motion);
    expect_equal(result, without_layout(motion));
    (result.contact_count() > 0 ? touching : apart) += 1;
  }
  EXPECT_GT(touching, 10);
  EXPECT_GT(apart, 10);
}

TEST(WindowSheets, SlowRandomOnesAreAnsweredByTheDefinitions) {
  int touching = 0, apart = 0;
  for (const double rough : {0.2, 0.3, 0.35, 0.5}) {
    const Motion motion = shaken(grid(4, 4), static_cast<std::uint64_t>(rough * 1000), rough);
    const LineScene scene = motion.scene();
    const WindowTruth truth = window_truth(scene, 3, 6);
    const WindowResult result = with_layout(motion);
    std::map<PairKey, int> reported;
    for (const FeatureContact& contact : result.reports) ++reported[key_of(contact)];
    EXPECT_EQ(reported, truth.contacts);
    EXPECT_EQ(result.initial_intersections, truth.initial.size());
    (truth.contacts.empty() ? apart : touching) += 1;
  }
  EXPECT_GT(touching, 0);
  EXPECT_GT(apart, 0);
}

/// Sheets, a closed surface, loose edges and points, all close to one another.
Motion medley(double shift) {
  Surface surface = grid(8, 8);
  append(surface, grid(8, 8), {0.4, 0.2, 1.2});
  append(surface, closed_box(3), {2, 2, 2.5});
  const auto first = static_cast<VertexId>(surface.x.size());
  for (int i = 0; i < 4; ++i) surface.x.push_back({1.0 + i, 1.5, 0.6 + 0.01 * i});
  surface.mesh.vertex_count = surface.x.size();
  surface.mesh.edges = {{first, first + 1}};
  surface.mesh.points = {first + 2, first + 3};
  return moving(surface, 4, [surface, shift](VertexId v, double t) {
    const Position& x = surface.x[v];
    return Position{x[0], x[1], x[2] - (v < 81 ? 0 : shift * t) + 0.1 * std::sin(x[0] + t)};
  });
}

TEST(WindowSheets, OfSeveralBodiesPairsAreFoundInEveryWay) {
  for (const double shift : {0.0, 0.03, 0.3}) {
    const WindowResult result = with_layout(medley(shift));
    EXPECT_EQ(result.contact_count() > 0, shift == 0.3);
    expect_equal(result, without_layout(medley(shift)));
  }
}

TEST(WindowSheets, ThreadsDoNotChangeAnything) {
  for (const Motion& motion : {medley(0.3), roll(grid(30, 8), 6, 4.5), shaken(grid(20, 20), 5, 0.3)}) {
    const WindowResult one = with_layout(motion, plain(1));
    for (const int threads : {2, 5}) {
      const WindowResult many = with_layout(motion, plain(threads));
      expect_equal(many, one);
      EXPECT_EQ(many.stages, one.stages);
      EXPECT_EQ(many.obligations, one.obligations);
      EXPECT_EQ(many.cell_pairs, one.cell_pairs);
      if (one.first) {
        EXPECT_EQ(many.first->time, one.first->time);
      }
    }
  }
}

TEST(WindowSheets, ScriptedSheetsAreNotLookedAt) {
  const Motion motion = roll(grid(24, 6), 3, 2.8);
  WindowOptions options = plain();
  const std::vector<std::uint8_t> all(motion.surface.x.size(), 1);
  options.scripted = all;
  EXPECT_EQ(with_layout(motion, options).initial_intersections, 0u);
  EXPECT_EQ(with_layout(motion, options).obligations, 0u);
  std::vector<std::uint8_t> some = all;
  for (std::size_t v = 0; v < 20; ++v) some[v] = 0;
  options.scripted = some;
  const WindowResult part = with_layout(motion, options);
  EXPECT_GT(part.initial_intersections, 0u);
  EXPECT_LT(part.initial_intersections, with_layout(motion).initial_intersections);
  expect_equal(part, without_layout(motion, options));
}

TEST(WindowSheets, StrictAlsoLooksAtTheFeaturesOfOneCell) {
  WindowOptions options = plain();
  options.strict = true;
  EXPECT_LE(with_layout(wave(grid(20, 15), 0.8), options).obligations, 2u);
  const Motion wild = shaken(grid(4, 4), 3, 0.6, 2);  // in the plane z = 0
  const WindowResult result = with_layout(wild, options);
  expect_equal(result, without_layout(wild, options));
  EXPECT_GT(result.contact_count(), with_layout(wild).contact_count());
}

// --- parts that are not sheets

Motion tremble(const Surface& surface, double much) {
  return moving(surface, 5, [surface, much](VertexId v, double t) {
    const Position& x = surface.x[v];
    const double w = much * std::sin(0.4 * x[0] + 0.3 * x[1] + 0.2 * x[2] + 0.2 * t);
    return Position{x[0] + w + t, x[1] - w, x[2] + w - 0.5 * t};
  });
}

TEST(WindowCharts, AClosedSurfaceIsSettledByCharts) {
  const Motion motion = tremble(closed_box(10), 0.3);
  const WindowResult result = with_layout(motion);
  expect_equal(result, without_layout(motion));
  EXPECT_EQ(result.contact_count() + result.initial_intersections, 0u);
  EXPECT_LT(result.obligations, without_layout(motion).obligations / 2);
}

TEST(WindowCharts, RandomOnesAreAnsweredAlikeWithAndWithoutCharts) {
  int touching = 0, apart = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const Motion motion = shaken(closed_box(4), seed, 0.05 + 0.015 * static_cast<double>(seed));
    const WindowResult result = with_layout(motion);
    expect_equal(result, without_layout(motion));
    (result.contact_count() > 0 ? touching : apart) += 1;
  }
  EXPECT_GT(touching, 5);
  EXPECT_GT(apart, 5);
}

/// A band wound around an axis twice; its windings are much closer together than its edges are long.
Motion spiral(double from, double to) {
  const Surface flat = grid(24, 5);
  const auto place = [&](VertexId v, double pitch) {
    const Position& x = flat.x[v];
    const double angle = x[0] / 2, radius = 2 + pitch * angle;
    return Position{radius * std::cos(angle), x[1], radius * std::sin(angle)};
  };
  Motion motion = moving(flat, 6, [&](VertexId v, double t) { return place(v, from + (to - from) * t / 6); });
  for (VertexId v = 0; v < flat.x.size(); ++v) motion.surface.x[v] = place(v, from);
  return motion;
}

TEST(WindowCharts, LayersOverOneAnotherAreNotTakenForOne) {
  const WindowResult open = with_layout(spiral(0.1, 0.08));
  EXPECT_EQ(open.contact_count() + open.initial_intersections, 0u);
  expect_equal(open, without_layout(spiral(0.1, 0.08)));
  const WindowResult closing = with_layout(spiral(0.1, -0.02));
  EXPECT_GT(closing.contact_count(), 0u);
  expect_equal(closing, without_layout(spiral(0.1, -0.02)));
}

/// Extra breakpoints on existing lines change nothing. They are dyadic, so that they lie exactly on the lines.
TEST(WindowSheets, BreakpointsOnTheLineChangeNothing) {
  for (const double rough : {0.1, 0.7}) {
    Motion motion = shaken(grid(6, 6), 12, rough);
    for (auto& path : motion.paths) {
      for (Breakpoint& b : path) b.t *= 64;
    }
    const WindowResult before = with_layout(motion);
    EXPECT_EQ(before.contact_count() > 0, rough == 0.7);
    Random random(6);
    for (auto& path : motion.paths) {
      std::vector<Breakpoint> finer;
      for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        finer.push_back(path[i]);
        const double w = (1 + random.below(7)) / 8.0;
        Breakpoint between{path[i].t + w * (path[i + 1].t - path[i].t), {}};
        for (std::size_t k = 0; k < 3; ++k) between.x[k] = path[i].x[k] + w * (path[i + 1].x[k] - path[i].x[k]);
        if (random.below(3) > 0) finer.push_back(between);
      }
      finer.push_back(path.back());
      path = finer;
    }
    const WindowResult after = with_layout(motion);
    expect_equal(after, before);
    if (before.first) {
      EXPECT_EQ(after.first->time, before.first->time);
    }
  }
}

/// A sheet that trembles so much that its chords decide nothing, so time is split. From one breakpoint to another, a
/// vertex of it is out of place.
Motion trembling(double displacement, int from, int to) {
  const Surface surface = grid(12, 12);
  Random random(8);
  Motion motion{surface, {}};
  for (const Position& x : surface.x) {
    std::vector<Breakpoint> path;
    for (int i = 0; i <= 64; ++i) {
      const double side = x[0] == 6 && x[1] == 6 && from <= i && i <= to ? displacement : 0;
      path.push_back({i / 64.0, {x[0] + 3 * std::sin(i / 10.0), x[1] + 0.001 * random.unit() - side, x[2]}});
    }
    motion.paths.push_back(path);
  }
  return motion;
}

TEST(WindowSheets, RestlessVerticesCutTime) {
  const WindowResult calm = with_layout(trembling(0, 40, 40));
  EXPECT_EQ(calm.contact_count(), 0u);
  EXPECT_GT(calm.obligations, 1u);
  EXPECT_LE(calm.obligations, 64u);
  EXPECT_EQ(calm.cell_pairs, 0u);
  const WindowResult wild = with_layout(trembling(1.5, 40, 40));
  EXPECT_GT(wild.contact_count(), 0u);
  EXPECT_GT(wild.first->lower(), 39 / 64.0);
  EXPECT_LT(wild.first->lower(), 40 / 64.0);
}

/// What meets as a window begins is left out of it, even where it still meets in spans that begin later.
TEST(WindowSheets, WhatGoesOnIsLeftOutWhereTimeIsCut) {
  const Motion folded = trembling(1.5, 0, 50);
  Motion resting = folded;
  for (auto& path : resting.paths) path = {path.front(), {1, path.front().x}};
  WindowOptions options = plain();
  const std::vector<FeatureContact> all = with_layout(folded, options).reports, before = with_layout(resting).reports;
  options.after_step = true;
  const WindowResult result = with_layout(folded, options);
  std::vector<FeatureContact> expected = all;
  std::erase_if(expected, [&](const FeatureContact& contact) { return std::ranges::count(before, contact) > 0; });
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.reports, expected);
  EXPECT_EQ(result.going_on, before.size());
  EXPECT_GT(before.size(), 0U);
}

}  // namespace
}  // namespace noli::testing
