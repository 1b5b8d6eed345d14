// SPDX-License-Identifier: Apache-2.0
//
// Tests that windows count from 1 wherever users read or type a number, even if files count from 0.
#include <gtest/gtest.h>

#include "tests/app/runs/simulate_fixture.h"
#include "tests/support/temporary_folder.h"
#include "trajectory/blocks/run_file.h"

namespace noli::app_tests {
namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(Simulate, WindowsCountFromOneInEveryCommand) {
  const std::string file = scene(falling_triangle()), run = run_path("run");
  // 39 windows are complete; the contact is in the next one.
  const Json json = json_of({"simulate", file, "-o", run}, 1);
  EXPECT_EQ(json["windows"], 39);
  EXPECT_EQ(json["first"]["window"], 40);
  const Process told = run_noli({"simulate", file, "-o", run, "--force"});
  EXPECT_TRUE(contains(told.out, "Contact in window 40: ")) << told.out;

  const auto again = [&](const std::string& window) {
    return run_noli(
        {"simulate", file, "--reproduce", run, "--window", window, "-o", run_path("again.block"), "--force"});
  };
  for (const char* window : {"1", "39"}) {
    const Process same = again(window);
    EXPECT_EQ(same.exit_code, 0) << same.err;
    EXPECT_TRUE(contains(same.out, std::string(" window ") + window)) << same.out;
  }
  EXPECT_EQ(
      json_of({"simulate", file, "--reproduce", run, "--window", "39", "-o", run_path("last.block")}, 0)["window"], 39);
  EXPECT_TRUE(contains(again("0").err, "--window: 0: expected a whole number from 1")) << again("0").err;
  EXPECT_TRUE(contains(again("40").err, "has 39 windows, counted from 1; expected one of them, found 40"));
  // The first one begins where the scene does.
  ASSERT_EQ(again("1").exit_code, 0);
  const std::string block = bytes_of(run_path("again.block"));
  RunReader reader(run);
  std::string first;
  put_lines_block(3, *reader.next_window()->lines, [&](std::string_view bytes) { first += bytes; });
  EXPECT_TRUE(block == first);

  const Json verified = json_of({"verify", run}, 0);
  EXPECT_EQ(verified["steps"], 39);
  EXPECT_EQ(verified["steps_total"], 39);
  EXPECT_EQ(verified["run"]["windows_total"], 128);
  EXPECT_EQ(json_of({"info", run}, 0)["files"][0]["windows"], 39);
  EXPECT_EQ(json_of({"explain", run}, 0)["windows"], 39);
}

TEST_F(Simulate, ExplainNamesWindowsFromOne) {
  const std::string file = scene(two_cloths()), run = run_path("run");
  ASSERT_EQ(run_noli({"simulate", file, "-o", run}).exit_code, 0);
  const Json json = json_of({"explain", run}, 0);
  const double length = 0.01;
  for (const char* moment : {"deepest", "nearest"}) {
    const double time = json[moment]["time"], window = json[moment]["window"];
    EXPECT_GE(time, (window - 1) * length * (1 - 1e-9)) << moment;
    EXPECT_LE(time, window * length * (1 + 1e-9)) << moment;
  }
  for (const Json& worst : json["layer_cap"]["worst"]) {
    EXPECT_GE(worst["window"].get<int>(), 1);
    EXPECT_LE(worst["window"].get<int>(), 20);
    EXPECT_LE(worst["time"].get<double>(), worst["window"].get<double>() * length * (1 + 1e-9));
  }
  const std::string text = run_noli({"explain", run}).out;
  EXPECT_TRUE(contains(text, "(window " + json["deepest"]["window"].dump() + ")")) << text;
  EXPECT_FALSE(contains(text, "(window 0)")) << text;
}

TEST_F(Simulate, PairsThatAreTooNearAreNamedWithTheirWindow) {
  Json json = {{"noli_scene", 1}, {"dimension", 2}, {"duration", 1}, {"window", 0.01}};
  json["bodies"] = Json::parse(R"([
      {"name": "floor", "mesh": {"chain": {"points": [[-1, 0], [1, 0]], "segments": 1}}, "pin": ["all"],
       "material": {"edge_stiffness": 0, "mass_per_length": 1}},
      {"name": "point", "mesh": {"points": {"at": [[0.1, 0.0078125]]}},
       "material": {"edge_stiffness": 0, "mass_per_vertex": 1}}])");
  json["contact"] = {{"thickness", 0.1}, {"stiffness", 100}, {"most_layers", 16}};
  EXPECT_EQ(json_of({"simulate", scene(json), "-o", run_path("run")}, 1)["too_near"]["window"], 1);
}

