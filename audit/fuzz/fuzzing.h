// SPDX-License-Identifier: Apache-2.0
//
// The harness of a fuzzer. It judges the items of the corpus first, then blocks of new items. Findings are kept, shrunk
// and saved; items of a new shape join the corpus.
//
// Notation
//   item     something that was made, or saved before, with its judgement
//   block    a few items, made and judged by one thread. Block b depends only on the seed and b, so a run has the same
//            items for any number of threads
//   shape    what a judgement is like, in words
//   subject  the class that derives from Fuzzing. It makes, judges, counts, shrinks and saves items. It has
//              items_per_block                  a constant
//              make(block, index, random)       an item, or nothing once stopped; called from several threads. A
//                                               subject that needs something once for each block has make_block instead
//              take(item, index)                counts it; then calls add_if_new, or is_kept and keep
//              take_saved(name)                 the same for an item of the corpus; false once stopped. If the corpus
//                                               is not a list of names, it has run_corpus and count_corpus instead
//              items()                          how many were counted
//
// What this does not do: it does not know what an item is.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include "audit/fuzz/random.h"
#include "audit/fuzz/save_finding.h"
#include "audit/fuzz/shape_corpus.h"
#include "kernel/parallel.h"

namespace noli::audit {

/// When a fuzzer stops. Precondition: at least one of count, time_limit and stop is set.
struct FuzzLimits {
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> count;                       ///< after so many items
  std::optional<std::chrono::duration<double>> time_limit;  ///< after that time, at the end of a few blocks
  int threads = 0;                                          ///< <= 0: all there are
  const std::atomic<bool>* stop = nullptr;                  ///< polled after every few blocks
  /// Called from the caller's thread now and then, with the share of the run that is done.
  std::function<void(double)> progress;
};

/// A difference reads "KIND: details". A finding keeps its kind while it is made smaller.
inline std::string_view kind_of(std::string_view difference) { return difference.substr(0, difference.find(':')); }

/// Whether there still is a difference, and of this kind.
inline bool is_of_kind(const std::optional<std::string>& difference, std::string_view kind) {
  return difference && kind_of(*difference) == kind;
}

/// Options that all fuzzers share.
struct FuzzSettings {
  FuzzLimits limits;
  std::filesystem::path out;                    ///< folder, made for the first finding; empty: nothing is saved
  std::size_t max_findings = 20;                ///< shrink and save at most that many; all are counted
  std::optional<std::filesystem::path> corpus;  ///< folder that is there: judged first, added to
};

/// What findings have in common.
struct FuzzFinding {
  std::string generator;        ///< or the name of the item in the corpus
  std::uint64_t block = 0;      ///< of the seed
  std::size_t index = 0;        ///< within the block
  std::string difference;       ///< in words
  std::filesystem::path place;  ///< where the smaller one was saved; empty if it was not saved
};

/// Keeps the first error of saving findings, such as a full disk. The report still lists the finding; the error is
/// thrown after the report has been written.
class NotSaved {
 public:
  /// Calls `save`, which may throw std::system_error. False if it did; the first of these is kept.
  template <class Save>
  bool attempt(const Save& save) {
    try {
      save();
      return true;
    } catch (const std::system_error& error) {
      if (!why_) why_ = error.what();
      return false;
    }
  }

  /// Throws WriteError if something was not saved.
  void require_nothing() const {
    if (why_) throw WriteError("not all findings were saved: " + *why_);
  }

 private:
  std::optional<std::string> why_;
};

/// Results that all fuzzers share.
struct FuzzTotals {
  std::uint64_t items = 0;
  bool interrupted = false;       ///< by the stop flag
  bool nothing_answered = false;  ///< a library was stopped, and had answered no query by then
  NotSaved not_saved;
  std::uint64_t findings_total = 0;
  std::size_t corpus_size = 0;  ///< items in the corpus, of before and new

  /// The run was interrupted (even if it has findings), or nothing was learnt.
  bool undecided() const { return interrupted || (findings_total == 0 && (items == 0 || nothing_answered)); }
  /// "undecided", "finding", or `holds`.
  const char* verdict(const char* holds = "no_finding") const {
    return undecided() ? "undecided" : findings_total > 0 ? "finding" : holds;
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

  /// Once. Throws std::invalid_argument when no limit is given, and what the subject throws.
  Report run() {
    if (corpus_) self().run_corpus();
    if (!self().enough()) run_blocks();
    report_.items = self().items();
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

  /// Saves the finding with save(finding), which sets its `place`, if there is a folder for findings. If saving fails,
  /// the place is empty.
  template <class Finding, class Save>
  void keep(Finding finding, const Save& save) {
    if (!options_.out.empty() && !report_.not_saved.attempt([&] { save(finding); })) finding.place.clear();
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
  /// Several threads make blocks, which are taken in order, until a limit is reached or enough() returns true.
  void run_blocks() {
    const FuzzLimits& limits = options_.limits;
    if (!limits.count && !limits.time_limit && !limits.stop) {
      throw std::invalid_argument("a fuzzer with neither count, nor time limit, nor stop flag");
    }
    constexpr std::uint64_t per_block = Subject::items_per_block;
    const auto begin = std::chrono::steady_clock::now();
    const auto threads = static_cast<std::uint64_t>(limits.threads > 0 ? limits.threads : hardware_threads());
    for (std::uint64_t made = 0;;) {
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      const double by_time = limits.time_limit ? seconds / limits.time_limit->count() : 0;
      const double by_count = limits.count ? static_cast<double>(made) / static_cast<double>(*limits.count) : 0;
      if (limits.progress) limits.progress(std::min(1.0, std::max(by_time, by_count)));
      report_.interrupted = stopped();
      if (report_.interrupted || by_time >= 1 || by_count >= 1) return;
      const std::uint64_t left = limits.count ? *limits.count - made : std::uint64_t{1} << 60;
      std::vector<decltype(self().make_block(block_, left))> blocks(
          std::min(2 * threads, (left + per_block - 1) / per_block));
      parallel_for(blocks.size(), static_cast<int>(threads), [&](std::size_t i) {
        blocks[i] = self().make_block(block_ + i, std::min(per_block, left - i * per_block));
      });
      made += std::min<std::uint64_t>(left, blocks.size() * per_block);
      for (auto& block : blocks) {
        self().take_block(std::move(block));
        ++block_;
        if (self().enough()) return;
      }
    }
  }

  Subject& self() { return static_cast<Subject&>(*this); }
  const Subject& self() const { return static_cast<const Subject&>(*this); }
};

}  // namespace noli::audit
