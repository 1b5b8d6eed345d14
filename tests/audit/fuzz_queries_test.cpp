// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/fuzz_queries.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "audit/fuzz/queries/judge.h"
#include "audit/fuzz/queries/minimise_query.h"
#include "audit/fuzz/queries/query_generators.h"
#include "trajectory/formats/query_csv.h"

namespace noli::audit {
namespace {

/// Uses the oracle as the code under test: it is never wrong and independent of the kernel.
Decision decide_with_oracle(const AnyQuery& query, StageCounters& stages) {
  stages.count(Stage::gmp);
  const Truth truth = truth_of(query);
  if (!truth.time) return {};
  const double lower = truth.time->lower();
  return {TimeEnclosure{lower, 1}, truth.kind, lower};
}

/// Uses the oracle as the code under test for probes.
ProbeDecision probe_with_oracle(const AnyQuery& query, const Probe& probe) {
  const ProbeTruth truth = truth_of(query, probe);
  return {truth.within_t.has_value(), truth.within_t, truth.failure};
}

/// Misses contact at the end of the step, as code with a half-open interval would.
Decision forgets_the_end(const AnyQuery& query, StageCounters& stages) {
  const Decision decision = decide_with_oracle(query, stages);
  return decision.contact && decision.lower == 1 ? Decision{} : decision;
}

class FuzzQueries : public testing::Test {
 protected:
  FuzzQueries() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    options.out = std::filesystem::temp_directory_path() / ("noli-" + std::to_string(getpid()) + "-" + test->name());
    options.limits.seed = 5;
    options.limits.threads = 1;
    options.limits.count = 6000;  // two dozen blocks, the last one incomplete
    options.decide = decide_with_oracle;
    options.decide_probe = probe_with_oracle;
  }
  ~FuzzQueries() override { std::filesystem::remove_all(options.out); }

