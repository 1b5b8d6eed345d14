// SPDX-License-Identifier: Apache-2.0
#include "noli/audit/fuzz_queries.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "noli/audit/judge.h"
#include "noli/audit/minimise_query.h"
#include "noli/audit/query_generators.h"
#include "noli/kernel/parallel.h"

namespace noli::audit {

namespace {

using Clock = std::chrono::steady_clock;

/// What went wrong. What a generator promises holds for its own queries: that cannot be shrunk.
enum class Fault { contact, probe, promise };

/// A finding before it is shrunk.
struct RawFinding {
  Finding finding;
  Fault fault;
};

/// Probes are made from the streams from here on, which no block is numbered by.
constexpr std::uint64_t probe_stream = std::uint64_t{1} << 63;

struct BlockResult {
  std::array<std::uint64_t, 4> answers{};
  ProbeTally probes;
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

void count(const Probe& probe, const ProbeTruth& truth, ProbeTally& tally) {
  if (probe.eta) ++(truth.within_t ? tally.within : tally.apart);
  ++(truth.failure == probe.from ? tally.failed : std::isfinite(truth.failure) ? tally.failing : tally.never_failing);
}

BlockResult run_block(const FuzzOptions& options, std::uint64_t block, std::size_t queries) {
  const auto generators = query_generators();
  const QueryGenerator& generator = generators[block % generators.size()];
  Random random(options.seed, block), probe_random(options.seed, probe_stream + block);
  BlockResult result;
  for (std::size_t index = 0; index < queries; ++index) {
    const Generated generated = generator(random);
    const AnyQuery& query = generated.query;
    const Probe probe = make_probe(query, index % queries_per_distance == 0, probe_random);
    const Truth truth = truth_of(query);
    const ProbeTruth probe_truth = truth_of(query, probe);
    const auto report = [&](std::optional<std::string> what, Fault fault) {
      if (!what) return;
      result.findings.push_back(
          {{generator.name(), block, index, std::move(*what), query, query, probe, truth.kind, {}}, fault});
    };
    ++result.answers[static_cast<std::size_t>(truth.kind)];
    count(probe, probe_truth, result.probes);
    report(difference(query, truth, options.decide, result.stages), Fault::contact);
    report(difference(query, probe, probe_truth, options.decide_probe), Fault::probe);
    report(broken_promise(generator, generated, truth.kind), Fault::promise);
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

/// Probes that may do as well, the simplest first.
std::vector<Probe> simpler(const Probe& probe) {
  std::vector<Probe> candidates(8, probe);
  if (probe.eta) candidates[0].eta = 0;
  if (probe.eta) candidates[1].eta = 1;
  candidates[2].from = 0;
  candidates[3].gap = 0;
  candidates[4].rays = {false, false};
  candidates[5].normal = {1, 0, 0};
  candidates[6].normal = {0, 1, 0};
  candidates[7].normal = {0, 0, 1};
  return candidates;
}

void shrink_probe(Finding& finding, const DecideProbe& decide) {
  const auto fault = [&](const AnyQuery& query, const Probe& probe) {
    return difference(query, probe, truth_of(query, probe), decide);
  };
  for (const Probe& candidate : simpler(finding.probe)) {
    if (fault(finding.query, candidate)) finding.probe = candidate;
  }
  finding.shrunk =
      minimise(finding.query, [&](const AnyQuery& query) { return fault(query, finding.probe).has_value(); });
  finding.truth = truth_of(finding.shrunk).kind;
  finding.difference = fault(finding.shrunk, finding.probe).value();
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
  std::ofstream comment(finding.file, std::ios::app | std::ios::binary);
  comment << probe_line(finding.shrunk, finding.probe) << '\n';
  comment.flush();
  if (!comment) throw std::system_error(std::make_error_code(std::errc::io_error), finding.file.string());
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
    report_.probes += result.probes;
    report_.stages += result.stages;
    report_.findings_total += result.findings.size();
    for (RawFinding& raw : result.findings) keep(std::move(raw));
  }

  void keep(RawFinding raw) {
    if (report_.findings.size() >= options_.max_findings) return;
    if (raw.fault == Fault::contact) shrink(raw.finding, options_.decide);
    if (raw.fault == Fault::probe) shrink_probe(raw.finding, options_.decide_probe);
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

ProbeTally& ProbeTally::operator+=(const ProbeTally& other) {
  apart += other.apart;
  within += other.within;
  failed += other.failed;
  failing += other.failing;
  never_failing += other.never_failing;
  return *this;
}

std::vector<std::string> replay(const AnyQuery& query, const std::optional<Probe>& probe, const Decide& decide,
                                const DecideProbe& decide_probe) {
  StageCounters ignored;
  std::vector<std::string> differences;
  if (auto what = difference(query, truth_of(query), decide, ignored)) {
    differences.push_back(std::move(*what));
  }
  if (!probe) return differences;
  if (auto what = difference(query, *probe, truth_of(query, *probe), decide_probe)) {
    differences.push_back(std::move(*what));
  }
  return differences;
}

FuzzReport fuzz_queries(const FuzzOptions& options) {
  if (!options.count && !options.time_limit && !options.stop) {
    throw std::invalid_argument("fuzz_queries: neither count, nor time limit, nor stop flag");
  }
  return Fuzzing(options).run();
}

}  // namespace noli::audit
