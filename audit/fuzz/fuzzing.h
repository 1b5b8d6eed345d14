// SPDX-License-Identifier: Apache-2.0
//
// The harness of a fuzzer: what is in its corpus is judged first, then blocks of items that it makes; what is wrong is
// kept, made smaller and saved, and what reached something new joins the corpus.
//
// Notation
//   item     something that was made, or saved before, with what the judge says of it
//   shape    what a judgement is like, in words
//   subject  who derives from Fuzzing: it makes, judges, counts, shrinks and saves items. It has
//              items_per_block                  a constant
//              make(block, index, random)       an item, or nothing when the user would not wait; called from several
//                                               threads. Who has something to do for a whole block has make_block
//              take(item, index)                counts it; then add_if_new, or is_kept and keep
//              take_saved(name)                 the same of what is in the corpus; false when the user would not wait.
//                                               Who does not go by names has run_corpus and count_corpus
//              items()                          how many were counted
//
// What this does not do: it knows nothing of what an item is.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "audit/fuzz/finding_name.h"
#include "audit/fuzz/fuzz_blocks.h"
#include "audit/fuzz/not_saved.h"
#include "audit/fuzz/random.h"
#include "audit/fuzz/shape_corpus.h"

namespace noli::audit {

/// Options that all fuzzers share.
struct FuzzSettings {
  FuzzLimits limits;
  std::filesystem::path out;                    ///< folder, made for the first finding; empty: nothing is saved
  std::size_t max_findings = 20;                ///< shrink and save at most that many; all are counted
  std::optional<std::filesystem::path> corpus;  ///< folder that is there: judged first, added to
};

/// Results that all fuzzers share.
struct FuzzTotals {
  FuzzExtent extent;
  NotSaved not_saved;
  std::uint64_t findings_total = 0;
  std::size_t corpus_size = 0;  ///< items in the corpus, of before and new

  /// "undecided" (interrupted, whatever was found so far, or nothing was done), "finding", or what holds.
  const char* verdict(const char* holds = "no_finding") const {
    if (extent.interrupted) return "undecided";
    if (findings_total > 0) return "finding";
    return extent.items == 0 ? "undecided" : holds;
  }
};

/// `Options` derive from FuzzSettings; `Report` from FuzzTotals, and has `findings`, a vector.
template <class Subject, class Options, class Report, class Item, class Corpus = ShapeCorpus>
class Fuzzing {
 public:
  /// The options have to outlive this. Throws InputError for a corpus that cannot be read.
  explicit Fuzzing(const Options& options) : options_(options) {
    if (options.corpus) corpus_.emplace(*options.corpus);
  }

  /// Once. Throws what the subject throws.
  Report run() {
    if (corpus_) self().run_corpus();
    if (!self().enough()) {
      report_.extent = fuzz_blocks(
          options_.limits, Subject::items_per_block,
          [this](std::uint64_t block, std::uint64_t count) { return self().make_block(block, count); },
          [this](auto block) {
            self().take_block(std::move(block));
            ++block_;
            return !self().enough();
          });
    }
    report_.extent.items = self().items();  // an interruption leaves blocks that are not whole
    if (corpus_) self().count_corpus();
    return std::move(report_);
  }

  bool enough() const { return false; }

  void run_corpus() {
    const std::vector<std::string> names = corpus_->names();  // none of those that are added
    for (const std::string& name : names) {
      if (stopped() || self().enough() || !self().take_saved(name)) return;
    }
  }
  void count_corpus() { report_.corpus_size = corpus_->names().size(); }

  std::vector<Item> make_block(std::uint64_t block, std::uint64_t count) const {
    Random random(options_.limits.seed, block);
    std::vector<Item> items;
    for (std::size_t index = 0; index < count && !stopped(); ++index) {
      std::optional<Item> item = self().make(block, index, random);
      if (!item) break;
      items.push_back(std::move(*item));
    }
    return items;
  }

  void take_block(std::vector<Item> items) {
    for (std::size_t index = 0; index < items.size(); ++index) self().take(std::move(items[index]), index);
  }

 protected:
  bool stopped() const { return options_.limits.stop != nullptr && options_.limits.stop->load(); }

  /// Generators take turns: the number of the one, of `count`, that makes this item.
  static std::size_t turn_of(std::uint64_t block, std::size_t index, std::size_t count) {
    return (block * Subject::items_per_block + index) % count;
  }

  /// `write` puts an item with this shape into an empty folder.
  template <class Write>
  void add_to_corpus(const std::string& shape, const Write& write) {
    if (corpus_) report_.not_saved.attempt([&] { corpus_->add(shape, write); });
  }
  /// Skips shapes that the corpus already has.
  template <class Write>
  void add_if_new(const std::string& shape, const Write& write) {
    if (corpus_ && corpus_->reached(shape)) add_to_corpus(shape, write);
  }

  /// Counts a finding; whether there is room for it in the report.
  bool is_kept() {
    ++report_.findings_total;
    return report_.findings.size() < options_.max_findings;
  }

  /// Saves it with save(finding), where things are saved at all. `place` is where, and empty where it was not.
  template <class Finding, class Save>
  void keep(Finding finding, std::filesystem::path Finding::*place, const Save& save) {
    if (!options_.out.empty() && !report_.not_saved.attempt([&] { save(finding); })) (finding.*place).clear();
    report_.findings.push_back(std::move(finding));
  }

  /// A folder in `out` that is not there: "seed1-block2-index3" with more behind it.
  std::filesystem::path folder_for(std::uint64_t block, std::size_t index, const std::string& more) const {
    return unused(options_.out / fmt::format("seed{}-block{}-index{}{}", options_.limits.seed, block, index, more));
  }

  const Options& options_;
  std::optional<Corpus> corpus_;
  std::uint64_t block_ = 0;  ///< that is being taken
  Report report_;

 private:
  Subject& self() { return static_cast<Subject&>(*this); }
  const Subject& self() const { return static_cast<const Subject&>(*this); }
};

}  // namespace noli::audit