  QueryFuzzOptions options;
};

TEST_F(FuzzQueries, FindsNothingWhereNothingIsWrong) {
  const QueryFuzzReport report = fuzz_queries(options);
  EXPECT_EQ(report.items, *options.limits.count);
  EXPECT_EQ(report.findings_total, 0U);
  EXPECT_FALSE(report.interrupted);
  EXPECT_FALSE(std::filesystem::exists(options.out)) << "nothing to save, and yet a folder";
  EXPECT_EQ(report.stages[Stage::gmp], report.items);
  const ProbeTally& probes = report.probes;
  const std::uint64_t distances = probes.apart + probes.within;
  EXPECT_GE(distances, report.items / queries_per_distance);
  EXPECT_EQ(probes.failed + probes.failing + probes.never_failing, report.items);
  for (const auto count : {probes.apart, probes.within}) EXPECT_GT(count, distances / 20);
  for (const auto count : {probes.failed, probes.failing, probes.never_failing}) EXPECT_GT(count, report.items / 20);
}

TEST_F(FuzzQueries, FindsShrinksAndSavesAPlantedBug) {
  options.decide = forgets_the_end;
  options.max_findings = 3;
  const QueryFuzzReport report = fuzz_queries(options);
  ASSERT_EQ(report.findings.size(), 3U);
  EXPECT_GT(report.findings_total, 3U);
  for (const Finding& finding : report.findings) {
    StageCounters stages;
    EXPECT_EQ(finding.truth, ContactKind::touching);
    EXPECT_TRUE(difference(finding.shrunk, truth_of(finding.shrunk), forgets_the_end, stages)) << "no longer fails";
    EXPECT_EQ(replay(finding.shrunk, std::nullopt, forgets_the_end), std::vector<std::string>{finding.difference});
    EXPECT_LT(complexity(finding.shrunk), complexity(finding.query) / 2);
    EXPECT_NE(finding.difference.find("contact: found none"), std::string::npos) << finding.difference;
  }
}

TEST_F(FuzzQueries, SavedFilesHoldTheQueryAndItsLabel) {
  options.decide = forgets_the_end;
  options.max_findings = 6;
  const QueryFuzzReport report = fuzz_queries(options);
  ASSERT_FALSE(report.findings.empty());
  for (const Finding& finding : report.findings) {
    const QueryKind kind = file_kind(finding.query.pair);
    EXPECT_EQ(kind_from_file_name(finding.place), kind) << finding.place;
    const auto records = read_query_csv(finding.place, kind);
    ASSERT_EQ(records.size(), 1U);
    EXPECT_EQ(records[0].label, true);
    for (std::size_t i = 0; i < finding.shrunk.size(); ++i) {
      EXPECT_EQ(records[0].x_t0[i], finding.shrunk.x_t0[i]);
      EXPECT_EQ(records[0].x_t1[i], finding.shrunk.x_t1[i]);
    }
  }
}

TEST_F(FuzzQueries, FindsWrongKindsTimesAndEnclosures) {
  const auto spoilt = [](auto spoil) {
    return [spoil](const AnyQuery& query, StageCounters& stages) {
      Decision decision = decide_with_oracle(query, stages);
      if (decision.contact) spoil(decision);
      return decision;
    };
  };
  const std::array<std::pair<std::string, Decide>, 4> subjects = {{
      {"kind", spoilt([](Decision& d) { d.kind = ContactKind::crossing; })},
      {"first time", spoilt([](Decision& d) { d.lower = std::nextafter(d.lower, 2); })},
      {"enclosure", spoilt([](Decision& d) { d.contact->end = 0; })},
      {"threw", [](const AnyQuery&, StageCounters&) -> Decision { throw std::runtime_error("planted"); }},
  }};
  options.max_findings = 1;
  options.limits.count = 200;
  for (const auto& [word, decide] : subjects) {
    options.decide = decide;
    const QueryFuzzReport report = fuzz_queries(options);
    ASSERT_EQ(report.findings.size(), 1U) << word;
    EXPECT_EQ(report.findings[0].difference.substr(0, word.size()), word);
  }
}

TEST_F(FuzzQueries, FindsWrongDistancesAndFailureTimes) {
  const auto spoilt = [](auto spoil) {
    return [spoil](const AnyQuery& query, const Probe& probe) {
      ProbeDecision decision = probe_with_oracle(query, probe);
      spoil(decision, probe);
      return decision;
    };
  };
  const std::array<std::pair<std::string, DecideProbe>, 5> subjects = {{
      {"distance", spoilt([](ProbeDecision& d, const Probe&) { d.within = false; })},
      {"distance", spoilt([](ProbeDecision& d, const Probe& p) {
         if (p.eta.value_or(0) > 0) d = {true, 0.0, d.failure};
       })},
      {"distance", spoilt([](ProbeDecision& d, const Probe&) {
         if (d.within_t) d.within_t = std::nextafter(*d.within_t, 2);
       })},
      {"failure time", spoilt([](ProbeDecision& d, const Probe&) { d.failure = std::nextafter(d.failure, 1e300); })},
      {"threw", [](const AnyQuery&, const Probe&) -> ProbeDecision { throw std::runtime_error("planted"); }},
  }};
  options.max_findings = 2;
  options.limits.count = 6000;
  for (const auto& [word, decide] : subjects) {
    options.decide_probe = decide;
    const QueryFuzzReport report = fuzz_queries(options);
    ASSERT_EQ(report.findings.size(), 2U) << word;
    for (const Finding& finding : report.findings) {
      EXPECT_EQ(finding.difference.substr(0, word.size()), word);
      EXPECT_TRUE(difference(finding.shrunk, finding.probe, truth_of(finding.shrunk, finding.probe), decide));
      EXPECT_LT(complexity(finding.shrunk), complexity(finding.query));
      EXPECT_TRUE(replay(finding.shrunk, finding.probe).empty()) << "the kernel does not have the planted fault";
      EXPECT_EQ(replay(finding.shrunk, finding.probe, decide_with_oracle, decide),
                std::vector<std::string>{finding.difference});
    }
  }
}

TEST_F(FuzzQueries, ProbesLeaveTheStreamsOfQueriesAsTheyAre) {
  options.decide = forgets_the_end;
  options.max_findings = 2;
  const QueryFuzzReport report = fuzz_queries(options);
  ASSERT_FALSE(report.findings.empty());
  const Finding& finding = report.findings[0];
  const auto generators = query_generators();
  Random random(options.limits.seed, finding.block);
  AnyQuery query;
  for (std::size_t i = 0; i <= finding.index; ++i) query = generators[finding.block % generators.size()](random).query;
  EXPECT_EQ(query, finding.query);
}

TEST_F(FuzzQueries, SavedProbesComeBack) {
  options.decide_probe = [](const AnyQuery&, const Probe&) { return ProbeDecision{true, 0.25, 7}; };
  options.max_findings = 4;
  const QueryFuzzReport report = fuzz_queries(options);
  ASSERT_EQ(report.findings.size(), 4U);
  for (const Finding& finding : report.findings) {
    std::ifstream file(finding.place);
    std::string line, last;
    while (std::getline(file, line)) last = line;
    const auto saved = parse_probe_line(last);
    ASSERT_TRUE(saved) << last;
    EXPECT_EQ(saved->probe, finding.probe);
    EXPECT_EQ(saved->dimension, finding.shrunk.dimension);
    EXPECT_TRUE(fits(finding.shrunk, saved->probe));
    EXPECT_EQ(read_query_csv(finding.place, file_kind(finding.query.pair)).size(), 1U) << "the line is a comment";
  }
}

TEST(Probe, LinesThatAreNoneAreRefused) {
  const std::string good = "# noli-fuzz dimension 2 eta 0.5 normal 1 -2 0 gap -1e-300 from 0 points 0 1 rays 1 0";
  EXPECT_EQ(parse_probe_line(good).value().probe.eta, 0.5);
  EXPECT_FALSE(parse_probe_line("# noli-fuzz dimension 3 eta none normal 1 -2 0 gap 0 from 0 points 0 1 rays 1 0")
                   .value()
                   .probe.eta);
  for (const char* const bad :
       {"", "# a comment", "# noli-fuzz dimension 1 eta 0.5 normal 1 -2 0 gap 0 from 0 points 0 1 rays 1 0",
        "# noli-fuzz dimension 2 eta -1 normal 1 -2 0 gap 0 from 0 points 0 1 rays 1 0",
        "# noli-fuzz dimension 2 eta 0.5 normal 1 inf 0 gap 0 from 0 points 0 1 rays 1 0",
        "# noli-fuzz dimension 2 eta 0.5 normal 1 -2 0 gap 0 from 0 points 0 4 rays 1 0",
        "# noli-fuzz dimension 2 eta 0.5 normal 1 -2 0 gap 0 from 0 points 0 1 rays 1"}) {
    EXPECT_FALSE(parse_probe_line(bad)) << bad;
  }
  EXPECT_FALSE(parse_probe_line(good + " 0"));
  const AnyQuery edges{FeaturePair::edge_edge, 3, {}, {}};
  Probe probe;
  probe.points = {1, 2};
  EXPECT_TRUE(fits(edges, probe));
  probe.points = {2, 3};
  EXPECT_FALSE(fits(edges, probe));
}

TEST_F(FuzzQueries, GivesTheSameReportForAnyNumberOfThreads) {
  options.decide = forgets_the_end;
  options.max_findings = 4;
  const QueryFuzzReport one = fuzz_queries(options);
  for (const int threads : {2, 5}) {
    options.limits.threads = threads;
    const QueryFuzzReport many = fuzz_queries(options);
    EXPECT_EQ(many.items, one.items);
    EXPECT_EQ(many.answers, one.answers);
    EXPECT_EQ(many.stages, one.stages);
    EXPECT_EQ(many.probes, one.probes);
    EXPECT_EQ(many.findings_total, one.findings_total);
    for (std::size_t i = 0; i < one.generators.size(); ++i) {
      EXPECT_EQ(many.generators[i].answers, one.generators[i].answers) << one.generators[i].name;
    }
    ASSERT_EQ(many.findings.size(), one.findings.size());
    for (std::size_t i = 0; i < one.findings.size(); ++i) {
      EXPECT_EQ(many.findings[i].block, one.findings[i].block);
      EXPECT_EQ(many.findings[i].index, one.findings[i].index);
      EXPECT_EQ(many.findings[i].shrunk, one.findings[i].shrunk);
    }
  }
}

TEST_F(FuzzQueries, AsksTheCorpusFirst) {
  options.corpus = options.out / "corpus";
  options.limits.count = 1000;
  const QueryFuzzReport first = fuzz_queries(options);
  EXPECT_GT(first.corpus.kept, 20U);
  EXPECT_EQ(first.corpus.signatures, first.corpus.kept);
  options.decide = forgets_the_end;
  options.limits.count = 1;
  options.max_findings = 1;
  const QueryFuzzReport second = fuzz_queries(options);
  EXPECT_EQ(second.corpus.replayed, first.corpus.kept);
  EXPECT_EQ(second.items, first.corpus.kept + 1);
  ASSERT_EQ(second.findings.size(), 1U);
  EXPECT_EQ(second.findings[0].generator.substr(0, 7), "corpus/");
  EXPECT_EQ(kind_from_file_name(second.findings[0].place), file_kind(second.findings[0].query.pair));
}

TEST_F(FuzzQueries, ShrinksSingleQueries) {
  Random random(3);
  std::size_t shrunk = 0;
  for (const QueryGenerator& generator : query_generators()) {
    if (generator.family != "at_the_ends") continue;
    for (int i = 0; i < 20; ++i) {
      const AnyQuery query = generator(random).query;
      StageCounters ignored;
      const bool fails = difference(query, truth_of(query), forgets_the_end, ignored).has_value();
      const auto finding = shrunk_finding(query, std::nullopt, forgets_the_end, probe_with_oracle);
      ASSERT_EQ(finding.has_value(), fails);
      if (!finding) continue;
      ++shrunk;
      EXPECT_TRUE(difference(finding->shrunk, truth_of(finding->shrunk), forgets_the_end, ignored));
      EXPECT_LE(complexity(finding->shrunk), complexity(query));
    }
  }
  EXPECT_GT(shrunk, 10U);
}

TEST_F(FuzzQueries, AnotherSeedGivesOtherQueries) {
  const QueryFuzzReport report = fuzz_queries(options);
  options.limits.seed = 6;
  EXPECT_NE(fuzz_queries(options).answers, report.answers);
}

TEST_F(FuzzQueries, StopsWhenTold) {
  std::atomic<bool> stop = false;
  options.limits.count.reset();
  options.limits.stop = &stop;
  int calls = 0;
  options.limits.progress = [&](double) { stop = ++calls == 3; };
  const QueryFuzzReport report = fuzz_queries(options);
  EXPECT_TRUE(report.interrupted);
  EXPECT_EQ(calls, 3);
  EXPECT_GT(report.items, 0U);
}

TEST_F(FuzzQueries, StopsWhenTimeIsUp) {
  options.limits.count.reset();
  options.limits.time_limit = std::chrono::milliseconds(1);
  const QueryFuzzReport report = fuzz_queries(options);
  EXPECT_GT(report.items, 0U);
  EXPECT_FALSE(report.interrupted);
}

TEST_F(FuzzQueries, WantsToKnowWhenToStop) {
  options.limits.count.reset();
  EXPECT_THROW(fuzz_queries(options), std::invalid_argument);
}

TEST_F(FuzzQueries, SaysWhereItCannotSave) {
  std::ofstream(options.out) << "a file where a folder should be";
  options.decide = forgets_the_end;
  const QueryFuzzReport report = fuzz_queries(options);
  EXPECT_THROW(report.not_saved.require_nothing(), std::runtime_error);
  ASSERT_FALSE(report.findings.empty()) << "what was found is told all the same";
  EXPECT_TRUE(report.findings[0].place.empty());
  std::filesystem::remove(options.out);
  EXPECT_NO_THROW(fuzz_queries(options).not_saved.require_nothing());
}

TEST_F(FuzzQueries, TheKernelPassesABlockOfEachGenerator) {
  options.decide = decide_with_kernel;
  options.decide_probe = probe_with_kernel;
  options.limits.count = query_generators().size() * queries_per_block;
  const QueryFuzzReport report = fuzz_queries(options);
  EXPECT_EQ(report.findings_total, 0U) << report.findings.at(0).generator << ": " << report.findings.at(0).difference;
}

TEST_F(FuzzQueries, SlowTheKernelPassesHalfAMillion) {
  options.decide = decide_with_kernel;
  options.decide_probe = probe_with_kernel;
  options.limits.seed = 2;
  options.limits.threads = 0;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  options.limits.count = 100000;  // sanitizers take twenty times as long
#else
  options.limits.count = 500000;
#endif
  const QueryFuzzReport report = fuzz_queries(options);
  EXPECT_EQ(report.findings_total, 0U) << report.findings.at(0).generator << ": " << report.findings.at(0).difference;
  for (const GeneratorTally& tally : report.generators) {
    for (std::size_t kind = 0; kind < 4; ++kind) {
      const bool enough = tally.answers[kind] * 20 >= tally.total();
      EXPECT_EQ(enough, tally.declared[kind]) << tally.name << " " << name(static_cast<ContactKind>(kind));
    }
  }
}

}  // namespace
}  // namespace noli::audit
