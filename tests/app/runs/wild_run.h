// SPDX-License-Identifier: Apache-2.0
//
// Writes runs of random motions, most of which touch.
#pragma once

#include <cstdint>
#include <filesystem>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "trajectory/blocks/run_file.h"

namespace noli::app_tests {

/// Loose points, edges and faces that jump around on a coarse grid, with individual breakpoints.
class WildRun {
 public:
  /// `apart`: how far the region of a vertex is moved against that of the vertex before; regions are 4 wide.
  WildRun(unsigned seed, std::uint32_t dimension, double apart = 1) : random_(seed), apart_(apart) {
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
  void write(const std::filesystem::path& folder, int windows) {
    std::filesystem::create_directories(folder);
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
  /// A random position in the region of the vertex.
  Position place(VertexId v) {
    return {coordinate() + apart_ * v, coordinate(), scene_.header.dimension == 2 ? 0 : coordinate()};
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
  double apart_;
  RunScene scene_;
};

}  // namespace noli::app_tests