TEST_F(Simulate, NumbersRunOutInAWindowThatIsNamed) {
  const Json json = Json::parse(R"({
      "noli_scene": 1, "dimension": 2, "duration": 1000, "window": 0.01, "allow_unstable": true,
      "bodies": [{"name": "pair", "mesh": {"chain": {"points": [[0, 0], [1, 0]], "segments": 1}},
                  "material": {"edge_stiffness": 1e6, "mass_per_vertex": 1}, "velocity": [0, 0], "spin": 1,
                  "steps": {"stretch": 0.01}}]})");
  const Json blown = json_of({"simulate", scene(json), "-o", run_path("run")}, 1);
  ASSERT_EQ(blown["verdict"], "not_finite");
  EXPECT_EQ(blown["not_finite"]["window"].get<std::uint64_t>(), blown["windows"].get<std::uint64_t>() + 1);
  const Process told = run_noli({"simulate", scene(json), "-o", run_path("run"), "--force"});
  EXPECT_TRUE(contains(told.out, "Not finite in window " + blown["not_finite"]["window"].dump() + ":")) << told.out;
}

TEST_F(Simulate, VerifyKnowsHowManyWindowsTheSceneAsksFor) {
  const std::string file = scene(hanging_sheet()), run = run_path("run");
  ASSERT_EQ(run_noli({"simulate", file, "-o", run, "--until", "0.05"}).exit_code, 0);
  const Json part = json_of({"verify", run}, 0);
  EXPECT_EQ(part["steps"], 5);
  EXPECT_EQ(part["steps_total"], 5);
  EXPECT_EQ(part["run"]["windows_total"], 25);
  const auto pairs_and_junit = [&] {
    const std::string junit = run_path("noli.xml");
    const std::string pairs = run_noli({"verify", run, "--porcelain", "--junit", junit, "--force"}).out;
    return std::pair(pairs, test::read_text(junit));
  };
  const auto [pairs, junit] = pairs_and_junit();
  EXPECT_TRUE(contains(pairs, " run.time=0.05 run.duration=0.25 run.windows_total=25\n")) << pairs;
  EXPECT_TRUE(contains(junit, "<property name=\"answer\" value=\"5 of 25 windows, 0.05 of 0.25 s: ")) << junit;
  ASSERT_EQ(run_noli({"simulate", file, "-o", run, "--resume"}).exit_code, 0);
  EXPECT_EQ(json_of({"verify", run}, 0)["steps"], 25);
  const auto [whole_pairs, whole_junit] = pairs_and_junit();
  EXPECT_TRUE(contains(whole_pairs, " run.end=done run.time=0.25 run.duration=0.25 run.windows_total=25\n"))
      << whole_pairs;
  EXPECT_TRUE(contains(whole_junit, "<property name=\"answer\" value=\"25 windows, 0.25 s: ")) << whole_junit;
  fs::remove(run_path("run/scene.json"));
  EXPECT_EQ(json_of({"verify", run}, 0)["run"]["windows_total"], nullptr);
}

TEST_F(Simulate, ExplainPredictsAsManyWindowsAsARunHas) {
  Json json = beam(0.07);  // 0.07 / 0.01 is a little more than 7
  json["window"] = 0.01;
  const std::string file = scene(json);
  EXPECT_EQ(json_of({"explain", file}, 0)["windows"], 7);
  EXPECT_EQ(json_of({"simulate", file, "-o", run_path("run")}, 0)["windows"], 7);
}

