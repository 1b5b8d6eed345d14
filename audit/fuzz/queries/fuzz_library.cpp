// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/fuzz_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <tuple>
#include <utility>

#include <noli/contact.h>
#include "audit/fuzz/fuzzing_library.h"
#include "audit/fuzz/queries/judge.h"
#include "audit/fuzz/queries/minimise_query.h"
#include "audit/fuzz/queries/query_generators.h"
#include "audit/fuzz/queries/saved_query.h"
#include "audit/fuzz/save_finding.h"

namespace noli::audit {

namespace {

namespace fs = std::filesystem;

std::vector<QueryGenerator> library_generators() {
  std::vector<QueryGenerator> result;
  for (const QueryGenerator& generator : query_generators()) {
    if (is_library_query(generator.type)) result.push_back(generator);
  }
  return result;
}

/// What became of some queries of one pair that were asked together.
struct Asked {
  std::uint64_t asked = 0, contacts = 0;
  FaultCounts faults{};
  std::vector<LibraryFinding> findings;
  Reached reached;  ///< where there is a corpus
};

std::string whole_signature(const AnyQuery& query, const LibraryAnswer& answer,
                            const std::optional<ExactContact>& exact) {
  StageCounters stages;
  visit(query, [&](const auto& typed) { contact(typed, &stages); });
  const std::optional<double> time = exact ? std::optional(exact->time) : std::nullopt;
  return signature(query, deciding_stage(stages), exact ? exact->kind : ContactKind::apart, time.value_or(0)) + "-" +
         signature_of_answer(answer, time);
}

/// The kernel is what a finding is judged by, so the oracle looks at what is told to the world.
void require_that_the_oracle_agrees(const AnyQuery& query) {
  const Truth truth = truth_of(query);
  const std::optional<ExactContact> exact = exact_contact(query);
  const bool same =
      !exact ? truth.kind == ContactKind::apart : truth.kind == exact->kind && truth.time->lower() == exact->time;
  if (same) return;
  throw std::logic_error("kernel and oracle disagree on a query that a library got wrong");
}

class LibraryFuzzing
    : public FuzzingLibrary<LibraryFuzzing, LibraryFuzzOptions, LibraryFuzzReport, Asked, QueryCorpus> {
 public:
  static constexpr std::uint64_t items_per_block = queries_per_block;

  explicit LibraryFuzzing(const LibraryFuzzOptions& options)
      : FuzzingLibrary(options), generators_(library_generators()) {
    for (const QueryGenerator& generator : generators_) {
      report_.generators.push_back({generator.name(), std::string(generator.attacks), 0, 0, {}});
    }
  }

  std::uint64_t items() const { return asked_queries_; }

  Asked make_block(std::uint64_t block, std::uint64_t count) const {
    const QueryGenerator& generator = generators_[block % generators_.size()];
    Random random(options_.limits.seed, block);
    std::vector<AnyQuery> queries;
    for (std::size_t i = 0; i < count; ++i) queries.push_back(generator(random).query);
    return ask_all(queries, generator.name(), block);
  }

  void take_block(Asked asked) { take(std::move(asked), &report_.generators[block_ % generators_.size()]); }

  /// Each query by itself, so that it does not matter what else is in the folder.
  void run_corpus() {
    std::vector<const CorpusQuery*> queries;
    for (const CorpusQuery& one : corpus_->queries()) {
      if (is_library_query({one.saved.query.pair, one.saved.query.dimension})) queries.push_back(&one);
    }
    std::vector<Asked> results(queries.size());
    parallel_for(queries.size(), options_.limits.threads, [&](std::size_t i) {
      results[i] = ask_all({queries[i]->saved.query}, "corpus/" + queries[i]->name, 0);
      for (LibraryFinding& finding : results[i].findings) finding.index = queries[i]->index;
    });
    report_.corpus.replayed = queries.size();
    for (Asked& asked : results) {
      for (const auto& [signature, query] : asked.reached) corpus_->reached(signature);
      take(std::move(asked), nullptr);
    }
  }

  void count_corpus() { corpus_->count(report_.corpus); }

  void shrink_findings() {
    std::vector<LibraryFinding>& findings = report_.findings;
    parallel_for(findings.size(), options_.limits.threads, [&](std::size_t i) {
      LibraryFinding& finding = findings[i];
      ShrunkForLibrary shrunk = shrink_for_library(options_.asked, finding.query, finding.found, report_.knows_times);
      finding.shrunk = shrunk.query;
      finding.found = std::move(shrunk.found);
      require_that_the_oracle_agrees(finding.shrunk);
    });
    std::vector<LibraryFinding> different;
    for (LibraryFinding& finding : findings) {
      const auto same = [&](const LibraryFinding& other) {
        return other.found.is_like(finding.found) && other.shrunk == finding.shrunk;
      };
      if (const auto found = std::find_if(different.begin(), different.end(), same); found != different.end()) {
        found->alike += finding.alike;
        if (!finding.file.empty()) fs::remove(finding.file);
        continue;
      }
      save(finding);
      different.push_back(std::move(finding));
    }
    std::ranges::stable_sort(different, {}, importance);
    findings = std::move(different);
  }

 private:
  Asked ask_all(const std::vector<AnyQuery>& queries, const std::string& generator, std::uint64_t block) const {
    Asked result;
    const std::vector<LibraryAnswer> answers = ask(asked_, queries.at(0).pair, queries);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const AnyQuery& query = queries[i];
      if (answers[i].given.state == AnswerState::not_asked) continue;
      const std::optional<ExactContact> exact = exact_contact(query);
      ++result.asked;
      result.contacts += exact ? 1 : 0;
      if (corpus_) {
        const ReachingQuery reaching{{query, std::nullopt}, exact.has_value()};
        result.reached.try_emplace(whole_signature(query, answers[i], exact), reaching);
      }
      const auto fault = fault_of(answers[i], exact, report_.knows_times, asked_.late_tolerance);
      if (!fault) continue;
      ++result.faults[static_cast<std::size_t>(fault->fault)];
      if (counts(fault->fault, asked_.exact))
        result.findings.push_back({*fault, generator, block, i, query, query, 0, {}});
    }
    return result;
  }

