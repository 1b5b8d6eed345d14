// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/fuzz_queries.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <noli/errors.h>
#include "audit/fuzz/queries/judge.h"
#include "audit/fuzz/queries/minimise_query.h"
#include "audit/fuzz/queries/query_generators.h"
#include "audit/fuzz/queries/saved_query.h"
#include "audit/fuzz/save_finding.h"
#include "kernel/parallel.h"

namespace noli::audit {

namespace {

/// What went wrong. What a generator promises holds for its own queries: that cannot be shrunk.
enum class Fault { contact, probe, promise };

/// A finding before it is shrunk.
struct RawFinding {
  Finding finding;
  Fault fault;
};

/// Probes are made from the streams from here on, which no block is numbered by.
constexpr std::uint64_t probe_stream = std::uint64_t{1} << 63;
constexpr std::uint64_t corpus_stream = std::uint64_t{1} << 62;

/// A query to be asked, where it came from, and what its generator says of it.
struct Item {
  Generated generated;
  Probe probe;
  std::string generator;
  std::uint64_t block = 0;
  std::size_t index = 0;
  Answers declared = {true, true, true, true};
};

struct BlockResult {
  std::array<std::uint64_t, 4> answers{};
  ProbeTally probes;
  StageCounters stages;
  std::vector<RawFinding> findings;
  Reached reached;  ///< where there is a corpus
};

/// What is wrong with the query itself, if the oracle's answer is not what its generator says.
std::optional<std::string> broken_promise(const Item& item, ContactKind truth) {
  const auto& made = item.generated.truth;
  if (made && *made != truth) {
    return fmt::format("construction: made to be {}, the oracle says {}", name(*made), name(truth));
  }
  if (!item.declared[static_cast<std::size_t>(truth)]) {
    return fmt::format("declaration: {} is not among the generator's answers", name(truth));
  }
  return std::nullopt;
}

void count(const Probe& probe, const ProbeTruth& truth, ProbeTally& tally) {
  if (probe.eta) ++(truth.within_t ? tally.within : tally.apart);
  ++(truth.failure == probe.from ? tally.failed : std::isfinite(truth.failure) ? tally.failing : tally.never_failing);
}

void judge(const QueryFuzzOptions& options, const Item& item, BlockResult& result) {
  const AnyQuery& query = item.generated.query;
  const Truth truth = truth_of(query);
  const ProbeTruth probe_truth = truth_of(query, item.probe);
  StageCounters stages;
  const auto report = [&](std::optional<std::string> what, Fault fault) {
    if (!what) return;
    result.findings.push_back(
        {{{item.generator, item.block, item.index, std::move(*what), {}}, query, query, item.probe, truth.kind},
         fault});
  };
  ++result.answers[static_cast<std::size_t>(truth.kind)];
  count(item.probe, probe_truth, result.probes);
  report(difference(query, truth, options.decide, stages), Fault::contact);
  report(difference(query, item.probe, probe_truth, options.decide_probe), Fault::probe);
  report(broken_promise(item, truth.kind), Fault::promise);
  result.stages += stages;
  if (!options.corpus) return;
  const double first = truth.time ? truth.time->lower() : 0;
  result.reached.try_emplace(signature(query, deciding_stage(stages), truth.kind, first),
                             ReachingQuery{{query, item.probe}, truth.time.has_value()});
}

/// A query of the corpus that was saved without a probe gets one that depends on its number.
Item corpus_item(const QueryFuzzOptions& options, const CorpusQuery& one, std::size_t number) {
  Random random(options.limits.seed, corpus_stream + number);
  const AnyQuery& query = one.saved.query;
  const Probe probe = one.saved.probe ? *one.saved.probe : make_probe(query, true, random);
  return {{query, {}}, probe, "corpus/" + one.name, number, one.index};
}

/// What is wrong with the subject's answer.
std::optional<std::string> difference(const AnyQuery& query, const Decide& decide) {
  StageCounters ignored;
  return difference(query, truth_of(query), decide, ignored);
}
std::optional<std::string> difference(const AnyQuery& query, const Probe& probe, const DecideProbe& decide) {
  return difference(query, probe, truth_of(query, probe), decide);
}

void shrink(Finding& finding, const Decide& decide) {
  finding.shrunk =
      minimise(finding.query, [&](const AnyQuery& query) { return difference(query, decide).has_value(); });
  finding.truth = truth_of(finding.shrunk).kind;
  finding.difference = difference(finding.shrunk, decide).value();
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
  for (const Probe& candidate : simpler(finding.probe)) {
    if (difference(finding.query, candidate, decide)) finding.probe = candidate;
  }
  finding.shrunk = minimise(
      finding.query, [&](const AnyQuery& query) { return difference(query, finding.probe, decide).has_value(); });
  finding.truth = truth_of(finding.shrunk).kind;
  finding.difference = difference(finding.shrunk, finding.probe, decide).value();
}

std::string file_name(const QueryFuzzOptions& options, const Finding& finding) {
  const bool corpus = finding.generator.starts_with("corpus/");
  return fmt::format("{}-{}{}-index{}-{}.csv", corpus ? "corpus" : fmt::format("seed{}", options.limits.seed),
                     corpus ? "query" : "block", finding.block, finding.index,
                     file_suffix({finding.query.pair, finding.query.dimension}));
}

void save(Finding& finding, const QueryFuzzOptions& options) {
  finding.place = unused(options.out / file_name(options, finding));
  std::vector<std::string> comments = {"# " + on_one_line(finding.difference)};
  if (options.command) comments.push_back("# " + options.command(finding.place));
  comments.push_back(probe_line(finding.shrunk, finding.probe));
  save_query(finding.place, finding.shrunk, finding.truth != ContactKind::apart, comments);
}

class QueryFuzzing : public Fuzzing<QueryFuzzing, QueryFuzzOptions, QueryFuzzReport, Item, QueryCorpus> {
 public:
  static constexpr std::uint64_t items_per_block = queries_per_block;

