// SPDX-License-Identifier: Apache-2.0
//
// Tests parts of the steps (proofs/FORMAT.md, section 6): what is looked at, what is passed over, and what joins them.
#include "run_writer.h"
#include "support.h"

namespace noli::checker::test {
namespace {

using namespace token;

/// Two edges that come nearer in four steps.
Proof four_steps() {
  Proof proof = two_edges();
  for (const double x : {1.5, 1.25, 1.0}) {
    proof.frames.push_back(proof.frames[1]);
    for (const std::size_t v : {2u, 3u}) proof.frames.back()[v][0] = x;
  }
  proof.tokens.assign(4, proof.tokens[0]);
  proof.step.p = -2;
  return proof;
}

/// The blocks of the proof with others in one of its groups.
Verdict changed(const Proof& proof, std::size_t group, const std::function<void(Blocks&)>& change,
                const Fields& asked) {
  auto groups = proof.groups();
  change(groups.at(group));
  Proof other = proof;
  other.fields = asked;
  return other.check(block_file("PROF", groups));
}

TEST(Parts, AreAccepted) {
  const Proof proof = four_steps();
  EXPECT_EQ(proof.asked({"steps=1..1"}).words, "; steps 1..1");
  EXPECT_EQ(proof.asked({"steps=2..3"}).words, "; steps 2..3");
  EXPECT_EQ(proof.asked({"steps=3.."}).words, "; steps 3..4");
  EXPECT_EQ(proof.asked({"steps=1.."}).words, "; steps 1..4");
  EXPECT_EQ(proof.asked({"steps=4..4"}).code, 0);
}

TEST(Parts, OfMoreStepsThanThereAreAreNot) {
  const Proof proof = four_steps();
  EXPECT_REJECTED(proof.asked({"steps=3..5"}), "steps: the proof says 3..4, asked was 3..5; --require steps=3..4 asks");
  EXPECT_REJECTED(proof.asked({"steps=5.."}), "has none of the steps that are asked for");
  // An open end is that of the trajectory.
  Proof longer = proof;
  longer.frames.push_back(longer.frames.back());
  EXPECT_REJECTED(longer.asked({"steps=3.."}), "steps: the proof says 3..4, asked was all of them, and the trajectory");
  EXPECT_ACCEPTED(longer.asked({"steps=3..4"}));
}

TEST(Parts, AreAskedForInTwoWays) {
  for (const char* const words :
       {"0..1", "2..1", "..2", "..", "1.", "1..2..3", "1.2", "1...2", "1..x", "-1..2", "1..4294967296"}) {
    EXPECT_REJECTED(four_steps().asked({std::string("steps=") + words}), "expected a number that is possible there");
  }
}

TEST(Parts, DoNotLookAtTheTokensOfOthers) {
  for (const std::size_t bad : {0u, 1u, 2u, 3u}) {
    Proof proof = four_steps();
    proof.tokens[bad] = px;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::string only = "steps=" + std::to_string(k + 1) + ".." + std::to_string(k + 1);
      EXPECT_EQ(proof.asked({only}).code, k == bad ? 3 : 0) << only << ", bad: " << bad;
    }
  }
}

TEST(Parts, LookAtTheMotionOfTheStepBefore) {
  const Proof proof = four_steps();
  // The last byte of STEP is one of the hash.
  const auto spoil = [](Blocks& blocks) { blocks[0].second.back() ^= 1; };
  const char* const why = "the step is about another motion";
  EXPECT_REJECTED(changed(proof, 2, spoil, {"steps=3.."}), why);
  EXPECT_REJECTED(changed(proof, 2, spoil, {"steps=1..2"}), why);
  EXPECT_ACCEPTED(changed(proof, 2, spoil, {"steps=4.."}));
  EXPECT_ACCEPTED(changed(proof, 2, spoil, {"steps=1..1"}));
}

TEST(Parts, UseTheLastTreeBeforeThem) {
  const Proof proof = four_steps();
  const std::pair<std::string, std::string> other{"TREE", uint(0) + uint(2) + uint(1)}, bad{"TREE", uint(0)};
  const auto insert = [](const auto& block) {
    return [block](Blocks& blocks) { blocks.insert(blocks.begin() + 1, block); };
  };
  // The other way around the edges are apart along the other direction.
  EXPECT_REJECTED(changed(proof, 2, insert(other), {"steps=3.."}), "byte");
  Proof around = proof;
  around.tokens[2] = around.tokens[3] = N + F + px + F;
  EXPECT_REJECTED(around.asked({"steps=3.."}), "byte");
  EXPECT_ACCEPTED(changed(around, 2, insert(other), {"steps=3.."}));
  EXPECT_REJECTED(changed(proof, 2, insert(bad), {"steps=3.."}), "byte");
  EXPECT_ACCEPTED(changed(proof, 2, insert(bad), {"steps=1..1"}));
  EXPECT_ACCEPTED(changed(proof, 4, insert(bad), {"steps=1..3"}));
  EXPECT_REJECTED(changed(proof, 4, insert(bad), {"steps=1..4"}), "byte");
  EXPECT_REJECTED(changed(proof, 1, [](Blocks& blocks) { blocks.erase(blocks.begin() + 1); }, {"steps=2.."}),
                  "no tree");
}

TEST(Parts, PassOverStepsOfTheRightForm) {
  const Proof proof = four_steps();
  const auto replace = [](std::size_t at, const char* kind) { return [=](Blocks& b) { b.at(at).first = kind; }; };
  EXPECT_REJECTED(changed(proof, 2, replace(1, "TOKZ"), {"steps=3.."}), "expected a block TOKS");
  EXPECT_REJECTED(changed(proof, 2, replace(1, "WITN"), {"steps=3.."}), "expected a block TOKS");
  EXPECT_REJECTED(changed(proof, 4, replace(1, "TREE"), {"steps=4.."}), "byte");
  EXPECT_ACCEPTED(changed(proof, 4, replace(1, "TREE"), {"steps=1..2"}));
  const auto number = [](Blocks& blocks) { blocks[0].second[0] ^= 1; };
  for (const std::size_t group : {1u, 2u, 3u, 4u}) {
    EXPECT_REJECTED(changed(proof, group, number, {"steps=2..2"}), "a step has the wrong number");
  }
  const auto large = [](Blocks& blocks) { blocks[0].second[6] = 0x20; };
  EXPECT_REJECTED(changed(proof, 4, large, {"steps=2..2"}), "a number is too large");
}

TEST(Parts, DoNotOpenFramesFarBeforeThem) {
  const Proof proof = four_steps();
  const Folder folder;
  const std::string file = folder.write("proof", block_file("PROF", proof.groups()));
  const auto with_broken = [&](std::size_t broken, const char* steps) {
    const auto paths = proof.write_frames(folder);
    folder.write("f" + std::to_string(broken) + ".obj", "v broken\n");
    return verdict(file, paths, Fields{steps}).code;
  };
  EXPECT_EQ(with_broken(1, "steps=4.."), 0);
  EXPECT_EQ(with_broken(2, "steps=4.."), 3);  // where the step before begins
  EXPECT_EQ(with_broken(0, "steps=4.."), 3);  // has the cells
  EXPECT_EQ(with_broken(3, "steps=1..2"), 0);
  EXPECT_EQ(with_broken(2, "steps=1..2"), 3);
}

TEST(Parts, OfOneProofNameItAlike) {
  const Proof proof = four_steps();
  const Folder folder;
  const auto paths = proof.write_frames(folder);
  const auto whole = [&](const Proof& p, const std::vector<std::string>& fields) {
    Check check(folder.write("proof", block_file("PROF", p.groups())), paths, Asked(fields));
    EXPECT_EQ(check.go(), std::nullopt);
    return check.proof();
  };
  const auto name = whole(proof, {"steps=1..2"});
  EXPECT_EQ(whole(proof, {"steps=3.."}), name);
  Proof other = proof;
  other.tokens[0] = N + F + packed(-1, 0, 0) + F;  // the same direction in more bytes
  EXPECT_NE(whole(other, {"steps=3.."}), name);
}

TEST(Parts, HaveTheTimesOfTheirOwnSteps) {
  const Proof proof = four_steps();
  const Folder folder;
  const auto paths = proof.write_frames(folder);
  Check check(folder.write("proof", block_file("PROF", proof.groups())), paths, Asked({"steps=2..3"}));
  EXPECT_EQ(check.go(), std::nullopt);
  EXPECT_EQ(check.times(), (std::array<double, 2>{1, 3}));
  EXPECT_EQ(check.steps(), "2..3");
}

/// A witness that vertices 0 and 1 meet in the middle of step k.
std::string at_middle(int k) {
  return raw(0u) + raw(1u) + bytes({1}) + raw(0u) + poly({1}) + bytes({1}) + raw(1u) + poly({1}) +
         poly({-2 * k - 1, 2}) + uint(1) + sint(2 * k + 1) + sint(2 * k + 1);
}

/// The vertices 0 and 1 meet in the second step and in the third; in the fourth they are apart.
Proof meeting_twice() {
  Proof proof{{}, {{0}, {1}}};
  for (const double x : {4, 0, 0, 3, 3}) proof.frames.push_back({{0, 0, 0}, {x, 0, 0}});
  proof.frames[3][1][0] = 3;
  proof.tokens = {"", "", "", N + F + mx + F};
  proof.witness = {at_begin(0, 1, 0), at_begin(0, 1, 1), at_begin(0, 1, 2), ""};
  proof.frames[0][1][0] = 0;
  return proof;
}

TEST(Parts, AreRefutedByTheirOwnWitnesses) {
  const Proof proof = meeting_twice();
  EXPECT_VERDICT(proof.asked({}), 1, "in step 1");
  EXPECT_VERDICT(proof.asked({"steps=1..1"}), 1, "in step 1");
  EXPECT_VERDICT(proof.asked({"steps=2..3"}), 1, "in step 2");
  EXPECT_VERDICT(proof.asked({"steps=3.."}), 1, "in step 3");
  EXPECT_VERDICT(proof.asked({"steps=4.."}), 0, "; steps 4..4");
}

/// Printed steps tell that parts leave a gap: the second step, whose witness refutes frames in motion alone.
TEST(Parts, OfFramesAtRestEndBeforeAWitnessOfMotion) {
  Proof proof = meeting_twice();
  for (const std::size_t k : {0u, 1u, 2u}) proof.frames[k][1][0] = k == 2 ? -4 : 4;  // meets within step 2
  proof.frames[3][1][0] = proof.frames[4][1][0] = 4;
  proof.tokens = {N + F + mx + F, "", "", N + F + mx + F};
  proof.witness = {"", at_middle(1), at_middle(2), ""};
  EXPECT_VERDICT(proof.asked({}), 1, "in step 2");
  EXPECT_EQ(proof.asked({"motion=rest", "steps=1..2"}).words, "; steps 1..1");
  EXPECT_EQ(proof.asked({"motion=rest", "steps=4.."}).words, "; steps 4..4");
  EXPECT_EQ(proof.asked({"motion=rest"}).code, 3);
}

TEST(Parts, HaveMergedVerticesAndPlanesOfTheirOwn) {
  Proof proof = four_steps();
  proof.claim.dimension = 3;
  for (std::size_t v = 0; v < 4; ++v) {
    for (const std::size_t k : {0u, 1u, 2u, 3u, 4u}) proof.frames[k][v][2] = 0;
  }
  for (const std::size_t k : {0u, 1u, 2u, 3u, 4u}) {
    proof.frames[k][2][1] = -1;
    proof.frames[k][3][1] = 1;
  }
  proof.frames[0][0][2] = 1;  // only the first step is not flat
  EXPECT_ACCEPTED(proof.asked({"steps=2..", "dimension=2"}));
  EXPECT_REJECTED(proof.asked({"steps=1..", "dimension=2"}), "the claim: dimension");
}

TEST(Parts, LackStepsOnlyAfterTheirOwnWitness) {
  const Proof proof = meeting_twice();
  auto groups = proof.groups();
  groups.erase(groups.begin() + 3);  // the third step
  const auto asked = [&](const char* steps) {
    Proof other = proof;
    other.fields = Fields{steps};
    return other.check(block_file("PROF", groups));
  };
  EXPECT_VERDICT(asked("steps=1.."), 1, "in step 1");
  EXPECT_VERDICT(asked("steps=2.."), 1, "in step 2");
  EXPECT_REJECTED(asked("steps=3.."), "a step that is asked for is missing before this one");
  EXPECT_ACCEPTED(asked("steps=4.."));
}

TEST(Parts, OfAWitnessThatRefutesAnotherClaimAreNotAccepted) {
  Proof proof = meeting_twice();
  proof.claim.eta = 1;
  proof.frames[0][1][0] = 1;  // too near, and apart
  proof.frames[1][1][0] = 1;
  EXPECT_REJECTED(proof.asked({"steps=1..1"}), "distance: the witness in step 1 says 1, asked was 0");
  EXPECT_VERDICT(proof.asked({"steps=1..1", "distance=1"}), 1, "in step 1");
}

TEST(Parts, OfFramesAtRest) {
  Proof proof = four_steps();
  proof.claim.source = 1;
  EXPECT_EQ(proof.asked({"motion=rest", "steps=2..3"}).words, "; frames at rest; steps 2..3");
  EXPECT_EQ(proof.asked({"motion=rest", "steps=4..4"}).words, "; frames at rest; steps 4..4");
  EXPECT_REJECTED(proof.asked({"motion=rest", "steps=4.."}), "and the trajectory goes on");
  for (const std::size_t bad : {0u, 1u, 2u, 3u}) {
    Proof other = proof;
    other.tokens[bad] = px;
    EXPECT_EQ(other.asked({"motion=rest", "steps=2..3"}).code, bad == 1 || bad == 2 ? 3 : 0);
  }
  // Frames in motion over the steps 2 to 4 cover the frames 2 to 5 at rest, counted from 1.
  EXPECT_ACCEPTED(four_steps().asked({"motion=rest", "steps=2..5"}));
  EXPECT_REJECTED(four_steps().asked({"motion=rest", "steps=2..6"}), "steps: the proof says 2..4, asked was 2..6");
}

TEST(Parts, OfFramesInMotionAreRefutedByFramesAtRest) {
  Proof rest = meeting_twice();
  rest.claim.source = 1;
  rest.witness = {"", "", at_begin(0, 1, 0)};  // frame 2, from 0: the end of step 2 and the beginning of step 3, from 1
  rest.frames[0][1][0] = rest.frames[1][1][0] = 4;
  rest.tokens = {N + F + mx + F, N + F + mx + F};
  EXPECT_VERDICT(rest.asked({"steps=2..2"}), 1, "in step 3");
  EXPECT_VERDICT(rest.asked({"steps=3..3"}), 1, "in step 3");
  EXPECT_EQ(rest.asked({"steps=1..1"}).code, 3);
  EXPECT_EQ(rest.asked({"steps=1..1", "motion=rest"}).code, 0);
}

TEST(Parts, OfABlockFileOfFrames) {
  const Proof proof = four_steps();
  std::string mesh = raw(std::array<std::uint64_t, 4>{4, 0, 2, 0});
  for (const auto& cell : proof.cells) mesh += raw(cell[0]) + raw(cell[1]);
  std::vector<Blocks> groups = {{{"MESH", mesh}}};
  for (std::size_t i = 0; i < proof.frames.size(); ++i) {
    std::string x;
    for (const auto& p : proof.frames[i]) x += raw(p);
    groups.push_back({{"FRAM", raw(static_cast<double>(i)) + x}});
  }
  const Folder folder;
  const std::string file = folder.write("proof", block_file("PROF", proof.groups())),
                    frames = folder.write("frames", block_file("FRMS", groups));
  EXPECT_EQ(verdict(file, {frames}, Fields{"steps=3.."}).words, "; steps 3..4");
  EXPECT_EQ(verdict(file, {frames}, Fields{"steps=2..3"}).words, "; steps 2..3");
  groups.resize(4);
  EXPECT_EQ(verdict(file, {folder.write("short", block_file("FRMS", groups))}, Fields{"steps=4.."}).code, 3);
}

/// A run of three equal windows.
RunProof three_windows() {
  RunProof proof;
  for (int k = 1; k < 3; ++k) {
    proof.run.windows.push_back(proof.run.windows[0]);
    proof.run.times.push_back(2.0 * k + 2);
    for (auto& line : proof.run.windows.back()) {
      for (double& t : line.times) t += 2.0 * k;
    }
    proof.tokens.push_back(proof.tokens[0]);
  }
  return proof;
}

TEST(Parts, OfARun) {
  RunProof proof = three_windows();
  const auto asked = [&](const char* steps) {
    proof.fields = Fields{steps};
    return proof.check();
  };
  EXPECT_EQ(asked("steps=2..2").words, "; steps 2..2");
  EXPECT_EQ(asked("steps=3..").words, "; steps 3..3");
  proof.tokens[0] = px;
  EXPECT_REJECTED(asked("steps=1..2"), "byte");
  EXPECT_ACCEPTED(asked("steps=2.."));
  // All windows before a part are read, and have to go on from each other.
  proof.run.windows[1][2].x[0] = {9, 0, -1};
  EXPECT_REJECTED(asked("steps=3.."), "a vertex does not begin where it was");
}

}  // namespace
}  // namespace noli::checker::test
