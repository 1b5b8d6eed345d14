// SPDX-License-Identifier: Apache-2.0
//
// What the fuzz target of scenes begins with: its seeds, and scenes in which `noli fuzz scenes` found something. Each
// is read and explained here as it is there, and ends as is written beside its name: in a scene, or in one message.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include <noli/errors.h>
#include "integrator/scene/explain.h"
#include "integrator/scene/read_scene.h"
#include "trajectory/text.h"

namespace noli::integrator {
namespace {

namespace fs = std::filesystem;

/// By name: how the message begins behind the file's name; "" for a scene.
using Ends = std::map<std::string, std::string>;

/// As the fuzz target takes it: 'S' or 'F' for the short or full form and then the text, or the text alone.
std::string end_of(const std::string& input) {
  const bool has_form = input.starts_with('S') || input.starts_with('F');
  try {
    const Scene scene = parse_scene(std::string_view(input).substr(has_form ? 1 : 0), "input",
                                    input.starts_with('S') ? Form::brief : Form::full);
    EXPECT_EQ(explain(scene).bodies.size(), scene.bodies.size());
    return "";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_TRUE(message.starts_with("input: ")) << message;
    return message.substr(message.find(": ") + 2);
  }
}

/// Each file of the folder has its end in the list, and each of the list its file.
void expect_ends(const std::string& seeds, Ends ends) {
  for (const auto& file : fs::directory_iterator(fs::path(NOLI_SOURCE_DIR) / seeds)) {
    if (!file.is_regular_file()) continue;
    const std::string name = file.path().filename();
    const auto expected = ends.find(name);
    ASSERT_NE(expected, ends.end()) << file.path() << ": its end is not in the list";
    const std::string end = end_of(read_whole_file(file.path()));
    EXPECT_TRUE(expected->second.empty() ? end.empty() : end.starts_with(expected->second)) << name << ": " << end;
    ends.erase(expected);
  }
  for (const auto& [name, end] : ends) ADD_FAILURE() << seeds << '/' << name << " is not there";
}

TEST(SceneSeeds, EndAsExpected) {
  expect_ends("tests/fuzz/seeds/scene", {{"chain", ""},
                                         {"contact", ""},
                                         {"deep", "/0/0/0/0/0/0/0/0/0/0/"},
                                         {"disc", ""},
                                         {"friction", ""},
                                         {"names_a_file", "/bodies/0/mesh/file: expected a mesh that loads"},
                                         {"ribbon", ""},
                                         {"ring", ""},
                                         {"sheet", ""},
                                         {"short", ""},
                                         {"solid", ""},
                                         {"truncated", "line 1, column 29: is not JSON"}});
}

TEST(SceneSeeds, ScenesThatWereFoundEndAsExpected) {
  expect_ends("tests/audit/scenes/found", {{"layers_in_advance.json", ""},
                                           {"lengths_of_1e-76.json", "/contact/thickness: expected at least 1e-70"},
                                           {"lengths_of_1e85.json", "/contact/thickness: expected at least 1e-70"},
                                           {"many_breakpoints.json", ""}});
}

TEST(SceneSeeds, ScenesOfTheAuditEndAsExpected) {
  expect_ends("tests/audit/scenes", {{"fall.json", ""}, {"wrong.json", "/bodies/0/mesh/ring/radius: "}});
}

}  // namespace
}  // namespace noli::integrator
