// SPDX-License-Identifier: Apache-2.0
//
// Tests each token where it is allowed, and with each of its conditions violated (proofs/FORMAT.md, section 3).
#include "support.h"

namespace noli::checker::test {
namespace {

using namespace token;

/// The tokens of a valid proof of two_edges(), with `pair` for its pair of cells.
std::string of_pair(const std::string& pair) { return N + F + pair + F; }
/// An edge whose ends are separated from each other.
std::string of_itself(const std::string& up, const std::string& down) {
  return D(0) + D(0) + none + up + D(0) + down + none;
}

Proof two_edges_at_distance(double eta) {
  Proof proof = two_edges();
  proof.claim.eta = eta;
  return proof;
}

/// Edges 0-1, 1-2 that share vertex 1.
Proof corner() {
  const Points x = {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}};
  return {{x, x}, {{0, 1}, {1, 2}}, {}, "", {of_pair(D(0) + mx + my)}};
}

/// Edges 0-1, 1-2, 2-3 along x. The middle one is shorter than the distance, which counts from two edges on (ring 2).
Proof chain() {
  const Points x = {{-100, 0, 0}, {0, 0, 0}, {1, 0, 0}, {100, 0, 0}};
  const std::string c01 = W({1}) + mx + W({1, 1, 2}) + mx + none + mx + D(0) + mx + mx,
                    c02 = W({1, 1, 2}) + mx + mx + mx,
                    c12 = W({2}) + W({1, 1, 2}) + none + mx + mx + mx + D(0) + mx + mx;
  Proof proof{{x, x}, {{0, 1}, {1, 2}, {2, 3}}, {}, "", {N + F + R + c01 + c02 + N + F + c12 + F}};
  proof.claim.eta = 10;
  proof.claim.ring = 2;
  return proof;
}

TEST(Tokens, TIsForAllIntervals) {
  EXPECT_ACCEPTED(two_edges().with(of_pair(T + T + mx + mx + mx)));
  EXPECT_ACCEPTED(two_edges().with(T + of_pair(mx) + of_pair(mx)));
  std::string deep, closed;
  for (int i = 0; i < 1024; ++i) deep += T, closed += mx;
  EXPECT_ACCEPTED(two_edges().with(of_pair(deep + closed + mx)));
  EXPECT_REJECTED(two_edges().with(of_pair(deep + T + closed + mx + mx)), "too short");
  EXPECT_REJECTED(two_edges().with(N + F + T + mx), "not complete");
}

TEST(Tokens, THasTheFirstHalfOnTop) {
  // Edge 1 moves from x = 8 to -4, edge 0 from -8 to 4, and above edge 1 at the end.
  Proof proof = two_edges();
  proof.frames = {{{-8, -1, 0}, {-8, 1, 0}, {8, 0, -1}, {8, 0, 1}}, {{4, -1, 8}, {4, 1, 8}, {-4, 0, -1}, {-4, 0, 1}}};
  EXPECT_ACCEPTED(proof.with(of_pair(T + mx + pz)));
  EXPECT_REJECTED(proof.with(of_pair(T + pz + mx)), "does not separate");
}

/// Points in a row along x, in a tree that halves them. The checker keeps no list for a node of more than 1,024 points.
struct Row {
  Proof proof;
  std::string tokens;

  /// `first`: the number of points in the root's left child.
  Row(std::uint32_t count, std::uint32_t first) {
    Points x;
    for (std::uint32_t i = 0; i < count; ++i) {
      x.push_back({4.0 * i, 0, 0});
      proof.cells.push_back({i});
    }
    proof.frames = {x, x};
    parts(0, first, count);
  }

  void add(std::uint32_t begin, std::uint32_t end) {
    if (end - begin == 1) {
      proof.tree += uint(begin + 1);
      tokens += F;
      return;
    }
    parts(begin, begin + (end - begin) / 2, end);
  }

