// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli repair --run`: the motion between the new frames, as contact made it, is a run like any other.
#include <filesystem>
#include <set>

#include "tests/app/repair/repair_fixture.h"
#include "tests/app/runs/simulate_fixture.h"
#include "trajectory/blocks/run_file.h"

namespace noli::app_tests {
namespace {

/// The first lines of a text.
std::string lines_of(const std::string& text, std::size_t count) {
  std::size_t at = 0;
  for (std::size_t k = 0; k < count; ++k) at = text.find('\n', at) + 1;
  return text.substr(0, at);
}

class RepairRun : public Repair {
 protected:
  std::string run() const { return folder.path("run"); }
  std::string trajectory() const { return folder.path("run/trajectory.blocks"); }
  Words with_run(const Words& frames, const Words& more = {}) const {
    return repair(frames, Words{"--run", run()} + more);
  }
  std::vector<RunWindow> windows() const {
    std::vector<RunWindow> result;
    RunReader reader(run());
    while (auto window = reader.next_window()) result.push_back(std::move(*window));
    EXPECT_FALSE(reader.open_window());
    return result;
  }
  void refuses(const Words& words, const std::string& why) const {
    const Process process = run_noli(words);
    EXPECT_EQ(process.exit_code, 3) << process.out;
    EXPECT_NE(process.err.find(why), std::string::npos) << process.err;
  }

