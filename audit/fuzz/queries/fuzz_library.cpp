// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/fuzz_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <utility>

#include <noli/contact.h>
#include "audit/fuzz/finding_name.h"
#include "audit/fuzz/queries/judge.h"
#include "audit/fuzz/queries/minimise_query.h"
#include "audit/fuzz/queries/query_generators.h"
#include "audit/fuzz/queries/saved_query.h"

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
  std::map<std::string, std::size_t> reached;  ///< signatures, and the first query that has each
  std::vector<AnyQuery> queries;               ///< kept for the corpus only
  std::vector<bool> contact;                   ///< the same
};

struct Situation {
  LibraryUnderTest asked;  ///< to be asked until the time of the run is over
  bool knows_times = false;
  bool with_corpus = false;
};

std::optional<Stage> deciding_stage(const AnyQuery& query) {
  StageCounters counters;
  visit(query, [&](const auto& typed) { contact(typed, &counters); });
  for (const Stage stage : all_stages) {
    if (counters[stage] > 0) return stage;
  }
  return std::nullopt;
}

std::string whole_signature(const AnyQuery& query, const LibraryAnswer& answer,
                            const std::optional<ExactContact>& exact) {
  const std::optional<double> time = exact ? std::optional(exact->time) : std::nullopt;
  return signature(query, deciding_stage(query), exact ? exact->kind : ContactKind::apart, time.value_or(0)) + "-" +
         signature_of_answer(answer, time);
}

/// `blank`: generator and block of the findings.
Asked ask_all(const Situation& situation, std::vector<AnyQuery> queries, const LibraryFinding& blank) {
  Asked result;
  const bool with_corpus = situation.with_corpus;
  const std::vector<LibraryAnswer> answers = ask(situation.asked, queries.at(0).pair, queries);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (answers[i].given.state == AnswerState::not_asked) continue;
    const std::optional<ExactContact> exact = exact_contact(queries[i]);
    ++result.asked;
    result.contacts += exact ? 1 : 0;
    if (with_corpus) result.reached.try_emplace(whole_signature(queries[i], answers[i], exact), i);
    if (with_corpus) result.contact.resize(i + 1), result.contact[i] = exact.has_value();
    const auto fault = fault_of(answers[i], exact, situation.knows_times);
    if (!fault) continue;
    ++result.faults[static_cast<std::size_t>(fault->fault)];
    if (!counts(fault->fault, situation.asked.exact)) continue;
    LibraryFinding finding = blank;
    finding.found = *fault;
    finding.index = i;
    finding.query = finding.shrunk = queries[i];
    result.findings.push_back(std::move(finding));
  }
  if (with_corpus) result.queries = std::move(queries);
  return result;
}

/// The library's answers while a query is shrunk. What hangs is waited for but a part of the limit, and not often, or
/// it would take all day.
class Shrinking {
 public:
  Shrinking(const LibraryUnderTest& library, const FaultFound& found, bool knows_times)
      : library_(library), found_(found), knows_times_(knows_times) {
    library_.host.most_hangs = 1;
    library_.host.query_limit = std::min(library_.host.query_limit, std::max(library_.host.query_limit / 50, least));
    library_.host.deadline.reset();
  }

  std::optional<std::size_t> first_failure(std::span<const AnyQuery> queries) {
    constexpr int most_costly = 400;
    const std::atomic<bool>* const stop = library_.host.stop;
    if (costly_ >= most_costly || (stop != nullptr && stop->load())) return std::nullopt;
    const std::vector<LibraryAnswer> answers = ask(library_, queries[0].pair, queries);
    for (const LibraryAnswer& answer : answers) {
      const AnswerState state = answer.given.state;
      costly_ += state == AnswerState::hung || state == AnswerState::too_much_memory ? 1 : 0;
    }
    for (std::size_t i = 0; i < queries.size(); ++i) {
      if (fails(queries[i], answers[i])) return i;
    }
    return std::nullopt;
  }

 private:
  bool fails(const AnyQuery& query, const LibraryAnswer& answer) const {
    const auto fault = fault_of(answer, exact_contact(query), knows_times_);
    return fault && fault->is_like(found_);
  }

  static constexpr std::chrono::nanoseconds least = std::chrono::milliseconds(20);

  LibraryUnderTest library_;
  FaultFound found_;
  bool knows_times_;
  int costly_ = 0;
};

/// The kernel is what a finding is judged by, so the oracle looks at what is told to the world.
void require_that_the_oracle_agrees(const AnyQuery& query) {
  const Truth truth = truth_of(query);
  const std::optional<ExactContact> exact = exact_contact(query);
  const bool same =
      !exact ? truth.kind == ContactKind::apart : truth.kind == exact->kind && truth.time->lower() == exact->time;
  if (same) return;
  throw std::logic_error("kernel and oracle disagree on a query that a library was found wrong on");
}

