// SPDX-License-Identifier: Apache-2.0
//
// From what Google Benchmark measures to tables of ratios.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

#include <noli/contact.h>

namespace noli::bench {

constexpr int passes = 5;

/// Prints as usual, and remembers the median time of every benchmark by its name, in nanoseconds a pass: the time of
/// the processor, which other work on the machine disturbs least, or what the benchmark measured itself.
class MedianReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override;

  /// Nothing when the benchmark did not run (filtered out).
  const double* median_ns(const std::string& name) const;

 private:
  std::map<std::string, double> medians_;
};

/// A benchmark whose every iteration is one pass over all the work, repeated `passes` times; the median counts.
template <class Pass>
void register_passes(const std::string& name, Pass&& pass) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [pass = std::forward<Pass>(pass)](benchmark::State& state) mutable {
                                 for (auto _ : state) benchmark::DoNotOptimize(pass());
                               })
      ->Iterations(1)
      ->Repetitions(passes)
      ->ReportAggregatesOnly(true)
      ->Unit(benchmark::kMillisecond);
}

/// Calls `decide` on every query and adds up the answers.
template <class Query, class Decide>
std::size_t count_true(const std::vector<Query>& queries, Decide&& decide) {
  std::size_t count = 0;
  for (const Query& query : queries) count += decide(query);
  return count;
}

/// The head of a column of shares(): "% comparison / direction / ...".
std::string shares_head();

/// How much of the work each stage decided, in per cent: "31.2 / 57.0 / ...".
std::string shares(const StageCounters& counters, std::size_t queries);

/// A Markdown table: a row of cells at a time.
class Table {
 public:
  explicit Table(const std::vector<std::string>& head);
  void row(const std::vector<std::string>& cells);
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace noli::bench
