// SPDX-License-Identifier: Apache-2.0
//
// Tests witnesses of contact: for each contact of random meshes, at the ends of the range of double, and the judge's
// refusals.
#include "proofs/prover/witness/witness.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "proofs/prover/earliest.h"
#include "proofs/prover/tokens/tokens.h"
#include "proofs/prover/witness/roots.h"
#include "trajectory/blocks/bytes.h"
#include "window_scenes.h"

namespace noli::testing {
namespace {

using witness::Root;

// --- roots ---

Polynomial poly(std::initializer_list<long> coefficients) {
  std::vector<Integer> c;
  for (const long x : coefficients) c.emplace_back(x);
  return Polynomial(std::move(c));
}

std::vector<Root> roots_within(const Polynomial& f, long from, long to) {
  return witness::roots_within(f, Integer(from), Integer(to), 0);
}

double value(const Integer& bound, std::size_t e) { return std::ldexp(mpz_get_d(bound.get()), -static_cast<int>(e)); }

TEST(Roots, AreEachInTheirOwnEnclosure) {
  // (4 t - 1) (2 t - 1) (t - 1), in [0, 1]
  const auto roots = roots_within(poly({-1, 7, -14, 8}), 0, 1);
  ASSERT_EQ(roots.size(), 3u);
  for (const double root : {0.25, 0.5, 1.0}) {
    EXPECT_TRUE(std::ranges::any_of(roots, [&](const Root& r) {
      return value(r.l, r.e) <= root && root <= value(r.u, r.e);
    })) << root;
  }
  EXPECT_TRUE(roots_within(poly({1, 0, 1}), -8, 8).empty());
  EXPECT_TRUE(roots_within(poly({-3, 1}), 0, 2).empty());
}

TEST(Roots, AtAnEndAreEnclosedFromWithin) {
  const auto end = roots_within(poly({-1, 1}), 0, 1);
  ASSERT_EQ(end.size(), 1u);
  EXPECT_LT(end[0].l, end[0].u);
  Root root = end[0];
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(witness::refine(poly({-1, 1}), root));
  EXPECT_EQ(root.l, Integer(31));
  EXPECT_EQ(root.u, Integer(32));
  const auto begin = roots_within(poly({0, 1}), 0, 1);
  ASSERT_EQ(begin.size(), 1u);
  EXPECT_EQ(begin[0].u, Integer(0));
  EXPECT_EQ(roots_within(poly({-1, 1}), 1, 1).size(), 1u);
}

TEST(Roots, OfTheLastUlpAreToldFromThatAtTheEnd) {
  // (t - 1) (2^70 t - (2^70 - 1)), in [0, 1]
  const Integer n = Integer(1) << 70;
  const Polynomial f({n - Integer(1), Integer(1) - (n << 1), n});
  const auto roots = roots_within(f, 0, 1);
  ASSERT_EQ(roots.size(), 2u);
  for (Root root : roots) {
    while (root.e < 100 && witness::refine(f, root)) EXPECT_TRUE(witness::changes_sign(f, root));
  }
}

// --- the search ---

WitnessStep step_of(const LineScene& scene, const WorldLines& lines, int dimension, bool strict) {
  return {scene.mesh, lines, 0, dimension, strict};
}

struct SoupCase {
  SoupSize size;
  int dimension;
  bool strict;
};

constexpr SoupCase soups[] = {
    {{14, 7, 0, 0, 6}, 3, false}, {{8, 6, 0, 0, 2}, 3, false},  {{10, 3, 3, 3, 2}, 3, false},
    {{6, 3, 4, 4, 2}, 3, true},   {{10, 5, 3, 3, 4}, 2, false}, {{5, 4, 4, 4, 1}, 2, false},
    {{3, 2, 2, 1, 2}, 3, true},   {{3, 1, 2, 1, 2}, 2, false},  {{2, 1, 1, 1, 2}, 2, true},
};

/// Small integers produce every degeneracy.
TEST(Witness, EveryContactOfFramesHasOne) {
  std::size_t contacts = 0;
  for (const SoupCase& soup : soups) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      const Step step = random_soup(seed, soup.size, soup.dimension);
      VerifyOptions options;
      options.dimension = soup.dimension;
      options.strict = soup.strict;
      options.threads = 1;
      const VerifyResult found = verify_step(step.mesh, step.x_t0, step.x_t1, options);
      const WorldLines lines = WorldLines::from_frames(step.x_t0, step.x_t1);
      const WitnessStep what{step.mesh, lines, 7, soup.dimension, soup.strict};
      const auto expect_one = [&](const auto& contact, const char* of) {
        const auto payload = witness_of(what, contact);
        ++contacts;
        ASSERT_TRUE(payload) << of << " of seed " << seed << " in " << soup.size.vertices << " vertices";
        EXPECT_EQ(fault_of_witness(what, *payload), std::nullopt);
      };
      if (found.first) expect_one(*found.first, "the first contact");
      for (const FeatureContact& contact : found.reports) expect_one(contact, "a contact");
      for (const InitialIntersection& pair : found.initial_reports) expect_one(pair, "a pair of cells");
    }
  }
  EXPECT_GE(contacts, 1000u);
}