class LibraryFuzzing : public Fuzzing<LibraryFuzzing, LibraryFuzzOptions, LibraryFuzzReport, Asked, QueryCorpus> {
 public:
  static constexpr std::uint64_t items_per_block = queries_per_block;

  explicit LibraryFuzzing(const LibraryFuzzOptions& options) : Fuzzing(options), generators_(library_generators()) {
    for (const QueryGenerator& generator : generators_) {
      report_.generators.push_back({generator.name(), std::string(generator.attacks), generator.type.pair, 0, 0, {}});
    }
  }

  LibraryFuzzReport run() {
    require_ccd_library(options_.asked.path, options_.asked.host);
    situation_.asked = options_.asked;
    if (const auto& limit = options_.limits.time_limit) {
      using Clock = std::chrono::steady_clock;
      situation_.asked.host.deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(*limit);
    }
    situation_.knows_times = report_.knows_times = knows_times(options_.asked);
    situation_.with_corpus = corpus_.has_value();
    report_ = Fuzzing::run();
    shrink_findings();
    report_.interrupted |= stopped();  // while they were shrunk
    return std::move(report_);
  }

  bool enough() const { return options_.first_only && report_.findings_total > 0; }
  std::uint64_t items() const { return asked_; }

  Asked make_block(std::uint64_t block, std::uint64_t count) const {
    const QueryGenerator& generator = generators_[block % generators_.size()];
    Random random(options_.limits.seed, block);
    std::vector<AnyQuery> queries;
    for (std::size_t i = 0; i < count; ++i) queries.push_back(generator(random).query);
    LibraryFinding blank;
    blank.generator = generator.name();
    blank.block = block;
    return ask_all(situation_, std::move(queries), blank);
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
      LibraryFinding blank;
      blank.generator = "corpus/" + queries[i]->name;
      results[i] = ask_all(situation_, {queries[i]->saved.query}, blank);
      for (LibraryFinding& finding : results[i].findings) finding.index = queries[i]->index;
    });
    report_.corpus.replayed = queries.size();
    for (Asked& asked : results) {
      for (const auto& [signature, i] : asked.reached) corpus_->reached(signature);
      asked.reached.clear();
      take(std::move(asked), nullptr);
    }
  }

  void count_corpus() {
    report_.corpus.signatures = corpus_->signatures();
    report_.corpus.kept = corpus_->kept();
  }

 private:
  void take(Asked asked, LibraryTally* tally) {
    asked_ += asked.asked;
    report_.contacts += asked.contacts;
    if (tally != nullptr) tally->asked += asked.asked, tally->contacts += asked.contacts;
    for (std::size_t i = 0; i < library_fault_count; ++i) {
      report_.faults[i] += asked.faults[i];
      if (tally != nullptr) tally->faults[i] += asked.faults[i];
    }
    for (const auto& reached : asked.reached) {
      const std::string& signature = reached.first;
      const std::size_t i = reached.second;
      if (!corpus_->reached(signature)) continue;
      report_.not_saved.attempt([&] { corpus_->keep(signature, {asked.queries[i], std::nullopt}, asked.contact[i]); });
    }
    for (LibraryFinding& finding : asked.findings) keep_simplest(std::move(finding));
  }

  /// The simplest of each fault and generator, saved as it is: it is shrunk later, and should not be lost until then.
  void keep_simplest(LibraryFinding finding) {
    const bool room = is_kept();
    const auto same = [&](const LibraryFinding& other) {
      return other.found.is_like(finding.found) && other.generator == finding.generator;
    };
    auto& all = report_.findings;
    const auto found = std::find_if(all.begin(), all.end(), same);
    if (found == all.end() && !room) return;
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
    findings = std::move(different);
  }

  std::vector<QueryGenerator> generators_;
  Situation situation_;
  std::uint64_t asked_ = 0, corpus_findings_ = 0;
};

}  // namespace

LibraryFuzzReport fuzz_library(const LibraryFuzzOptions& options) { return LibraryFuzzing(options).run(); }

ShrunkForLibrary shrink_for_library(const LibraryUnderTest& library, const AnyQuery& query, const FaultFound& fault,
                                    bool knows_times) {
  Shrinking shrinking(library, fault, knows_times);
  const FirstFailure first_failure = [&](std::span<const AnyQuery> queries) {
    return shrinking.first_failure(queries);
  };
  const AnyQuery shrunk = minimise(query, first_failure);
  if (shrunk == query) return {query, fault};
  const std::vector<LibraryAnswer> again = ask(library, shrunk.pair, std::span(&shrunk, 1));
  const auto found = fault_of(again[0], exact_contact(shrunk), knows_times);
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
    const auto fault = fault_of(answers[i], exact_contact(queries[i]), knows_times);
    if (fault && counts(fault->fault, library.exact)) result.faults[i] = fault;
  }
  return result;
}

}  // namespace noli::audit
