// SPDX-License-Identifier: Apache-2.0
//
// Tests checks of parts of a proof: `noli check --steps`, `--shard`, and several checkers for one answer.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "certify/proofs/check_parts.h"
#include "tests/app/process.h"
#include "tests/app/shards/shards_fixture.h"

namespace noli::app_tests {
namespace {

/// Waves of a sheet, whose proof has some megabytes.
class CheckedParts : public Shards {
 protected:
  static constexpr int frames = 9;

  void SetUp() override {
    names = write_waves(frames);
    const Process proved = run_noli(joined({"verify", "--no-check", "--proof", proof()}, names));
    ASSERT_EQ(proved.exit_code, 0) << proved.err;
    ASSERT_GT(fs::file_size(proof()), 3U << 20U);
  }
  std::string proof() const { return folder.path("waves.noli"); }
  Process check(const Words& more) const { return run_noli(joined(joined({"check", proof()}, names), more)); }
  CheckRequest request(int checkers) const {
    return {.proof = proof(),
            .trajectory = {names.begin(), names.end()},
            .programs = fs::path(NOLI_COMMAND).parent_path(),
            .checkers = checkers};
  }

  Words names;
};

TEST_F(CheckedParts, GiveTheAnswerOfOneChecker) {
  const CheckerVerdict one = check_proof(request(1));
  EXPECT_EQ(one.code, 0);
  EXPECT_FALSE(accepted_in_parts(request(1)).has_value());
  for (const Checker checker : {Checker::plain, Checker::verified}) {
    if (checker == Checker::verified && !verified_checker_is_there()) continue;
    CheckRequest several = request(3);
    several.checker = checker;
    const auto parted = accepted_in_parts(several);
    ASSERT_TRUE(parted.has_value());
    EXPECT_EQ(parted->words, one.words);
    EXPECT_EQ(check_proof(several).words, one.words);
  }
}

TEST_F(CheckedParts, AskForWhatOneCheckerIsAskedFor) {
  for (const char* const word : {"steps=8", "steps=3", "motion=rest", "distance=0"}) {
    CheckRequest one = request(1), several = request(3);
    one.asked = several.asked = {word};
    EXPECT_TRUE(accepted_in_parts(several).has_value()) << word;
    EXPECT_EQ(check_proof(one).words, check_proof(several).words) << word;
  }
  const std::vector<Words> refused = {{"steps=9"},
                                      {"steps=2..3"},
                                      {"steps=x"},
                                      {"steps"},
                                      {"strict"},
                                      {"distance=1"},
                                      {"nothing"},
                                      {"steps=3", "steps=4"},
                                      {"steps=8", "steps=2..3"}};
  for (const Words& words : refused) {
    CheckRequest one = request(1), several = request(3);
    one.asked = several.asked = words;
    EXPECT_FALSE(accepted_in_parts(several).has_value()) << words[0];
    EXPECT_EQ(check_proof(one).words, check_proof(several).words) << words[0];
  }
}

TEST_F(CheckedParts, OfOtherFramesAreRejected) {
  for (const int changed : {0, 3, 4, frames - 1}) {
    write_wave(changed, 1);
    EXPECT_FALSE(accepted_in_parts(request(3)).has_value()) << changed;
    EXPECT_EQ(check({}).exit_code, 3) << changed;
    write_wave(changed, 0);
  }
  EXPECT_EQ(check({}).exit_code, 0);
  names.push_back(write_wave(frames, 0));
  EXPECT_FALSE(accepted_in_parts(request(3)).has_value());
  EXPECT_EQ(check({}).exit_code, 3);
}

TEST_F(CheckedParts, OfADamagedProofAreRejected) {
  const std::string bytes = bytes_of(proof());
  for (const std::size_t share : {1U, 5U, 9U}) {
    std::string other = bytes;
    other[bytes.size() / 10 * share] ^= 1;
    folder.write("waves.noli", other);
    EXPECT_FALSE(accepted_in_parts(request(3)).has_value()) << share;
    EXPECT_EQ(check({}).exit_code, 3) << share;
  }
}

TEST_F(CheckedParts, AreShardsThatNameOneProof) {
  std::string name;
  std::uint64_t next = 1;
  for (const char* const which : {"1/3", "2/3", "3/3"}) {
    const Process checked = check({"--shard", which, "--json", "-"});
    EXPECT_EQ(checked.exit_code, 0) << checked.err;
    const Json part = Json::parse(checked.out)["claim"]["part"];
    EXPECT_EQ(part["first"], next);
    next = part["last"].get<std::uint64_t>() + 1;
    if (name.empty()) name = part["proof"];
    EXPECT_EQ(part["proof"], name);
    const std::string line = check({"--shard", which, "--porcelain"}).out;
    EXPECT_NE(line.find(" first=" + part["first"].dump() + " last=" + part["last"].dump() + " proof=" + name),
              std::string::npos)
        << line;
  }
  EXPECT_EQ(next, static_cast<std::uint64_t>(frames));
}

/// A claim of more steps than there are is not that of the steps that are there.
TEST_F(CheckedParts, ReachTheLastStepOfTheClaim) {
  const std::string claim = folder.path("claim.json");
  ASSERT_EQ(run_noli(joined({"verify", "--no-check", "--claim-out", claim}, names)).exit_code, 0);
  EXPECT_EQ(check({"--claim", claim, "--shard", "2/2"}).exit_code, 0);
  EXPECT_EQ(check({"--claim", claim, "--steps", "5.."}).exit_code, 0);
  const Words fewer(names.begin(), names.end() - 2);
  names = fewer;
  ASSERT_EQ(run_noli(joined({"verify", "--no-check", "--force", "--proof", proof()}, names)).exit_code, 0);
  EXPECT_EQ(check({"--claim", claim}).exit_code, 3);
  EXPECT_EQ(check({"--claim", claim, "--shard", "1/2"}).exit_code, 0);
  EXPECT_EQ(check({"--claim", claim, "--shard", "2/2"}).exit_code, 3);
  EXPECT_EQ(check({"--claim", claim, "--steps", "5.."}).exit_code, 3);
  EXPECT_EQ(check({"--claim", claim, "--steps", "5..6"}).exit_code, 0);
}

/// Frames that are passed on to the checker end where one cannot be read; that is not where they end.
TEST_F(CheckedParts, DoNotEndAtAFrameThatCannotBeRead) {
  const std::string text = bytes_of(names[6]);
  folder.write("wave_6.ply", text.substr(0, text.size() / 2));
  const auto check_body = [&](const Words& more) {
    return run_noli(joined({"check", proof(), "--body", "sheet=" + folder.path("wave_*.ply")}, more)).exit_code;
  };
  EXPECT_EQ(check_body({"--steps", "1..5"}), 0);
  EXPECT_EQ(check_body({"--steps", "1..6"}), 3);
  EXPECT_EQ(check_body({"--steps", "1.."}), 3);
  EXPECT_EQ(check_body({}), 3);
  folder.write("wave_6.ply", text);
  EXPECT_EQ(check_body({"--steps", "1.."}), 0);
}

TEST_F(CheckedParts, OfSomeStepsAreNamedInTheVerdict) {
  const Process some = check({"--steps", "3..4"});
  EXPECT_EQ(some.exit_code, 0);
  EXPECT_NE(some.verdict_line().find("nothing touches; steps 3..4"), std::string::npos) << some.out;
  EXPECT_EQ(check({"--steps", "7.."}).exit_code, 0);
  EXPECT_EQ(check({"--steps", "7..9"}).exit_code, 3);
  for (const char* const steps : {"3..x", "3", "", "..3", "3..2", "0..2", "3-4"}) {
    const Process wrong = check({"--steps", steps});
    EXPECT_EQ(wrong.exit_code, 3) << steps;
    EXPECT_NE(wrong.err.find("expected A..B with 1 <= A <= B, or A.."), std::string::npos) << wrong.err;
  }
  EXPECT_EQ(check({"--shard", ""}).exit_code, 3);
  EXPECT_EQ(check({"--shard", "1/2", "--time-limit", "1ms"}).exit_code, 2);
  EXPECT_EQ(check({"--shard", "3"}).exit_code, 3);
  const Process many = check({"--shard", "2/9"});
  EXPECT_EQ(many.exit_code, 3);
  EXPECT_NE(many.err.find("the proof has 8 steps; expected K/N with N <= 8"), std::string::npos) << many.err;
  EXPECT_EQ(check({"--shard", "1/2", "--steps", "1..2"}).exit_code, 3);
  EXPECT_EQ(check({"--shard", "1/2", "--require", "steps=2"}).exit_code, 3);
  EXPECT_EQ(check({"--steps", "1..2", "--require", "steps=5"}).exit_code, 3);
}

}  // namespace
}  // namespace noli::app_tests
