// SPDX-License-Identifier: Apache-2.0
//
// Tests checks of parts of a proof: `noli check --steps`, `--shard`, and several checkers for one answer.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "certify/proofs/check_parts.h"
#include "tests/app/process.h"
#include "tests/app/shards/shards_fixture.h"
#include "trajectory/blocks/block_file.h"
#include "trajectory/blocks/bytes.h"

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
    EXPECT_NE(line.find(" excluded=0 empty=false first=" + part["first"].dump() + " last=" + part["last"].dump() +
                        " proof=" + name),
              std::string::npos)
        << line;
  }
  EXPECT_EQ(next, static_cast<std::uint64_t>(frames));
}

/// Answers about parts, as other machines would write them.
class JoinedAnswers : public CheckedParts {
 protected:
  void SetUp() override {
    CheckedParts::SetUp();
    for (const char* const which : {"1", "2", "3"}) answer(which, {"--shard", std::string(which) + "/3"});
  }
  /// Writes the answer about some steps, and returns its name.
  std::string answer(const std::string& name, const Words& more) const {
    const std::string file = folder.path(name + ".json");
    EXPECT_EQ(check(joined(more, {"--json", file, "--force", "-q"})).exit_code, 0);
    return file;
  }
  std::string changed(const std::string& name, const std::function<void(Json&)>& change) const {
    Json json = Json::parse(bytes_of(folder.path(name + ".json")));
    change(json);
    return folder.write("changed.json", json.dump());
  }
  std::string at(const std::string& name) const { return folder.path(name + ".json"); }
  static Process join(const Words& files) { return run_noli(joined({"check", "--join"}, files)); }
  void expect_same_but_for_joining(const std::string& one, const std::string& all) const {
    const Json whole = Json::parse(bytes_of(at(one)));
    Json joined = Json::parse(bytes_of(at(all)));
    EXPECT_GE(joined["joined"], 1);
    joined.erase("joined");
    joined["notes"].erase(joined["notes"].size() - 1);
    EXPECT_EQ(joined, whole);
  }
  static void expect_refused(const Words& files, const std::string& why) {
    const Process process = join(files);
    EXPECT_EQ(process.exit_code, 3) << why;
    EXPECT_NE(process.err.find(why), std::string::npos) << process.err;
    EXPECT_EQ(process.out, "") << why;
  }
};

TEST_F(JoinedAnswers, AreThatOfOneChecker) {
  const Process one = check({"--json", folder.path("one.json")});
  const Process all = join({at("2"), at("3"), at("1"), "--json", folder.path("all.json")});
  EXPECT_EQ(all.exit_code, 0) << all.err;
  EXPECT_EQ(all.verdict_line(), one.verdict_line());
  EXPECT_NE(all.out.find("joined from the answers about 3 parts; nothing was checked again"), std::string::npos);
  expect_same_but_for_joining("one", "all");
  // Steps that were chosen by hand are parts, too; a part may be all of the proof.
  EXPECT_EQ(join({answer("a", {"--steps", "1..2"}), answer("b", {"--steps", "3.."})}).exit_code, 0);
  EXPECT_EQ(join({answer("c", {"--shard", "1/1"})}).exit_code, 0);
}

TEST_F(JoinedAnswers, CoverEachStepOnce) {
  expect_refused({at("2"), at("3")}, "and no answer is about step");
  expect_refused({at("1"), at("3")}, "and no answer is about step");
  expect_refused({at("1"), at("2")}, "nothing says that this is the last one");
  expect_refused({at("1"), at("2"), at("2"), at("3")}, "expected each step once");
  expect_refused({at("1"), answer("b", {"--steps", "2.."})}, "expected each step once");
  expect_refused({answer("a", {"--steps", "1..8"})}, "nothing says that this is the last one");
  expect_refused({}, "with --join, answers");
}

