// SPDX-License-Identifier: Apache-2.0
//
// Queries of files: the textbook cubic, the kernel and the oracle, in one run. Each file is shuffled and repeated to
// 100,000 queries in memory; textbook and kernel pass over the same array; the median of five passes counts. The oracle
// gets a sample.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

#include <noli/contact.h>
#include "bench/bench.h"
#include "bench/data.h"
#include "bench/report.h"
#include "bench/textbook.h"
#include "oracle/oracle.h"

namespace noli::bench {
namespace {

constexpr std::size_t oracle_sample = 200;

template <class Query>
bool oracle_meet(const Query& query) {
  constexpr auto pair = Query::pair == FeaturePair::vertex_face ? oracle::Pair::vertex_face : oracle::Pair::edge_edge;
  return oracle::first_contact({pair, 3, query.x_t0, query.x_t1}).kind != oracle::Kind::apart;
}

template <class Query>
void register_file(const std::string& name, const std::vector<Query>& queries) {
  const auto work = std::make_shared<std::vector<Query>>(workload(queries));
  register_passes("textbook/" + name,
                  [work] { return count_true(*work, [](const Query& q) { return textbook_meet(q); }); });
  register_passes("noli/" + name, [work] { return count_true(*work, [](const Query& q) { return meet(q); }); });
  auto sample = *work;
  sample.resize(oracle_sample);
  register_passes("oracle/" + name, [sample = std::move(sample)] {
    return count_true(sample, [](const Query& q) { return oracle_meet(q); });
  });
}

/// Wrong answers of a method on a file.
struct Errors {
  std::size_t false_positives = 0, false_negatives = 0;
};

template <class Decide>
Errors errors(const QueryFile& file, Decide&& decide) {
  Errors result;
  std::visit(
      [&](const auto& queries) {
        for (std::size_t i = 0; i < queries.size(); ++i) {
          const bool contact = decide(queries[i]);
          result.false_positives += contact && !file.labels[i];
          result.false_negatives += !contact && file.labels[i];
        }
      },
      file.queries);
  return result;
}

std::string text(const Errors& errors) { return fmt::format("{}/{}", errors.false_positives, errors.false_negatives); }

template <class Query>
double median_of_calls_ns(const Query& query) {
  std::array<double, passes> ns{};
  for (double& call : ns) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(meet(query));
    call = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
  }
  std::nth_element(ns.begin(), ns.begin() + passes / 2, ns.end());
  return ns[passes / 2];
}

double slowest_ns(const QueryFile& file) {
  return std::visit(
      [](const auto& queries) {
        double slowest = 0;
        for (const auto& query : queries) slowest = std::max(slowest, median_of_calls_ns(query));
        return slowest;
      },
      file.queries);
}

StageCounters stages(const QueryFile& file) {
  StageCounters counters;
  std::visit([&](const auto& queries) { count_true(queries, [&](const auto& q) { return meet(q, &counters); }); },
             file.queries);
  return counters;
}

/// Time of all queries of some files, by two methods.
struct Pool {
  std::string name;
  double textbook = 0, noli = 0;

  void add(const QueryFile& file, double textbook_ns, double noli_ns) {
    textbook += textbook_ns * static_cast<double>(file.size());
    noli += noli_ns * static_cast<double>(file.size());
  }
};

class Pools {
 public:
  void add(const QueryFile& file, double textbook_ns, double noli_ns) {
    const auto is = [&](const char* part) { return file.name.find(part) != std::string::npos; };
    const bool handcrafted = is("erleben") || is("unit-tests");
    if (handcrafted) pools_[0].add(file, textbook_ns, noli_ns);
    if (handcrafted && !is("cube-cliff") && !is("unit-tests")) pools_[1].add(file, textbook_ns, noli_ns);
    if (is("cloth-funnel")) pools_[2].add(file, textbook_ns, noli_ns);
    if (is("armadillo")) pools_[3].add(file, textbook_ns, noli_ns);
  }

  void rows(Table& table) const {
    for (const Pool& pool : pools_) {
      if (pool.textbook > 0)
        table.row({pool.name, "", "", "", fmt::format("{:.2f}", pool.noli / pool.textbook), "", "", "", "", ""});
    }
  }

 private:
  std::array<Pool, 4> pools_ = {{{"handcrafted, all"},
                                 {"handcrafted, without cube-cliff and unit-tests"},
                                 {"cloth-funnel"},
                                 {"armadillo-rollers"}}};
};

std::string per_query(const double* pass_ns, std::size_t queries) {
  return pass_ns == nullptr ? "-" : fmt::format("{:.1f}", *pass_ns / static_cast<double>(queries));
}

std::size_t work_size(const QueryFile& file) { return (100'000 + file.size() - 1) / file.size() * file.size(); }

void add_row(const QueryFile& file, const MedianReporter& reporter, Table& table, Pools& pools) {
  const double* const textbook = reporter.median_ns("textbook/" + file.name);
  const double* const noli = reporter.median_ns("noli/" + file.name);
  if (textbook == nullptr || noli == nullptr) return;
  const auto work = static_cast<double>(work_size(file));
  pools.add(file, *textbook / work, *noli / work);
  table.row({file.name, fmt::format("{}", file.size()), per_query(textbook, work_size(file)),
             per_query(noli, work_size(file)), fmt::format("{:.2f}", *noli / *textbook),
             per_query(reporter.median_ns("oracle/" + file.name), oracle_sample),
             text(errors(file, [](const auto& q) { return textbook_meet(q); })),
             text(errors(file, [](const auto& q) { return meet(q); })), fmt::format("{:.1f}", slowest_ns(file) / 1000),
             shares(stages(file), file.size())});
}

void print_table(const std::vector<QueryFile>& files, const MedianReporter& reporter) {
  Table table({"file", "queries", "textbook ns", "noli ns", "ratio", "oracle ns", "textbook f.p./f.n.",
               "noli f.p./f.n.", "slowest noli µs", shares_head()});
  Pools pools;
  for (const QueryFile& file : files) add_row(file, reporter, table, pools);
  pools.rows(table);
  std::fputs(("\n" + table.text()).c_str(), stdout);
}

}  // namespace

bool run() {
  const auto files = read_query_files();
  for (const QueryFile& file : files) {
    std::visit([&](const auto& queries) { register_file(file.name, queries); }, file.queries);
  }
  MedianReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  print_table(files, reporter);
  return !files.empty();
}

}  // namespace noli::bench