  void parts(std::uint32_t begin, std::uint32_t middle, std::uint32_t end) {
    proof.tree += uint(0);
    tokens += N;
    add(begin, middle);
    tokens += mx;
    add(middle, end);
  }
};

TEST(Tokens, GroupsOfManyVerticesAreSeparatedByAllOfThem) {
  Row row(2200, 1100);
  EXPECT_ACCEPTED(row.proof.with(row.tokens));
  // The last point of the first half moves past the first of the second: only the root's token is wrong.
  row.proof.frames[1][1099][0] = 4402;
  EXPECT_REJECTED(row.proof.with(row.tokens), "does not separate");
  Row lopsided(1200, 1);
  EXPECT_ACCEPTED(lopsided.proof.with(lopsided.tokens));
  lopsided.proof.frames[1][0][0] = 1;
  EXPECT_ACCEPTED(lopsided.proof.with(lopsided.tokens));
  lopsided.proof.frames[1][0][0] = 4;
  EXPECT_REJECTED(lopsided.proof.with(lopsided.tokens), "does not separate");
}

TEST(Tokens, LAndRAreForPairsWithParts) {
  const std::string first = of_itself(py, my), second = of_itself(pz, mz);
  EXPECT_ACCEPTED(two_edges().with(B + L + R + first + mx + R + px + second));
  EXPECT_ACCEPTED(two_edges().with(B + R + L + first + px + L + mx + second));
  EXPECT_REJECTED(two_edges().with(L), "L and R");
  EXPECT_REJECTED(two_edges().with(R), "L and R");
  EXPECT_REJECTED(two_edges().with(of_pair(L + mx + mx)), "L and R");
  EXPECT_REJECTED(two_edges().with(B + L + R + R), "L and R");
}

TEST(Tokens, NIsForOneWithParts) {
  EXPECT_REJECTED(two_edges().with(N + N), "N is");
  EXPECT_REJECTED(two_edges().with(B + N), "N is");
}

TEST(Tokens, FIsForOneCell) {
  EXPECT_REJECTED(two_edges().with(F), "F is");
  EXPECT_REJECTED(two_edges().with(B + L + R + F), "F is");
  Proof strict = two_edges();
  strict.claim.flags = 1;
  EXPECT_REJECTED(strict.check(), "not strict");
  EXPECT_ACCEPTED(strict.with(N + B + of_itself(py, my) + mx + B + of_itself(pz, mz)));
}

TEST(Tokens, BIsForOne) { EXPECT_REJECTED(two_edges().with(N + F + B), "B is"); }

TEST(Tokens, XIsForExcludedLabels) {
  Proof proof = two_edges();
  proof.claim.excluded = {{0, 0}};
  for (const std::string& tokens : {X, N + X + X + X, B + X}) EXPECT_ACCEPTED(proof.with(tokens));
  EXPECT_REJECTED(two_edges().with(X), "not an excluded pair");
  proof.claim.excluded = {{0, 1}};
  EXPECT_REJECTED(proof.with(X), "not an excluded pair");
}

TEST(Tokens, SOfEachKind) {
  for (const std::string& s : {mx, packed(-1, 0, 0), packed(-512, 511, -511), S(-1, 0, 0),
                               S(-(mpz_class(1) << 40), 0, 0), S(-(mpz_class(1) << 200), 1, 1)}) {
    EXPECT_ACCEPTED(two_edges().with(of_pair(s)));
    EXPECT_REJECTED(two_edges().with(s), "for a pair");
  }
  for (const std::string& s : {px, py, my, pz, mz, none, packed(1, 0, 0), packed(-1, 3, 0), S(1, 0, 0), S(0, 0, 0),
                               S(mpz_class(1) << 200, 0, 0)})
    EXPECT_REJECTED(two_edges().with(of_pair(s)), "does not separate");
  for (const std::uint32_t high : {0x40000000u, 0x80000000u}) {
    const std::string s = first_byte(TokenCode::short_direction) + raw(high | 1023u);
    EXPECT_REJECTED(two_edges().with(of_pair(s)), "highest bits");
  }
}

TEST(Tokens, SHoldsAtBothEnds) {
  Proof proof = two_edges();
  for (auto& [x, y, z] : proof.frames[1]) x = -x;
  EXPECT_REJECTED(proof.check(), "does not separate");
  std::swap(proof.frames[0], proof.frames[1]);
  EXPECT_REJECTED(proof.check(), "does not separate");
  proof = two_edges();
  proof.frames[1][2][0] = 0;
  EXPECT_REJECTED(proof.check(), "does not separate");  // it touches in the end
}

TEST(Tokens, SAtDistance) {
  for (const std::string& s : {mx, packed(-2, 0, 0), packed(-300, 1, 0)}) {
    EXPECT_ACCEPTED(two_edges_at_distance(1).with(of_pair(s)));
    EXPECT_REJECTED(two_edges_at_distance(2).with(of_pair(s)), "does not separate");
    EXPECT_REJECTED(two_edges_at_distance(3).with(of_pair(s)), "does not separate");
  }
  EXPECT_REJECTED(two_edges_at_distance(1).with(of_pair(px)), "does not separate");
}

TEST(Tokens, P) {
  EXPECT_ACCEPTED(two_edges().with(of_pair(P(0, {-1, 0, 0}, 0, -1, 0))));
  EXPECT_ACCEPTED(two_edges().with(of_pair(P(4, {-1, 0, 0}, 0, -16, 0))));
  EXPECT_ACCEPTED(two_edges().with(of_pair(P(0, {-2, 0, 0}, 1, -1, 0))));  // a plane that moves
  EXPECT_REJECTED(two_edges().with(of_pair(P(0, {-1, 0, 0}, -1, -1, 0))), "does not separate");
  EXPECT_REJECTED(two_edges().with(of_pair(P(0, {-1, 0, 0}, 2, -1, 0))), "does not separate");
  EXPECT_REJECTED(two_edges().with(of_pair(P(0, {-1, 0, 0}, 0, 0, 0))), "does not separate");    // edge 0 is on it
  EXPECT_REJECTED(two_edges().with(of_pair(P(0, {-1, 0, 0}, 0, -2, 0))), "does not separate");   // edge 1 in the end
  EXPECT_REJECTED(two_edges().with(of_pair(P(0, {-1, 0, 0}, -4, -3, 0))), "does not separate");  // edge 0 in the end
  EXPECT_REJECTED(two_edges().with(of_pair(P(0, {-1, 0, 0}, 3, -4, 0))), "does not separate");   // edge 1 at first
  EXPECT_REJECTED(two_edges().with(of_pair(P(0, {-1, 0, 0}, -3, -4, 0))), "does not separate");  // and only then
  EXPECT_REJECTED(two_edges().with(of_pair(P(0, {-1, 0, 0}, 1, 0, 0))), "does not separate");    // edge 0 at first
  EXPECT_REJECTED(two_edges().with(of_pair(P(0, {-1, 0, 0}, 0, -1, -1))), "does not separate");
  EXPECT_REJECTED(two_edges().with(P(0, {-1, 0, 0}, 0, -1, 0)), "for a pair");
  EXPECT_REJECTED(two_edges().with(of_pair(P(4097, {-1, 0, 0}, 0, -1, 0))), "shift");
  EXPECT_REJECTED(two_edges().with(of_pair(first_byte(TokenCode::half_space) + bytes({0, 1, 0, 0}) + scaled(0, 4097))),
                  "shift");
  EXPECT_ACCEPTED(
      two_edges().with(of_pair(P(4096, {-1, 0, 0}, 0, -1, 0).substr(0, 6) + scaled(0) + scaled(-1, 4096) + scaled(0))));
}

TEST(Tokens, PAtDistance) {
  EXPECT_ACCEPTED(two_edges_at_distance(1).with(of_pair(P(0, {-2, 0, 0}, 0, -1, 2))));
  EXPECT_REJECTED(two_edges_at_distance(1).with(of_pair(P(0, {-2, 0, 0}, 0, -1, 1))), "does not separate");
  EXPECT_REJECTED(two_edges_at_distance(1).with(of_pair(P(0, {-2, 0, 0}, 0, -1, -2))), "does not separate");
  EXPECT_REJECTED(two_edges_at_distance(1).with(of_pair(P(0, {-2, 0, 0}, 0, -1, 3))), "does not separate");
}

TEST(Tokens, DIsForVerticesInCommon) {
  EXPECT_ACCEPTED(corner().check());
  EXPECT_REJECTED(corner().with(of_pair(mx)), "does not separate");
  EXPECT_REJECTED(corner().with(of_pair(D(1))), "no such common vertex");
  EXPECT_REJECTED(corner().with(of_pair(D(0) + D(0))), "no such common vertex");
  EXPECT_REJECTED(corner().with(D(0)), "D is");
  EXPECT_REJECTED(corner().with(B + D(0)), "D is");
  EXPECT_REJECTED(corner().with(B + L + D(0)), "D is");
  EXPECT_REJECTED(corner().with(N + D(0)), "D is");
  EXPECT_REJECTED(corner().with(B + R + D(0)), "D is");
}

TEST(Tokens, DOfTwoFaces) {
  const Points x = {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}};
  Proof proof{{x, x}, {{0, 1, 2}, {0, 1, 3}}};
  // (12, 013): D 0 drops vertex 1 from either; (012, 13) the same.
  proof.tokens = {of_pair(D(0) + D(0) + mx + S(-2, 1, 0) + D(0) + S(-2, -1, 0) + mx)};
  EXPECT_ACCEPTED(proof.check());
  EXPECT_ACCEPTED(proof.with(of_pair(D(1) + D(0) + mx + S(-2, -1, 0) + D(0) + S(-2, 1, 0) + mx)));
  EXPECT_REJECTED(proof.with(of_pair(D(2))), "no such common vertex");
}

