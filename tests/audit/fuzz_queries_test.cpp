// SPDX-License-Identifier: Apache-2.0
#include "noli/audit/fuzz_queries.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "noli/audit/judge.h"
#include "noli/audit/minimise_query.h"
#include "noli/audit/query_generators.h"
#include "noli/trajectory/query_csv.h"

namespace noli::audit {
namespace {

/// The oracle itself as the code under test: never wrong, and independent of the kernel.
Decision decide_with_oracle(const AnyQuery& query, StageCounters& stages) {
  stages.count(Stage::gmp);
  const Truth truth = truth_of(query);
  if (!truth.time) return {};
  const double lower = truth.time->lower();
  return {TimeEnclosure{lower, 1}, truth.kind, lower};
}

/// Takes a contact at the end of the step for none: what a half-open interval would do.
Decision forgets_the_end(const AnyQuery& query, StageCounters& stages) {
  const Decision decision = decide_with_oracle(query, stages);
  return decision.contact && decision.lower == 1 ? Decision{} : decision;
}

class FuzzQueries : public testing::Test {
 protected:
  FuzzQueries() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    options.out = std::filesystem::temp_directory_path() / ("noli-" + std::to_string(getpid()) + "-" + test->name());
    options.seed = 5;
    options.threads = 1;
    options.count = 6000;  // two dozen blocks, the last one not whole
    options.decide = decide_with_oracle;
  }
  ~FuzzQueries() override { std::filesystem::remove_all(options.out); }

  FuzzOptions options;
};

TEST_F(FuzzQueries, FindsNothingWhereNothingIsWrong) {
  const FuzzReport report = fuzz_queries(options);
  EXPECT_EQ(report.queries, *options.count);
  EXPECT_EQ(report.findings_total, 0U);
  EXPECT_FALSE(report.interrupted);
  EXPECT_FALSE(std::filesystem::exists(options.out)) << "nothing to save, and yet a folder";
  EXPECT_EQ(report.stages[Stage::gmp], report.queries);
}

TEST_F(FuzzQueries, FindsShrinksAndSavesAPlantedBug) {
  options.decide = forgets_the_end;
  options.max_findings = 3;
  const FuzzReport report = fuzz_queries(options);
  ASSERT_EQ(report.findings.size(), 3U);
  EXPECT_GT(report.findings_total, 3U);
  for (const Finding& finding : report.findings) {
    StageCounters stages;
    EXPECT_EQ(finding.truth, ContactKind::touching);
    EXPECT_TRUE(difference(finding.shrunk, truth_of(finding.shrunk), forgets_the_end, stages)) << "no longer fails";
    EXPECT_LT(complexity(finding.shrunk), complexity(finding.query) / 2);
    EXPECT_NE(finding.difference.find("contact: found none"), std::string::npos) << finding.difference;
  }
}

TEST_F(FuzzQueries, SavedFilesHoldTheQueryAndItsLabel) {
  options.decide = forgets_the_end;
  options.max_findings = 6;
  const FuzzReport report = fuzz_queries(options);
  ASSERT_FALSE(report.findings.empty());
  for (const Finding& finding : report.findings) {
    const QueryKind kind = file_kind(finding.query.pair);
    EXPECT_EQ(kind_from_file_name(finding.file), kind) << finding.file;
    const auto records = read_query_csv(finding.file, kind);
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
  options.count = 200;
  for (const auto& [word, decide] : subjects) {
    options.decide = decide;
    const FuzzReport report = fuzz_queries(options);
    ASSERT_EQ(report.findings.size(), 1U) << word;
    EXPECT_EQ(report.findings[0].difference.substr(0, word.size()), word);
  }
}

TEST_F(FuzzQueries, GivesTheSameReportForAnyNumberOfThreads) {
  options.decide = forgets_the_end;
  options.max_findings = 4;
  const FuzzReport one = fuzz_queries(options);
  for (const int threads : {2, 5}) {
    options.threads = threads;
    const FuzzReport many = fuzz_queries(options);
    EXPECT_EQ(many.queries, one.queries);
    EXPECT_EQ(many.answers, one.answers);
    EXPECT_EQ(many.stages, one.stages);
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

TEST_F(FuzzQueries, AnotherSeedGivesOtherQueries) {
  const FuzzReport report = fuzz_queries(options);
  options.seed = 6;
  EXPECT_NE(fuzz_queries(options).answers, report.answers);
}

TEST_F(FuzzQueries, StopsWhenTold) {
  std::atomic<bool> stop = false;
  options.count.reset();
  options.stop = &stop;
  int calls = 0;
  options.progress = [&](const FuzzProgress& progress) {
    EXPECT_GT(progress.queries, 0U);
    stop = ++calls == 2;
  };
  const FuzzReport report = fuzz_queries(options);
  EXPECT_TRUE(report.interrupted);
  EXPECT_EQ(calls, 2);
}

TEST_F(FuzzQueries, StopsWhenTimeIsUp) {
  options.count.reset();
  options.time_limit = std::chrono::milliseconds(1);
  const FuzzReport report = fuzz_queries(options);
  EXPECT_GT(report.queries, 0U);
  EXPECT_FALSE(report.interrupted);
}

TEST_F(FuzzQueries, WantsToKnowWhenToStop) {
  options.count.reset();
  EXPECT_THROW(fuzz_queries(options), std::invalid_argument);
}

TEST_F(FuzzQueries, SaysWhereItCannotSave) {
  std::ofstream(options.out) << "a file where a folder should be";
  options.decide = forgets_the_end;
  EXPECT_THROW(fuzz_queries(options), std::system_error);
}

TEST_F(FuzzQueries, TheKernelPassesABlockOfEachGenerator) {
  options.decide = decide_with_kernel;
  options.count = query_generators().size() * queries_per_block;
  const FuzzReport report = fuzz_queries(options);
  EXPECT_EQ(report.findings_total, 0U) << report.findings.at(0).generator << ": " << report.findings.at(0).difference;
}

TEST_F(FuzzQueries, SlowTheKernelPassesHalfAMillion) {
  options.decide = decide_with_kernel;
  options.seed = 2;
  options.threads = 0;
  options.count = 500000;
  const FuzzReport report = fuzz_queries(options);
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
