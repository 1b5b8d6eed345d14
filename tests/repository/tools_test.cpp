// SPDX-License-Identifier: Apache-2.0
//
// Tests the small programs of scripts/ together with the command they are made for.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "workspace.h"

namespace noli::repository {
namespace {

CommandResult verify_generated(const std::string& kind) {
  const TemporaryFolder folder;
  const std::string where = quoted(folder.path().string());
  EXPECT_EQ(run(quoted(NOLI_DEMO_FRAMES) + " " + kind + " 20 " + where).exit_code, 0);
  return run(quoted(NOLI_COMMAND) + " verify " + where + "/0?.ply 2>/dev/null");
}

TEST(DemoFrames, TheCleanSequenceIsClean) {
  const auto [exit_code, output] = verify_generated("clean");
  EXPECT_EQ(exit_code, 0) << output;
  EXPECT_TRUE(output.find("\nPROVED ") != std::string::npos) << output;
}

TEST(DemoFrames, TheOtherTouchesBetweenFramesThreeAndFour) {
  const auto [exit_code, output] = verify_generated("contact");
  EXPECT_EQ(exit_code, 1) << output;
  EXPECT_TRUE(output.find("\nCONTACT ") != std::string::npos) << output;
  EXPECT_NE(output.find("step 4 ("), std::string::npos) << output;
}

TEST(DemoFrames, RefusesWhatItDoesNotKnow) {
  for (const char* arguments : {"", "both 20 .", "clean 0 .", "clean 20x .", "clean 20"}) {
    EXPECT_EQ(run(quoted(NOLI_DEMO_FRAMES) + " " + arguments + " 2>/dev/null").exit_code, 3) << arguments;
  }
  EXPECT_EQ(run(quoted(NOLI_DEMO_FRAMES) + " clean 20 no/such/folder 2>/dev/null").exit_code, 4);
}

CommandResult json_without(const std::string& text, const std::string& keys) {
  const TemporaryFolder folder;
  write_file(folder.path() / "in.json", text);
  return run(quoted(NOLI_JSON_WITHOUT) + " " + quoted((folder.path() / "in.json").string()) + " " + keys +
             " 2>/dev/null");
}

TEST(JsonWithout, RemovesMembersAtAnyDepthAndKeepsTheOrderOfTheRest) {
  const auto [exit_code, output] = json_without(R"({"b": 1, "timing": 2, "a": [{"timing": {}, "c": 3}]})", "timing");
  EXPECT_EQ(exit_code, 0);
  EXPECT_EQ(output, "{\n \"b\": 1,\n \"a\": [\n  {\n   \"c\": 3\n  }\n ]\n}\n");
}

TEST(JsonWithout, RemovesNothingUnasked) {
  EXPECT_EQ(json_without(R"({"timing": 2})", "").output, "{\n \"timing\": 2\n}\n");
}

TEST(JsonWithout, RefusesWhatIsNotJson) {
  EXPECT_EQ(json_without(R"({"timing": )", "timing").exit_code, 3);
  EXPECT_EQ(run(quoted(NOLI_JSON_WITHOUT) + " no_such.json 2>/dev/null").exit_code, 3);
}

}  // namespace
}  // namespace noli::repository