TEST(Witness, EveryContactOfAWindowHasOne) {
  std::size_t contacts = 0;
  for (const SoupCase& soup : soups) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      const LineScene scene = random_line_scene(seed, soup.size, soup.dimension, 4);
      const WorldLines lines = scene.lines();
      WindowOptions options;
      options.dimension = soup.dimension;
      options.strict = soup.strict;
      options.threads = 1;
      std::vector<Position> x;
      for (const auto& path : scene.paths) x.push_back(path.front().x);
      const WindowResult found = WindowVerifier(scene.mesh, x, options).verify(lines, options);
      const WitnessStep what = step_of(scene, lines, soup.dimension, soup.strict);
      for (const FeatureContact& contact : found.reports) {
        ++contacts;
        EXPECT_TRUE(witness_of(what, contact)) << "seed " << seed << " in " << soup.size.vertices << " vertices";
      }
      if (found.first) {
        EXPECT_TRUE(witness_of(what, found.first->contact)) << "seed " << seed;
      }
    }
  }
  EXPECT_GE(contacts, 1000u);
}

/// Roots can be as small as the product of three smallest doubles divided by that of three largest ones.
TEST(Witness, ContactsInTheFirst2ToMinus1024OfAStepHaveOne) {
  const Mesh mesh{4, {}, {{0, 1}, {3, 2}}, {}};
  const std::vector<Position> x_t1 = {{0, 0, 0}, {0, 0, 1}, {0, 0, -1}, {1, 0, -0x1p30}};
  for (const double gap : {0x1p-1000, 0x1p-1060, 0x1p-1074}) {
    const std::vector<Position> x_t0 = {{0, 0, 0}, {0, 0, -0x1p-960}, {0, 0, -1}, {-gap, 0, 0}};
    const WorldLines lines = WorldLines::from_frames(x_t0, x_t1);
    const WitnessStep what{mesh, lines, 7, 3, false};
    const VerifyResult found = verify_step(mesh, x_t0, x_t1, {});
    ASSERT_TRUE(found.first) << gap;
    const auto payload = witness_of(what, *found.first);
    ASSERT_TRUE(payload) << gap;
    EXPECT_EQ(fault_of_witness(what, *payload), std::nullopt) << gap;
  }
}

// --- the judge ---

using Coefficients = std::vector<mpz_class>;  ///< as written, with zeros at the end

/// Point 0 rests at the origin. Edge 1-2 passes over it when (1 + t)^2 = 2: its ends are at (-(1 + t), -1) and
/// (2, 1 + t).
class Judge : public ::testing::Test {
 protected:
  using Side = std::vector<std::pair<VertexId, Coefficients>>;
  struct Fields {
    std::uint32_t i = 0, j = 1;
    Side p, q;
    Coefficients g;
    std::uint64_t e = 2;
    mpz_class l = 1, u = 2;
  };

  Judge() {
    mesh.vertex_count = 3;
    mesh.edges = {{1, 2}};
    mesh.points = {0};
    right.i = 1;
    right.j = 0;
    right.p = {{0, Coefficients{1}}};
    right.q = {{1, Coefficients{1, 1}}, {2, Coefficients{1}}};
    right.g = Coefficients{-1, 2, 1};
  }

