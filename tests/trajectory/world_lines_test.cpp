// SPDX-License-Identifier: Apache-2.0
#include "trajectory/world_lines.h"

#include <cmath>

#include "support.h"

namespace noli {
namespace {

struct Arrays {
  std::vector<std::size_t> offsets{0, 3, 5};
  std::vector<double> times{0, 0.25, 2, 0, 2};
  std::vector<Position> positions{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 5, 0}, {0, 6, 0}};
};

WorldLines build(const Arrays& a) { return WorldLines::from_breakpoints(a.offsets, a.times, a.positions, "lines"); }

TEST(WorldLines, KeepTheirBreakpoints) {
  const WorldLines lines = build({});
  EXPECT_EQ(lines.vertex_count(), 2u);
  EXPECT_EQ(lines.first_time(), 0);
  EXPECT_EQ(lines.last_time(), 2);
  EXPECT_EQ(std::vector<double>(lines.times(0).begin(), lines.times(0).end()), (std::vector<double>{0, 0.25, 2}));
  ASSERT_EQ(lines.positions(1).size(), 2u);
  EXPECT_EQ(lines.positions(1)[1], (Position{0, 6, 0}));
}

TEST(WorldLines, SegmentAtATime) {
  const WorldLines lines = build({});
  EXPECT_EQ(lines.segment_at(0, 0), 0u);
  EXPECT_EQ(lines.segment_at(0, std::nextafter(0.25, 0)), 0u);
  EXPECT_EQ(lines.segment_at(0, 0.25), 1u) << "the one that begins there";
  EXPECT_EQ(lines.segment_at(0, 1), 1u);
  EXPECT_EQ(lines.segment_at(0, 2), 1u) << "the last";
  EXPECT_EQ(lines.segment_at(1, 0), 0u);
  EXPECT_EQ(lines.segment_at(1, 2), 0u);
}

TEST(WorldLines, FromTwoFrames) {
  const std::vector<Position> x_t0{{1, 2, 3}, {4, 5, 6}}, x_t1{{7, 8, 9}, {-0.0, 0, 0}};
  const WorldLines lines = WorldLines::from_frames(x_t0, x_t1);
  EXPECT_EQ(lines.vertex_count(), 2u);
  EXPECT_EQ(lines.first_time(), 0);
  EXPECT_EQ(lines.last_time(), 1);
  for (VertexId v = 0; v < 2; ++v) {
    ASSERT_EQ(lines.times(v).size(), 2u);
    EXPECT_EQ(lines.positions(v)[0], x_t0[v]);
    EXPECT_EQ(lines.positions(v)[1], x_t1[v]);
  }
}

struct BadLines {
  const char* name;
  void (*spoil)(Arrays&);
  std::string message;
  friend void PrintTo(const BadLines& bad, std::ostream* out) { *out << bad.name; }
};
const BadLines bad_lines[] = {
    {"no_vertices",
     [](Arrays& a) {
       a = {{0}, {}, {}};
     },
     "lines: there are no vertices"},
    {"no_offsets", [](Arrays& a) { a.offsets = {}; }, "lines: there are no vertices"},
    {"position_missing", [](Arrays& a) { a.positions.pop_back(); },
     "lines: offsets from 0 to 5 do not fit 5 times and 4 positions"},
    {"late_start", [](Arrays& a) { a.offsets[0] = 1; },
     "lines: offsets from 1 to 5 do not fit 5 times and 5 positions"},
    {"early_end", [](Arrays& a) { a.offsets[2] = 4; }, "lines: offsets from 0 to 4 do not fit 5 times and 5 positions"},
    {"single_breakpoint", [](Arrays& a) { a.offsets[1] = 4; }, "lines: vertex 1: expected at least two breakpoints"},
    {"descending_offsets",
     [](Arrays& a) {
       a.offsets = {0, 4, 2, 5};
     },
     "lines: vertex 1: expected at least two breakpoints"},
    {"far_offset", [](Arrays& a) { a.offsets[1] = 9; }, "lines: vertex 0: its breakpoints reach beyond the last"},
    {"nan_time", [](Arrays& a) { a.times[1] = std::nan(""); },
     "lines: vertex 0, breakpoint 1: expected a finite time, found nan"},
    {"infinite_end", [](Arrays& a) { a.times[2] = HUGE_VAL; },
     "lines: vertex 0, breakpoint 2: expected a finite time, found inf"},
    {"equal_times", [](Arrays& a) { a.times[1] = 0; }, "lines: vertex 0, breakpoint 1: time 0 does not come after 0"},
    {"descending_times", [](Arrays& a) { a.times[1] = 3; },
     "lines: vertex 0, breakpoint 2: time 2 does not come after 3"},
    {"other_start", [](Arrays& a) { a.times[3] = 1; }, "lines: vertex 1: begins at 1, but vertex 0 at 0"},
    {"other_end", [](Arrays& a) { a.times[4] = 3; }, "lines: vertex 1: ends at 3, but vertex 0 at 2"},
    {"infinite_position", [](Arrays& a) { a.positions[4][1] = HUGE_VAL; },
     "lines: vertex 1, breakpoint 1: expected a finite coordinate, found inf"},
};

class WorldLineErrors : public ::testing::TestWithParam<BadLines> {};
INSTANTIATE_TEST_SUITE_P(All, WorldLineErrors, ::testing::ValuesIn(bad_lines),
                         [](const auto& bad) { return bad.param.name; });

TEST_P(WorldLineErrors, SaysWhatAndWhere) {
  Arrays arrays;
  GetParam().spoil(arrays);
  EXPECT_EQ(testing::input_error([&] { build(arrays); }), GetParam().message);
}

}  // namespace
}  // namespace noli