TEST_F(JoinedAnswers, AreAboutOneProofAndOneQuestion) {
  expect_refused({at("1"), at("2"), answer("e", {"--shard", "3/3", "--require", "distance=0"})}, "asked for");
  if (verified_checker_is_there()) {
    expect_refused({at("1"), at("2"), answer("v", {"--shard", "3/3", "--verified"})}, "was checked by");
  }
  write_wave(8, 1);
  ASSERT_EQ(run_noli(joined({"verify", "--no-check", "--force", "--proof", proof()}, names)).exit_code, 0);
  expect_refused({at("1"), at("2"), answer("o", {"--shard", "3/3"})}, "is about the proof with the hash");
}

TEST_F(JoinedAnswers, AreAcceptedPartsAsCheckersSayThem) {
  ASSERT_EQ(check({"--json", folder.path("whole.json")}).exit_code, 0);
  expect_refused({at("whole")}, "is about all steps of a proof");
  ASSERT_EQ(check({"--steps", "1..9", "--json", folder.path("less.json")}).exit_code, 3);
  expect_refused({at("less")}, "is not an acceptance: rejected");
  const auto refused = [&](const std::string& why, const std::function<void(Json&)>& change) {
    expect_refused({at("1"), changed("2", change), at("3")}, why);
  };
  refused("is not an acceptance: refuted",
          [](Json& json) { json["verdict"] = "refuted", json["words"] = "refuted: no"; });
  refused("is not what noli check --json writes", [](Json& json) { json["schema"] = "noli-verify"; });
  refused("is not what noli check --json writes", [](Json& json) { json["version"] = 2; });
  refused("is not what noli check --json writes", [](Json& json) { json.erase("words"); });
  refused("is not what noli check --json writes", [](Json& json) { json["claim"] = nullptr; });
  refused("is not what noli check --json writes", [](Json& json) { json["claim"]["part"]["last"] = "x"; });
  refused("is not what noli check --json writes", [](Json& json) { json["claim"]["part"]["last"] = -1; });
  refused("is not what noli check --json writes", [](Json& json) { json["asked"]["distance"] = 5; });
  refused("is not what noli check --json writes", [](Json& json) { json["notes"] = 5; });
  refused("does not fit the other answers",
          [](Json& json) { json["words"] = json["words"].get<std::string>() + "more\n"; });
  refused("does not fit the other answers", [](Json& json) { json["words"] = "accepted: nothing touches"; });
  expect_refused({at("1"), folder.write("no.json", "{")}, "no.json");
  expect_refused({at("1"), folder.path("none.json")}, "none.json");
  expect_refused({at("1"), at("2"), at("3"), "--verified"}, "takes only files of answers");
  expect_refused({at("1"), at("2"), at("3"), "--require", "steps=8"}, "takes only files of answers");
  expect_refused({at("1"), at("2"), at("3"), "--threads", "2"}, "takes only files of answers");
  expect_refused({at("1"), at("2"), at("3"), "--steps", "1..2"}, "--steps");
  expect_refused({at("1"), at("2"), at("3"), "--json", at("1")}, "1.json");
}

/// What a claim asks for beyond the proof is not lost on the way.
TEST_F(JoinedAnswers, ReachAsFarAsWasAsked) {
  const std::string claim = folder.path("claim.json");
  ASSERT_EQ(run_noli(joined({"verify", "--no-check", "--claim-out", claim}, names)).exit_code, 0);
  const Words of_claim = {"--claim", claim};
  const auto ask = [&](const std::string& name, const Words& steps) { return answer(name, joined(of_claim, steps)); };
  ASSERT_EQ(check(joined(of_claim, {"--json", folder.path("one.json")})).exit_code, 0);
  const Words parts = {ask("a", {"--steps", "1..3"}), ask("b", {"--require", "steps=4.."})};
  EXPECT_EQ(join(joined(parts, {"--json", folder.path("all.json")})).exit_code, 0);
  expect_same_but_for_joining("one", "all");
  expect_refused({parts[0], answer("c", {"--steps", "4.."})}, "asked for the default");
  // Of a proof with fewer steps, no part with an open end is accepted.
  names.resize(names.size() - 2);
  ASSERT_EQ(run_noli(joined({"verify", "--no-check", "--force", "--proof", proof()}, names)).exit_code, 0);
  ask("d", {"--steps", "1..3"});
  for (const Words& open : {Words{"--steps", "4.."}, Words{"--require", "steps=4.."}}) {
    const Process process = check(joined(of_claim, open));
    EXPECT_EQ(process.exit_code, 3);
    EXPECT_NE(process.err.find("8 steps are asked for, but the proof has 6"), std::string::npos) << process.err;
  }
  const auto more = [](Json& json) { json["asked"]["steps"] = "4.."; };
  ask("e", {"--steps", "4..6"});
  expect_refused({at("d"), changed("e", more)}, "ends with step 6, and 8 steps were asked for");
}

