// SPDX-License-Identifier: Apache-2.0
//
// Tests that the worked example of trajectory/FORMAT.md has the bytes that the writer produces.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <sstream>

#include "run_samples.h"
#include "support.h"

namespace noli {
namespace {

using namespace noli::testing;

/// The bytes of the lines "    OFFSET  BYTES  meaning". A wrong offset is a test failure.
std::string example_bytes(const std::string& document) {
  static const std::regex line_of_bytes(R"(    ([0-9a-f]{4})  (([0-9a-f]{2} ?)+)( .*)?)");
  std::string bytes;
  std::istringstream lines(document);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, line_of_bytes)) continue;
    EXPECT_EQ(std::stoul(match[1], nullptr, 16), bytes.size()) << line;
    std::istringstream words(match[2]);
    for (std::string word; words >> word;) bytes += static_cast<char>(std::stoul(word, nullptr, 16));
  }
  return bytes;
}

RunScene example_scene() {
  RunScene scene;
  scene.header = {.dimension = 2, .record = RecordMode::full, .window_length = 0.5};
  scene.mesh.vertex_count = 2;
  scene.mesh.edges = {{0, 1}};
  scene.labels = {scripted_vertex, 0};
  return scene;
}

std::string written_example() {
  MemoryFile file;
  RunWriter writer(sink_to(file), example_scene());
  const WorldLines lines = WorldLines::from_breakpoints(
      {0, 2, 5}, {0, 0.5, 0, 0.25, 0.5}, {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, -0.5, 0}, {1, -1.5, 0}}, "example");
  const std::vector<Position> velocities{{0, 0, 0}, {0, -5, 0}};
  writer.append_window({.index = 0, .lines = lines, .velocities = velocities, .state = "abc"});
  writer.commit();
  return file.bytes;
}

TEST(FormatDocument, ItsExampleIsWhatTheWriterWrites) {
  const std::string document = test::read_text(std::filesystem::path(NOLI_SOURCE_DIR) / "trajectory" / "FORMAT.md");
  EXPECT_EQ(example_bytes(document), written_example());
  EXPECT_EQ(written_example().size(), 0x225u);
}

}  // namespace
}  // namespace noli
