// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli verify --shard` and `noli merge`: the answer of all shards is that of one process, byte for byte, and
// shards that are not whole give none.
#include "tests/app/shards/shards_fixture.h"

#include <sys/stat.h>

#include "tests/app/runs/killer.h"
#include "tests/app/runs/wild_run.h"
#include "tests/app/sequences.h"

namespace noli::app_tests {
namespace {

/// What is asked of 40 frames.
struct Question {
  const char* name;
  std::set<std::size_t> through;
  Words options;
  int exit_code;
  std::vector<Position> still = {};  ///< a triangle that touches without the options
};

void PrintTo(const Question& question, std::ostream* out) { *out << question.name; }

class AnyQuestion : public Shards, public testing::WithParamInterface<Question> {};

TEST_P(AnyQuestion, HasTheAnswerOfOneProcess) {
  const Question& question = GetParam();
  const Words frames = write_motion(40, question.through, question.still);
  if (!question.still.empty()) {
    EXPECT_EQ(whole(frames).exit_code, 1);
  }
  Words asked = joined(frames, question.options);
  if (std::string(question.name) == "ignore") {
    asked = joined(asked, {"--ignore", folder.write("groups.json", R"({"groups": {"floor": [[0, 2]], "other": [[3, 5]],
                                        "sheet": [[6, 14]]}, "ignore": [["floor", "other"]]})")});
  }
  const Process one = whole(asked);
  EXPECT_EQ(one.exit_code, question.exit_code) << one.out << one.err;
  int worst = 0;
  for (const char* which : {"2/3", "1/3", "3/3"}) {
    const Process process = part(asked, which);
    worst = std::max(worst, process.exit_code);
    EXPECT_LE(process.exit_code, 1) << process.out << process.err;
  }
  EXPECT_EQ(worst, question.exit_code);
  expect_same_answer(one, merge());
}

const std::vector<Position> at_the_corner = {{-1, -1, 0}, {-2, -1, 0}, {-1, -2, 0}};
const std::vector<Position> through_the_floor = {{0, 4, -0.5}, {0.5, 4, 0.5}, {0, 4.5, 0.5}};

INSTANTIATE_TEST_SUITE_P(
    All, AnyQuestion,
    testing::Values(
        Question{"nothing_touches", {}, {}, 0}, Question{"contact", {20}, {}, 1},
        Question{"contact_at_a_border", {16, 17}, {}, 1},
        Question{"keep_going", {5, 16, 17, 32, 33, 38}, {"--keep-going"}, 1},
        Question{"few_reports", {5, 16, 32}, {"--keep-going", "--max-reports", "3"}, 1},
        Question{"no_reports", {5, 16, 32}, {"--keep-going", "--max-reports", "0"}, 1},
        Question{"first_only", {20}, {"--first-only"}, 1},
        Question{"distance_holds", {}, {"--min-distance", "0.01", "--min-distance-from-ring", "2"}, 0},
        Question{"distance_is_broken", {}, {"--min-distance", "1.1"}, 1},
        Question{"distance_is_broken_later", {35}, {"--min-distance", "0.01", "--min-distance-from-ring", "2"}, 1},
        Question{"distance_and_contacts", {5, 20}, {"--keep-going", "--min-distance", "1.1"}, 1},
        Question{
            "distance_unchecked", {}, {"--no-check", "--min-distance", "0.01", "--min-distance-from-ring", "2"}, 0},
        Question{"at_rest", {}, {"--static"}, 0}, Question{"strict", {}, {"--strict"}, 0},
        Question{"merged", {}, {"--merge-identical"}, 0, at_the_corner}, Question{"ignore", {20, 30}, {}, 0},
        Question{"only_new", {}, {"--only-new"}, 0, through_the_floor},
        Question{"only_new_and_contact", {20}, {"--only-new"}, 1, through_the_floor},
        Question{"space", {}, {"--dimension", "3"}, 0}),
    [](const auto& one) { return one.param.name; });

TEST_F(Shards, OfLongSequencesHaveTheAnswerOfOneProcess) {
  int tried = 0;
  for (const Sequence& sequence : untouched_sequences()) {
    if (sequence.frames.size() < 18) continue;
    const Words asked =
        joined(write_frames(sequence, [&](const auto& name, const auto& text) { return folder.write(name, text); }),
               sequence.options);
    const Process one = whole(asked);
    ASSERT_EQ(part(asked, "1/2").exit_code, 0) << sequence.name;
    ASSERT_EQ(part(asked, "2/2").exit_code, 0) << sequence.name;
    expect_same_answer(one, merge());
    fs::remove_all(shards());
    ++tried;
  }
  EXPECT_GE(tried, 2);
}

TEST_F(Shards, ProofsOfShardsAreAcceptedByBothCheckers) {
  const Words asked = write_motion(40);
  ASSERT_EQ(part(asked, "1/1").exit_code, 0);
  ASSERT_EQ(merge().exit_code, 0);
  EXPECT_EQ(run_noli(joined({"check", folder.path("all.noli")}, asked)).exit_code, 0);
  if (verified_checker_is_there()) {
    EXPECT_EQ(run_noli(joined({"check", "--verified", folder.path("all.noli")}, asked)).exit_code, 0);
  }
}

/// A merge that is killed leaves no proof in the way of the next one.
TEST_F(Shards, AMergeThatWasKilledIsRunAgain) {
  const Words asked = write_motion(40);
  const std::string proof = folder.path("all.noli");
  ASSERT_EQ(whole(asked).exit_code, 0);
  ASSERT_EQ(part(asked, "1/1").exit_code, 0);
  const auto is_whole = [&] { return bytes_of(proof) == bytes_of(folder.path("one.noli")); };
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(merge().exit_code, 0);
  const auto whole = std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - begin);
  for (int i = 0; i < 20; ++i) {
    fs::remove(proof);
    run_and_kill({"merge", shards(), "--proof", proof}, whole * i / 20);
    EXPECT_TRUE(!fs::exists(proof) || is_whole()) << "killed at " << i << " of 20";
  }
  const auto is_part = [](const auto& entry) { return entry.path().extension() == ".part"; };
  EXPECT_TRUE(std::ranges::any_of(fs::directory_iterator(folder.path("")), is_part)) << "none was killed in between";
}

/// So does one that is stopped, while it writes or while the checker reads.
TEST_F(Shards, AMergeThatWasStoppedIsRunAgain) {
  const Words asked = write_motion(40);
  const std::string proof = folder.path("all.noli");
  ASSERT_EQ(part(asked, "1/1").exit_code, 0);
  int stopped = 0;
  for (int limit = 1;; limit += limit / 4 + 1) {  // ms
    const Process process =
        run_noli({"merge", shards(), "--proof", proof, "--time-limit", std::to_string(limit) + "ms"});
    EXPECT_EQ(fs::exists(proof), process.exit_code == 0) << limit << process.out;
    if (process.exit_code != 2) {
      EXPECT_EQ(process.exit_code, 0) << process.err;
      break;
    }
    ++stopped;
  }
  EXPECT_GT(stopped, 0);
}

TEST_F(Shards, WithoutProofsGiveNoContact) {
  const Words asked = joined(write_motion(20), {"--no-check"});
  ASSERT_EQ(part(asked, "1/1").exit_code, 0);
  EXPECT_EQ(merge().exit_code, 3) << "a proof was asked for";
  const Process process = run_noli({"merge", shards()});
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_EQ(process.verdict_line().substr(0, 10), "NO CONTACT");
}

/// Without a proof, `noli merge` reads only the frames that it says something about.
class UnprovedShards : public Shards {
 protected:
  void expect_answer_of_one_process(const Words& frames, int exit_code) const {
    const Words asked = joined(frames, {"--keep-going", "--no-check"});
    const Process one = run_noli(joined({"verify", "--force", "--json", folder.path("one.json")}, asked));
    EXPECT_EQ(one.exit_code, exit_code) << one.err;
    EXPECT_EQ(part(asked, "1/1").exit_code, exit_code);
    const Process all = run_noli({"merge", shards(), "--force", "--json", folder.path("all.json")});
    expect_same_answer(one, all);
  }
};

TEST_F(UnprovedShards, HaveTheAnswerOfOneProcess) { expect_answer_of_one_process(write_motion(40), 0); }

TEST_F(UnprovedShards, HaveTheContactsOfOneProcess) {
  expect_answer_of_one_process(write_motion(60, {5, 16, 17, 32, 33, 34, 59}), 1);
}

TEST_F(UnprovedShards, SayWhereNothingMoves) {
  Words frames = write_motion(40);
  for (const std::size_t k : {std::size_t{3}, std::size_t{17}, std::size_t{39}}) {
    fs::copy_file(frames[k - 1], frames[k], fs::copy_options::overwrite_existing);
  }
  expect_answer_of_one_process(frames, 0);
  EXPECT_NE(bytes_of(folder.path("all.json")).find("nothing moves in step 39"), std::string::npos);
}

TEST_F(UnprovedShards, KnowThePolygonsOfAllFrames) {
  Words frames;
  for (int k = 0; k < 20; ++k) {
    const std::string bent = std::to_string(k == 18 ? 0.5 : 0.125);
    frames.push_back(folder.write("quad_" + std::to_string(k) + ".obj",
                                  "v 0 0 0\nv 1 0 0\nv 1 1 " + bent + "\nv 0 1 0\nf 1 2 3 4\n"));
  }
  expect_answer_of_one_process(frames, 0);
  EXPECT_NE(bytes_of(folder.path("all.json")).find("polygon"), std::string::npos);
  // The same cells, which only the frame in the middle has as a polygon.
  for (int k = 0; k < 20; ++k) {
    if (k == 10) continue;
    folder.write("quad_" + std::to_string(k) + ".obj", "v 0 0 0\nv 1 0 0\nv 1 1 0.125\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
  }
  fs::remove_all(shards());
  expect_answer_of_one_process(frames, 0);
  EXPECT_NE(bytes_of(folder.path("all.json")).find("1 polygon"), std::string::npos);
}

TEST_F(UnprovedShards, NameTheBodiesOfOneProcess) {
  for (int k = 0; k < 20; ++k) {
    const std::string z = k == 12 ? "-1" : "1";
    folder.write("body_" + std::to_string(k) + ".obj", "v 0 0 " + z + "\nv 1 0 " + z + "\nv 0 1 " + z + "\nf 1 2 3\n");
  }
  const std::string floor = folder.write("floor.obj", "v -9 -9 0\nv 9 -9 0\nv 0 9 0\nf 1 2 3\n");
  expect_answer_of_one_process({"--body", "body=" + folder.path("body_*.obj"), "--obstacle", floor}, 1);
}

TEST_F(Shards, AreNotMadeTwice) {
  const Words asked = write_motion(40);
  ASSERT_EQ(part(asked, "2/3").exit_code, 0);
  const auto before = fs::last_write_time(shard(2));
  const Process again = part(asked, "1/1");
  EXPECT_NE(again.out.find("2 of 3 tasks done now, 1 before"), std::string::npos) << again.out;
  EXPECT_EQ(fs::last_write_time(shard(2)), before);
}

TEST_F(Shards, BehindAContactAreNotNeeded) {
  const Words asked = write_motion(40, {3});
  const Process process = part(asked, "1/1");
  EXPECT_EQ(process.exit_code, 1);
  EXPECT_NE(process.verdict_line().find("1 of 3 tasks done now, 0 before, 2 not needed"), std::string::npos)
      << process.out;
  EXPECT_NE(process.verdict_line().find("something touches in step 3"), std::string::npos) << process.out;
  expect_same_answer(whole(asked), merge());
}

TEST_F(Shards, StoppedOnesGoOn) {
  const Words asked = write_motion(40);
  const Process stopped = part(joined(asked, {"--time-limit", "1ms"}), "1/1");
  EXPECT_EQ(stopped.exit_code, 2) << stopped.out;
  EXPECT_EQ(merge().exit_code, 3);
  EXPECT_EQ(part(asked, "1/1").exit_code, 0);
  expect_same_answer(whole(asked), merge());
}

using OrderedJson = nlohmann::ordered_json;  // as Noli compares them

class SpoiltShards : public Shards {
 protected:
  void SetUp() override {
    frames_ = write_motion(40);
    ASSERT_EQ(part(frames_, "1/1").exit_code, 0);
  }
  void try_heads() const;
  void expect_refused(const std::string& words) const {
    const Process process = merge();
    EXPECT_EQ(process.exit_code, 3) << process.out;
    EXPECT_NE(process.err.find(words), std::string::npos) << process.err;
    EXPECT_FALSE(fs::exists(folder.path("all.json")));
  }

  Words frames_;
};

TEST_F(SpoiltShards, AMissingOneIsNamed) {
  fs::remove(shard(2));
  expect_refused("task_000002.shard is missing (steps 17 to 32); run `noli verify --shard` again");
}

TEST_F(SpoiltShards, ADoubledOneIsNamed) {
  fs::copy_file(shard(1), shard(2), fs::copy_options::overwrite_existing);
  expect_refused("is the shard of another task than 2");
}

TEST_F(SpoiltShards, OneOfAnotherRequestIsNamed) {
  const std::string other = folder.path("other");
  ASSERT_EQ(run_noli(joined({"verify", "--shard", "2/3", "-o", other, "--strict"}, frames_)).exit_code, 0);
  fs::copy_file(other + "/task_000002.shard", shard(2), fs::copy_options::overwrite_existing);
  expect_refused("is a shard of another request");
}

TEST_F(SpoiltShards, OneOfOtherFramesIsNamed) {
  const std::string frame = bytes_of(frames_[20]);
  folder.write(fs::path(frames_[20]).filename().string(), frame + "\n");  // the same motion in other bytes
  expect_refused("is not the file that ");
}

TEST_F(SpoiltShards, OnesThatAreSpoiltOrOfOtherFramesAreMadeAgain) {
  folder.write("shards/task_000003.shard", "nothing");
  folder.write(fs::path(frames_[20]).filename().string(), bytes_of(frames_[20]) + "\n");
  const Process process = part(frames_, "1/1");
  EXPECT_NE(process.out.find("2 of 3 tasks done now, 1 before"), std::string::npos) << process.out;
  expect_same_answer(whole(frames_), merge());
}

/// Members of the head, replaced by every kind of value, with the right checksums: every seventh pair of these, all
/// with NOLI_EVERY_FAULT=1.
void SpoiltShards::try_heads() const {
  const std::vector<Block> blocks = blocks_of(shard(2));
  const OrderedJson head = OrderedJson::parse(blocks[0].payload);
  write_shard(shard(2), blocks);
  ASSERT_EQ(merge().exit_code, 0) << "nothing was changed";
  fs::remove(folder.path("all.json"));
  const std::vector<OrderedJson> values = {nullptr,
                                           true,
                                           -1,
                                           0,
                                           1,
                                           1e300,
                                           "x",
                                           OrderedJson::array(),
                                           OrderedJson::array({OrderedJson::array({0, 1 << 30})}),
                                           OrderedJson::object()};
  std::uint64_t tried = 0;
  const auto try_head = [&](const OrderedJson& other) {
    if (tried++ % trials(7, 1) != 0) return;
    std::vector<Block> changed = blocks;
    changed[0].payload = other.dump();
    write_shard(shard(2), changed);
    const Process process = merge();
    EXPECT_TRUE(process.exit_code == 0 || process.exit_code == 3) << other.dump().substr(0, 300) << process.err;
    EXPECT_EQ(process.err.find("internal error"), std::string::npos) << process.err;
  };
  for (const auto& item : head.items()) {
    for (const OrderedJson& value : values) {
      OrderedJson other = head;
      other[item.key()] = value;
      try_head(other);
    }
  }
  for (const auto& item : head["steps"][3].items()) {
    for (const OrderedJson& value : values) {
      OrderedJson other = head;
      other["steps"][3][item.key()] = value;
      try_head(other);
    }
  }
}

TEST_F(SpoiltShards, AnyHeadEndsInAnAnswerOrAMessage) { try_heads(); }

TEST_F(SpoiltShards, AnyHeadOfARunEndsInAnAnswerOrAMessage) {
  fs::remove_all(shards());
  WildRun(2, 3, 5).write(folder.path("run"), 36);
  ASSERT_EQ(part({folder.path("run")}, "1/1").exit_code, 0);
  try_heads();
}

/// Whoever changes a shard can change counts, but then the checker finds another claim than was asked.
TEST_F(SpoiltShards, OnesWithAnInventedIntersectionAreRefused) {
  change_head(shard(2), [](auto& head) {
    head["steps"][3]["initial_intersections"] = 1;
    head["touch"] = 19;
  });
  expect_refused("the shards do not match");
}

TEST_F(Shards, AContactThatIsNoneIsAFaultOfTheShards) {
  const Words asked = joined(write_motion(20, {5, 17}), {"--keep-going"});
  ASSERT_EQ(part(asked, "1/1").exit_code, 1);
  const auto sound = blocks_of(shard(1));
  const auto expect_refused = [&](const char* member) {
    change_head(shard(1), [&](auto& head) {
      auto& contact =
          std::string(member) == "first" ? head["steps"][4]["first"]["contact"] : head["steps"][4][member][0];
      contact[1] = {6, 0, 1, 2};  // a vertex of the sheet, and the floor
    });
    const Process process = merge();
    EXPECT_EQ(process.exit_code, 3) << process.out << process.err;
    EXPECT_NE(process.err.find("lists features that do not meet"), std::string::npos) << process.err;
    write_shard(shard(1), sound);
  };
  expect_refused("reports");
  expect_refused("first");
}

/// What no step has.
TEST_F(Shards, ContactsThatCannotBeAreAFaultOfTheShards) {
  ASSERT_EQ(part(joined(write_motion(20, {5, 17}), {"--keep-going"}), "1/1").exit_code, 1);
  const auto sound = blocks_of(shard(1));
  const auto expect_refused = [&](const char* why, const std::function<void(nlohmann::ordered_json&)>& change) {
    change_head(shard(1), [&](auto& head) { change(head["steps"][4]); });
    const Process process = merge();
    EXPECT_EQ(process.exit_code, 3) << why << process.out << process.err;
    EXPECT_NE(process.err.find(why), std::string::npos) << process.err;
    write_shard(shard(1), sound);
  };
  expect_refused("share a vertex", [](auto& step) { step["reports"][0][1] = {0, 0, 1, 2}; });
  expect_refused("ends before it begins",
                 [](auto& step) { step["first"]["contact"][2] = 1, step["first"]["contact"][3] = 0; });
  expect_refused("none is the first", [](auto& step) { step["first"] = nullptr; });
  expect_refused("ascending order", [](auto& step) {
    step["initial_intersections"] = 1;
    step["initial_reports"] = {{1, 1}};
  });
}

/// The first step of half a megabyte a step: the checker, which reads along with one thread, ends long before the
/// proof.
TEST_F(Shards, AProofThatIsRefusedEarlyIsAFaultOfTheShards) {
  ASSERT_EQ(part(write_waves(3), "1/1").exit_code, 0);
  std::vector<Block> blocks = blocks_of(shard(1));
  const auto tokens = std::ranges::find(blocks, four_letters("TOKS"), &Block::kind);
  ASSERT_NE(tokens, blocks.end());
  std::ranges::fill(tokens->payload, '\xff');
  write_shard(shard(1), blocks);
  for (const char* threads : {"1", "2"}) {
    const Process process = run_noli({"merge", shards(), "--threads", threads});
    EXPECT_EQ(process.exit_code, 3) << process.out << process.err;
    EXPECT_NE(process.err.find("the shards do not match"), std::string::npos) << process.err;
  }
}

TEST_F(SpoiltShards, WhatIsNoFileIsRefused) {
  fs::remove(shard(2));
  fs::create_directory(shard(2));
  expect_refused("task_000002.shard: is not a regular file");
  EXPECT_EQ(part(frames_, "1/1").exit_code, 3);
  fs::remove(shards() + "/request.json");
  ASSERT_EQ(::mkfifo((shards() + "/request.json").c_str(), 0600), 0);
  expect_refused("request.json: is not a regular file");
}

TEST_F(SpoiltShards, AreNotOverwrittenByTheAnswer) {
  const std::string before = bytes_of(shard(1));
  EXPECT_EQ(run_noli({"merge", shards(), "--force", "--json", shard(1)}).exit_code, 3);
  EXPECT_EQ(bytes_of(shard(1)), before);
}

TEST_F(SpoiltShards, FramesThatMovedAreNamed) {
  fs::copy_file(frames_[21], frames_[20], fs::copy_options::overwrite_existing);
  expect_refused("is not the file that");
}

TEST_F(SpoiltShards, OneOfAnotherVersionIsNamed) {
  const std::string file = shards() + "/request.json";
  Json request = Json::parse(bytes_of(file));
  request["noli"]["version"] = "0.0.1";
  folder.write("shards/request.json", request.dump(2));
  expect_refused("the shards are from Noli 0.0.1");
}

TEST_F(SpoiltShards, AnyLengthIsNoticed) {
  const std::string all = bytes_of(shard(2));
  for (std::size_t size = 0; size < all.size(); size += 1 + all.size() / 40) {
    folder.write("shards/task_000002.shard", all.substr(0, size));
    const Process process = merge();
    EXPECT_EQ(process.exit_code, 3) << size << process.out;
    EXPECT_NE(process.err.find("task_000002.shard"), std::string::npos) << process.err;
  }
}

/// No byte of a shard is without a check, and none gives another answer.
TEST_F(SpoiltShards, AnyByteIsNoticed) {
  const std::string all = bytes_of(shard(2));
  for (std::size_t at = 0; at < all.size(); at += 1 + all.size() / trials(60, all.size())) {
    std::string bytes = all;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
    folder.write("shards/task_000002.shard", bytes);
    const Process process = merge();
    EXPECT_EQ(process.exit_code, 3) << "byte " << at << process.out;
    if (at < block_format::file_header_size) continue;  // not a block file any more
    EXPECT_NE(process.err.find("run `noli verify --shard` again"), std::string::npos) << "byte " << at << process.err;
  }
}

TEST_F(SpoiltShards, AFolderOfAnotherRequestIsRefused) {
  const Process process = part(joined(frames_, {"--strict"}), "1/1");
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("differs in \"strict\""), std::string::npos) << process.err;
}

TEST_F(Shards, OfSomethingElseAreRefused) {
  EXPECT_EQ(part({write_motion(1)[0]}, "1/1").exit_code, 3);
  EXPECT_FALSE(fs::exists(shards())) << "a request that is refused leaves nothing";
  const Words frames = write_motion(3);
  for (const char* which : {"0/3", "4/3", "1", "1/0", "a/b", "1/3 "}) {
    EXPECT_EQ(part(frames, which).exit_code, 3) << which;
  }
  EXPECT_EQ(run_noli(joined({"verify", "--shard", "1/1"}, frames)).exit_code, 3) << "no folder";
  EXPECT_EQ(part(joined(frames, {"--json", folder.path("r.json")}), "1/1").exit_code, 3);
  EXPECT_EQ(part(joined(frames, {"--proof", folder.path("r.noli")}), "1/1").exit_code, 3);
  EXPECT_EQ(run_noli({"merge", folder.path("")}).exit_code, 3) << "no shards";
}

}  // namespace
}  // namespace noli::app_tests
