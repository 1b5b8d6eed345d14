// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli verify RUN --shard` and `noli merge`: the answer of all shards is that of one process, byte for byte,
// also of a run that is still written, or that recorded frames alone.
#include "tests/app/runs/wild_run.h"
#include "tests/app/shards/shards_fixture.h"

#include <thread>

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
  EXPECT_NE(refusal({"merge", shards()}).find("remove it, and run"), std::string::npos);
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
  while (!fs::exists(run_path() + "/log.jsonl")) std::this_thread::sleep_for(std::chrono::milliseconds(5));
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
  const Process process = part({run_path(), "--follow", "--time-limit", "300ms"}, "1/1");
  EXPECT_EQ(process.exit_code, 2) << process.out << process.err;
  EXPECT_NE(process.out.find("3 of 4 tasks done now, 0 before, 0 not needed; time limit"), std::string::npos)
      << process.out;
}

TEST_F(RunShards, OfAnotherRunAreRefusedAndMadeAgain) {
  write_run(2, 36, 5);
  ASSERT_EQ(compare({}), 0);
  fs::remove(shard(2));
  EXPECT_NE(refusal({"merge", shards()}).find("task_000002.shard is missing (windows 17 to 32)"), std::string::npos);
  ASSERT_EQ(part({run_path()}, "1/1").exit_code, 0);
  write_run(6, 36, 5);
  EXPECT_NE(refusal({"merge", shards()}).find("task_000001.shard"), std::string::npos);
  EXPECT_NE(part({run_path()}, "1/1").out.find("3 of 3 tasks done now"), std::string::npos);
  expect_same_answer(whole({run_path()}), merge());
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