TEST(Tokens, GroupsWithoutVertices) {
  const std::string rest = my + D(0) + D(0) + none;
  // ({1}, {0, 1}) becomes ({}, {0, 1}).
  for (const std::string& empty : {none, mx, px, S(0, 0, 0), S(mpz_class(1) << 50, 0, 0), P(0, {0, 0, 0}, 0, 1, 0)})
    EXPECT_ACCEPTED(
        two_edges().with(B + L + R + D(0) + D(0) + empty + py + D(0) + my + none + mx + R + px + of_itself(pz, mz)));
  EXPECT_REJECTED(two_edges().with(B + L + R + D(0) + D(0) + P(0, {0, 0, 0}, 0, -1, 0)), "does not separate");
}

TEST(Tokens, W) {
  EXPECT_ACCEPTED(chain().check());
  const auto first = [](const std::string& w) { return chain().with(N + F + R + w); };
  EXPECT_REJECTED(first(W({1, 1, 2, 1, 1})), "not shorter");
  EXPECT_REJECTED(first(W({0})), "does not join");               // not in the second
  EXPECT_REJECTED(first(W({2})), "does not join");               // not in the first
  EXPECT_REJECTED(first(W({1, 3, 2})), "has not its vertices");  // no such cell
  EXPECT_REJECTED(first(W({1, 0x7fffffff, 2})), "has not its vertices");
  EXPECT_REJECTED(first(W({1, 2, 2})), "has not its vertices");  // cell 2 has not 1
  EXPECT_REJECTED(first(W({1, 1, 3})), "has not its vertices");  // cell 1 has not 3
  EXPECT_REJECTED(first(W({1}) + W({1})), "does not join");      // already dropped
  EXPECT_REJECTED(first(W({1}) + mx + mx), "does not separate");
  EXPECT_REJECTED(first(W({1}) + mx + W({1, 1, 2}) + mx + none + mx + W({1})), "W is");  // disjoint
  EXPECT_REJECTED(chain().with(W({1})), "W is");
  EXPECT_REJECTED(chain().with(N + W({1})), "W is");
  EXPECT_REJECTED(chain().with(B + W({1})), "W is");
  EXPECT_REJECTED(chain().with(B + L + W({1})), "W is");
  EXPECT_REJECTED(chain().with(B + R + W({1})), "W is");
}

