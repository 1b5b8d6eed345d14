// SPDX-License-Identifier: Apache-2.0
//
// Tests requirements on a proof (proofs/FORMAT.md, section 6): each field both ways, for claims and for witnesses.
#include "run_writer.h"
#include "support.h"

namespace noli::checker::test {
namespace {

using namespace token;

/// Two edges that pass each other, in three frames.
Proof three_frames() {
  Proof proof = two_edges();
  proof.frames.push_back(proof.frames[1]);
  proof.tokens.push_back(proof.tokens[0]);
  return proof;
}
/// Loose points 0 and 1 meet at the beginning of their motion.
Proof meeting() {
  Proof proof{{{{0, 0, 0}, {0, 0, 0}}, {{0, 0, 0}, {4, 0, 0}}}, {{0}, {1}}};
  proof.tokens.clear();
  return proof;
}
Proof refuted(Proof proof) {
  proof.witness = {at_begin(0, 1)};
  return proof;
}

std::string in_hex(const std::string& hash) {
  std::string text;
  for (const char byte : hash) {
    for (const int digit : {static_cast<unsigned char>(byte) / 16, static_cast<unsigned char>(byte) % 16})
      text += "0123456789abcdef"[digit];
  }
  return "cells=" + text;
}

/// Requires this number of merged vertices and the proof's cells.
std::vector<std::string> merging(const Proof& proof, int merged, std::vector<std::string> more = {}) {
  more.push_back("merged=" + std::to_string(merged));
  more.push_back(in_hex(hash_of_cells(proof.frames[0].size(), proof.listed(), proof.labels)));
  return more;
}

TEST(Asked, OfFramesTheirMotion) {
  Proof rest = two_edges();
  rest.claim.source = 1;
  rest.tokens.push_back(rest.tokens[0]);
  EXPECT_REJECTED(rest.asked({}),
                  "the claim: motion: the proof says rest, asked was linear; --require motion=rest asks for that");
  EXPECT_REJECTED(rest.asked({"motion=linear"}), "the claim: motion");
  EXPECT_REJECTED(rest.asked({"motion=run"}), "the claim: motion");
  EXPECT_VERDICT(rest.asked({"motion=rest"}), 0, "; frames at rest");
  EXPECT_ACCEPTED(two_edges().asked({}));
  EXPECT_ACCEPTED(two_edges().asked({"motion=rest"}));
  EXPECT_REJECTED(two_edges().asked({"motion=run"}), "the claim: motion");
  EXPECT_ACCEPTED(RunProof{.fields = Fields{}}.check());
  EXPECT_ACCEPTED(RunProof{.fields = Fields{"motion=run"}}.check());
  EXPECT_REJECTED(RunProof{.fields = Fields{"motion=linear"}}.check(), "the claim: motion");
  EXPECT_REJECTED(RunProof{.fields = Fields{"motion=rest"}}.check(), "the claim: motion");
}

TEST(Asked, OfWitnessesTheirMotion) {
  Proof proof = refuted(meeting());
  EXPECT_VERDICT(proof.asked({}), 1, "meet");
  EXPECT_REJECTED(proof.asked({"motion=rest"}), "motion: the witness in step 1 says linear, asked was rest");
  // No step is proved, so no frames are proved either.
  EXPECT_REJECTED(proof.asked({"motion=rest", "steps=1"}), "motion: the witness in step 1 says linear, asked was rest");
  EXPECT_REJECTED(proof.asked({"motion=run"}), "the claim: motion");
  proof.claim.source = 1;
  EXPECT_VERDICT(proof.asked({}), 1, "meet");
  EXPECT_VERDICT(proof.asked({"motion=rest"}), 1, "meet");
  EXPECT_REJECTED(proof.asked({"motion=run"}), "the claim: motion");
}

/// Edges that are apart in the plane, the second one above the first.
Proof above() {
  Proof proof = two_edges();
  for (auto& frame : proof.frames) {
    for (auto& x : frame) x[2] = 0;
    frame[2][1] = -1;
    frame[3][1] = 1;
  }
  return proof;
}

TEST(Asked, TheDimension) {
  Proof proof = above();
  for (const int dimension : {2, 3}) {
    proof.claim.dimension = dimension;
    for (const char* const asked : {"dimension=2", "dimension=3"}) EXPECT_ACCEPTED(proof.asked({asked}));
  }
  // Each frame lies in a plane of its own.
  for (auto& x : proof.frames[1]) x[2] = 7;
  EXPECT_ACCEPTED(proof.asked({"dimension=2"}));
  for (const std::size_t frame : {0u, 1u}) {
    for (const std::size_t v : {0u, 1u, 2u, 3u}) {
      Proof uneven = proof;
      uneven.frames[frame][v][2] += 1;
      EXPECT_ACCEPTED(uneven.asked({}));
      EXPECT_REJECTED(uneven.asked({"dimension=2"}), "dimension: the proof says 3, asked was 2");
      uneven.claim.dimension = 2;
      EXPECT_ACCEPTED(uneven.asked({}));
      EXPECT_ACCEPTED(uneven.asked({"dimension=2"}));
    }
  }
  // One step outside the plane is enough.
  proof = above();
  proof.frames = {proof.frames[0], proof.frames[0], proof.frames[0], proof.frames[0]};
  proof.tokens.assign(3, proof.tokens[0]);
  EXPECT_ACCEPTED(proof.asked({"dimension=2"}));
  proof.frames[3][0][2] = 1;
  EXPECT_REJECTED(proof.asked({"dimension=2"}), "the claim: dimension");
  proof.frames[3][0][2] = 0;
  proof.frames[0][0][2] = 1;
  EXPECT_REJECTED(proof.asked({"dimension=2"}), "the claim: dimension");
}

TEST(Asked, InThePlaneMergedVerticesNeedNotBeWhereTheOtherIs) {
  Proof proof = above();
  for (auto& frame : proof.frames) frame.push_back(frame[0]);
  proof.cells.push_back({1, 4});
  proof.cells_after = {{0, 1}, {2, 3}};
  proof.claim.dimension = 2;
  proof.claim.merged = {{4, 0}};
  EXPECT_ACCEPTED(proof.asked(merging(proof, 1)));
  for (auto& frame : proof.frames) frame[4][2] = 1;
  EXPECT_REJECTED(proof.asked(merging(proof, 1)), "dimension: the proof says 2, asked was 3");
  EXPECT_ACCEPTED(proof.asked(merging(proof, 1, {"dimension=2"})));
}

TEST(Asked, OfWitnessesTheirDimension) {
  Proof proof = refuted(meeting());
  EXPECT_VERDICT(proof.asked({"dimension=2"}), 1, "meet");
  proof.claim.dimension = 2;
  EXPECT_VERDICT(proof.asked({}), 1, "meet");
  for (const std::size_t frame : {0u, 1u}) {
    Proof uneven = proof;
    uneven.frames[frame][1][2] = 5;
    EXPECT_REJECTED(uneven.asked({}), "dimension: the witness in step 1 says 2, asked was 3; --require dimension=2");
    EXPECT_VERDICT(uneven.asked({"dimension=2"}), 1, "; z does not count");
  }
}

TEST(Asked, Steps) {
  const Proof proof = three_frames();
  Proof one = proof;
  one.tokens.pop_back();
  EXPECT_REJECTED(one.asked({}), "steps: the proof says 1, asked was all of them");
  EXPECT_REJECTED(one.asked({"steps=2"}), "steps: the proof says 1, asked was 2; --require steps=1 asks for that");
  EXPECT_VERDICT(one.asked({"steps=1"}), 0, "; the first 1 steps");
  // Later frames are not read.
  one.frames[2].pop_back();
  EXPECT_ACCEPTED(one.asked({"steps=1"}));
  EXPECT_ACCEPTED(proof.asked({"steps=1"}));
  EXPECT_VERDICT(proof.asked({"steps=2"}), 0, "");
  EXPECT_EQ(proof.asked({"steps=2"}).words, "");
  EXPECT_REJECTED(proof.asked({"steps=3"}), "the claim: steps");
  // Three frames at rest.
  EXPECT_ACCEPTED(proof.asked({"steps=3", "motion=rest"}));
  EXPECT_REJECTED(proof.asked({"steps=4", "motion=rest"}), "the claim: steps");
  Proof rest = proof;
  rest.claim.source = 1;
  EXPECT_REJECTED(rest.asked({"steps=3", "motion=rest"}), "the claim: steps");
  EXPECT_VERDICT(rest.asked({"steps=2", "motion=rest"}), 0, "; frames at rest; the first 2 steps");
  EXPECT_REJECTED(rest.asked({"motion=rest"}), "the claim: steps");
}

TEST(Asked, StepsOfARun) {
  RunProof proof;
  proof.run.windows.push_back(proof.run.windows[0]);
  proof.run.times.push_back(4);
  for (auto& line : proof.run.windows[1]) {
    for (double& t : line.times) t += 2;
  }
  proof.tokens.push_back(proof.tokens[0]);
  proof.fields = Fields{"steps=2"};
  EXPECT_ACCEPTED(proof.check());
  EXPECT_EQ(proof.check().words, "");
  proof.fields = Fields{"steps=3"};
  EXPECT_REJECTED(proof.check(), "the claim: steps");
  proof.steps = 1;
  proof.fields = Fields{"steps=2"};
  EXPECT_REJECTED(proof.check(), "the claim: steps");
  proof.fields = Fields{"steps=1"};
  EXPECT_VERDICT(proof.check(), 0, "; the first 1 steps");
}

/// The vertices 0 and 1 meet in the second step.
Proof meeting_later() {
  Proof proof{{}, {{0}, {1}}};
  for (const double x : {4, 3, 0, 0}) proof.frames.push_back({{0, 0, 0}, {x, 0, 0}});
  proof.tokens = {N + F + mx + F};
  proof.witness = {"", at_begin(0, 1, 2)};
  return proof;
}

TEST(Asked, OfWitnessesTheirStep) {
  const Proof proof = meeting_later();
  EXPECT_VERDICT(proof.asked({}), 1, "in step 2");
  EXPECT_VERDICT(proof.asked({"steps=2"}), 1, "in step 2");
  EXPECT_VERDICT(proof.asked({"steps=3"}), 1, "in step 2");
  EXPECT_VERDICT(proof.asked({"steps=1"}), 0, "; the first 1 steps");
  // Frame 2, from 0, at rest ends the second step.
  Proof rest = proof;
  rest.claim.source = 1;
  rest.tokens = {N + F + mx + F, N + F + mx + F};
  rest.witness = {"", "", at_begin(0, 1)};
  EXPECT_VERDICT(rest.asked({}), 1, "in step 3");
  EXPECT_VERDICT(rest.asked({"steps=2"}), 1, "in step 3");
  EXPECT_REJECTED(rest.asked({"steps=1"}), "the claim: motion");
  EXPECT_VERDICT(rest.asked({"steps=3", "motion=rest"}), 1, "in step 3");
  EXPECT_VERDICT(rest.asked({"steps=2", "motion=rest"}), 0, "; frames at rest; the first 2 steps");
}

TEST(Asked, AWitnessThatDoesNotCountHidesNone) {
  Proof proof = meeting_later();
  proof.claim.eta = 4;
  proof.tokens.clear();
  proof.witness = {at_begin(0, 1), at_begin(0, 1, 2)};
  EXPECT_VERDICT(proof.asked({}), 1, "in step 2, vertices {0} of cell 0 and {1} of cell 1 meet");
  EXPECT_VERDICT(proof.asked({"distance=4"}), 1, "in step 1");
  proof.witness.pop_back();
  EXPECT_REJECTED(proof.asked({}), "distance: the witness in step 1 says 4, asked was 0");
  EXPECT_REJECTED(proof.asked({"steps=1"}), "distance: the witness in step 1");
}

/// An edge whose ends stay apart, with a strict claim.
Proof one_strict_edge() {
  const Points x = {{0, 0, 0}, {4, 0, 0}};
  Proof proof{{x, x}, {{0, 1}}};
  proof.tokens = {B + D(0) + D(0) + none + px + D(0) + mx + none};
  proof.claim.flags = 1;
  return proof;
}

TEST(Asked, FeaturesOfOneCell) {
  const Proof proof = two_edges();
  EXPECT_REJECTED(proof.asked({"strict"}), "strict: the proof says 0, asked was 1; --require strict=0 asks for that");
  EXPECT_REJECTED(proof.asked({"strict=1"}), "the claim: strict");
  EXPECT_ACCEPTED(proof.asked({"strict=0"}));
  EXPECT_ACCEPTED(one_strict_edge().asked({"strict"}));
  EXPECT_REJECTED(one_strict_edge().asked({}), "the claim: empty");
  Proof witness{{{{0, 0, 0}, {3, 0, 0}}, {{3, 0, 0}, {0, 0, 0}}}, {{0, 1}}};
  witness.claim.flags = 1;
  witness.tokens.clear();
  witness.witness = {raw(0u) + raw(0u) + bytes({1}) + raw(0u) + poly({1}) + bytes({1}) + raw(1u) + poly({1}) +
                     poly({-1, 2}) + uint(1) + sint(1) + sint(1)};
  EXPECT_VERDICT(witness.asked({"strict"}), 1, "; features of one cell count");
  EXPECT_REJECTED(witness.asked({}),
                  "strict: the witness in step 1 says 1, asked was 0; --require strict=1 asks for that");
}

TEST(Asked, VerticesWithoutACell) {
  Proof proof = two_edges();
  EXPECT_REJECTED(proof.asked({"points"}), "points: the proof says 0, asked was 1; --require points=0 asks for that");
  proof.claim.flags = 2;
  EXPECT_ACCEPTED(proof.asked({"points"}));
  EXPECT_ACCEPTED(proof.asked({}));
  Proof witness = refuted(meeting());
  witness.cells = {{0}};
  witness.cells_after = {{0}, {1}};
  witness.claim.flags = 2;
  EXPECT_VERDICT(witness.asked({"points"}), 1, "; vertices without a cell count");
  EXPECT_REJECTED(witness.asked({}), "points: the witness in step 1 says 1, asked was 0");
  witness.cells = {{1}};
  witness.cells_after = {{1}, {0}};
  witness.witness = {at_begin(1, 0)};
  EXPECT_REJECTED(witness.asked({}), "the claim: points");
  // Vertices 0 and 1 are both listed points; only an unlisted vertex makes a difference.
  witness = refuted(meeting());
  witness.claim.flags = 2;
  EXPECT_VERDICT(witness.asked({}), 1, "meet");
}

TEST(Asked, TheLeastDistance) {
  Proof proof = two_edges();
  EXPECT_REJECTED(proof.asked({"distance=0.5"}), "distance: the proof says 0, asked was 0.5; --require distance=0 ");
  proof.claim.eta = 1;
  EXPECT_ACCEPTED(proof.asked({}));
  EXPECT_ACCEPTED(proof.asked({"distance=0.5"}));
  EXPECT_ACCEPTED(proof.asked({"distance=1"}));
  EXPECT_REJECTED(proof.asked({"distance=1.0000000000000002"}), "the claim: distance");
}

TEST(Asked, OfWitnessesTheirDistance) {
  Proof proof = refuted(meeting());
  proof.claim.eta = 2;
  EXPECT_VERDICT(proof.asked({}), 1, "meet");
  EXPECT_EQ(proof.asked({}).words.find("distance"), std::string::npos);
  proof.frames[0][1][0] = 1;
  EXPECT_REJECTED(proof.asked({}),
                  "distance: the witness in step 1 says 2, asked was 0; --require distance=2 asks for that");
  EXPECT_REJECTED(proof.asked({"distance=1.5"}), "the claim: distance");
  EXPECT_VERDICT(proof.asked({"distance=2"}), 1, "are too near; least distance 2, ring 1");
  EXPECT_VERDICT(proof.asked({"distance=3"}), 1, "too near");
}

TEST(Asked, TheRing) {
  Proof proof = two_edges();
  proof.claim.eta = 1;
  proof.claim.ring = 3;
  EXPECT_ACCEPTED(proof.asked({}));
  EXPECT_REJECTED(proof.asked({"distance=1"}), "ring: the proof says 3, asked was 1; --require ring=3 asks for that");
  EXPECT_REJECTED(proof.asked({"distance=1", "ring=2"}), "the claim: ring");
  EXPECT_ACCEPTED(proof.asked({"distance=1", "ring=3"}));
  EXPECT_ACCEPTED(proof.asked({"distance=1", "ring=4"}));
  Proof witness = refuted(meeting());
  witness.claim.eta = 2;
  witness.claim.ring = 2;
  EXPECT_VERDICT(witness.asked({"distance=2", "ring=3"}), 1, "meet");
  witness.frames[0][1][0] = 1;
  EXPECT_REJECTED(witness.asked({"distance=2", "ring=3"}), "ring: the witness in step 1 says 2, asked was 3");
  EXPECT_VERDICT(witness.asked({"distance=2", "ring=2"}), 1, "too near");
  EXPECT_VERDICT(witness.asked({"distance=2"}), 1, "too near");
}

TEST(Asked, MergedVertices) {
  Proof proof = two_edges();
  for (auto& frame : proof.frames) frame.push_back(frame[0]);
  proof.cells.push_back({1, 4});
  proof.cells_after = {{0, 1}, {2, 3}};
  proof.claim.merged = {{4, 0}};
  EXPECT_REJECTED(proof.asked({}), "merged: the proof says 1, asked was 0; --require merged=1 --require cells=");
  EXPECT_REJECTED(proof.asked({"merged=1"}), "only the cells say which are merged: expected cells=HASH too");
  EXPECT_VERDICT(proof.asked(merging(proof, 1)), 0, "; 1 merged vertices");
  EXPECT_ACCEPTED(proof.asked(merging(proof, 2)));
  EXPECT_ACCEPTED(two_edges().asked(merging(two_edges(), 2)));
  Proof witness = refuted(meeting());
  EXPECT_REJECTED(witness.asked(merging(witness, 1)), "merged: the witness in step 1 says 0, asked was 1");
  for (auto& frame : witness.frames) frame.push_back(frame[0]);
  witness.cells = {{0}, {1}, {2}};
  witness.cells_after = {{0}, {1}};
  witness.claim.merged = {{2, 0}};
  EXPECT_VERDICT(witness.asked({}), 1, "meet");
  EXPECT_VERDICT(witness.asked(merging(witness, 1)), 1, "meet");
  EXPECT_REJECTED(witness.asked(merging(witness, 2)), "the claim: merged");
}

TEST(Asked, PairsOfLabelsThatAreNotCompared) {
  Proof proof = two_edges();
  proof.labels = {3, 5};
  const std::string cells = in_hex(hash_of_cells(4, proof.cells, proof.labels));
  const std::string other = in_hex(hash_of_cells(4, proof.cells, {5, 3}));
  EXPECT_ACCEPTED(proof.asked({}));
  EXPECT_ACCEPTED(proof.asked({"excluded=3-3,3-5", cells}));
  proof.claim.excluded = {{3, 3}, {5, 5}};
  EXPECT_REJECTED(proof.asked({}),
                  "excluded: the proof says 3-3,5-5, asked was nothing; --require excluded=3-3,5-5 --require " + cells);
  EXPECT_REJECTED(proof.asked({"excluded="}), "the claim: excluded");
  EXPECT_REJECTED(proof.asked({"excluded=3-3", cells}), "the claim: excluded");
  EXPECT_REJECTED(proof.asked({"excluded=3-3,5-6", cells}), "the claim: excluded");
  EXPECT_VERDICT(proof.asked({"excluded=3-3,5-5", cells}), 0, "; not compared: 3-3,5-5");
  EXPECT_VERDICT(proof.asked({"excluded=3-3", cells, "excluded=5-5"}), 0, "; not compared: 3-3,5-5");
  EXPECT_REJECTED(proof.asked({"excluded=5-5", "excluded=3-3", cells}), "in ascending order");
  EXPECT_REJECTED(proof.asked({"excluded=3-3,5-5", "excluded=5-5", cells}), "in ascending order");
  EXPECT_ACCEPTED(proof.asked({"excluded=3-3,3-5,5-5", cells}));
  EXPECT_REJECTED(proof.asked({"excluded=3-3,5-5", other}), "the claim: cells");
  proof.claim.excluded.clear();
  for (std::uint32_t a = 6; a < 15; ++a) proof.claim.excluded.push_back({a, a});
  EXPECT_VERDICT(proof.check(), 0, "; not compared: 9 pairs");
  proof.claim.excluded.pop_back();
  EXPECT_VERDICT(proof.check(), 0, "; not compared: 6-6,7-7,8-8,9-9,10-10,11-11,12-12,13-13");
}

TEST(Asked, OfWitnessesTheirLabels) {
  Proof proof = refuted(meeting());
  proof.labels = {5, 3};
  const std::string cells = in_hex(hash_of_cells(2, proof.cells, proof.labels));
  EXPECT_VERDICT(proof.asked({}), 1, "meet");
  EXPECT_VERDICT(proof.asked({cells}), 1, "meet");
  EXPECT_REJECTED(proof.asked({in_hex(hash_of_cells(2, proof.cells, {3, 5}))}), "the claim: cells");
  EXPECT_VERDICT(proof.asked({"excluded=3-3,5-5", cells}), 1, "meet");
  EXPECT_REJECTED(proof.asked({"excluded=3-5", cells}), "excluded: the witness in step 1 says ");
}

TEST(Asked, OfARunThePairsOfItsScene) {
  RunProof proof;
  proof.run.pairs = {{2, 3}};
  proof.run.groups = {2, 2, 3, 3};
  proof.labels = {4, 6};
  proof.claim.excluded = {{4, 6}};
  proof.fields = Fields{"empty"};
  EXPECT_ACCEPTED(proof.check());
  EXPECT_EQ(proof.check().words, "; the claim is empty");
  proof.fields = Fields{"empty", "excluded="};
  EXPECT_REJECTED(proof.check(), "the claim: excluded");
  proof.fields = Fields{"empty", "excluded=4-6", in_hex(hash_of_cells(4, proof.run.cells, proof.labels))};
  EXPECT_ACCEPTED(proof.check());
}

TEST(Asked, ARunOfItsOwnDimension) {
  RunProof proof;
  for (const char* const asked : {"dimension=3", "strict=0"}) {
    proof.fields = Fields{asked};
    EXPECT_ACCEPTED(proof.check());
  }
  proof.fields = Fields{"dimension=2"};
  EXPECT_REJECTED(proof.check(), "the claim: dimension");
  proof.run.dimension = 2;
  for (const char* const asked : {"dimension=3", "dimension=2", "strict=0"}) {
    proof.fields = Fields{asked};
    EXPECT_ACCEPTED(proof.check());
  }
}

TEST(Asked, EmptyClaims) {
  const Points x = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const auto of = [&](const Lists& cells, const std::string& tokens, const ClaimFields& claim = {}) {
    Proof proof{{x, x}, cells};
    proof.tokens = {tokens};
    proof.claim = claim;
    return proof;
  };
  const auto is_empty = [](const Proof& proof) {
    EXPECT_REJECTED(proof.asked({}), "empty: the proof says 1, asked was 0; --require empty=1 asks for that");
    EXPECT_VERDICT(proof.asked({"empty"}), 0, "; the claim is empty");
  };
  const auto is_not = [](const Proof& proof) {
    EXPECT_ACCEPTED(proof.asked({}));
    EXPECT_EQ(proof.asked({"empty"}).words, "");
  };
  const auto is_not_where_strict_is_asked = [](const Proof& proof) {
    EXPECT_REJECTED(proof.asked({}), "empty: the proof says 1, asked was 0; --require strict=1 asks for that");
    EXPECT_ACCEPTED(proof.asked({"strict"}));
    EXPECT_EQ(proof.asked({"strict", "empty"}).words, "");
  };
  is_empty(of({{0, 1, 2}}, F));
  is_empty(of({{0}}, F));
  is_not(of({{0}, {1}}, N + F + mx + F));
  // Two degenerate faces of one vertex; then one of them with another vertex.
  is_empty(of({{1, 1, 1}, {1, 1, 1}}, N + F + D(0) + none + none + F));
  is_not(of({{1, 1, 1}, {0}}, N + F + px + F));
  // One cell is compared with itself if the claim is strict.
  ClaimFields strict;
  strict.flags = 1;
  is_not(of({{0}, {1}}, N + B + D(0) + none + none + mx + B + D(0) + none + none, strict));
  is_empty(of({{0}}, B + D(0) + none + none, strict));
  is_empty(of({{0, 0, 0}}, B + D(0) + none + none, strict));
  is_not_where_strict_is_asked(one_strict_edge());
}

TEST(Asked, EmptyByWhatIsExcluded) {
  Proof proof = two_edges();
  proof.labels = {3, 5};
  proof.claim.excluded = {{3, 5}};
  const std::string cells = in_hex(hash_of_cells(4, proof.cells, proof.labels));
  EXPECT_REJECTED(proof.asked({"excluded=3-5", cells}), "the claim: empty");
  EXPECT_VERDICT(proof.asked({"excluded=3-5", cells, "empty"}), 0, "; not compared: 3-5; the claim is empty");
  proof.labels = {3, 3};
  EXPECT_ACCEPTED(proof.asked({"excluded=3-5", in_hex(hash_of_cells(4, proof.cells, proof.labels))}));
  proof.claim.excluded = {{3, 3}};
  EXPECT_REJECTED(proof.asked({"excluded=3-3", in_hex(hash_of_cells(4, proof.cells, proof.labels))}), "empty");
}

TEST(Asked, FieldsThatNobodyCanAsk) {
  const std::string cells = "cells=" + std::string(64, '0');
  for (const std::string field : {"",
                                  "=",
                                  "motion",
                                  "motion=",
                                  "motion=Rest",
                                  "dimension",
                                  "dimension=1",
                                  "dimension=4",
                                  "dimension=+2",
                                  "steps=0",
                                  "steps=-1",
                                  "steps=1.0",
                                  "steps=99999999999",
                                  "strict=",
                                  "strict=2",
                                  "points=yes",
                                  "distance",
                                  "distance=-1",
                                  "distance=-0",
                                  "distance=nan",
                                  "distance=inf",
                                  "distance=1e999",
                                  "distance=.5",
                                  "distance=1 ",
                                  "ring=0",
                                  "ring=4294967296",
                                  "merged=",
                                  "merged=-1",
                                  "excluded",
                                  "excluded=1",
                                  "excluded=1-",
                                  "excluded=-1",
                                  "excluded=2-1",
                                  "excluded=1-2,",
                                  "excluded=,1-2",
                                  "excluded=1-2,1-2",
                                  "excluded=1-2,0-1",
                                  "excluded=1-2-3",
                                  "cells=",
                                  "empty=",
                                  "from=0",
                                  "all"}) {
    EXPECT_REJECTED(two_edges().asked({cells, field}), "the command line");
  }
  EXPECT_REJECTED(two_edges().asked({"colour=" + std::string(64, '0')}), "expected motion, dimension");
  EXPECT_REJECTED(two_edges().asked({"cells=" + std::string(63, '0')}), "64 digits");
  EXPECT_REJECTED(two_edges().asked({"cells=" + std::string(64, 'A')}), "64 digits");
  EXPECT_REJECTED(two_edges().asked({cells}), "the claim: cells: the proof says ");
  EXPECT_REJECTED(two_edges().asked({"excluded=1-2"}), "expected cells=HASH too");
  EXPECT_REJECTED(two_edges().asked({"ring=2"}), "expected distance=ETA too");
  EXPECT_REJECTED(two_edges().asked({"empty", "empty=0"}), "asked twice");
  EXPECT_ACCEPTED(two_edges().asked({"strict=0", "points=0", "empty=0", "excluded=", "merged=0", "ring=1", "distance=0",
                                     "steps=1", "dimension=3", "motion=linear"}));
}

}  // namespace
}  // namespace noli::checker::test