  void take(Asked asked, LibraryTally* tally) {
    asked_queries_ += asked.asked;
    report_.contacts += asked.contacts;
    if (tally != nullptr) tally->asked += asked.asked, tally->contacts += asked.contacts;
    for (std::size_t i = 0; i < library_fault_count; ++i) {
      report_.faults[i] += asked.faults[i];
      if (tally != nullptr) tally->faults[i] += asked.faults[i];
    }
    if (corpus_) corpus_->keep_new(asked.reached, report_.not_saved);
    for (LibraryFinding& finding : asked.findings) keep_simplest(std::move(finding));
  }

  /// Missed crossings first; of equal faults those of ordinary queries, which no special position explains.
  static std::tuple<int, bool, bool> importance(const LibraryFinding& finding) {
    return {rank(finding.found.fault), finding.found.kind != ContactKind::crossing,
            !finding.generator.starts_with("generic/")};
  }

  /// Drops the last of the least important findings if this one is more important, but none that is the only one of its
  /// fault and kind of contact. Whether there is room now.
  bool make_room_for(const LibraryFinding& finding) {
    auto& all = report_.findings;
    const auto spared = [&](const LibraryFinding& one) {
      const auto like = [&](const LibraryFinding& other) { return other.found.is_like(one.found); };
      return !one.found.is_like(finding.found) && std::ranges::count_if(all, like) == 1;
    };
    const auto key = [&](const LibraryFinding& one) { return std::pair(!spared(one), importance(one)); };
    const auto least = std::ranges::max_element(all.rbegin(), all.rend(), {}, key);
    if (least == all.rend() || spared(*least) || importance(*least) <= importance(finding)) return false;
    if (!least->file.empty()) fs::remove(least->file);
    all.erase(std::next(least).base());
    return true;
  }

