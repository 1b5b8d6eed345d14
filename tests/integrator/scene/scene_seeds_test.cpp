// SPDX-License-Identifier: Apache-2.0
//
// Tests the seeds of the fuzz target of scenes, and scenes in which `noli fuzz scenes` found something. Each is read
// and explained as in the fuzz target, and must give a scene or the message listed with its name.
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

/// For each name: the beginning of the message after the file's name; "" for a valid scene.
using Ends = std::map<std::string, std::string>;

/// Reads input in the form of the fuzz target: 'S' or 'F' for the short or full form, then the text; or only the text.
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

/// Expects that the files of the folder and the names in the list are the same, and that each file ends as listed.
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