// --- Windows that end early ------------------------------------------------------------------------------------------

TEST_F(Simulate, AWindowWithTooManyBreakpointsEndsEarly) {
  Json json = two_cloths();
  const std::string unbounded = run_path("unbounded"), run = run_path("run"), parts = run_path("parts");
  ASSERT_EQ(json_of({"simulate", scene(json), "-o", unbounded}, 0)["windows"], 20);
  const std::uint64_t there = json_of({"info", unbounded}, 0)["files"][0]["most_breakpoints_in_a_window"];
  const std::uint64_t most = there / 6;
  json["most_breakpoints"] = most;
  const std::string file = scene(json);
  const Json whole = json_of({"simulate", file, "-o", run}, 0);
  EXPECT_GT(whole["windows"], 40);
  EXPECT_EQ(whole["windows"], whole["windows_total"]);
  EXPECT_EQ(whole["time"], 0.2);
  const Json info = json_of({"info", run}, 0)["files"][0];
  // A window includes the events at its last time, and an end for each vertex.
  EXPECT_LT(info["most_breakpoints_in_a_window"], most + 3 * info["vertices"].get<std::uint64_t>());
  EXPECT_EQ(info["end_time"], 0.2);
  EXPECT_EQ(info["windows"], whole["windows"]);

  const Json verified = json_of({"verify", run}, 0);
  EXPECT_EQ(verified["steps"], whole["windows"]);
  EXPECT_EQ(verified["run"]["windows_total"], whole["windows"]);
  EXPECT_EQ(verified["run"]["time"], 0.2);
  EXPECT_EQ(run_noli({"check", run}).exit_code, 0);
  EXPECT_EQ(json_of({"explain", run}, 0)["windows"], whole["windows"]);

  ASSERT_EQ(run_noli({"simulate", file, "-o", parts, "--until", "0.13"}).exit_code, 0);
  const Json part = json_of({"verify", parts}, 0);
  EXPECT_EQ(part["run"]["time"], 0.13);
  EXPECT_EQ(part["run"]["windows_total"], part["steps"].get<int>() + 7);
  ASSERT_EQ(run_noli({"simulate", file, "-o", parts, "--resume"}).exit_code, 0);
  EXPECT_TRUE(blocks("parts") == blocks("run"));
}

TEST_F(Simulate, HowManyWindowsAreToComeIsALeastNumberWhereSomeEndEarly) {
  Json json = hanging_sheet();
  json["most_breakpoints"] = 300;
  const std::string file = scene(json), run = run_path("run");
  const Process part = run_noli({"simulate", file, "-o", run, "--until", "0.05"});
  EXPECT_EQ(part.exit_code, 0);
  EXPECT_FALSE(contains(part.verdict_line(), "at least")) << part.verdict_line();
  EXPECT_TRUE(contains(run_noli({"verify", run}).verdict_line(), " of at least ")) << run_noli({"verify", run}).out;
  EXPECT_FALSE(contains(part.out, "windows of 0.01 s")) << part.out;
}

TEST_F(Simulate, WindowsThatEndedEarlyAreMadeAgain) {
  Json json = hanging_sheet();
  json["most_breakpoints"] = 300;
  json["record"] = "frames";
  const std::string file = scene(json), run = run_path("run");
  const Json simulated = json_of({"simulate", file, "-o", run}, 0);
  ASSERT_GT(simulated["windows"], 50);
  EXPECT_EQ(json_of({"verify", run, "--reproduce"}, 0)["steps"], simulated["windows"]);
  EXPECT_EQ(json_of({"info", run}, 0)["files"][0]["frames"], 16);  // 0.25 s at 60 a second, and the first
  EXPECT_EQ(run_noli({"simulate", file, "--reproduce", run, "--window", "40", "-o", run_path("again.block")}).exit_code,
            0);
}