  /// The simplest of each fault and generator, saved as it is: it is shrunk later, and should not be lost until then.
  void keep_simplest(LibraryFinding finding) {
    const bool room = is_kept();
    const auto same = [&](const LibraryFinding& other) {
      return other.found.is_like(finding.found) && other.generator == finding.generator;
    };
    auto& all = report_.findings;
    auto found = std::find_if(all.begin(), all.end(), same);
    if (found == all.end() && !room) {
      if (!make_room_for(finding)) return;
      found = all.end();
    }
    finding.alike = 1;
    if (found != all.end()) {
      ++found->alike;
      if (complexity(found->query) <= complexity(finding.query)) return;
      finding.alike = found->alike;
      if (!found->file.empty()) fs::remove(found->file);
    }
    if (!options_.out.empty()) finding.file = unused(options_.out / file_name(finding));
    save(finding);
    if (found != all.end()) {
      *found = std::move(finding);
    } else {
      all.push_back(std::move(finding));
    }
  }

  std::string file_name(const LibraryFinding& finding) {
    const bool corpus = finding.generator.starts_with("corpus/");
    const std::string origin = corpus ? fmt::format("corpus{}", ++corpus_findings_)
                                      : fmt::format("seed{}-block{}", options_.limits.seed, finding.block);
    std::string fault(name(finding.found.fault));
    std::replace(fault.begin(), fault.end(), '_', '-');
    return fmt::format("{}-{}-index{}-{}.csv", fault, origin, finding.index,
                       file_suffix({finding.query.pair, finding.query.dimension}));
  }

  void save(LibraryFinding& finding) {
    if (!finding.file.empty() && !report_.not_saved.attempt([&] { write(finding); })) finding.file.clear();
  }

  void write(const LibraryFinding& finding) const {
    std::vector<std::string> comments = {"# " + finding.found.words, "# from " + finding.generator};
    if (options_.command) comments.push_back("# " + options_.command(finding.file));
    save_query(finding.file, finding.shrunk, finding.found.kind != ContactKind::apart, comments);
  }

  std::vector<QueryGenerator> generators_;
  std::uint64_t asked_queries_ = 0, corpus_findings_ = 0;
};

}  // namespace

LibraryFuzzReport fuzz_library(const LibraryFuzzOptions& options) { return LibraryFuzzing(options).run(); }

ShrunkForLibrary shrink_for_library(const LibraryUnderTest& library, const AnyQuery& query, const FaultFound& fault,
                                    bool knows_times) {
  constexpr int most_costly = 400;  // of those that hang or take all memory
  const LibraryUnderTest asked = asked_while_shrinking(library, true);
  int costly = 0;
  const FirstFailure first_failure = [&](std::span<const AnyQuery> queries) -> std::optional<std::size_t> {
    if (costly >= most_costly || asked.host.stopped()) return std::nullopt;
    const std::vector<LibraryAnswer> answers = ask(asked, queries[0].pair, queries);
    for (const LibraryAnswer& answer : answers) {
      const AnswerState state = answer.given.state;
      costly += state == AnswerState::hung || state == AnswerState::too_much_memory ? 1 : 0;
    }
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const auto found = fault_of(answers[i], exact_contact(queries[i]), knows_times, library.late_tolerance);
      if (found && found->is_like(fault)) return i;
    }
    return std::nullopt;
  };
  const AnyQuery shrunk = minimise(query, first_failure);
  if (shrunk == query) return {query, fault};
  const std::vector<LibraryAnswer> again = ask(library, shrunk.pair, std::span(&shrunk, 1));
  const auto found = fault_of(again[0], exact_contact(shrunk), knows_times, library.late_tolerance);
  if (!found || !found->is_like(fault)) return {query, fault};  // another answer than before
  return {shrunk, *found};
}

FaultsFound faults_of(const LibraryUnderTest& library, FeaturePair pair, std::span<const AnyQuery> queries,
                      bool knows_times) {
  FaultsFound result;
  result.faults.resize(queries.size());
  const std::vector<LibraryAnswer> answers = ask(library, pair, queries);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    result.asked += answers[i].given.state == AnswerState::not_asked ? 0 : 1;
    const auto fault = fault_of(answers[i], exact_contact(queries[i]), knows_times, library.late_tolerance);
    if (fault && counts(fault->fault, library.exact)) result.faults[i] = fault;
  }
  return result;
}

}  // namespace noli::audit