TEST(Tokens, WIsOfAtMost255) {
  Proof proof = chain();
  proof.claim.ring = 1000;
  std::vector<unsigned> way = {1};
  for (unsigned i = 0; i < 255; ++i) way.insert(way.end(), {1, 2 - i % 2});
  EXPECT_REJECTED(proof.with(N + F + R + W({1}) + mx + W(way) + mx + none + mx + X),
                  "not an excluded pair");  // W was right
  way.insert(way.end(), {1, 1, 1, 2});
  EXPECT_REJECTED(proof.with(N + F + R + W({1}) + mx + W(way)), "longer than 255");
}

TEST(Tokens, OthersAreRefused) {
  for (const int code : {0x07, 0x0f, 0x13, 0x1f, 0x23, 0x2f, 0x31, 0xff})
    EXPECT_REJECTED(two_edges().with(bytes({code})), "no token");
}

TEST(Tokens, JustAllAreShown) {
  EXPECT_REJECTED(two_edges().with(""), "not complete");
  EXPECT_REJECTED(two_edges().with(N + F + mx), "not complete");
  EXPECT_REJECTED(two_edges().with(of_pair(mx) + F), "nothing is left");
  for (const std::string& cut :
       {first_byte(TokenCode::short_direction) + bytes({0}), first_byte(TokenCode::direction) + bytes({1}),
        first_byte(TokenCode::direction) + bytes({0x80}), first_byte(TokenCode::half_space) + bytes({0}),
        first_byte(TokenCode::ring) + bytes({1})})
    EXPECT_REJECTED(two_edges().with(N + F + cut), "expected more bytes");
}