  static void put_number(std::string& bytes, const mpz_class& n) {
    Integer value;
    mpz_set(value.get(), n.get_mpz_t());
    put_sint(bytes, value);
  }
  static void put_poly(std::string& bytes, const Coefficients& f) {
    put(bytes, static_cast<std::uint8_t>(f.size()));
    for (const mpz_class& c : f) put_number(bytes, c);
  }
  static std::string encoded(const Fields& w) {
    std::string bytes;
    put(bytes, w.i);
    put(bytes, w.j);
    for (const Side* side : {&w.p, &w.q}) {
      put(bytes, static_cast<std::uint8_t>(side->size()));
      for (const auto& [v, weight] : *side) {
        put(bytes, v);
        put_poly(bytes, weight);
      }
    }
    put_poly(bytes, w.g);
    put_uint(bytes, w.e);
    put_number(bytes, w.l);
    put_number(bytes, w.u);
    return bytes;
  }

  std::string fault(const std::function<void(Fields&)>& change) {
    Fields changed = right;
    change(changed);
    return fault_of(encoded(changed));
  }
  std::string fault_of(const std::string& bytes) {
    const WitnessStep step{mesh, lines, 0, 3, strict, eta, ring};
    return fault_of_witness(step, bytes).value_or("");
  }

  Mesh mesh;
  WorldLines lines = WorldLines::from_frames(std::vector<Position>{{0, 0, 0}, {-1, -1, 0}, {2, 1, 0}},
                                             std::vector<Position>{{0, 0, 0}, {-2, -1, 0}, {2, 2, 0}});
  bool strict = false;
  double eta = 0;
  std::uint32_t ring = 1;
  Fields right;
};

TEST_F(Judge, TakesAWitnessOfTheSquareRootOfTwo) {
  EXPECT_EQ(fault([](Fields&) {}), "");
  EXPECT_EQ(fault([](Fields& w) { w.g = Coefficients{1, -2, -1}; }), "");
  EXPECT_EQ(fault([](Fields& w) { w.e = 8192, w.l = mpz_class(1) << 8190, w.u = mpz_class(1) << 8191; }), "");
  EXPECT_EQ(fault([](Fields& w) { w.q.push_back({1, w.g}); }), "") << "g divides that weight";
}

TEST_F(Judge, RefusesOtherCellsAndVertices) {
  EXPECT_EQ(fault([](Fields& w) { w.i = 2; }), "no such cell");
  EXPECT_EQ(fault([](Fields& w) { w.p[0].first = 1; }), "a vertex is not one of its cell");
  EXPECT_EQ(fault([](Fields& w) { w.i = 0, w.p = {{1, {1}}}, w.q = {{2, {1}}}; }), "it is about one cell");
  EXPECT_EQ(fault([](Fields& w) { w.p.clear(); }), "a side has 1 to 3 vertices");
  EXPECT_EQ(fault([](Fields& w) { w.p.assign(4, w.p[0]); }), "a side has 1 to 3 vertices");
  mesh.edges.push_back({0, 1});  // cell 1; the point 0 is cell 2
  EXPECT_EQ(fault([](Fields& w) { w.p.push_back({1, {1}}); }), "a vertex is on both sides");
}

TEST_F(Judge, RefusesOtherTimes) {
  EXPECT_EQ(fault([](Fields& w) { w.u = 5; }), "the time is not in the step");
  EXPECT_EQ(fault([](Fields& w) { w.l = -1; }), "the time is not in the step");
  EXPECT_EQ(fault([](Fields& w) { w.l = 3; }), "the time is not in the step");
  EXPECT_EQ(fault([](Fields& w) { w.l = 2, w.u = 3; }), "g does not change its sign");
  EXPECT_EQ(fault([](Fields& w) { w.e = 8193; }), "e is above 8,192");
  EXPECT_EQ(fault([](Fields& w) { w.g.push_back(0); }), "the last coefficient of g is 0");
}

