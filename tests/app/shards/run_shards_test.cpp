// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli verify RUN --shard` and `noli merge`: the answer of all shards is that of one process, byte for byte,
// also of a run that is still being written, or that recorded only frames.
#include "tests/app/runs/wild_run.h"
#include "tests/app/shards/shards_fixture.h"

#include <thread>

#include "certify/shards/shards.h"
#include "trajectory/blocks/folder_lock.h"

namespace noli::app_tests {
namespace {

class RunShards : public Shards {
 protected:
  std::string run_path() const { return folder.path("run"); }
  /// Removes what was there before.
  void write_run(unsigned seed, int windows, double apart) const {
    fs::remove_all(run_path());
    WildRun(seed, seed % 4 == 3 ? 2 : 3, apart).write(run_path(), windows);
  }
  void simulate(const Json& scene, const Words& more = {}) const {
    const std::string file = folder.write("scene.json", scene.dump());
    const Process process = run_noli(joined({"simulate", file, "-o", run_path()}, more));
    ASSERT_EQ(process.exit_code, 0) << process.err;
  }
  /// A simulation of 50 windows.
  static Json swinging_beam(const char* record = "full") {
    Json scene = beam(0.5);
    scene["window"] = 0.01;
    scene["record"] = record;
    return scene;
  }
  /// Verifies the run in three parts and compares with one process. Returns the exit code.
  int compare(const Words& options) const {
    fs::remove_all(shards());
    const Words asked = joined({run_path()}, options);
    const Process one = whole(asked);
    EXPECT_LE(one.exit_code, 1) << one.out << one.err;
    for (const char* which : {"2/3", "3/3", "1/3"}) {
      const Process process = part(asked, which);
      EXPECT_LE(process.exit_code, 1) << process.out << process.err;
    }
    expect_same_answer(one, merge());
    return one.exit_code;
  }
  /// The run, except that all vertices begin elsewhere.
  void write_with_another_beginning() const {
    std::vector<RunWindow> windows;
    RunReader reader(run_path());
    while (auto window = reader.next_window()) windows.push_back(std::move(*window));
    const RunScene scene = reader.scene();
    fs::remove_all(run_path());
    fs::create_directory(run_path());
    RunWriter writer(run_path(), scene);
    for (const RunWindow& window : windows) {
      WorldLines lines = *window.lines;
      if (window.index == 0) {
        std::vector<Position> elsewhere = window.positions;
        for (Position& x : elsewhere) x = {1.5 * x[0], 1.5 * x[1], 1.5 * x[2]};  // nothing touches on the way
        lines = WorldLines::from_frames(elsewhere, window.positions);
      }
      writer.append_window({window.index, lines, window.velocities, window.state, {}});
      writer.commit();
    }
  }
  std::string refusal(const Words& words) const {
    const Process process = run_noli(words);
    EXPECT_EQ(process.exit_code, 3) << process.out;
    return process.err;
  }
};

TEST_F(RunShards, OfWildRunsHaveTheAnswerOfOneProcess) {
  const std::vector<Words> questions = {{},
                                        {"--keep-going"},
                                        {"--min-distance", "0.125"},
                                        {"--keep-going", "--min-distance", "0.125"},
                                        {"--keep-going", "--max-reports", "3"},
                                        {"--first-only"},
                                        {"--strict", "--keep-going"}};
  int touched = 0, apart = 0;
  const std::uint64_t count = trials(14, 140);
  for (std::uint64_t i = 0; i < count; ++i) {
    write_run(static_cast<unsigned>(i), 36, 1.5 + static_cast<double>(i % 5) / 4);
    const int code = compare(questions[i % questions.size()]);
    (code == 0 ? apart : touched) += 1;
    if (HasFailure()) FAIL() << "run " << i;
  }
  EXPECT_GT(touched, 0);
  EXPECT_GT(apart, 0);
}

TEST_F(RunShards, OfASimulationHaveTheAnswerOfOneProcess) {
  simulate(swinging_beam());
  EXPECT_EQ(compare({}), 0);
  EXPECT_EQ(compare({"--min-distance", "1e-6"}), 0);
  EXPECT_EQ(compare({"--reproduce"}), 0);
  const Process checked = run_noli({"check", folder.path("all.noli"), run_path()});
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
}

/// Its world lines are in no file.
TEST_F(RunShards, OfARunOfFramesNeedNoChecker) {
  simulate(swinging_beam("frames"));
  const Words asked = {run_path(), "--reproduce"};
  EXPECT_NE(refusal(joined({"verify", "--shard", "1/1", "-o", shards()}, asked)).find("expected --no-check"),
            std::string::npos);
  const Words unchecked = joined(asked, {"--no-check"});
  const auto json = [&](const Words& words, const char* name) {
    const Process process = run_noli(joined(words, {"--force", "--json", folder.path(name)}));
    EXPECT_EQ(process.exit_code, 0) << process.err;
    return process.verdict_line();
  };
  const std::string one = json(joined({"verify"}, unchecked), "one.json");
  for (const char* which : {"2/2", "1/2"}) EXPECT_EQ(part(unchecked, which).exit_code, 0);
  EXPECT_EQ(json({"merge", shards()}, "all.json"), one);
  EXPECT_EQ(answer("one.json"), answer("all.json"));
  EXPECT_EQ(answer("all.json")["reproduced"], true);
}

TEST_F(RunShards, OfARunThatGrewAreMadeForItsEndAlone) {
  simulate(swinging_beam(), {"--until", "0.2"});
  ASSERT_EQ(part({run_path()}, "1/1").exit_code, 0);
  expect_same_answer(whole({run_path()}), merge());
  const auto before = fs::last_write_time(shard(1));
  simulate(swinging_beam(), {"--resume"});
  EXPECT_NE(refusal({"merge", shards()}).find("ends before window 21; run `noli verify --shard` again"),
            std::string::npos);
  const Process again = part({run_path()}, "1/1");
  EXPECT_NE(again.out.find("3 of 4 tasks done now, 1 before"), std::string::npos) << again.out;
  EXPECT_EQ(fs::last_write_time(shard(1)), before);
  expect_same_answer(whole({run_path()}), merge());
}

TEST_F(RunShards, FollowARunToItsEnd) {
  Json scene = swinging_beam();
  scene["duration"] = 8;  // 800 windows, which take some seconds
  const std::string file = folder.write("scene.json", scene.dump());
  std::thread writer([&] { EXPECT_EQ(run_noli({"simulate", file, "-o", run_path()}).exit_code, 0); });
  for (int i = 0; i < 4000 && !fs::exists(run_path() + "/log.jsonl"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_TRUE(is_locked(run_path())) << "it is still being written";
  std::thread other([&] { EXPECT_EQ(part({run_path(), "--follow"}, "2/2").exit_code, 0); });
  const Process process = part({run_path(), "--follow"}, "1/2");
  EXPECT_EQ(process.exit_code, 0) << process.err;
  other.join();
  writer.join();
  EXPECT_NE(process.out.find("of 50 tasks done now"), std::string::npos) << process.out;
  expect_same_answer(whole({run_path()}), merge());
}

TEST_F(RunShards, EndAtTheTimeLimitWhileTheyWait) {
  simulate(swinging_beam());
  const FolderLock lock(run_path());
  const Process process = part({run_path(), "--follow", "--time-limit", "300ms"}, "4/4");
  EXPECT_EQ(process.exit_code, 2) << process.out << process.err;
  EXPECT_NE(process.out.find("0 of 4 tasks done now, 0 before, 0 not needed; time limit"), std::string::npos)
      << process.out;
}

TEST_F(RunShards, OfAnotherRunAreRefusedAndMadeAgain) {
  write_run(2, 36, 5);
  ASSERT_EQ(compare({}), 0);
  fs::remove(shard(2));
  EXPECT_NE(refusal({"merge", shards()}).find("task_000002.shard is missing (windows 17 to 32)"), std::string::npos);
  ASSERT_EQ(part({run_path()}, "1/1").exit_code, 0);
  write_run(2, 36, 6);
  EXPECT_NE(refusal({"merge", shards()}).find("task_000001.shard: was made when window 1 had another hash"),
            std::string::npos);
  EXPECT_NE(part({run_path()}, "1/1").out.find("3 of 3 tasks done now"), std::string::npos);
  expect_same_answer(whole({run_path()}), merge());
}

/// The first window says how cells are grouped, in all tasks.
TEST_F(RunShards, OfARunWithAnotherBeginningAreMadeAgain) {
  write_run(2, 36, 5);
  ASSERT_EQ(part({run_path()}, "1/1").exit_code, 0);
  write_with_another_beginning();
  const Process process = part({run_path()}, "1/1");
  EXPECT_NE(process.out.find("3 of 3 tasks done now"), std::string::npos) << process.out << process.err;
  expect_same_answer(whole({run_path()}), merge());
  ASSERT_EQ(part({run_path()}, "1/1").exit_code, 0);
  const std::string later = bytes_of(shard(2));
  write_run(2, 36, 5);
  ASSERT_EQ(part({run_path()}, "1/1").exit_code, 0);
  folder.write("shards/task_000002.shard", later);
  EXPECT_NE(refusal({"merge", shards()}).find("task_000002.shard: was made when window 1 had another hash"),
            std::string::npos);
}

/// What a shard names are the windows that were decided, whatever has taken their place since.
TEST_F(RunShards, OfARunThatWasReplacedMeanwhileAreRefused) {
  write_run(2, 16, 5);
  fs::rename(run_path(), folder.path("first"));
  write_run(2, 16, 6);
  fs::rename(run_path(), folder.path("second"));
  fs::rename(folder.path("first"), run_path());
  VerifyWork request;
  request.frames = {run_path()};
  request.run = true;
  request.check = false;
  request.progress = [&](std::string_view /*work*/, double /*share*/) {
    if (!fs::exists(folder.path("second"))) return;
    fs::rename(run_path(), folder.path("first"));
    fs::rename(folder.path("second"), run_path());
  };
  EXPECT_EQ(verify_shard(request, {.folder = shards()}).done, 1u);
  EXPECT_FALSE(fs::exists(folder.path("second"))) << "it was replaced";
  EXPECT_NE(refusal({"merge", shards()}).find("had another hash than it has now"), std::string::npos);
}

TEST_F(RunShards, OfAnotherSceneAreRefused) {
  simulate(swinging_beam("frames"));
  const Words asked = {run_path(), "--reproduce", "--no-check"};
  ASSERT_EQ(part(asked, "1/1").exit_code, 0);
  fs::rename(run_path(), folder.path("kept"));
  Json other = swinging_beam("frames");
  other["gravity"] = {0, -5};
  simulate(other);
  for (const char* file : {"scene.json", "manifest.json"}) {
    fs::copy_file(run_path() + "/" + file, folder.path("kept") + "/" + file, fs::copy_options::overwrite_existing);
  }
  fs::remove_all(run_path());
  fs::rename(folder.path("kept"), run_path());
  fs::remove(run_path() + "/log.jsonl");
  EXPECT_NE(refusal({"merge", shards()}).find("/reproduce: is about files that have changed"), std::string::npos);
  EXPECT_NE(refusal(joined({"verify", "--shard", "1/1", "-o", shards()}, asked)).find("differs in \"reproduce\""),
            std::string::npos);
}

TEST_F(RunShards, OfAQuestionThatIsRefusedLeaveNothing) {
  simulate(swinging_beam("frames"));
  const auto asked = [&](const Words& more) {
    return joined({"verify", run_path(), "--shard", "1/1", "-o", shards()}, more);
  };
  EXPECT_NE(refusal(asked({})).find("pass --reproduce"), std::string::npos);
  EXPECT_NE(refusal(asked({"--static"})).find("apply to frames only"), std::string::npos);
  EXPECT_NE(refusal(asked({"--reproduce"})).find("expected --no-check"), std::string::npos);
  fs::remove_all(run_path());
  WildRun(2, 3, 5).write(run_path(), 0);
  EXPECT_NE(refusal(asked({})).find("has no window yet"), std::string::npos);
  EXPECT_FALSE(fs::exists(shards()));
}

/// It is about the windows that were committed when the parts looked.
TEST_F(RunShards, OfARunThatIsBeingWrittenAreJoined) {
  simulate(swinging_beam());
  const FolderLock lock(run_path());
  const Process one = whole({run_path()});
  ASSERT_EQ(part({run_path()}, "1/1").exit_code, 0);
  const Process all = merge();
  EXPECT_EQ(one.exit_code, all.exit_code) << all.err;
  EXPECT_EQ(bytes_of(folder.path("one.noli")), bytes_of(folder.path("all.noli")));
  EXPECT_NE(all.out.find("another process writes to the run"), std::string::npos) << all.out;
  EXPECT_EQ(all.out.find("--follow"), std::string::npos) << "merge has no such option";
}

TEST_F(RunShards, OfADamagedRunAreNotMade) {
  write_run(2, 36, 5);
  std::string bytes = bytes_of(run_path() + "/trajectory.blocks");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  folder.write("run/trajectory.blocks", bytes);
  const Process process = part({run_path()}, "2/3");
  EXPECT_EQ(process.exit_code, 3) << process.out;
  EXPECT_NE(process.err.find("trajectory.blocks"), std::string::npos) << process.err;
  EXPECT_FALSE(fs::exists(shard(2)));
}

}  // namespace
}  // namespace noli::app_tests
