// SPDX-License-Identifier: Apache-2.0
//
// Tests `--divide`: the parts of one step, decided by several processes, give the answer of one process, byte for byte.
#include "tests/app/shards/shards_fixture.h"
#include "tests/support/real_data.h"

namespace noli::app_tests {
namespace {

class DividedStep : public Shards {
 protected:
  Process divided(const Words& asked, const std::string& which) const {
    return part(joined(asked, {"--divide"}), which);
  }

  void expect_answer_of_one_process(const Words& asked, int exit_code) const {
    const Process one = whole(asked);
    EXPECT_EQ(one.exit_code, exit_code) << one.out << one.err;
    for (const char* which : {"2/3", "1/3", "3/3"}) {
      const Process process = divided(asked, which);
      EXPECT_LE(process.exit_code, 1) << process.err;
    }
    expect_same_answer(one, merge());
  }

  /// All parts are there.
  void divide(const Words& asked, int exit_code) const { ASSERT_EQ(divided(asked, "1/1").exit_code, exit_code); }

  /// Two frames of a sheet in waves, the second one with its right half folded onto the left one.
  Words folding() const {
    const std::string folded = write_wave(1, 0, [](Position& x) {
      if (x[0] > 24) x = {48.25 - x[0], x[1], x[2] + 0.3};
    });
    return {write_wave(0), folded};
  }
};

TEST_F(DividedStep, HasTheProofOfOneProcess) {
  const Words asked = write_waves(2);
  expect_answer_of_one_process(asked, 0);
  EXPECT_GT(fs::file_size(folder.path("all.noli")), 300'000U) << "tokens of several parts";
  EXPECT_EQ(run_noli(joined({"check", folder.path("all.noli")}, asked)).exit_code, 0);
  if (verified_checker_is_there()) {
    EXPECT_EQ(run_noli(joined({"check", "--verified", folder.path("all.noli")}, asked)).exit_code, 0);
  }
}

TEST_F(DividedStep, HasTheContactsOfOneProcess) {
  const Words frames = folding();
  for (const Words& more : {Words{}, Words{"--max-reports", "3"}, Words{"--max-reports", "0"}, Words{"--strict"}}) {
    expect_answer_of_one_process(joined(frames, more), 1);
    EXPECT_GT(answer("all.json").at("contacts").at("edge_edge").get<int>(), 1000);
    fs::remove_all(shards());
  }
}

TEST_F(DividedStep, MayStandStill) {
  expect_answer_of_one_process({write_wave(3), "--static"}, 0);
  fs::remove_all(shards());
  expect_answer_of_one_process({folding()[1], "--static"}, 1);
  EXPECT_GT(answer("all.json").at("initial_intersections").get<int>(), 100);
}

TEST_F(DividedStep, MayHaveFewerTasksThanParts) {
  expect_answer_of_one_process(write_motion(2), 0);
  fs::remove_all(shards());
  expect_answer_of_one_process(write_motion(2, {1}), 1);
}

TEST_F(DividedStep, WithoutProofsGivesNoContact) {
  const Words asked = joined(write_waves(2), {"--no-check"});
  const Process one = run_noli(joined({"verify", "--json", folder.path("one.json")}, asked));
  ASSERT_EQ(divided(asked, "1/1").exit_code, 0);
  EXPECT_EQ(merge().exit_code, 3) << "a proof was asked for";
  expect_same_answer(one, run_noli({"merge", shards(), "--json", folder.path("all.json")}));
}

TEST_F(DividedStep, DoesOnlyWhatIsMissing) {
  const Words asked = write_waves(2);
  EXPECT_EQ(divided(joined(asked, {"--time-limit", "1ms"}), "1/1").exit_code, 2);
  EXPECT_EQ(merge().exit_code, 3);
  ASSERT_EQ(divided(asked, "1/2").exit_code, 0);
  const Process missing = merge();
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_NE(missing.err.find("task_000002.shard is missing (part 2 of 64)"), std::string::npos) << missing.err;
  ASSERT_EQ(divided(asked, "2/2").exit_code, 0);
  fs::remove(shard(7));
  fs::resize_file(shard(9), fs::file_size(shard(9)) / 2);
  EXPECT_EQ(merge().exit_code, 3);
  const Process again = divided(asked, "1/1");
  EXPECT_NE(again.out.find("2 of 64 tasks done now, 62 before"), std::string::npos) << again.out;
  expect_same_answer(whole(asked), merge());
  write_wave(1, 1);
  const Process other = merge();
  EXPECT_EQ(other.exit_code, 3);
  EXPECT_NE(other.err.find("is not the file that"), std::string::npos) << other.err;
}

TEST_F(DividedStep, MayHaveEqualFramesAndTwoDimensions) {
  const std::string wave = write_wave(3);
  expect_answer_of_one_process({wave, wave}, 0);
  EXPECT_NE(bytes_of(folder.path("all.json")).find("nothing moves in step 1"), std::string::npos);
  fs::remove_all(shards());
  expect_answer_of_one_process(joined(write_waves(2), {"--dimension", "2"}), 0);
  fs::remove_all(shards());
  expect_answer_of_one_process(joined(folding(), {"--dimension", "2"}), 1);
}

/// The tokens are those of other parts.
TEST_F(DividedStep, ExchangedPartsAreRefusedByTheChecker) {
  divide(write_waves(2), 0);
  fs::rename(shard(3), folder.path("third"));
  fs::rename(shard(4), shard(3));
  fs::rename(folder.path("third"), shard(4));
  for (const int task : {3, 4}) change_head(shard(task), [&](auto& head) { head["task"] = task - 1; });
  const Process process = merge();
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("the shards do not match"), std::string::npos) << process.err;
}

TEST_F(DividedStep, APartWithoutAProofLeavesTheStepUnchecked) {
  divide(write_waves(2), 0);
  std::vector<Block> blocks = blocks_of(shard(5));
  blocks.resize(2);  // the head and its commit
  write_shard(shard(5), blocks);
  change_head(shard(5), [](auto& head) { head["unproved"] = true, head["groups"] = 0; });
  const Process process = merge();
  EXPECT_EQ(process.exit_code, 2) << process.out << process.err;
  EXPECT_EQ(process.verdict_line().substr(0, 9), "UNDECIDED") << process.out;
}

TEST_F(DividedStep, AnInventedFirstContactIsAFaultOfTheShards) {
  const Words asked = folding();
  divide(asked, 1);
  int changed = 0;
  for (int task = 1; task <= 9; ++task) {
    change_head(shard(task), [&](auto& head) {
      auto& first = head["steps"][0]["first"];
      if (!first.is_null()) first["contact"][1] = {0, 100, 1000, 1001}, ++changed;
    });
  }
  ASSERT_GT(changed, 0);
  const Process process = merge();
  EXPECT_EQ(process.exit_code, 3) << process.out << process.err;
  EXPECT_NE(process.err.find("lists features that do not meet"), std::string::npos) << process.err;
}

/// Stopped with a contact found: tasks are missing, so this is not the exit code of a contact.
TEST_F(DividedStep, StoppedIsUndecidedWhateverWasFound) {
  const Words asked = folding();
  divide(asked, 1);
  fs::remove(shard(9));
  const Process stopped = divided(joined(asked, {"--time-limit", "1ms"}), "1/1");
  EXPECT_EQ(stopped.exit_code, 2) << stopped.out << stopped.err;
  EXPECT_EQ(divided(asked, "1/1").exit_code, 1);
}

/// The head of a part says which one it is.
TEST_F(DividedStep, APartInThePlaceOfAnotherIsRefused) {
  divide(write_waves(2), 0);
  fs::copy_file(shard(3), shard(4), fs::copy_options::overwrite_existing);
  const Process process = merge();
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("is the shard of another task"), std::string::npos) << process.err;
}

TEST_F(DividedStep, WrongUsageIsRefused) {
  const Words three = write_waves(3), two = write_waves(2);
  const auto expect_refused = [&](const Words& asked, const std::string& why) {
    const Process process = divided(asked, "1/2");
    EXPECT_EQ(process.exit_code, 3);
    EXPECT_NE(process.err.find(why), std::string::npos) << process.err;
    EXPECT_FALSE(fs::exists(shards())) << "a request that is refused leaves nothing";
  };
  expect_refused(three, "found 2 steps");
  expect_refused(joined(two, {"--first-only"}), "expected no --first-only");
  for (const Words& more : {Words{"--only-new"}, Words{"--min-distance", "0.01"}}) {
    expect_refused(joined(two, more), "--divide: cannot be combined with");
  }
  const Process alone = run_noli(joined({"verify", "--divide"}, two));
  EXPECT_EQ(alone.exit_code, 3);
  EXPECT_NE(alone.err.find("--divide: divides one step among processes"), std::string::npos) << alone.err;
}

TEST_F(DividedStep, SlowHasTheAnswerOfOneProcessForRealFrames) {
  int tried = 0;
  for (const char* const motion : {"armadillo-rollers", "cloth-ball", "cloth-funnel", "rod-twist-clean"}) {
    const auto data = test::real_data(std::string("frames/") + motion);
    if (!data) GTEST_SKIP();
    Words frames;
    for (const auto& entry : fs::directory_iterator(*data)) frames.push_back(entry.path().string());
    std::ranges::sort(frames);
    frames.resize(2);
    const bool touches = std::string(motion) != "rod-twist-clean";
    expect_answer_of_one_process(frames, touches ? 1 : 0);
    fs::remove_all(shards());
    ++tried;
  }
  EXPECT_EQ(tried, 4);
}

}  // namespace
}  // namespace noli::app_tests