  const std::vector<double> heights = {1, 0.5, -0.5, -0.25, 1};
};

TEST_F(RepairRun, HasTheMotionOfEachStep) {
  const Json json = json_of(with_run(falling(heights)), 0);
  EXPECT_EQ(json["run"], run());
  const std::vector<RunWindow> steps = windows();
  ASSERT_EQ(steps.size(), heights.size() - 1);
  std::set<std::size_t> changed;
  for (const Json& step : json["changed"]) changed.insert(step["step"].get<std::size_t>() - 1);
  EXPECT_FALSE(changed.empty());
  EXPECT_LT(changed.size(), steps.size());
  for (std::size_t k = 0; k < steps.size(); ++k) {
    EXPECT_EQ(steps[k].begin, static_cast<double>(k));
    EXPECT_EQ(steps[k].end, static_cast<double>(k + 1));
    // What contact moved turns on its way; all else goes straight.
    EXPECT_EQ(steps[k].breakpoints > 2 * 6, changed.contains(k)) << k;
  }
}

TEST_F(RepairRun, MeetsTheNewFrames) {
  const Json json = json_of(with_run(falling(heights)), 0);
  const std::vector<RunWindow> steps = windows();
  std::size_t compared = 0;
  for (const Json& frame : json["outputs"]) {
    const auto time = frame["time"].get<double>();
    if (time == 0 || time != static_cast<double>(static_cast<std::size_t>(time))) continue;
    EXPECT_EQ(steps[static_cast<std::size_t>(time) - 1].positions, positions(frame["file"])) << time;
    ++compared;
  }
  EXPECT_EQ(compared, steps.size());
}

TEST_F(RepairRun, IsVerifiedAndCheckedLikeAnyRun) {
  ASSERT_EQ(run_noli(with_run(falling(heights))).exit_code, 0);
  const std::string proof = folder.path("run.noli");
  const Process verified = run_noli({"verify", run(), "--proof", proof});
  EXPECT_EQ(verified.exit_code, 0) << verified.err;
  EXPECT_TRUE(verified.verdict_line().starts_with("PROVED  4 windows, 4 s: nothing touches")) << verified.out;
  const Process checked = run_noli({"check", proof, run()});
  EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
}

TEST_F(RepairRun, KeepsWhatWasRepairedBeforeNoWayWasLeft) {
  const Json json = json_of(with_run(falling({1, 0.5, -0.5, 1}), {"--fixed-first", "6"}), 1);
  EXPECT_EQ(json["end"], "blocked");
  EXPECT_EQ(windows().size(), json["steps"]);
  const Json verified = json_of({"verify", run()}, 0);
  EXPECT_EQ(verified["run"]["end"], "blocked");
  EXPECT_EQ(verified["run"]["windows_total"], 3);
  EXPECT_EQ(verified["run"]["time"], json["steps"]);
  EXPECT_NE(run_noli({"verify", run()}).out.find("(fixed vertices meet in the next step)"), std::string::npos);
}

TEST_F(RepairRun, IsNotBegunByAStartThatTouches) {
  EXPECT_EQ(json_of(with_run(falling({0, 1})), 1)["run"], nullptr);
  EXPECT_FALSE(fs::exists(run()));
  EXPECT_FALSE(fs::exists(folder.path("out/times.csv")));
  // An older run stays, and is not said to be that of this repair.
  ASSERT_EQ(run_noli(with_run(falling({1, -0.5}))).exit_code, 0);
  const std::string before = read_text(trajectory());
  EXPECT_EQ(json_of(with_run(falling({0, 1}), {"--force"}), 1)["run"], nullptr);
  EXPECT_TRUE(read_text(trajectory()) == before);
}

TEST_F(RepairRun, NamesNeedNotBeUtf8) {
  const Words frames = falling({1, -0.5});
  const std::string name = folder.path("\xff.ply");
  fs::copy_file(frames[0], name);
  const Words words = with_run({name, frames[1]}, {"--order", "given"});
  EXPECT_EQ(run_noli(words).exit_code, 0);
  EXPECT_EQ(run_noli(words + Words{"--resume"}).exit_code, 0);
}

TEST_F(RepairRun, InThePlaneHasNoThirdCoordinate) {
  const auto flat = [&](const char* name, double x) {
    return folder.write(
        name, ply_text({{0, 0, 7}, {1, 0, 7}, {0, 1, 7}, {x, 0, 7}, {x + 1, 0, 7}, {x, 1, 7}}, {{0, 1, 2}, {3, 4, 5}}));
  };
  const Json json = json_of(with_run({flat("p_0.ply", 2), flat("p_1.ply", 0.5)}), 0);
  EXPECT_EQ(json["changed"].size(), 1u);
  EXPECT_EQ(RunReader(run()).header().dimension, 2u);
  const std::vector<RunWindow> steps = windows();
  const std::vector<Position> repaired = positions(out(json["frames"].get<std::size_t>() - 1));
  for (VertexId v = 0; v < 6; ++v) {
    EXPECT_EQ(steps.at(0).positions[v], (Position{repaired[v][0], repaired[v][1], 0})) << v;
    EXPECT_EQ(repaired[v][2], 7) << v;
  }
  EXPECT_EQ(run_noli({"verify", run()}).exit_code, 0);
}

TEST_F(RepairRun, LeavesOutGroupsThatMayPass) {
  // The third triangle sinks through the second, which it may, and onto the first, which it may not go through.
  const auto frame = [&](const char* name, double z) {
    return folder.write(
        name,
        ply_text(
            {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 1}, {4, 0, 1}, {0, 4, 1}, {1, 1, z}, {1.5, 1, z}, {1, 1.5, z}},
            {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}));
  };
  const std::string groups =
      folder.write("groups.json", R"({"groups": {"a": [3, 4, 5], "b": [6, 7, 8]}, "ignore": [["a", "b"]]})");
  const Json json = json_of(with_run({frame("g_0.ply", 2), frame("g_1.ply", -0.5)}, {"--ignore", groups}), 0);
  EXPECT_EQ(json["changed"].size(), 1u);
  EXPECT_EQ(json["notes"].dump().find("straight lines"), std::string::npos) << json["notes"];
  const RunWindow step = windows().at(0);
  EXPECT_GT(step.breakpoints, 2u * 9);
  EXPECT_LT(step.positions[6][2], 1);
  EXPECT_GT(step.positions[6][2], 0);
  const Process verified = run_noli({"verify", run()});
  EXPECT_EQ(verified.exit_code, 0) << verified.err;
  EXPECT_NE(verified.out.find("not compared"), std::string::npos) << verified.out;
}

TEST_F(RepairRun, ThreadsChangeNoByte) {
  const Words frames = falling({1, -0.5, -1, 0.25});
  std::set<std::string> bytes;
  for (const char* threads : {"1", "2", "5"}) {
    ASSERT_EQ(run_noli(with_run(frames, {"--threads", threads, "--force"})).exit_code, 0);
    bytes.insert(read_text(trajectory()));
  }
  EXPECT_EQ(bytes.size(), 1u);
}

/// As if it had been killed when so many rows of the table of frames were there. The run may be ahead of them.
TEST_F(RepairRun, WhatWasKilledResumesToTheSameBytes) {
  const Words frames = falling({1, 0.5, -0.5, -1, -0.5, 1});
  ASSERT_EQ(run_noli(with_run(frames)).exit_code, 0);
  const std::string whole = read_text(trajectory()), table = read_text(folder.path("out/times.csv"));
  std::size_t times = 0;
  for (std::size_t row = table.find('\n'); row != std::string::npos; row = table.find('\n', row + 1), ++times) {
    folder.write("out/times.csv", table.substr(0, row + 1));
    const Process process = run_noli(with_run(frames, {"--resume"}));
    ASSERT_EQ(process.exit_code, 0) << row << process.out << process.err;
    EXPECT_TRUE(read_text(trajectory()) == whole) << row;
    EXPECT_EQ(read_text(folder.path("out/times.csv")), table) << row;
  }
  EXPECT_GT(times, frames.size());
  EXPECT_EQ(run_noli({"verify", run()}).exit_code, 0);
}

class ResumedRun : public RepairRun, public testing::WithParamInterface<const char*> {
 protected:
  /// A repair into frames of this format.
  Words words(const Words& frames, const Words& more = {}) const {
    return Words{"repair", "-o", folder.path("out/%03d") + GetParam(), "--run", run()} + frames + more;
  }
};

/// As if it had been killed after each number of steps: with their rows, their lines in the log, and a part of the next
/// window.
TEST_P(ResumedRun, GoesOnFromEachStep) {
  const Words frames = falling({1, 0.5, -0.5, -1, -0.0, 1});
  ASSERT_EQ(run_noli(words(frames)).exit_code, 0);
  const std::string whole = read_text(trajectory()), log = read_text(folder.path("run/log.jsonl"));
  const std::string table = read_text(folder.path("out/times.csv"));
  const Json result = json_of(words(frames, {"--force"}), 0);
  for (std::size_t steps = 0; steps < 5; ++steps) {
    std::size_t rows = 0, window = whole.find("WIND");
    for (const Json& frame : result["outputs"]) rows += frame["time"] <= steps ? 1 : 0;
    for (std::size_t k = 0; k < steps; ++k) window = whole.find("WIND", window + 1);
    folder.write("out/times.csv", lines_of(table, 1 + rows));
    folder.write("run/log.jsonl", lines_of(log, 1 + steps));
    folder.write("run/trajectory.blocks", whole.substr(0, window + 40));
    const Process process = run_noli(words(frames, {"--resume"}));
    ASSERT_EQ(process.exit_code, 0) << steps << process.out << process.err;
    EXPECT_TRUE(read_text(trajectory()) == whole) << steps;
    EXPECT_EQ(read_text(folder.path("out/times.csv")), table) << steps;
  }
}
INSTANTIATE_TEST_SUITE_P(Formats, ResumedRun, testing::Values(".ply", ".obj", ".vtu"),
                         [](const auto& format) { return std::string(format.param + 1); });

TEST_F(RepairRun, AWindowWithoutItsLineIsLoggedWhenItIsTaken) {
  const Words frames = falling(heights);
  ASSERT_EQ(run_noli(with_run(frames)).exit_code, 0);
  const std::string whole = read_text(trajectory()), log = read_text(folder.path("run/log.jsonl"));
  const std::string table = read_text(folder.path("out/times.csv"));
  // Killed between the commit of the second window and its line in the log.
  folder.write("out/times.csv", lines_of(table, 3));
  folder.write("run/log.jsonl", lines_of(log, 2));
  const std::size_t second = whole.find("WIND", whole.find("WIND") + 1);
  folder.write("run/trajectory.blocks", whole.substr(0, whole.find("WIND", second + 1)));
  ASSERT_EQ(run_noli(with_run(frames, {"--resume"})).exit_code, 0);
  // Its line comes before any that the next windows get, so another stop then does no harm.
  const std::string resumed = read_text(folder.path("run/log.jsonl"));
  ASSERT_NE(resumed.find("\"window\":1"), std::string::npos);
  EXPECT_LT(resumed.find("\"window\":1"), resumed.find("resume")) << resumed;
  EXPECT_TRUE(read_text(trajectory()) == whole);
}

TEST_F(RepairRun, RunsThatLackStepsAreNotResumed) {
  const Words frames = falling(heights);
  ASSERT_EQ(run_noli(repair(frames)).exit_code, 0);
  refuses(with_run(frames, {"--resume"}), "is not the folder of a run");
  ASSERT_EQ(run_noli(with_run(frames, {"--force"})).exit_code, 0);
  const std::string whole = read_text(trajectory()), log = read_text(folder.path("run/log.jsonl"));
  folder.write("run/log.jsonl", lines_of(log, 2));
  const std::size_t second = whole.find("WIND", whole.find("WIND") + 1);
  const std::string first_alone = whole.substr(0, second - 8);
  folder.write("run/trajectory.blocks", first_alone);
  refuses(with_run(frames, {"--resume"}), "lacks steps of this repair");
  EXPECT_TRUE(read_text(trajectory()) == first_alone);
}

TEST_F(RepairRun, IsTakenForThisRepairByItsLogAlone) {
  const Words frames = falling({1, 0.5, -0.5, 1, 1.5});
  ASSERT_EQ(run_noli(with_run(frames)).exit_code, 0);
  const std::string other = folder.path("other");
  const Words words =
      Words{"repair", "-o", folder.path("others/%d.ply"), "--run", other, "--restitution", "0.9"} + frames;
  ASSERT_EQ(run_noli(words).exit_code, 0);
  // Both end at the same place, so the last window tells nothing.
  fs::copy_file(other + "/trajectory.blocks", trajectory(), fs::copy_options::overwrite_existing);
  refuses(with_run(frames, {"--resume"}), "trajectory.blocks");
  folder.write("run/log.jsonl", lines_of(read_text(folder.path("run/log.jsonl")), 1));
  refuses(with_run(frames, {"--resume"}), "lacks steps of this repair");
}

TEST_F(RepairRun, ARefusedRunLeavesTheFramesAlone) {
  const Words frames = falling(heights);
  ASSERT_EQ(run_noli(repair(frames)).exit_code, 0);
  const std::string table = read_text(folder.path("out/times.csv")), file = folder.write("file", "");
  refuses(repair(frames, {"--force", "--run", file + "/run"}), "--run");
  EXPECT_EQ(read_text(folder.path("out/times.csv")), table);
}

TEST_F(RepairRun, ResumeReplacesNoOtherRun) {
  ASSERT_EQ(run_noli(with_run(falling(heights))).exit_code, 0);
  const std::string before = read_text(trajectory());
  const Words others = falling({1, 0.5, -0.5, -0.25, 0.75});
  const Words elsewhere = {"repair", "-o", folder.path("new/%d.ply"), "--run", run(), "--resume"};
  refuses(elsewhere + others, "belongs to another repair");
  // Nor one whose manifest and log are lost, or a file of frames by that name.
  for (const char* name : {"manifest.json", "log.jsonl", "scene.json"}) fs::remove(folder.path("run") + "/" + name);
  const Words words = elsewhere + Words{others[0], others[2]};
  refuses(words, "has lost its manifest.json");
  EXPECT_TRUE(read_text(trajectory()) == before);
  const Words write = {"verify", "--no-check", "--trajectory", folder.path("trajectory.blocks"), others[0], others[1]};
  ASSERT_EQ(run_noli(write).exit_code, 0);
  fs::rename(folder.path("trajectory.blocks"), trajectory());
  refuses(words, "has lost its manifest.json");
  // What a repair leaves that is killed before its first window is replaced.
  folder.write("run/trajectory.blocks", before.substr(0, 14));
  EXPECT_EQ(run_noli(words).exit_code, 0);
}

TEST_F(RepairRun, HasAFolderOfItsOwn) {
  const Words frames = falling({1, -0.5});
  refuses(with_run(frames, {"--only-new"}), "--run: cannot be combined with --only-new");
  for (const char* name : {"out", "out/", "new/../out", "out/007.ply", "out/times.csv", "."}) {
    refuses(repair(frames, {"--run", folder.path(name)}), "the new frames go there; choose another folder");
  }
  fs::create_directory(run());
  folder.write("run/mine.txt", "mine");
  refuses(with_run(frames), "--run " + run() + ": exists already");
  refuses(with_run(frames, {"--force"}), "is not a run");
  refuses(with_run(frames, {"--json", folder.path("run/log.jsonl")}), "is a file of the run in that folder");
  EXPECT_FALSE(fs::exists(folder.path("out/000.ply")));
  EXPECT_FALSE(fs::exists(folder.path("out/times.csv")));
  EXPECT_EQ(read_text(folder.path("run/mine.txt")), "mine");
  fs::remove_all(run());
  // A file of frames may be called like the file of a run.
  ASSERT_EQ(
      run_noli(Words{"verify", "--no-check", "--trajectory", folder.path("trajectory.blocks")} + frames).exit_code, 1);
  fs::create_directory(run());
  fs::rename(folder.path("trajectory.blocks"), trajectory());
  const std::string before = read_text(trajectory());
  refuses(with_run({trajectory()}, {"--force"}), "is read; choose another folder");
  EXPECT_TRUE(read_text(trajectory()) == before);
  const std::string pins = folder.write("run/log.jsonl.part", "0 1 2\n");
  refuses(with_run(frames, {"--force", "--fixed-vertices", pins}), "is read; choose another folder");
  EXPECT_EQ(read_text(pins), "0 1 2\n");
  fs::create_symlink(trajectory(), folder.path("frames.blocks"));
  refuses(with_run({folder.path("frames.blocks")}, {"--force"}), "is read; choose another folder");
  EXPECT_TRUE(read_text(trajectory()) == before);
}

TEST_F(RepairRun, IsDescribedAndShown) {
  ASSERT_EQ(run_noli(with_run(falling(heights))).exit_code, 0);
  EXPECT_EQ(json_of({"info", run()}, 0)["files"][0]["windows"], heights.size() - 1);
  EXPECT_EQ(run_noli({"export", run(), "--fps", "2", "-o", folder.path("at/%02d.ply")}).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder.path("at/08.ply")));
  refuses({"explain", run()}, "a repair has no energies; expected a run of `noli simulate`");
  if (!reports_are_there()) return;
  const std::string page = folder.path("run.html");
  const Process reported = run_noli({"report", run(), "-o", page});
  EXPECT_EQ(reported.exit_code, 0) << reported.err;
  const std::string html = read_text(page);
  EXPECT_NE(html.find("Repair of in_0.ply"), std::string::npos);
  EXPECT_EQ(html.find("checks its proof"), std::string::npos);
}

}  // namespace
}  // namespace noli::app_tests