// --- The requested end -----------------------------------------------------------------------------------------------

TEST_F(Simulate, UntilBeyondTheDurationHasToBeMeant) {
  const std::string file = scene(hanging_sheet()), run = run_path("run");  // 0.25 s in 25 windows
  const Process beyond = run_noli({"simulate", file, "-o", run, "--until", "0.5"});
  EXPECT_EQ(beyond.exit_code, 3);
  EXPECT_TRUE(contains(beyond.err, "--until 0.5: ")) << beyond.err;
  EXPECT_TRUE(contains(beyond.err, "has a duration of 0.25 s; expected no later time, or --past-duration"))
      << beyond.err;
  EXPECT_FALSE(fs::exists(run));
  EXPECT_EQ(run_noli({"simulate", file, "-o", run, "--past-duration"}).exit_code, 3);
  // The end itself is not beyond.
  EXPECT_EQ(json_of({"simulate", file, "-o", run, "--until", "0.25"}, 0)["windows"], 25);
  const std::vector<std::string> longer = {"simulate", file, "-o", run, "--until", "0.3", "--resume"};
  EXPECT_EQ(run_noli(longer).exit_code, 3);
  auto meant = longer;
  meant.emplace_back("--past-duration");
  EXPECT_EQ(json_of(meant, 0)["windows"], 30);
  EXPECT_EQ(json_of({"verify", run}, 0)["verdict"], "proved");
}

TEST_F(Simulate, AuditsOfPrecisionStopAtTheDurationToo) {
  const std::string file = scene(resting_bar(0.5, 0.25));
  const auto audit = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"audit", "precision", file, "--bits", "64", "--until", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return run_noli(words);
  };
  EXPECT_EQ(audit({}).exit_code, 3);
  EXPECT_TRUE(contains(audit({}).err, "--past-duration")) << audit({}).err;
  EXPECT_EQ(audit({"--past-duration"}).exit_code, 0);
}

// --- The actual end --------------------------------------------------------------------------------------------------

/// The verdict follows from the committed windows, whenever the stop came. Before the run has begun, only the reason of
/// the stop is reported.
void expect_done_or_undecided(const Process& process) {
  if (process.out.empty()) {
    EXPECT_EQ(process.exit_code, 2) << process.err;
    EXPECT_TRUE(contains(process.err, "the time limit has passed") || contains(process.err, "interrupted"))
        << process.err;
    return;
  }
  const Json json = Json::parse(process.out);
  const bool whole = json["windows"] == json["windows_total"];
  EXPECT_EQ(process.exit_code, whole ? 0 : 2) << process.out;
  EXPECT_EQ(json["verdict"], whole ? "no_contact" : "undecided");
  EXPECT_EQ(json["end"] == "done", whole) << json["end"];
}

TEST_F(Simulate, ARunWithAllItsWindowsIsDoneWheneverItIsStopped) {
  const std::string file = scene(hanging_sheet());
  bool seen[2] = {false, false};
  for (int i = 0; i < 67; ++i) {
    const int limit = i < 60 ? 1 + 5 * i : 1 << (i - 50);  // a busy machine needs more
    const Process limited = run_noli({"simulate", file, "-o", run_path("run"), "--force", "--json", "-", "--time-limit",
                                      std::to_string(limit) + "ms"});
    expect_done_or_undecided(limited);
    seen[limited.exit_code == 0] = true;
    if (limited.exit_code == 0 && i % 3 == 0) break;
  }
  EXPECT_TRUE(seen[0]);
  EXPECT_TRUE(seen[1]);
  for (int i = 0; i < 20; ++i) {
    const Process process =
        run_noli({"simulate", file, "-o", run_path("run"), "--force", "--json", "-"}, interrupt_after(10 * i));
    if (process.exit_code >= 0) expect_done_or_undecided(process);
  }
}

}  // namespace
}  // namespace noli::app_tests
