// SPDX-License-Identifier: Apache-2.0
//
// Tests the output and exit codes of `noli audit precision`. tests/audit/precision_test.cpp tests the measurements.
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>

#include "tests/app/process.h"
#include "tests/app/scene.h"
#include "tests/app/worked_example.h"

namespace noli::app_tests {
namespace {

using Json = nlohmann::json;

std::string scene(const std::string& name) { return std::string(NOLI_SOURCE_DIR) + "/scenes/" + name + ".json"; }

std::vector<std::string> command(const std::string& name, const std::vector<std::string>& more) {
  std::vector<std::string> words = {"audit", "precision", scene(name), "--short"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::size_t count(const std::string& text, const std::string& words) {
  std::size_t n = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++n;
  return n;
}

TEST(AuditPrecision, SaysThatFiftyThreeBitsAreDouble) {
  const Json document = json_of(command("bounce", {"--until", "1", "--bits", "256,113"}), 0);
  EXPECT_EQ(document["verdict"], "same");
  EXPECT_EQ(document["difference"], nullptr);
  EXPECT_EQ(document["windows"], 20);
  ASSERT_EQ(document["runs"].size(), 3u);
  EXPECT_EQ(document["runs"][0]["bits"], 53);
  EXPECT_EQ(document["runs"][0]["binary64"], true);
  EXPECT_EQ(document["runs"][1]["bits"], 113);
  EXPECT_EQ(document["runs"][2]["bits"], 256);
  EXPECT_GT(document["impulses"], 100);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(document["runs"][0]["windows"][i]["position"], 0);
    EXPECT_EQ(document["runs"][2]["windows"][i]["time"], document["energies"][i]["time"]);
  }
  EXPECT_GT(document["runs"][2]["greatest_position"], 1e-17);
  EXPECT_LT(document["runs"][2]["greatest_position"], 1e-12);
  const Json& last = document["energies"].back();
  EXPECT_GT(std::abs(last["truncation"].get<double>()), 1e6 * std::abs(last["rounding"].get<double>()));
  EXPECT_GT(document["timing"]["seconds"], 0);
}

TEST(AuditPrecision, GivesTheSameBytesWithAnyNumberOfThreads) {
  const auto run = [](const std::string& threads) {
    return without_timing(json_of(command("hanging_chain", {"--until", "0.06", "--threads", threads}), 0));
  };
  EXPECT_EQ(run("1"), run("3"));
}

TEST(AuditPrecision, DrawsAPicture) {
  const Folder folder;
  const std::string svg = folder.path("out.svg");
  const Process process =
      run_noli(command("bounce", {"--until", "1", "--bits", "64,128", "--svg", svg, "--json", folder.path("o.json")}));
  EXPECT_EQ(process.exit_code, 0) << process.err;
  const std::string picture = read_text(svg);
  EXPECT_EQ(count(picture, "<svg "), 1u);
  for (const char* const panel : {"position, greatest [m]", "energy [J]", "momentum [N s]", "angular mom. [N m s]",
                                  "energy error [J]", ">truncation<", ">rounding<"}) {
    EXPECT_EQ(count(picture, panel), 1u) << panel;
  }
  EXPECT_EQ(count(picture, ">double - 64 bits<"), 3u) << "position, energy and momentum drift";
  EXPECT_EQ(count(picture, ">double - 128 bits<"), 3u);
  EXPECT_EQ(count(picture, ">double - 128 bits: 0<"), 1u) << "it drops straight: no angular momentum";
  EXPECT_EQ(count(picture, "<polyline "), 8u) << "a curve for each that is not 0, truncation and rounding";
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"o.json", "out.svg"}));
}

TEST(AuditPrecision, DrawsAngularMomentumWhereThereIsSome) {
  const Folder folder;
  const std::string svg = folder.path("out.svg");
  const Process process = run_noli(command("hanging_chain", {"--until", "0.06", "--bits", "256", "--svg", svg}));
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_EQ(count(read_text(svg), ">double - 256 bits<"), 4u);
}

TEST(AuditPrecision, RefusesWhatItCannotDo) {
  for (const char* const bits : {"23", "1025", "x", "53,0x100", "", "-256"}) {
    EXPECT_EQ(run_noli(command("bounce", {"--until", "1", "--bits", bits})).exit_code, 3) << bits;
  }
  const Process none = run_noli(command("bounce", {"--bits", "53,24"}));
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_NE(none.err.find("expected at least one precision above 53"), std::string::npos) << none.err;
  EXPECT_EQ(none.out, "");
  EXPECT_EQ(run_noli({"audit", "precision", "absent.json"}).exit_code, 3);
  EXPECT_EQ(run_noli(command("bounce", {"--until", "0"})).exit_code, 3);
  EXPECT_EQ(run_noli(command("bounce", {"--until", "1e300"})).exit_code, 3);
  EXPECT_EQ(run_noli(command("bounce", {"--svg", "/nowhere/at/all.svg"})).exit_code, 3);
  EXPECT_EQ(run_noli(command("bounce", {"--svg", scene("bounce")})).exit_code, 3);
}

TEST(AuditPrecision, StopsWhenItsTimeIsOver) {
  const Process process = run_noli({"audit", "precision", scene("swinging_cloth"), "--time-limit", "1s"});
  EXPECT_EQ(process.exit_code, 2) << process.err;
  EXPECT_EQ(process.verdict_line().rfind("UNDECIDED ", 0), 0u) << process.out;
}

TEST(AuditPrecision, KeepsWhatItHasWhenInterrupted) {
  ProcessOptions options;
  options.signal = SIGINT;
  options.signal_after = std::chrono::milliseconds(500);
  const Process process = run_noli({"audit", "precision", scene("bounce"), "--threads", "1"}, options);
  EXPECT_EQ(process.exit_code, 2) << process.err;
  EXPECT_EQ(process.verdict_line().rfind("UNDECIDED  windows ", 0), 0u) << process.out;
  EXPECT_NE(process.verdict_line().find("complete false"), std::string::npos) << process.out;
}

TEST(AuditPrecision, TheWorkedExampleIsTrue) {
  const Folder folder;
  const auto commands = worked_example("docs/audit/precision.md", "## A worked example");
  ASSERT_EQ(commands.size(), 2u);
  expect_worked_example(commands,
                        {{"build/release/app/noli", NOLI_COMMAND}, {"build/bounce.svg", folder.path("b.svg")}});
  EXPECT_NE(read_text(folder.path("b.svg")).find("Bounce"), std::string::npos);
}

}  // namespace
}  // namespace noli::app_tests
