// SPDX-License-Identifier: Apache-2.0
//
// Tests witnesses (proofs/FORMAT.md, section 5): valid ones, and one that violates each condition.
#include "support.h"

namespace noli::checker::test {
namespace {

using Corners = std::vector<std::pair<std::uint32_t, std::vector<mpz_class>>>;

struct WitnessFields {
  std::uint32_t i, j;
  Corners p, q;
  std::vector<mpz_class> g;
  int e;
  mpz_class l, u;

  std::string encode() const {
    std::string result = raw(i) + raw(j);
    for (const auto* side : {&p, &q}) {
      result += bytes({static_cast<int>(side->size())});
      for (const auto& [v, w] : *side) result += raw(v) + poly(w);
    }
    return result + poly(g) + uint(e) + sint(l) + sint(u);
  }
};

/// Point 0 rests at the origin. Edge 1-2 passes over it when (1 + t)^2 = 2: its ends are at (-(1 + t), -1) and
/// (2, 1 + t).
Proof root_two() {
  return {{{{0, 0, 0}, {-1, -1, 0}, {2, 1, 0}}, {{0, 0, 0}, {-2, -1, 0}, {2, 2, 0}}}, {{1, 2}, {0}}, {}, "", {}};
}
const WitnessFields at_root_two = {1, 0, {{0, {1}}}, {{1, {1, 1}}, {2, {1}}}, {-1, 2, 1}, 2, 1, 2};

Verdict check(const WitnessFields& w, Proof proof = root_two()) {
  proof.tokens.clear();
  proof.witness = {w.encode()};
  return proof.check();
}
WitnessFields changed(const std::function<void(WitnessFields&)>& change, WitnessFields w = at_root_two) {
  change(w);
  return w;
}

TEST(Witnesses, AtTheSquareRootOfTwo) {
  EXPECT_VERDICT(check(at_root_two), 1, "in step 1, vertices {0} of cell 1 and {1 2} of cell 0 meet");
  EXPECT_VERDICT(
      check({0, 1, at_root_two.q, at_root_two.p, {1, -2, -1}, 8192, mpz_class(1) << 8190, mpz_class(1) << 8191}), 1,
      "");
  Proof excluded = root_two();
  excluded.claim.excluded = {{0, 0}};
  EXPECT_REJECTED(check(at_root_two, excluded), "the pair is excluded");
}

TEST(Witnesses, WithAWeightThatIsZero) {
  // g divides it, but it is negative before its root.
  EXPECT_VERDICT(check(changed([](auto& w) { w.q.push_back({1, w.g}); })), 1, "");
  EXPECT_REJECTED(check(changed([](auto& w) { w.q.push_back({1, {-1, 3}}); })), "may be negative");
  EXPECT_REJECTED(check(changed([](auto& w) { w.p.push_back({0, {-1}}); })), "may be negative");
  EXPECT_VERDICT(check(changed([](auto& w) { w.p.push_back({0, {0}}); })), 1, "");
  EXPECT_REJECTED(check(changed([](auto& w) { w.p[0].second = {0}; })), "sum of weights");
  EXPECT_REJECTED(check(changed([](auto& w) { w.p[0].second = {1, -2}; })), "sum of weights");  // 0 at 1/2
  EXPECT_REJECTED(check(changed([](auto& w) { w.q = {{1, w.g}}; })), "sum of weights");
}

TEST(Witnesses, OfTheTwoCells) {
  EXPECT_REJECTED(check(changed([](auto& w) { w.i = 2; })), "not there");
  EXPECT_REJECTED(check(changed([](auto& w) { w.j = 0xffffffff; })), "not there");
  EXPECT_REJECTED(check(changed([](auto& w) { w.p[0].first = 1; })), "not one of its cell");
  EXPECT_REJECTED(check(changed([](auto& w) { w.q[1].first = 0; })), "not one of its cell");
  EXPECT_REJECTED(check(changed([](auto& w) { w.i = 0, w.p = {{1, {1}}}, w.q = {{2, {1}}}; })), "about one cell");
  EXPECT_REJECTED(check(changed([](auto& w) { w.p.clear(); })), "1 to 3 vertices");
  EXPECT_REJECTED(check(changed([](auto& w) { w.p.assign(4, w.p[0]); })), "1 to 3 vertices");
  Proof shared = root_two();
  shared.cells = {{1, 2}, {0, 1}};
  EXPECT_REJECTED(check(changed([](auto& w) { w.p.push_back({1, {1}}); }), shared), "both sides");
}

TEST(Witnesses, OneCellOfAStrictClaim) {
  Proof strict{{{{0, 0, 0}, {3, 0, 0}}, {{3, 0, 0}, {0, 0, 0}}}, {{0, 1}}};
  const WitnessFields half = {0, 0, {{0, {1}}}, {{1, {1}}}, {-1, 2}, 1, 1, 1};
  EXPECT_REJECTED(check(half, strict), "about one cell");
  strict.claim.flags = 1;
  EXPECT_VERDICT(check(half, strict), 1, "");
}

TEST(Witnesses, WithinTheStep) {
  EXPECT_VERDICT(check(changed([](auto& w) { w.l = 0, w.u = 4; })), 1, "");
  EXPECT_REJECTED(check(changed([](auto& w) { w.l = -1; })), "not in the step");
  EXPECT_REJECTED(check(changed([](auto& w) { w.u = 5; })), "not in the step");
  EXPECT_REJECTED(check(changed([](auto& w) { std::swap(w.l, w.u); })), "not in the step");
  EXPECT_REJECTED(check(changed([](auto& w) { w.e = 8193; })), "denominator");
}

TEST(Witnesses, AtBothEnds) {
  const Points apart = {{0, 0, 0}, {4, 0, 0}}, together = {{0, 0, 0}, {0, 0, 0}};
  const Proof parting{{together, apart}, {{0}, {1}}}, meeting{{apart, together}, {{0}, {1}}};
  EXPECT_VERDICT(check({0, 1, {{0, {1}}}, {{1, {1}}}, {0, 1}, 0, 0, 0}, parting), 1, "");
  EXPECT_VERDICT(check({0, 1, {{0, {1}}}, {{1, {1}}}, {-1, 1}, 0, 1, 1}, meeting), 1, "");
  EXPECT_REJECTED(check({0, 1, {{0, {1}}}, {{1, {1}}}, {0, 1}, 0, 0, 0}, meeting), "do not meet");
  EXPECT_REJECTED(check({0, 1, {{0, {1}}}, {{1, {1}}}, {-1, 1}, 0, 1, 1}, parting), "do not meet");
}

TEST(Witnesses, WithARoot) {
  EXPECT_REJECTED(check(changed([](auto& w) { w.g.push_back(0); })), "last coefficient");
  EXPECT_REJECTED(check(changed([](auto& w) { w.g = {0}; })), "last coefficient");
  EXPECT_REJECTED(check(changed([](auto& w) { w.g = {1}; })), "no change of sign");
  EXPECT_REJECTED(check(changed([](auto& w) { w.l = 2; })), "no change of sign");
  EXPECT_REJECTED(check(changed([](auto& w) { w.u = 1; })), "no change of sign");
  EXPECT_REJECTED(check(changed([](auto& w) { w.g.assign(33, 1); })), "1 to 32 coefficients");
  EXPECT_REJECTED(check(changed([](auto& w) { w.g.clear(); })), "1 to 32 coefficients");
}

TEST(Witnesses, PointsThatMeet) {
  for (const std::size_t axis : {0u, 1u, 2u}) {
    Proof proof = root_two();
    for (auto& frame : proof.frames) frame[0][axis] += 1;
    EXPECT_REJECTED(check(at_root_two, proof), "do not meet");
  }
  EXPECT_REJECTED(check(changed([](auto& w) { w.q[1].second = {2}; })), "do not meet");
  EXPECT_REJECTED(check(changed([](auto& w) { w.g = {-1, 3}; })), "do not meet");
}

TEST(Witnesses, PointsThatComeNear) {
  const WitnessFields half = {0, 1, {{0, {1}}}, {{1, {1}}}, {-1, 2}, 1, 1, 1};
  const auto at = [](double distance, double eta) {
    const Points x = {{0, 0, 0}, {distance, 0, 0}};
    Proof proof{{x, x}, {{0}, {1}}};
    proof.claim.eta = eta;
    return proof;
  };
  EXPECT_VERDICT(check(half, at(3, 4)), 1, "vertices {0} of cell 0 and {1} of cell 1 are too near");
  EXPECT_VERDICT(check(half, at(0, 4)), 1, "vertices {0} of cell 0 and {1} of cell 1 meet");
  EXPECT_VERDICT(check(half, at(3, 3)), 1, "");
  EXPECT_REJECTED(check(half, at(3, 2)), "not as near");
  EXPECT_REJECTED(check(half, at(3, 0)), "do not meet");
}

TEST(Witnesses, DistanceCountsFromTheRingOn) {
  const Points x = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  Proof chain{{x, x}, {{0, 1}, {1, 2}, {2, 3}}};
  chain.claim.eta = 5;
  const WitnessFields ends = {0, 2, {{0, {1}}}, {{3, {1}}}, {-1, 2}, 1, 1, 1};
  for (std::uint32_t ring = 1; ring <= 5; ++ring) {
    chain.claim.ring = ring;
    if (ring <= 3) EXPECT_VERDICT(check(ends, chain), 1, "");
    if (ring > 3) EXPECT_REJECTED(check(ends, chain), "so near by edges");
  }
  chain.claim.ring = 0xffffffff;
  EXPECT_REJECTED(check(ends, chain), "so near by edges");
}

TEST(Witnesses, BehindOneStepsMayBeMissing) {
  using namespace token;
  Proof proof = root_two();
  proof.frames.insert(proof.frames.end(), {proof.frames[1], proof.frames[1]});
  proof.witness = {at_root_two.encode()};
  EXPECT_VERDICT(proof.check(), 1, "");
  proof.tree = uint(0) + uint(1) + uint(2);
  proof.tokens = {"", N + F + S(1, -1, 0) + F, N + F + S(1, -1, 0) + F};
  auto groups = proof.groups();
  const Verdict all = proof.check(block_file("PROF", groups));
  EXPECT_EQ(all.code, 3) << all.words;  // the edge passes through the point: S does not hold
  groups.pop_back();
  groups.pop_back();
  EXPECT_VERDICT(proof.check(block_file("PROF", groups)), 1, "");
  groups.push_back(groups[1]);
  EXPECT_REJECTED(proof.check(block_file("PROF", groups)), "wrong number");
}

TEST(Witnesses, AreFollowedByTheirCommit) {
  Proof proof = root_two();
  proof.tokens.clear();
  proof.witness = {at_root_two.encode()};
  auto groups = proof.groups();
  groups[1].emplace_back("TOKS", "");
  EXPECT_REJECTED(proof.check(block_file("PROF", groups)), "expected a commit");
  groups[1].pop_back();
  groups[1].back().second += '\0';
  EXPECT_REJECTED(proof.check(block_file("PROF", groups)), "expected the end");
  EXPECT_EQ(proof.check(block_file("PROF", groups).substr(0, 300)).code, 3);
}

}  // namespace
}  // namespace noli::checker::test