  explicit QueryFuzzing(const QueryFuzzOptions& options) : Fuzzing(options) {
    for (const QueryGenerator& generator : query_generators()) {
      report_.generators.push_back({generator.name(), generator.type, generator.declared, {}});
    }
  }

  BlockResult make_block(std::uint64_t block, std::uint64_t count) const {
    const auto generators = query_generators();
    const QueryGenerator& generator = generators[block % generators.size()];
    Random random(options_.limits.seed, block), probe_random(options_.limits.seed, probe_stream + block);
    BlockResult result;
    for (std::size_t index = 0; index < count; ++index) {
      const Generated generated = generator(random);
      const Probe probe = make_probe(generated.query, index % queries_per_distance == 0, probe_random);
      judge(options_, {generated, probe, generator.name(), block, index, generator.declared}, result);
    }
    return result;
  }

  void take_block(BlockResult result) {
    take(std::move(result), &report_.generators[block_ % report_.generators.size()]);
  }

  void run_corpus() {
    const std::vector<CorpusQuery>& queries = corpus_->queries();
    std::vector<BlockResult> results(queries.size());
    parallel_for(queries.size(), options_.limits.threads,
                 [&](std::size_t i) { judge(options_, corpus_item(options_, queries[i], i), results[i]); });
    for (BlockResult& result : results) {
      for (const auto& [signature, query] : result.reached) corpus_->reached(signature);
      take(std::move(result), nullptr);
    }
    report_.corpus.replayed = queries.size();
  }

  void count_corpus() { corpus_->count(report_.corpus); }

  std::uint64_t items() const {
    return std::accumulate(report_.answers.begin(), report_.answers.end(), std::uint64_t{0});
  }

 private:
  void take(BlockResult result, GeneratorTally* tally) {
    for (std::size_t kind = 0; kind < 4; ++kind) {
      if (tally != nullptr) tally->answers[kind] += result.answers[kind];
      report_.answers[kind] += result.answers[kind];
    }
    report_.probes += result.probes;
    report_.stages += result.stages;
    if (corpus_) corpus_->keep_new(result.reached, report_.not_saved);
    for (RawFinding& raw : result.findings) found(std::move(raw));
  }

  void found(RawFinding raw) {
    if (!is_kept()) return;
    if (raw.fault == Fault::contact) shrink(raw.finding, options_.decide);
    if (raw.fault == Fault::probe) shrink_probe(raw.finding, options_.decide_probe);
    keep(std::move(raw.finding), [this](Finding& finding) { save(finding, options_); });
  }
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
  std::vector<std::string> differences;
  if (auto what = difference(query, decide)) differences.push_back(std::move(*what));
  if (!probe) return differences;
  if (auto what = difference(query, *probe, decide_probe)) differences.push_back(std::move(*what));
  return differences;
}

std::optional<Finding> shrunk_finding(const AnyQuery& query, const std::optional<Probe>& probe, const Decide& decide,
                                      const DecideProbe& decide_probe) {
  Finding finding;
  finding.query = finding.shrunk = query;
  if (probe) finding.probe = *probe;
  if (difference(query, decide)) {
    shrink(finding, decide);
    return finding;
  }
  if (!probe || !difference(query, *probe, decide_probe)) return std::nullopt;
  shrink_probe(finding, decide_probe);
  return finding;
}

QueryFuzzReport fuzz_queries(const QueryFuzzOptions& options) { return QueryFuzzing(options).run(); }

}  // namespace noli::audit
