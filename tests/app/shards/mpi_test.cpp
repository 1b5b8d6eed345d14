// SPDX-License-Identifier: Apache-2.0
//
// Tests `mpirun noli verify` and `check`: ranks give the answer of one process, and a job that died goes on.
#include <chrono>
#include <random>
#include <thread>

#include "tests/app/runs/wild_run.h"
#include "tests/app/shards/shards_fixture.h"
#include "trajectory/blocks/folder_lock.h"

namespace noli::app_tests {
namespace {

class InRanks : public Shards {
 protected:
  /// Run as a job of ranks, in a session of its own.
  Process job(int ranks, const Words& words, const std::string& before = "") const {
    ProcessOptions options;
    options.program = "/bin/sh";
    options.environment = {{"TERM", "xterm"},  // mpirun gives a rank a terminal
                           {"NO_COLOR", ""},
                           {"OMPI_ALLOW_RUN_AS_ROOT", "1"},
                           {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"},
                           {"OMPI_MCA_rmaps_base_oversubscribe", "1"},
                           // Two jobs that begin at once both make the folder of this machine, and one fails.
                           {"OMPI_MCA_orte_tmpdir_base", folder.path("mpi")}};
    std::string command = before + "exec " NOLI_MPIRUN " -n " + std::to_string(ranks) + " " NOLI_COMMAND;
    for (const std::string& word : words) command += " '" + word + "'";
    return run_noli({"-c", command}, options);
  }
  Words asked_of_ranks(const Words& asked) const {
    return joined(
        {"verify", "--force", "-o", shards(), "--json", folder.path("all.json"), "--proof", folder.path("all.noli")},
        asked);
  }
};

TEST_F(InRanks, NothingTouches) {
  const Words asked = write_motion(50);
  const Process all = job(4, asked_of_ranks(asked));
  EXPECT_EQ(all.exit_code, 0) << all.out << all.err;
  expect_same_answer(whole(asked), all);
}

TEST_F(InRanks, AStepIsDivided) {
  const Words asked = write_waves(2);
  const Process all = job(3, joined(asked_of_ranks(asked), {"--divide"}));
  EXPECT_EQ(all.exit_code, 0) << all.out << all.err;
  expect_same_answer(whole(asked), all);
}

TEST_F(InRanks, ARunIsVerified) {
  const std::string run = folder.path("run");
  WildRun(2, 3, 5).write(run, 36);
  const Process all = job(3, asked_of_ranks({run}));
  EXPECT_EQ(all.exit_code, 0) << all.out << all.err;
  expect_same_answer(whole({run}), all);
}

/// The rank that waits for windows 33 to 48 hears that another has found a contact.
TEST_F(InRanks, AContactEndsTheWaiting) {
  const std::string run = folder.path("run");
  WildRun(0, 3, 1.5).write(run, 36);
  const FolderLock lock(run);
  const Process refused = job(2, asked_of_ranks({run}));
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("pass --follow"), std::string::npos) << refused.err;
  const Process all = job(3, asked_of_ranks({run, "--follow"}));
  EXPECT_EQ(all.exit_code, 1) << all.out << all.err;
  expect_same_answer(whole({run, "--follow"}), all);
}

TEST_F(InRanks, SomethingTouches) {
  const Words asked = write_motion(50, {20, 40});
  const Process all = job(3, asked_of_ranks(asked));
  EXPECT_EQ(all.exit_code, 1) << all.out << all.err;
  expect_same_answer(whole(asked), all);
}

TEST_F(InRanks, TheUsualFolderIsRemoved) {
  const Words asked = write_motion(20);
  const Process all = job(2, joined({"verify"}, asked), "cd '" + folder.path("") + "' && ");
  EXPECT_EQ(all.exit_code, 0) << all.out << all.err;
  for (const auto& entry : fs::directory_iterator(folder.path(""))) {
    EXPECT_FALSE(entry.path().filename().string().starts_with("noli-shards")) << entry.path();
  }
}

TEST_F(InRanks, AProofIsCheckedAsByOneProcess) {
  const Words waves = write_waves(9);
  ASSERT_EQ(run_noli(joined({"verify", "--no-check", "--proof", folder.path("one.noli")}, waves)).exit_code, 0);
  const auto asked = [&](const std::string& json) {
    return joined(joined({"check", folder.path("one.noli")}, waves), {"--force", "--json", folder.path(json)});
  };
  const auto expect_same = [&](const Words& more, int exit_code) {
    const Process one = run_noli(joined(asked("one.json"), joined({"--threads", "1"}, more)));
    const Process all = job(3, joined(asked("all.json"), more));
    EXPECT_EQ(one.exit_code, exit_code) << one.out << one.err;
    EXPECT_EQ(all.exit_code, exit_code) << all.out << all.err;
    EXPECT_EQ(one.verdict_line(), all.verdict_line());
    EXPECT_EQ(bytes_of(folder.path("one.json")), bytes_of(folder.path("all.json")));
  };
  expect_same({}, 0);
  if (verified_checker_is_there()) expect_same({"--verified"}, 0);
  expect_same({"--require", "strict"}, 3);
  write_wave(5, 1);
  expect_same({}, 3);
}

/// A frame that only the first rank is asked about is not passed over.
TEST_F(InRanks, OtherFramesOfARankAreNoticed) {
  const Words waves = write_waves(9), more = write_waves(10);
  ASSERT_EQ(run_noli(joined({"verify", "--no-check", "--proof", folder.path("one.noli")}, waves)).exit_code, 0);
  const auto of_ranks = [](const Words& first, const Words& others) {
    return joined(joined(first, {":", "-n", "2", NOLI_COMMAND}), others);
  };
  const Words ask = joined({"check", folder.path("one.noli")}, waves), ask_more = joined(ask, {more.back()});
  const Process rejected = job(1, of_ranks(ask_more, ask)), accepted = job(1, of_ranks(ask, ask_more));
  EXPECT_EQ(rejected.exit_code, 3) << rejected.out << rejected.err;
  EXPECT_EQ(accepted.exit_code, 0) << accepted.out << accepted.err;
  for (const Process* const process : {&rejected, &accepted}) {
    EXPECT_NE(process->err.find("not all ranks were asked about the same frames"), std::string::npos) << process->err;
  }
}

TEST_F(InRanks, WrongUsageEndsTheJob) {
  EXPECT_EQ(job(2, {"verify", folder.path("none.ply"), folder.path("nor.ply")}).exit_code, 3);
  const Process join = job(2, {"check", "--join", folder.path("1.json")});
  EXPECT_EQ(join.exit_code, 3);
  EXPECT_NE(join.err.find("--join: runs in one process"), std::string::npos) << join.err;
  const Process other = job(2, {"info", write_motion(2)[0]});
  EXPECT_EQ(other.exit_code, 3);
  EXPECT_NE(other.err.find("`noli info` runs in one process"), std::string::npos) << other.err;
}

/// One of the ranks is killed as soon as the first shard is there; the same command then does only what is missing.
TEST_F(InRanks, AJobThatDiedGoesOn) {
  const Words asked = write_motion(50);
  const Process one = whole(asked);
  std::mt19937 random(1);
  for (std::uint64_t trial = 0; trial < trials(3, 50); ++trial) {
    fs::remove_all(shards());
    const std::string pause = "0.0" + std::to_string(random() % 10);
    // The last process of this program that was started under this folder's name.
    const std::string killer = "(for i in $(seq 1000); do [ -e '" + shard(1) +
                               "' ] && break; sleep 0.01; done; sleep " + pause +
                               "; kill -9 $(pgrep -n -f '^" NOLI_COMMAND ".*" + shards() + "')) & ";
    job(4, asked_of_ranks(asked), killer);
    std::map<std::string, fs::file_time_type> done;
    for (const auto& entry : fs::directory_iterator(shards())) {
      if (entry.path().extension() == ".shard") done[entry.path().string()] = fs::last_write_time(entry.path());
    }
    EXPECT_FALSE(done.empty());
    const Process all = job(4, asked_of_ranks(asked));
    expect_same_answer(one, all);
    for (const auto& [file, time] : done) EXPECT_EQ(fs::last_write_time(file), time) << file;
  }
}

}  // namespace
}  // namespace noli::app_tests
