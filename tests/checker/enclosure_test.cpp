// SPDX-License-Identifier: Apache-2.0
//
// Tests that vertices which proofs/checker/enclosure.h finds apart are apart in exact arithmetic, for random paths that
// come within a few units of the error bounds, at all scales of positions and times.
#include <random>

#include "support.h"

namespace noli::checker::test {
namespace {

struct Draw {
  std::mt19937_64 random;
  long number(long low, long high) { return std::uniform_int_distribution<long>(low, high)(random); }
  bool one_in(long n) { return number(1, n) == 1; }
};

double next_after(double t, long steps) {
  for (long i = 0; i < steps; ++i) t = std::nextafter(t, INFINITY);
  return t;
}

/// Times of one vertex in [t0, t1], some very close to each other or to the ends.
std::vector<double> times(Draw& draw, double t0, double t1) {
  std::set<double> all = {t0, t1};
  for (long n = draw.number(0, 6); n > 0; --n) {
    double t = t0 + (t1 - t0) * std::ldexp(static_cast<double>(draw.number(0, 1 << 16)), -16);
    if (draw.one_in(3)) t = next_after(draw.one_in(2) ? t0 : t, draw.number(1, 9));
    if (t0 < t && t < t1) all.insert(t);
  }
  return {all.begin(), all.end()};
}

Motion motion(Draw& draw) {
  const int scale = static_cast<int>(draw.one_in(3) ? draw.number(-1074, 840) : draw.number(-60, 60)),
            time_scale = static_cast<int>(draw.one_in(3) ? draw.number(-1000, 840) : draw.number(-20, 20));
  Motion m;
  m.t0 = draw.one_in(3) ? 0 : std::ldexp(static_cast<double>(draw.number(-1000, 1000)), time_scale);
  m.t1 = draw.one_in(3) ? next_after(m.t0, draw.number(1, 40))
                        : m.t0 + std::ldexp(static_cast<double>(draw.number(1, 1000)), time_scale);
  if (!(m.t0 < m.t1)) m.t1 = next_after(m.t0, 3);
  m.begin = {0};
  const long reach = draw.one_in(2) ? 1L << 50 : 1L << draw.number(1, 50), gap = draw.number(0, 40);
  std::vector<std::array<long, 3>> base;
  for (std::size_t v = 0; v < 4; ++v) {
    const bool again = v >= 2 && draw.one_in(2);  // follows vertex v - 2 at a small distance
    const std::size_t first = again ? m.begin[v - 2] : 0, count = again ? m.begin[v - 1] - first : 0;
    std::vector<double> t = times(draw, m.t0, m.t1);
    if (again) t.assign(m.times.begin() + static_cast<long>(first), m.times.begin() + static_cast<long>(first + count));
    for (std::size_t i = 0; i < t.size(); ++i) {
      std::array<long, 3> x;
      for (std::size_t k = 0; k < 3; ++k)
        x[k] = again ? base[first + i][k] - draw.number(0, gap) : draw.number(-reach, reach);
      base.push_back(x);
      m.times.push_back(t[i]);
      m.x.push_back({});
      for (std::size_t k = 0; k < 3; ++k) m.x.back()[k] = std::ldexp(static_cast<double>(x[k]), scale);
    }
    m.begin.push_back(m.times.size());
  }
  return m;
}

/// Piece k of the 2^halvings equal pieces of the step.
Piece piece(const Integers& exact, std::uint64_t k, std::uint64_t halvings) {
  const Piece& step = exact.step();
  const mpz_class duration = step.b - step.a, a = (step.a << halvings) + k * duration;
  return {a, a + duration, k, halvings, (std::uint64_t{1} << halvings) + k};
}

int compare(std::uint64_t seed) {
  Draw draw{std::mt19937_64(seed)};
  const Motion m = motion(draw);
  double unit = 1;  // rough size of positions
  for (const auto& x : m.x) unit = std::max(std::abs(x[0]), std::abs(x[1]));
  const bool distance = draw.one_in(2);
  const double eta = distance ? std::ldexp(unit, -static_cast<int>(draw.number(0, 50))) : 0;
  const Integers exact(m, -1200, -1200, eta, Reader("", "motion"));
  Enclosures quick(m, eta);
  int open = 0;
  for (int i = 0; i < 40; ++i) {
    const int halvings = draw.one_in(3) ? 0 : static_cast<int>(draw.number(0, 30));
    const long k = draw.number(0, (1L << halvings) - 1), most = draw.one_in(2) ? 1 : 1L << draw.number(0, 40);
    std::array<std::int64_t, 3> n{};
    for (auto& c : n) c = draw.number(-most + (most > 1 ? 1 : 0), most - (most > 1 ? 1 : 0));
    const Piece part = piece(exact, static_cast<std::uint64_t>(k), static_cast<std::uint64_t>(halvings));
    const std::vector<std::uint32_t> x(draw.one_in(2) ? 2 : 1, 0), y = {2};
    if (!quick.apart(n, part, x, y, distance)) continue;
    ++open;
    const mpz_class& least = exact.eta();
    const std::vector<Path> paths = {exact.path(0, part), exact.path(2, part)};
    EXPECT_TRUE(separated({n[0], n[1], n[2]}, part, distance ? mpz_class(least * least) : mpz_class(0), paths, 1))
        << "seed " << seed << ", question " << i;
  }
  return open;
}

TEST(Enclosures, NeverSayApartWhatIsNot) {
  int open = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) open += compare(seed);
  EXPECT_GT(open, 20000);
}

TEST(Enclosures, NeverSayApartWhatIsNotSlow) {
  for (std::uint64_t seed = 1 << 20; seed < (1 << 20) + 300000; ++seed) compare(seed);
}

/// Two vertices that rest at `x` and at -1.
Motion two_at_rest(double x, double end = 1) {
  Motion m;
  m.t1 = end;
  m.begin = {0, 2, 4};
  m.times = {0, end, 0, end};
  m.x = {{x, 0, 0}, {x, 0, 0}, {-1, 0, 0}, {-1, 0, 0}};
  return m;
}
bool apart(const Motion& m, const std::array<std::int64_t, 3>& n, std::uint64_t halvings, double eta = 0) {
  return Enclosures(m, eta).apart(n, {0, 1, 0, halvings, 1}, std::vector{0u}, std::vector{1u}, eta > 0);
}

TEST(Enclosures, RememberVerticesApart) {
  // More vertices than the number of boxes kept; vertex v rests at x = v.
  Motion m;
  m.t1 = 1;
  m.begin = {0};
  for (std::uint32_t v = 0; v < 40000; ++v) {
    for (const double t : {0.0, 1.0}) {
      m.times.push_back(t);
      m.x.push_back({static_cast<double>(v), 0, 0});
    }
    m.begin.push_back(m.times.size());
  }
  Enclosures all(m, 0);
  const Piece half{0, 1, 0, 1, 2};
  for (std::uint32_t v = 0; v + 32768 < 40000; v += 1000) {
    EXPECT_TRUE(all.apart({1, 0, 0}, half, std::vector{v + 32768}, std::vector{v}, false));
    EXPECT_FALSE(all.apart({1, 0, 0}, half, std::vector{v}, std::vector{v + 32768}, false));
  }
}

/// Two vertices that move up and down together. The first stays above the second by `above`, except at the breakpoint
/// `below`, where it is below.
Motion side_by_side(std::size_t breakpoints, std::size_t below, double above = 0.001) {
  Motion m;
  m.t1 = 1;
  m.begin = {0};
  for (const double more : {above, 0.0}) {
    for (std::size_t i = 0; i < breakpoints; ++i) {
      m.times.push_back(static_cast<double>(i) / static_cast<double>(breakpoints - 1));
      m.x.push_back({0, 0, static_cast<double>(i * i % 7) + (i == below ? -more : more)});
    }
    m.begin.push_back(m.times.size());
  }
  return m;
}

TEST(Enclosures, LookAtBreakpoints) {
  const auto is_above = [](const Motion& m, std::uint64_t halvings, double eta = 0) {
    return apart(m, {0, 0, 3}, halvings, eta);
  };
  constexpr std::size_t nowhere = 100;
  for (const std::uint64_t halvings : {0u, 1u, 4u, 30u}) EXPECT_TRUE(is_above(side_by_side(100, nowhere), halvings));
  for (const std::size_t below : {0u, 3u, 47u, 52u, 98u, 99u}) {
    EXPECT_FALSE(is_above(side_by_side(100, below), 0)) << below;
    EXPECT_EQ(is_above(side_by_side(100, below), 1), below > 50) << "behind the first half, or not: " << below;
    EXPECT_FALSE(apart(side_by_side(100, below), {0, 0, -3}, 0)) << below;
  }
  EXPECT_TRUE(is_above(side_by_side(100, nowhere), 0, 0.000999));
  EXPECT_FALSE(is_above(side_by_side(100, nowhere), 0, 0.001)) << "as near as the distance is too near";
  EXPECT_TRUE(is_above(side_by_side(100, nowhere, 0x1p-41), 0));
  EXPECT_FALSE(is_above(side_by_side(100, nowhere, 0x1p-44), 0)) << "too close for binary64";
}

TEST(Enclosures, LeaveWhatIsTooLargeToExactNumbers) {
  const std::int64_t large = std::int64_t{1} << 40;
  EXPECT_TRUE(apart(two_at_rest(1), {1, 0, 0}, 0));
  EXPECT_TRUE(apart(two_at_rest(1), {1, 0, 0}, 30));
  EXPECT_FALSE(apart(two_at_rest(1), {1, 0, 0}, 31));
  EXPECT_TRUE(apart(two_at_rest(1), {large - 1, 0, 0}, 0));
  EXPECT_FALSE(apart(two_at_rest(1), {large, 0, 0}, 0));
  EXPECT_FALSE(apart(two_at_rest(1), {1, -large, 0}, 0));
  EXPECT_FALSE(apart(two_at_rest(1), {1, 0, large}, 0));
  EXPECT_TRUE(apart(two_at_rest(0x1p900), {1, 0, 0}, 0));
  EXPECT_FALSE(apart(two_at_rest(0x1p901), {1, 0, 0}, 0));
  EXPECT_TRUE(apart(two_at_rest(1, 0x1p900), {1, 0, 0}, 0));
  EXPECT_FALSE(apart(two_at_rest(1, 0x1p901), {1, 0, 0}, 0));
  EXPECT_TRUE(apart(two_at_rest(1, 0x1p-900), {1, 0, 0}, 0));
  EXPECT_FALSE(apart(two_at_rest(1, 0x1p-901), {1, 0, 0}, 0));
}

TEST(Enclosures, DecideTheDistanceUnlessItIsNearlyReached) {
  for (const std::int64_t n : {std::int64_t{1}, std::int64_t{511}, std::int64_t{1} << 39}) {
    EXPECT_TRUE(apart(two_at_rest(1), {n, 0, 0}, 0, 1.99999));
    EXPECT_TRUE(apart(two_at_rest(1), {n, 0, 0}, 9, 1.99999));
    EXPECT_FALSE(apart(two_at_rest(1), {n, 0, 0}, 0, 2));
    EXPECT_TRUE(apart(two_at_rest(1), {n, n, 0}, 0, 1.4142));
    EXPECT_FALSE(apart(two_at_rest(1), {n, n, 0}, 0, 1.4143));
  }
}

}  // namespace
}  // namespace noli::checker::test