TEST_F(Judge, RefusesOtherWeights) {
  EXPECT_EQ(fault([](Fields& w) { w.q.push_back({1, Coefficients{-1, 3}}); }), "a weight may be negative");
  EXPECT_EQ(fault([](Fields& w) { w.p[0].second = Coefficients{-1}; }), "a weight may be negative");
  EXPECT_EQ(fault([](Fields& w) { w.p[0].second = Coefficients{0}; }), "a sum of weights may not be positive");
  EXPECT_EQ(fault([](Fields& w) { w.q[0].second = Coefficients{1}; }), "the points do not meet");
  EXPECT_EQ(fault([](Fields& w) { w.p[0].second = Coefficients(33, 1); }), "a polynomial has 1 to 32 coefficients");
  EXPECT_EQ(fault([](Fields& w) { w.p[0].second = Coefficients(32, 1); }), "");
  EXPECT_EQ(fault([](Fields& w) { w.p[0].second = {}; }), "a polynomial has 1 to 32 coefficients");
}

/// 1,200 groups of seven bits hold 8,400 bits, one of them for the sign.
TEST_F(Judge, RefusesIntegersBeyondTheLimit) {
  const mpz_class most = (mpz_class(1) << 8399) - 1;
  EXPECT_EQ(fault([&](Fields& w) { w.p[0].second = {most}; }), "");
  EXPECT_EQ(fault([&](Fields& w) { w.p[0].second = {most + 1}; }), "an integer is too long");
}

TEST_F(Judge, RefusesOtherBytes) {
  const std::string bytes = encoded(right);
  EXPECT_EQ(fault_of(bytes + '\0'), "bytes are left");
  for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_NE(fault_of(bytes.substr(0, size)), "") << size;
  std::string longer = bytes;
  longer.back() = static_cast<char>(longer.back() | 0x80);
  EXPECT_EQ(fault_of(longer + '\0'), "an integer is written longer than it is");
}

/// Uses t = 1/2, where the points are about 0.35 apart.
TEST_F(Judge, KnowsTheLeastDistance) {
  const auto beside = [](Fields& w) {
    w.q = {{1, Coefficients{1}}, {2, Coefficients{1}}};
    w.g = Coefficients{-1, 2};
    w.e = 1;
    w.l = w.u = 1;
  };
  EXPECT_EQ(fault(beside), "the points do not meet");
  eta = 0.25;  // the middle of the edge is at (1/4, 1/4)
  EXPECT_EQ(fault(beside), "the points are not as near as the least distance");
  eta = 0.375;
  EXPECT_EQ(fault(beside), "");
  mesh.edges.push_back({0, 1});  // cell 1; the point 0 is cell 2
  const auto joined = [&](Fields& w) { beside(w), w.i = 2; };
  EXPECT_EQ(fault(joined), "");
  ring = 2;
  EXPECT_EQ(fault(joined), "the points do not meet, and a short path joins the sides");
}

TEST_F(Judge, KnowsBreakpoints) {
  LineScene scene;
  const VertexId a = scene.vertex({{0, {-1, 0, 0}}, {2, {1, 0, 0}}});
  const VertexId b = scene.vertex({{0, {0, 0, 0}}, {0.5, {0, 0, 0}}, {2, {0, 0, 0}}});
  scene.mesh.points = {a, b};
  mesh = scene.mesh;
  lines = scene.lines();
  right = {0, 1, {{a, Coefficients{1}}}, {{b, Coefficients{1}}}, Coefficients{-2, 1}, 0, 1, 3};  // in halves
  EXPECT_EQ(fault([](Fields&) {}), "");
  EXPECT_EQ(fault([](Fields& w) { w.l = 0; }), "a vertex has a breakpoint in the enclosure");
  EXPECT_EQ(fault([](Fields& w) { w.l = w.u = 4, w.g = Coefficients{-4, 1}; }), "the points do not meet");
}

TEST_F(Judge, KnowsWhatIsNotCompared) {
  for (const LabelPairs& pairs : {LabelPairs{{3, 5}}, LabelPairs{{3, 3}}}) {
    const CellLabels labels{{3, 5}, pairs};
    const WitnessStep step{mesh, lines, 0, 3, false, 0, 1, &labels};
    const bool excluded = pairs.contains({3, 5});
    EXPECT_EQ(fault_of_witness(step, encoded(right)).value_or(""), excluded ? "the pair is excluded" : "");
    const FeatureContact contact{FeaturePair::vertex_edge, {0, 1, 2}, {0.25, 0.5}};
    EXPECT_EQ(witness_of(step, contact).has_value(), !excluded);
  }
}

}  // namespace
}  // namespace noli::testing
