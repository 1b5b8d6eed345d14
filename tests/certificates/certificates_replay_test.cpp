// SPDX-License-Identifier: Apache-2.0
//
// Tests that no certificate fails too late: plays back motions followed by certificates and checks exactly that each
// pair of features is always farther apart than its next layer (proofs/theory.md, C1).
#include "certificates_replay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "certificates/cells.h"
#include "certificates_kicks.h"
#include "tests/support/every_pair.h"

namespace noli::certificates {
namespace {

using test::Breakpoint;
using test::Fault;
using test::KickOptions;
using test::MotionSegment;
using test::RandomKicks;
using test::Replay;
using test::ReplayCounts;
using test::Track;

constexpr double infinity = std::numeric_limits<double>::infinity();

// --- The test of the test --------------------------------------------------------------------------------------------

/// A vertex that sinks to `lowest` above an edge at rest and rises again, at `offset` from the origin.
std::vector<Track<2>> dip(double lowest, double offset) {
  const auto at = [offset](double t, double x, double y) { return Breakpoint<2>{t, {offset + x, offset + y}}; };
  return {{at(0, 0.5, 1), at(1, 0.5, lowest), at(2, 0.5, 1)},
          {at(0, 0, 0), at(0.75, 0, 0), at(2, 0, 0)},
          {at(0, 1, 0), at(1.375, 1, 0), at(2, 1, 0)}};
}

const Stencil vertex_and_edge{FeaturePair::vertex_edge, {0, 1, 2, 0}, 0};

bool stays_farther(const std::vector<Track<2>>& tracks, double begin, double end, double eta, ReplayCounts& counts) {
  Replay<2> replay(tracks);
  Vector<2> n = Vector<2>::Zero();
  const bool farther = replay.stays_farther(vertex_and_edge, begin, end, eta, n);
  counts += replay.counts();
  return farther;
}

TEST(Replay, TellsTheLastBitHoweverFarOut) {
  for (const double offset : {0.0, 0x1p10, 0x1p30}) {
    const double unit = std::max(offset, 0.25) * 0x1p-52, eta = 0.25;
    ReplayCounts counts;
    EXPECT_TRUE(stays_farther(dip(0.25 + 2 * unit, offset), 0, 2, eta, counts));
    EXPECT_FALSE(stays_farther(dip(0.25, offset), 0, 2, eta, counts)) << "a distance of eta is no more than eta";
    EXPECT_FALSE(stays_farther(dip(0.25 - 2 * unit, offset), 0, 2, eta, counts));
    EXPECT_GT(counts.exact, 0U);
    EXPECT_TRUE(stays_farther(dip(0.25 - 2 * unit, offset), 0, 0.99, eta, counts)) << "it is farther before";
    EXPECT_TRUE(stays_farther(dip(0.25 - 2 * unit, offset), 1.01, 2, eta, counts)) << "and after";
    EXPECT_FALSE(stays_farther(dip(0.25, offset), 0, 1, eta, counts)) << "pieces are closed";
    EXPECT_FALSE(stays_farther(dip(0.25, offset), 1, 2, eta, counts));
  }
}

/// The chords begin at different times, so the coordinates at ends of pieces are not doubles.
TEST(Replay, ChordsThatBeginWheneverAreExact) {
  const MotionSegment<2> vertex{0, 3, {0.5, 1}, {0.5, -0.5}};  // 0.5 (2 - t)
  const MotionSegment<2> left{0.1, 5, {0, 0}, {0, 0}}, right{-1, 7, {1, 0}, {1, 0}};
  const std::array<MotionSegment<2>, 3> chords{vertex, left, right};
  const auto within = [&chords](double begin, double end) {
    return test::comes_within<2>(FeaturePair::vertex_edge, chords, begin, end, 0.25);
  };
  EXPECT_TRUE(within(1, 1.5));
  EXPECT_FALSE(within(1, std::nextafter(1.5, 0)));
  EXPECT_TRUE(within(2.5, 3));
  EXPECT_FALSE(within(std::nextafter(2.5, 3), 3));
}

/// Compares with distances at many times, for all kinds of pairs in space.
TEST(Replay, AgreesWithDistancesAtManyTimes) {
  noli::test::Random random(5);
  int farther = 0, within = 0;
  for (int round = 0; round < 400; ++round) {
    const FeaturePair kind = all_feature_pairs[static_cast<std::size_t>(round) % all_feature_pairs.size()];
    const Stencil s{kind, {0, 1, 2, 3}, 0};
    std::vector<Track<3>> tracks(s.size());
    for (auto& track : tracks) {
      for (int b = 0; b < 4; ++b) {
        const double t = b == 0 ? 0 : b == 3 ? 3 : b + 0.4 * random.unit();
        track.push_back({t, {random.unit(), random.unit(), random.unit()}});
      }
    }
    double least = infinity;
    constexpr int fine = 3000;
    for (int k = 0; k <= fine; ++k) {
      const double t = 3.0 * k / fine;
      std::array<Vector<3>, 4> x;
      for (std::size_t i = 0; i < s.size(); ++i) {
        std::size_t b = 0;
        while (b + 2 < tracks[i].size() && tracks[i][b + 1].t < t) ++b;
        x[i] = MotionSegment<3>{tracks[i][b].t, tracks[i][b + 1].t, tracks[i][b].x, tracks[i][b + 1].x}.at(t);
      }
      least = std::min(least, closest<3>(kind, std::span<const Vector<3>>(x.data(), s.size())).distance());
    }
    Replay<3> replay(tracks);
    Vector<3> n = Vector<3>::Zero();
    const double eta = 0.02 + 0.2 * random.unit();
    if (std::abs(least - eta) < 0.02) continue;  // between samples it may be nearer
    const bool claim = replay.stays_farther(s, 0, 3, eta, n);
    EXPECT_EQ(claim, least > eta) << round << " " << name(kind);
    (claim ? farther : within) += 1;
  }
  EXPECT_GT(farther, 50);
  EXPECT_GT(within, 50);
}

// --- Random kicks ---------------------------------------------------------------------------------------------------

struct Sum {
  std::uint64_t kicks = 0, scenes = 0, late = 0;
  ReplayCounts replayed;
  CertificateCounts certificates;
};

/// Sizes, positions, speeds and times of all scales, chosen by `number`.
KickOptions options_of(std::uint64_t number) {
  noli::test::Random random(number);
  const auto one_of = [&random](std::initializer_list<double> values) {
    return values.begin()[random.below(static_cast<int>(values.size()))];
  };
  KickOptions o;
  o.seed = number;
  o.eta = one_of({0x1p-20, 1e-3, 0.01, 3});
  o.beat = one_of({1e-7, 1e-3, 1});
  o.offset = one_of({0, 1, 1e3, 1e6, 0x1p32});
  o.drift = one_of({0, 1, 1e3});
  o.start = one_of({0, 1e3, 1e8});
  o.slice = one_of({2, 20, 200});
  o.bodies = random.below(8) == 0 ? 16 : 4 + random.below(5);
  o.many_walls = random.below(2) == 0 ? 4 : 64;
  return o;
}

template <int Dim, template <int, class> class Certificates>
void kick_scene(const KickOptions& options, std::uint64_t kicks, Sum& sum) {
  RandomKicks<Dim, Certificates> scene(options);
  ++sum.scenes;
  while (scene.kicks() < kicks) {
    scene.run_window();
    const auto late = scene.replay();
    if (!late) continue;
    ++sum.late;
    if (options.fault == Fault::none) {
      ADD_FAILURE() << "scene " << options.seed << ": " << name(late->kind) << " of vertices " << late->vertices[0]
                    << " " << late->vertices[1] << " " << late->vertices[2] << " " << late->vertices[3];
    }
    break;
  }
  sum.kicks += scene.kicks();
  sum.replayed += scene.replayed();
  sum.certificates += scene.certificates();
}

template <template <int, class> class Certificates>
Sum kick_scenes(std::uint64_t first, std::uint64_t count, std::uint64_t kicks, Fault fault = Fault::none) {
  Sum sum;
  for (std::uint64_t number = first; number < first + count; ++number) {
    KickOptions o = options_of(number);
    o.fault = fault;
    number % 5 < 3 ? kick_scene<3, Certificates>(o, kicks, sum) : kick_scene<2, Certificates>(o, kicks, sum);
  }
  return sum;
}

void print(const char* what, const Sum& s) {
  std::printf(
      "%s: %.0f kicks in %.0f scenes; layers %.0f on, %.0f off, deepest %u; plans %.0f (%.0f in pens), slabs %.0f; "
      "replayed %.0f "
      "pieces (%.0f within twice the bound, %.0f by integers) and %.0f by boxes; nearest %.3g above the bound\n",
      what, static_cast<double>(s.kicks), static_cast<double>(s.scenes),
      static_cast<double>(s.certificates.activations), static_cast<double>(s.certificates.deactivations),
      s.certificates.deepest, static_cast<double>(s.certificates.plans), static_cast<double>(s.certificates.penned),
      static_cast<double>(s.certificates.repairs), static_cast<double>(s.replayed.pieces),
      static_cast<double>(s.replayed.near), static_cast<double>(s.replayed.exact),
      static_cast<double>(s.replayed.boxed), s.replayed.least);
}

/// Expects no late certificate, and enough events that one could have been late.
void expect_busy(const Sum& s) {
  EXPECT_EQ(s.late, 0U);
  EXPECT_GT(s.certificates.activations * 40, s.kicks);
  EXPECT_GT(s.certificates.deactivations * 40, s.kicks);
  EXPECT_GT(s.replayed.near, s.kicks);
  EXPECT_GT(s.certificates.deepest, 8U);
}

TEST(CertificatesReplayed, CellsAreNeverLate) {
  const Sum sum = kick_scenes<Cells>(0, 60, 2000);
  print("cells", sum);
  EXPECT_GT(sum.certificates.penned * 30, sum.certificates.plans);
  expect_busy(sum);
}

TEST(CertificatesReplayed, TheLiteralAlgorithmIsNeverLate) {
  const Sum sum = kick_scenes<EveryPair>(0, 30, 1000);
  print("every pair", sum);
  expect_busy(sum);
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(NDEBUG)
constexpr std::uint64_t part = 10;  // takes thirty times as long
#else
constexpr std::uint64_t part = 1;
#endif

TEST(CertificatesReplayed, SlowCellsAreNeverLateInTenMillionKicks) {
  const Sum sum = kick_scenes<Cells>(1000, 500 / part, 20'000);
  print("cells", sum);
  EXPECT_GE(sum.kicks, 10'000'000U / part);
  EXPECT_GT(sum.certificates.penned * 30, sum.certificates.plans);
  expect_busy(sum);
}

TEST(CertificatesReplayed, SlowTheLiteralAlgorithmIsNeverLateInAMillionKicks) {
  const Sum sum = kick_scenes<EveryPair>(1000, 100 / part, 10'000);
  print("every pair", sum);
  EXPECT_GE(sum.kicks, 1'000'000U / part);
  expect_busy(sum);
}

/// Faults that make certificates a little late must be found.
class CertificatesWithAFault : public testing::TestWithParam<Fault> {};

TEST_P(CertificatesWithAFault, AreFoundLate) {
  const Fault fault = GetParam();
  const Sum cells = kick_scenes<Cells>(0, 10, 3000, fault), literal = kick_scenes<EveryPair>(0, 10, 3000, fault);
  std::printf("fault %d: found in %d and %d of %d scenes\n", static_cast<int>(fault), static_cast<int>(cells.late),
              static_cast<int>(literal.late), 10);
  EXPECT_GE(cells.late, 3U);
  EXPECT_GE(literal.late, 3U);
}

INSTANTIATE_TEST_SUITE_P(Faults, CertificatesWithAFault, testing::Values(Fault::late, Fault::thin, Fault::forgetful));

}  // namespace
}  // namespace noli::certificates
