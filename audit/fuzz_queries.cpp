// SPDX-License-Identifier: Apache-2.0
#include "noli/audit/fuzz_queries.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "noli/audit/judge.h"
#include "noli/audit/minimise_query.h"
#include "noli/audit/query_generators.h"
#include "noli/kernel/parallel.h"

namespace noli::audit {

namespace {

using Clock = std::chrono::steady_clock;

/// A finding before it is shrunk. Only what the subject did wrong can be shrunk: what a generator promises holds for
/// its own queries.
struct RawFinding {
  Finding finding;
  bool by_subject = true;
};

struct BlockResult {
  std::array<std::uint64_t, 4> answers{};
  StageCounters stages;
  std::vector<RawFinding> findings;
};

/// What is wrong with the query itself, if the oracle's answer is not what its generator says.
std::optional<std::string> broken_promise(const QueryGenerator& generator, const Generated& generated,
                                          ContactKind truth) {
  if (generated.truth && *generated.truth != truth) {
    return fmt::format("construction: made to be {}, the oracle says {}", name(*generated.truth), name(truth));
  }
  if (!generator.declared[static_cast<std::size_t>(truth)]) {
    return fmt::format("declaration: {} is not among the generator's answers", name(truth));
  }
  return std::nullopt;
}

BlockResult run_block(const FuzzOptions& options, std::uint64_t block, std::size_t count) {
  const auto generators = query_generators();
  const QueryGenerator& generator = generators[block % generators.size()];
  Random random(options.seed, block);
  BlockResult result;
  const auto report = [&](std::size_t index, const AnyQuery& query, ContactKind truth, std::string what,
                          bool by_subject) {
    result.findings.push_back({{generator.name(), block, index, std::move(what), query, query, truth, {}}, by_subject});
  };
  for (std::size_t index = 0; index < count; ++index) {
    const Generated generated = generator(random);
    const Truth truth = truth_of(generated.query);
    ++result.answers[static_cast<std::size_t>(truth.kind)];
    if (auto what = difference(generated.query, truth, options.decide, result.stages)) {
      report(index, generated.query, truth.kind, std::move(*what), true);
    }
    if (auto what = broken_promise(generator, generated, truth.kind)) {
      report(index, generated.query, truth.kind, std::move(*what), false);
    }
  }
  return result;
}

void shrink(Finding& finding, const Decide& decide) {
  StageCounters ignored;
  const auto fails = [&](const AnyQuery& query) {
    return difference(query, truth_of(query), decide, ignored).has_value();
  };
  finding.shrunk = minimise(finding.query, fails);
  const Truth truth = truth_of(finding.shrunk);
  finding.truth = truth.kind;
  finding.difference = difference(finding.shrunk, truth, decide, ignored).value();
}

/// The last part names the kind of query, as `noli ccd` reads it.
std::string file_name(const FuzzOptions& options, const Finding& finding) {
  std::string pair(name(finding.query.pair));
  std::replace(pair.begin(), pair.end(), '_', '-');
  return fmt::format("seed{}-block{}-index{}-{}{}.csv", options.seed, finding.block, finding.index, pair,
                     finding.query.dimension == 2 ? "-2d" : "");
}

void save(Finding& finding, const FuzzOptions& options) {
  std::filesystem::create_directories(options.out);
  finding.file = options.out / file_name(options, finding);
  const QueryRecord record{finding.shrunk.x_t0, finding.shrunk.x_t1, finding.truth != ContactKind::apart};
  write_query_csv(finding.file, file_kind(finding.shrunk.pair), std::span(&record, 1));
}

class Fuzzing {
 public:
  explicit Fuzzing(const FuzzOptions& options) : options_(options), begin_(Clock::now()) {
    for (const QueryGenerator& generator : query_generators()) {
      report_.generators.push_back({generator.name(), generator.type, generator.declared, {}});
    }
  }

  FuzzReport run() {
    while (!finished()) {
      run_batch();
      if (options_.progress) options_.progress({report_.queries, report_.findings_total, seconds()});
    }
    return std::move(report_);
  }

 private:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

  std::uint64_t remaining() const {
    const std::uint64_t unlimited = std::uint64_t{1} << 60;
    return options_.count ? *options_.count - report_.queries : unlimited;
  }

  bool finished() {
    report_.interrupted = options_.stop && options_.stop->load();
    return report_.interrupted || remaining() == 0 ||
           (options_.time_limit && seconds() >= options_.time_limit->count());
  }

  /// Some blocks at once, taken over in order.
  void run_batch() {
    const auto threads = static_cast<std::uint64_t>(options_.threads > 0 ? options_.threads : hardware_threads());
    const std::uint64_t left = remaining(), blocks_left = (left + queries_per_block - 1) / queries_per_block;
    std::vector<BlockResult> results(std::min(8 * threads, blocks_left));
    const std::uint64_t first = next_block_;
    parallel_for(results.size(), static_cast<int>(threads), [&](std::size_t i) {
      const std::uint64_t before = i * queries_per_block;
      const std::uint64_t count = std::min<std::uint64_t>(queries_per_block, left - before);
      results[i] = run_block(options_, first + i, count);
    });
    for (BlockResult& result : results) take(std::move(result));
  }

  void take(BlockResult result) {
    GeneratorTally& tally = report_.generators[next_block_++ % report_.generators.size()];
    for (std::size_t kind = 0; kind < 4; ++kind) {
      tally.answers[kind] += result.answers[kind];
      report_.answers[kind] += result.answers[kind];
      report_.queries += result.answers[kind];
    }
    report_.stages += result.stages;
    report_.findings_total += result.findings.size();
    for (RawFinding& raw : result.findings) keep(std::move(raw));
  }

  void keep(RawFinding raw) {
    if (report_.findings.size() >= options_.max_findings) return;
    if (raw.by_subject) shrink(raw.finding, options_.decide);
    if (!options_.out.empty()) save(raw.finding, options_);
    report_.findings.push_back(std::move(raw.finding));
  }

  const FuzzOptions& options_;
  Clock::time_point begin_;
  std::uint64_t next_block_ = 0;
  FuzzReport report_;
};

}  // namespace

std::uint64_t GeneratorTally::total() const {
  return std::accumulate(answers.begin(), answers.end(), std::uint64_t{0});
}

FuzzReport fuzz_queries(const FuzzOptions& options) {
  if (!options.count && !options.time_limit && !options.stop) {
    throw std::invalid_argument("fuzz_queries: neither count, nor time limit, nor stop flag");
  }
  return Fuzzing(options).run();
}

}  // namespace noli::audit
