// SPDX-License-Identifier: Apache-2.0
#include "noli/audit/ccd_library.h"

#include <noli/ccd_plugin.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>

#include "noli/audit/elf_header.h"

namespace noli::audit {
namespace {

namespace fs = std::filesystem;

/// The queries of one file, asked by as many hosts as it takes.
class Asking {
 public:
  Asking(const std::optional<fs::path>& library, int kind, const std::vector<AskedQuery>& queries, double tolerance,
         const HostOptions& options)
      : library_(library),
        options_(options),
        memory_(exchange_bytes(queries.size())),
        e_(*new (memory_.begin()) Exchange) {
    e_.count = queries.size();
    std::uninitialized_copy(queries.begin(), queries.end(), queries_of(e_));
    std::uninitialized_fill_n(answers_of(e_), queries.size(), GivenAnswer{});
    e_.kind = kind;
    e_.tolerance = tolerance;
    e_.repeat_seconds = options.repeat_seconds;
    e_.most_growth = std::uint64_t{64} << 20;
    result_.endings.resize(queries.size());
  }

  LibraryAnswers run() {
    while (one_host()) {
    }
    const GivenAnswer* const answers = answers_of(e_);
    result_.answers.assign(answers, answers + e_.count);
    result_.ns_per_query = ns_per_query();
    result_.description.assign(e_.description.data(), ::strnlen(e_.description.data(), e_.description.size()));
    look_for_leaks();
    return std::move(result_);
  }

 private:
  /// Whether another one is needed.
  bool one_host() {
    e_.phase = HostPhase::loading;
    e_.calls = 0;
    e_.passes = 0;
    e_.repeated = 0;
    const Ending ending = HostProcess(library_, memory_, e_, options_, false).wait();
    require_loaded(library_, e_, ending);
    switch (ending.kind) {
      case Ending::Kind::finished: return false;
      case Ending::Kind::stopped: result_.complete = false; return false;
      case Ending::Kind::crashed: ++result_.crashes; break;
      case Ending::Kind::hung: ++result_.hangs; break;
      case Ending::Kind::too_much_memory: ++result_.memory; break;
    }
    e_.phase.load() == HostPhase::repeating ? leave_out(ending) : go_on_behind(ending);
    if (result_.hangs < options_.most_hangs) return true;
    result_.complete = false;
    return false;
  }

  static AnswerState state(Ending::Kind kind) {
    if (kind == Ending::Kind::hung) return AnswerState::hung;
    return kind == Ending::Kind::too_much_memory ? AnswerState::too_much_memory : AnswerState::crashed;
  }

  /// A host that died before its first call of all died of its first query.
  void go_on_behind(const Ending& ending) {
    const std::uint64_t i = e_.calls == 0 ? e_.first : e_.at.load();
    if (i >= e_.count) return give_up_repeating();
    answers_of(e_)[i].state = state(ending.kind);
    result_.endings[i] = ending.words;
    e_.first = i + 1;
  }

  void leave_out(const Ending& ending) {
    constexpr int most = 3;
    if (e_.calls > 0) {
      const std::uint64_t i = e_.at;
      answers_of(e_)[i].not_again = 1;
      result_.endings[i] = ending.words + ", when asked again";
    }
    if (++left_out_ >= most) give_up_repeating();
  }

  void give_up_repeating() {
    e_.first = e_.count;
    e_.repeat_seconds = 0;
  }

  double ns_per_query() const {
    if (e_.passes > 0) {
      std::vector<double> passes(e_.pass_seconds.begin(), e_.pass_seconds.begin() + static_cast<long>(e_.passes));
      const auto middle = passes.begin() + static_cast<long>(passes.size() / 2);
      std::nth_element(passes.begin(), middle, passes.end());
      return *middle * 1e9 / static_cast<double>(e_.pass_calls);
    }
    double sum = 0, count = 0;
    for (const GivenAnswer& answer : result_.answers) {
      if (answer.state != AnswerState::answered) continue;
      sum += answer.ns;
      ++count;
    }
    return count > 0 ? sum / count : 0;
  }

  /// What an allocator takes at a time, or a page here and there, is no leak; nor is what was needed but once.
  void look_for_leaks() {
    if (e_.repeated == 0) return;
    constexpr std::int64_t slack = 256 << 10;
    const auto growth = [&](std::size_t from, std::size_t to) {
      return static_cast<std::int64_t>(e_.resident[to]) - static_cast<std::int64_t>(e_.resident[from]);
    };
    result_.repeated = e_.repeated;
    result_.growth = growth(0, 2);
    const bool stopped_early = growth(0, 1) >= static_cast<std::int64_t>(e_.most_growth);
    result_.leaks = growth(0, 1) >= slack && (growth(1, 2) >= slack || stopped_early);
  }

  const std::optional<fs::path>& library_;
  const HostOptions& options_;
  SharedMemory memory_;
  Exchange& e_;
  LibraryAnswers result_;
  int left_out_ = 0;
};

}  // namespace

void require_ccd_library(const fs::path& library, const HostOptions& options) {
  require_shared_library(library);
  ask_library(library, NOLI_CCD_VERTEX_FACE, {}, 0, options);
}

LibraryAnswers ask_library(const std::optional<fs::path>& library, int kind, const std::vector<AskedQuery>& queries,
                           double tolerance, const HostOptions& options) {
  return Asking(library, kind, queries, tolerance, options).run();
}

}  // namespace noli::audit
