// SPDX-License-Identifier: Apache-2.0
//
// Verifies pairs of frames of real simulations; visibly skipped where the files are missing.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>

#include "brute_force.h"
#include "tests/support/real_data.h"
#include "trajectory/formats/frames.h"

namespace noli::testing {
namespace {

struct Pair {
  const char* name;
  const char* t0;
  const char* t1;
  std::uint64_t vertex_face, edge_edge, most_cell_pairs;
  friend void PrintTo(const Pair& pair, std::ostream* out) { *out << pair.name; }
};

constexpr Pair pairs[] = {
    {"cloth_funnel", "cloth-funnel/227.ply", "cloth-funnel/228.ply", 27, 107, 800},
    {"armadillo_rollers", "armadillo-rollers/326.ply", "armadillo-rollers/327.ply", 4650, 19308, 60000},
    {"cloth_ball", "cloth-ball/cloth_ball92.ply", "cloth-ball/cloth_ball93.ply", 19032, 94822, 400000},
    {"rod_twist_clean", "rod-twist-clean/0.ply", "rod-twist-clean/1.ply", 0, 0, 1000},
};

/// Reads the pair; nullopt if the files are missing.
std::optional<Step> read(const Pair& pair) {
  const auto t0 = test::real_data(std::string("frames/") + pair.t0),
             t1 = test::real_data(std::string("frames/") + pair.t1);
  if (!t0 || !t1) return std::nullopt;
  const Frame begin = read_frame(*t0), end = read_frame(*t1);
  return Step{begin.mesh, begin.positions, end.positions};
}

class Frames : public ::testing::TestWithParam<Pair> {};
INSTANTIATE_TEST_SUITE_P(All, Frames, ::testing::ValuesIn(pairs),
                         [](const auto& p) { return std::string(p.param.name); });

TEST_P(Frames, HaveTheKnownContacts) {
  const auto step = read(GetParam());
  if (!step) GTEST_SKIP() << "no real data";
  const VerifyResult result = verify_step(step->mesh, step->x_t0, step->x_t1, {});
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.contacts, (std::array<std::uint64_t, 4>{GetParam().vertex_face, GetParam().edge_edge, 0, 0}));
  EXPECT_EQ(result.first.has_value(), result.contact_count() > 0);
  EXPECT_LT(result.cell_pairs, GetParam().most_cell_pairs);  // directions settle nearly all
}

/// The box of a face at t = 0; boxes are sorted by their least x.
struct Box {
  Position low, high;
  std::uint32_t face;
};

std::vector<Box> sorted_boxes(const Step& step) {
  std::vector<Box> boxes;
  for (std::uint32_t f = 0; f < step.mesh.faces.size(); ++f) {
    Box box{step.x_t0[step.mesh.faces[f][0]], step.x_t0[step.mesh.faces[f][0]], f};
    for (const VertexId v : step.mesh.faces[f]) {
      for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = std::min(box.low[k], step.x_t0[v][k]);
        box.high[k] = std::max(box.high[k], step.x_t0[v][k]);
      }
    }
    boxes.push_back(box);
  }
  std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.low[0] < b.low[0]; });
  return boxes;
}

TEST(FramesSlow, InitialIntersectionsAreThoseOfBruteForce) {
  const auto pair = read(pairs[0]);
  if (!pair) GTEST_SKIP() << "no real data";
  const Step& step = *pair;
  const std::vector<Box> boxes = sorted_boxes(step);
  std::set<std::pair<std::uint32_t, std::uint32_t>> truth;
  std::size_t asked = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = i + 1; j < boxes.size() && boxes[j].low[0] <= boxes[i].high[0]; ++j) {
      const Box &a = boxes[i], &b = boxes[j];
      if (a.low[1] > b.high[1] || b.low[1] > a.high[1] || a.low[2] > b.high[2] || b.low[2] > a.high[2]) continue;
      ++asked;
      if (cells_meet_at_begin(step, 3, a.face, b.face)) truth.insert(std::minmax(a.face, b.face));
    }
  }
  EXPECT_GT(asked, step.mesh.faces.size());
  VerifyOptions options;
  options.max_reports = 100000;
  const VerifyResult result = verify_step(step.mesh, step.x_t0, step.x_t1, options);
  std::set<std::pair<std::uint32_t, std::uint32_t>> found;
  for (const auto& i : result.initial_reports) found.insert({i.first_cell, i.second_cell});
  EXPECT_EQ(found, truth);
  EXPECT_EQ(result.initial_intersections, truth.size());
  EXPECT_GT(truth.size(), 0u);
}

}  // namespace
}  // namespace noli::testing
