// SPDX-License-Identifier: Apache-2.0
//
// Motions for the tests of `noli repair`, and what it wrote.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/app/audits/libraries.h"
#include "tests/app/process.h"
#include "tests/app/scene.h"
#include "trajectory/formats/frames.h"

namespace noli::app_tests {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class Repair : public testing::Test {
 protected:
  /// The upper triangle of two_triangles() at these heights, a frame for each.
  Words falling(const std::vector<double>& heights) const {
    Words frames;
    for (std::size_t k = 0; k < heights.size(); ++k) {
      frames.push_back(folder.write(fmt::format("in_{}.ply", k), two_triangles(heights[k])));
    }
    return frames;
  }
  std::string pattern() const { return folder.path("out/%03d.ply"); }
  std::string out(std::size_t k) const { return folder.path(fmt::format("out/{:03}.ply", k)); }
  Words repair(const Words& frames, const Words& more = {}) const {
    Words words = {"repair", "-o", pattern()};
    words.insert(words.end(), frames.begin(), frames.end());
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  Process verify_out() const { return run_noli({"verify", folder.path("out")}); }
  static std::vector<Position> positions(const std::string& file) { return read_frame(file).positions; }

  Folder folder;
};

}  // namespace noli::app_tests
