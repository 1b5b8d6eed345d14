// SPDX-License-Identifier: Apache-2.0
//
// Tests runs in which something touches or comes too near: `noli verify` writes a witness that both checkers accept.
#include <fmt/format.h>

#include <cmath>
#include <random>
#include <set>

#include "tests/app/runs/simulate_fixture.h"
#include "trajectory/blocks/run_file.h"

namespace noli::app_tests {
namespace {

/// Loose points, edges and faces that jump around on a coarse grid, with individual breakpoints.
class WildRun {
 public:
  WildRun(unsigned seed, std::uint32_t dimension) : random_(seed) {
    scene_.header = {dimension, RecordMode::full, 1.0};
    VertexId v = 0;
    const auto next = [&] { return v++; };
    for (std::size_t i = 0; i < 1 + below(2); ++i) scene_.mesh.faces.push_back({next(), next(), next()});
    for (std::size_t i = 0; i < 1 + below(2); ++i) scene_.mesh.edges.push_back({next(), next()});
    for (std::size_t i = 0; i < 1 + below(2); ++i) scene_.mesh.points.push_back(next());
    scene_.mesh.vertex_count = v;
    scene_.labels.assign(v, 0);
  }

  /// Writes windows of 1 s; each begins where the one before ends.
  void write(const fs::path& folder, int windows) {
    fs::create_directories(folder);
    RunWriter writer(folder, scene_);
    std::vector<Position> x(scene_.mesh.vertex_count);
    for (VertexId v = 0; v < x.size(); ++v) x[v] = place(v);
    const std::vector<Position> rest(x.size(), Position{});
    for (int k = 0; k < windows; ++k) {
      const WorldLines lines = wander(x, k);
      writer.append_window({.index = static_cast<std::uint64_t>(k), .lines = lines, .velocities = rest});
      writer.commit();
    }
  }

 private:
  std::size_t below(std::size_t n) { return random_() % n; }
  double coordinate() { return static_cast<double>(below(65)) / 16; }
  /// A random position; the regions of different vertices overlap partly.
  Position place(VertexId v) {
    return {coordinate() + 1.0 * v, coordinate(), scene_.header.dimension == 2 ? 0 : coordinate()};
  }

  WorldLines wander(std::vector<Position>& x, int window) {
    std::vector<std::size_t> offsets = {0};
    std::vector<double> times;
    std::vector<Position> positions;
    for (VertexId v = 0; v < x.size(); ++v) {
      std::set<double> mine = {window + 0.0, window + 1.0};
      for (std::size_t i = below(4); i > 0; --i) mine.insert(window + static_cast<double>(below(32)) / 32);
      for (const double t : mine) {
        if (t > window) x[v] = place(v);
        times.push_back(t);
        positions.push_back(x[v]);
      }
      offsets.push_back(times.size());
    }
    return WorldLines::from_breakpoints(std::move(offsets), std::move(times), std::move(positions), "a wild run");
  }

  std::mt19937 random_;
  RunScene scene_;
};

class RunWitness : public Simulate {
 protected:
  std::string proof() const { return folder.path("proof.noli"); }
  Process verify(const std::string& run, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"verify", run, "--force", "--proof", proof()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_noli(arguments);
  }
  /// The exit code on which all checkers that are built agree.
  int check(const std::string& run, const std::string& distance = "0") const {
    const std::vector<std::string> asked = {"check", proof(), run, "--require", "distance=" + distance};
    const Process plain = run_noli(asked);
    if (verified_checker_is_there()) {
      std::vector<std::string> again = asked;
      again.emplace_back("--verified");
      EXPECT_EQ(run_noli(again).verdict_of_checker(), plain.verdict_of_checker());
    }
    return plain.exit_code;
  }
};

TEST_F(RunWitness, WildRunsAreProvedOrRefuted) {
  int proved = 0, refuted = 0, without = 0;
  for (unsigned seed = 0; seed < 80; ++seed) {
    const std::string run = run_path(std::to_string(seed));
    WildRun(seed, seed % 4 == 3 ? 2 : 3).write(run, 2);
    const Process process = verify(run, {});
    ASSERT_LE(process.exit_code, 1) << seed << process.err;
    const bool has_witness = process.out.find("No witness was found") == std::string::npos;
    without += has_witness ? 0 : 1;
    if (!has_witness) continue;
    EXPECT_EQ(check(run), process.exit_code) << seed;
    (process.exit_code == 0 ? proved : refuted) += 1;
  }
  std::printf("proved %d, refuted %d, without a witness %d\n", proved, refuted, without);
  EXPECT_GE(proved, 10);
  EXPECT_GE(refuted, 30);
  EXPECT_EQ(without, 0);
}

TEST_F(RunWitness, WhatComesTooNearHasOneToo) {
  int proved = 0, near = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const std::string run = run_path(std::to_string(seed));
    WildRun(seed, seed % 4 == 3 ? 2 : 3).write(run, 1);
    const Process process = verify(run, {"--min-distance", "0.25"});
    ASSERT_LE(process.exit_code, 1) << seed << process.out << process.err;
    if (process.verdict_line().starts_with("CONTACT")) continue;
    EXPECT_EQ(check(run, "0.25"), process.exit_code) << seed;
    (process.exit_code == 0 ? proved : near) += 1;
  }
  std::printf("proved %d, too near %d\n", proved, near);
  EXPECT_GE(proved, 5);
  EXPECT_GE(near, 5);
}

TEST_F(RunWitness, TheMeshMayAllowLess) {
  const std::string file = scene(hanging_sheet());
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--until", "0.02"}).exit_code, 0);
  const Process process = verify(run_path("run"), {"--min-distance", "0.5", "--json", folder.path("result.json")});
  EXPECT_EQ(process.exit_code, 1);
  const Json first = Json::parse(read_text(folder.path("result.json")))["first_frame"];
  const double allowed = first["allowed"], limit = first["not"];
  EXPECT_NE(process.out.find("The first frame allows "), std::string::npos);
  EXPECT_EQ(check(run_path("run"), "0.5"), 1);
  // The cells are squares of 1/6, each split in two and slightly perturbed.
  EXPECT_GT(allowed, 0.11);
  EXPECT_LT(limit, 0.13);
  EXPECT_LT(limit, allowed * (1 + 0x1p-19));
  const auto at = [&](double distance) {
    return verify(run_path("run"), {"--min-distance", fmt::format("{:.17g}", distance)}).verdict_line();
  };
  EXPECT_TRUE(at(limit).starts_with("TOO NEAR ")) << limit;
  EXPECT_TRUE(at(allowed * 0.99).starts_with("PROVED "));  // it moves a little
}

}  // namespace
}  // namespace noli::app_tests
