// SPDX-License-Identifier: Apache-2.0
//
// Verifies one motion as a whole and in shards, and compares the answers.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "tests/app/process.h"
#include "tests/app/runs/simulate_fixture.h"
#include "tests/app/scene.h"
#include "trajectory/blocks/block_file.h"
#include "trajectory/blocks/block_sink.h"

namespace noli::app_tests {

using Words = std::vector<std::string>;

class Shards : public testing::Test {
 protected:
  /// Waves of a sheet above a floor; in the frames `through`, a triangle beside it is below the floor. `still`:
  /// nothing, or the corners of one more triangle.
  Words write_motion(std::size_t frames, const std::set<std::size_t>& through = {},
                     const std::vector<Position>& still = {}) const {
    Words paths;
    for (std::size_t k = 0; k < frames; ++k) {
      std::vector<Position> points = {{-1, -1, 0}, {9, -1, 0}, {-1, 9, 0}};
      const double depth = through.contains(k) ? -1 : 1;
      points.insert(points.end(), {{5, 1, depth}, {5.5, 1, depth + 0.25}, {5, 1.5, depth + 0.25}});
      for (int i = 0; i < 9; ++i) {
        const int row = i / 3, column = i % 3;
        const double x = column, y = row;
        points.push_back({x, y, 1 + 0.125 * static_cast<double>((i + k) % 5)});
      }
      std::vector<std::array<VertexId, 3>> faces = {{0, 1, 2},   {3, 4, 5},   {6, 7, 9},    {7, 10, 9},   {7, 8, 10},
                                                    {8, 11, 10}, {9, 10, 12}, {10, 13, 12}, {10, 11, 13}, {11, 14, 13}};
      points.insert(points.end(), still.begin(), still.end());
      if (!still.empty()) faces.push_back({15, 16, 17});
      paths.push_back(folder.write("frame_" + std::to_string(100 + k) + ".ply", ply_text(points, faces)));
    }
    return paths;
  }

  /// Frame k of a sheet in waves, whose proof has half a megabyte a step.
  std::string write_wave(
      int k, double lifted = 0, const std::function<void(Position&)>& move = [](Position&) {}) const {
    constexpr int side = 48;
    std::vector<Position> points;
    std::vector<std::array<VertexId, 3>> faces;
    for (int i = 0; i < side * side; ++i) {
      const int row = i / side, column = i % side;
      const double x = column, y = row;
      points.push_back({x, y, 0.25 * std::sin(0.5 * x + 0.25 * y + k) + lifted});
      move(points.back());
    }
    for (VertexId i = 0; i + side < side * side; ++i) {
      if (i % side == side - 1) continue;
      faces.push_back({i, i + 1, i + side});
      faces.push_back({i + 1, i + side + 1, i + side});
    }
    return folder.write("wave_" + std::to_string(k) + ".ply", ply_text(points, faces));
  }
  Words write_waves(int frames) const {
    Words paths;
    for (int k = 0; k < frames; ++k) paths.push_back(write_wave(k));
    return paths;
  }

  static Words joined(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  std::string shards() const { return folder.path("shards"); }
  std::string shard(int task) const { return shards() + "/task_00000" + std::to_string(task) + ".shard"; }

  Process whole(const Words& asked) const {
    return run_noli(
        joined({"verify", "--force", "--json", folder.path("one.json"), "--proof", folder.path("one.noli")}, asked));
  }
  Process part(const Words& asked, const std::string& which) const {
    return run_noli(joined({"verify", "--shard", which, "-o", shards()}, asked));
  }
  Process merge() const {
    return run_noli(
        {"merge", shards(), "--force", "--json", folder.path("all.json"), "--proof", folder.path("all.noli")});
  }

  static std::vector<Block> blocks_of(const std::string& file) {
    BlockReader reader(fs::path(file), four_letters("SHRD"));
    std::vector<Block> blocks;
    while (auto block = reader.next()) blocks.push_back(*block);
    return blocks;
  }
  /// With the right checksums.
  static void write_shard(const std::string& file, const std::vector<Block>& blocks) {
    fs::remove(file);
    BlockWriter writer(std::make_unique<FileSink>(file, FileSink::Open::create), four_letters("SHRD"));
    for (const Block& block : blocks) {
      block.kind == block_format::commit ? writer.commit() : writer.append(block.kind, block.payload);
    }
  }
  /// The head of a shard, as `change` changes it.
  static void change_head(const std::string& file, const std::function<void(nlohmann::ordered_json&)>& change) {
    std::vector<Block> blocks = blocks_of(file);
    auto head = nlohmann::ordered_json::parse(blocks[0].payload);
    change(head);
    blocks[0].payload = head.dump();
    write_shard(file, blocks);
  }

  /// The JSON without the clock and the name of the proof.
  Json answer(const std::string& name) const {
    Json json = Json::parse(bytes_of(folder.path(name)));
    json.erase("timing");
    if (json.contains("proof")) json["proof"].erase("file");
    return json;
  }

  void expect_same_answer(const Process& one, const Process& all) const {
    EXPECT_EQ(one.exit_code, all.exit_code) << all.out << all.err;
    EXPECT_EQ(one.verdict_line(), all.verdict_line());
    EXPECT_EQ(answer("one.json"), answer("all.json"));
    EXPECT_EQ(fs::exists(folder.path("one.noli")), fs::exists(folder.path("all.noli")));
    EXPECT_TRUE(bytes_of(folder.path("one.noli")) == bytes_of(folder.path("all.noli"))) << "the proofs differ";
  }

  Folder folder;
};

}  // namespace noli::app_tests