/// Cuts a block file off behind so many of its groups.
void keep_groups(const fs::path& file, int groups) {
  const std::string bytes = bytes_of(file);
  std::size_t at = block_format::file_header_size;
  while (groups > 0 && at < bytes.size()) {
    const auto kind = get<FourLetters>(bytes.data() + at);
    at += block_format::block_header_size + get<std::uint64_t>(bytes.data() + at + sizeof kind) +
          block_format::checksum_size;
    if (kind == block_format::commit) --groups;
  }
  ASSERT_LT(at, bytes.size());
  fs::resize_file(file, at);
}

/// Windows that are missing at the end of a run are noticed in parts, too.
TEST_F(Shards, PartsOfARunReachItsLastWindow) {
  const std::string run = folder.path("run"), cut = folder.path("cut");
  ASSERT_EQ(run_noli({"simulate", folder.write("scene.json", two_cloths().dump()), "-o", run}).exit_code, 0);
  fs::copy(run, cut, fs::copy_options::recursive);
  keep_groups(fs::path(cut) / "trajectory.blocks", 3);
  keep_groups(fs::path(cut) / "proof.blocks", 3);
  const auto answer = [&](const std::string& folder_of_run, const std::string& steps, const std::string& name) {
    return run_noli({"check", folder_of_run, "--require", "steps=" + steps, "--json", folder.path(name), "--force"});
  };
  EXPECT_EQ(answer(run, "1..1", "1.json").exit_code, 0);
  EXPECT_EQ(answer(run, "2..", "2.json").exit_code, 0);
  EXPECT_EQ(run_noli({"check", "--join", folder.path("1.json"), folder.path("2.json")}).exit_code, 0);
  EXPECT_EQ(run_noli({"check", cut}).exit_code, 3);
  EXPECT_EQ(answer(cut, "1..1", "3.json").exit_code, 0);
  EXPECT_EQ(answer(cut, "2..", "4.json").exit_code, 3);
  // The files of the run say nothing of its length.
  const Process files = run_noli(
      {"check", cut + "/proof.blocks", cut + "/trajectory.blocks", "--steps", "2..", "--json", folder.path("5.json")});
  EXPECT_EQ(files.exit_code, 0) << files.err;
  EXPECT_EQ(run_noli({"check", "--join", folder.path("3.json"), folder.path("5.json")}).exit_code, 3);
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

TEST_F(Shards, AProofWithAWitnessIsNotCut) {
  const std::string proof = folder.path("contact.noli"), claim = folder.path("claim.json");
  const Words names = write_motion(4, {2});
  ASSERT_EQ(run_noli(joined({"verify", "--proof", proof, "--claim-out", claim}, names)).exit_code, 1);
  for (const Words& some : {Words{"--claim", claim, "--steps", "1.."}, Words{"--shard", "1/2"}}) {
    const Process process = run_noli(joined(joined({"check", proof}, names), some));
    EXPECT_EQ(process.exit_code, 3);
    EXPECT_NE(process.err.find("cannot be cut into parts, as it has a witness"), std::string::npos) << process.err;
  }
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
  const Process none = check({"--steps", "9.."});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_NE(none.out.find("Next: ask for steps that the proof has."), std::string::npos) << none.out;
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