TEST(Tokens, Numbers) {
  const std::string s = N + F + first_byte(TokenCode::direction), w = N + F + first_byte(TokenCode::ring);
  EXPECT_REJECTED(two_edges().with(s + bytes({0x80, 0})), "written longer");
  EXPECT_REJECTED(two_edges().with(s + std::string(1200, '\x80') + bytes({1})), "too long");
  EXPECT_ACCEPTED(two_edges().with(s + std::string(1199, '\xff') + bytes({1, 0, 0, 4})));
  EXPECT_REJECTED(two_edges().with(w + std::string(9, '\x80') + bytes({2})), "below 2^64");
  EXPECT_REJECTED(two_edges().with(w + std::string(10, '\x80') + bytes({1})), "too long");
}

TEST(Tokens, AStreamInSeveralBlocks) {
  auto groups = two_edges().groups();
  groups[1].pop_back();
  for (const std::string& part : {N, F + mx, std::string(), F}) groups[1].emplace_back("TOKS", part);
  EXPECT_ACCEPTED(two_edges().check(block_file("PROF", groups)));
  groups[1].insert(groups[1].begin() + 3, {"TREE", uint(0) + uint(1) + uint(2)});
  EXPECT_REJECTED(two_edges().check(block_file("PROF", groups)), "expected a block TOKS");
}

TEST(Tokens, ABlockIsOfAtMostAMebibyte) {
  std::string many;
  for (int i = 0; i < 1 << 18; ++i) many += packed(-1, 0, 0);  // none of them is read
  EXPECT_REJECTED(two_edges().with(many), "2^20 bytes");
}

TEST(Trees, HaveEachCellOnce) {
  Proof proof = two_edges();
  const auto with = [&](const std::string& tree) {
    proof.tree = tree;
    return proof.check();
  };
  EXPECT_ACCEPTED(with(uint(0) + uint(1) + uint(2)));
  EXPECT_REJECTED(with(uint(0) + uint(1) + uint(1)), "twice");
  EXPECT_REJECTED(with(uint(0) + uint(1) + uint(3)), "not there");
  EXPECT_REJECTED(with(uint(0) + uint(1) + uint(mpz_class(1) << 40)), "not there");
  EXPECT_REJECTED(with(uint(1)), "not all cells");
  EXPECT_REJECTED(with(uint(0) + uint(1)), "expected more bytes");
  EXPECT_REJECTED(with(uint(0) + uint(1) + uint(2) + uint(2)), "expected the end");
  EXPECT_REJECTED(with(std::string(255, '\0') + uint(1)), "expected more bytes");
  EXPECT_REJECTED(with(std::string(1 << 16, '\0')), "too deep");
}

/// Points on a line, in a tree where the left (or right) child of each node is a leaf.
Proof comb(std::uint32_t n, bool left) {
  Proof proof;
  proof.frames.resize(2);
  std::string tokens;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (auto& frame : proof.frames) frame.push_back({static_cast<double>(i), 0, 0});
    proof.cells.push_back({i});
  }
  if (left) {
    for (std::uint32_t i = 0; i + 1 < n; ++i) tokens += N + F + mx;
    tokens += F;
  } else {
    proof.tree = std::string(n - 1, '\0');
    for (std::uint32_t i = n; i-- > 0;) proof.tree += uint(i + 1);
    for (std::uint32_t i = 0; i + 1 < n; ++i) tokens += N;
    tokens += F;
    for (std::uint32_t i = 0; i + 1 < n; ++i) tokens += px + F;
  }
  proof.tokens = {tokens};
  return proof;
}
TEST(Trees, UpTo255Deep) {
  for (const bool left : {true, false}) {
    EXPECT_ACCEPTED(comb(256, left).check());
    EXPECT_REJECTED(comb(257, left).check(), "too deep");
  }
}

}  // namespace
}  // namespace noli::checker::test
