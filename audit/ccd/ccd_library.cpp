// SPDX-License-Identifier: Apache-2.0
#include "audit/ccd/ccd_library.h"

#include <elf.h>
#include <fmt/format.h>
#include <noli/ccd_plugin.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <fstream>
#include <limits>
#include <memory>
#include <new>

#include <noli/errors.h>
#include "audit/ccd/host/library.h"
#include "trajectory/text.h"

namespace noli::audit {
namespace {

namespace fs = std::filesystem;

// --- Is it a library? ------------------------------------------------------------------------------------------------

/// The fields that are in the same place for 32 and 64 bits.
struct Head {
  unsigned char ident[EI_NIDENT];
  Elf64_Half type, machine;
};

std::optional<Head> head_of(const fs::path& file) {
  Head head = {};
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(&head), sizeof head);
  if (in.gcount() != sizeof head || std::memcmp(head.ident, ELFMAG, SELFMAG) != 0) return std::nullopt;
  return head;
}

std::string described(const Head& head) {
  const char* const bits = head.ident[EI_CLASS] == ELFCLASS64 ? "64" : "32";
  const char* const order = head.ident[EI_DATA] == ELFDATA2LSB ? "little" : "big";
  return fmt::format("machine {}, {} bits, {} endian", head.machine, bits, order);
}

/// The number of the machine, when its bytes are in the other order than ours.
void swap_if_foreign(Head& head, const Head& own) {
  if (head.ident[EI_DATA] == own.ident[EI_DATA]) return;
  const auto swapped = [](Elf64_Half x) { return static_cast<Elf64_Half>((x >> 8) | (x << 8)); };
  head.type = swapped(head.type);
  head.machine = swapped(head.machine);
}

/// Throws InputError, with what the file is instead: the loader's own words for one that is no shared library of this
/// machine are misleading. Reads the first bytes only; whether the rest is whole, the loader finds out.
void require_shared_library(const fs::path& file) {
  const auto refuse = [&](const std::string& problem) { throw InputError(file.string(), "", problem); };
  std::error_code error;
  if (!fs::exists(file, error)) refuse("does not exist; expected a shared library");
  if (!fs::is_regular_file(file, error)) refuse("is not a file; expected a shared library");
  if (!std::ifstream(file, std::ios::binary)) refuse("cannot be read");
  std::optional<Head> head = head_of(file);
  const std::optional<Head> own = head_of("/proc/self/exe");
  if (!head) refuse("is not a shared library (it does not begin like an ELF file)");
  if (!own) return;
  swap_if_foreign(*head, *own);
  if (described(*head) != described(*own)) {
    refuse(fmt::format("is for another machine (ELF: {}; expected {})", described(*head), described(*own)));
  }
  if (head->type != ET_DYN)
    refuse(fmt::format("is an ELF file, but not a shared library (type {}; expected 3)", head->type));
}

// --- In this process -------------------------------------------------------------------------------------------------

/// For a debugger or a sanitizer, which are to see the library's call: asks each query once. Nothing protects this
/// process from the library. Returns the answers without times of computation. Throws InputError if the library cannot
/// be loaded, or lacks the functions.
LibraryAnswers ask_in_process(const fs::path& library, int kind, const std::vector<AskedQuery>& queries,
                              double tolerance) {
  HostStatus status;
  const Library loaded = load(status, library.c_str(), false);
  require_loaded(library, status, {});
  LibraryAnswers result;
  result.endings.resize(queries.size());
  result.description = status.description.data();
  for (AskedQuery query : queries) {  // a copy, which the library may write to
    GivenAnswer answer{};
    answer.time = std::numeric_limits<double>::quiet_NaN();
    try {
      answer.code = loaded.ask(kind, query.x_t0.data(), query.x_t1.data(), tolerance, &answer.time);
    } catch (const std::exception& error) {
      throw InputError(
          library.string(), "",
          fmt::format("threw an exception: {}; `catch throw` in gdb stops where", on_one_line(error.what())));
    }
    answer.state = AnswerState::answered;
    result.answers.push_back(answer);
  }
  return result;
}

// --- In processes of its own -----------------------------------------------------------------------------------------

/// The queries of one file, asked by as many hosts as it takes. A library may write anywhere in the memory that is
/// shared with it: what is read there is looked at first, and nothing here counts by what is there.
class Asking {
 public:
  Asking(const std::optional<fs::path>& library, int kind, const std::vector<AskedQuery>& queries, double tolerance,
         const HostOptions& options)
      : library_(library),
        options_(options),
        queries_(queries),
        memory_(exchange_bytes(queries.size())),
        e_(*new (memory_.begin()) Exchange),
        lost_(queries.size(), AnswerState::not_asked),
        repeat_seconds_(options.repeat_seconds) {
    e_.kind = kind;
    e_.tolerance = tolerance;
    e_.count = queries.size();
    answers_ = answers_of(e_);
    std::uninitialized_copy(queries.begin(), queries.end(), queries_of(e_));
    std::uninitialized_fill_n(answers_, queries.size(), GivenAnswer{});
    result_.endings.resize(queries.size());
  }

  LibraryAnswers run() {
    while (one_host()) {
    }
    take_answers();
    result_.ns_per_query = ns_per_query();
    result_.description.assign(e_.description.data(), ::strnlen(e_.description.data(), e_.description.size()));
    look_for_leaks();
    return std::move(result_);
  }

 private:
  /// What the next host is asked for, whatever the last one has left there.
  void prepare() {
    e_.phase = HostPhase::loading;
    e_.calls = 0;
    e_.at = first_;
    e_.passes = 0;
    e_.repeated = 0;
    e_.count = queries_.size();
    e_.first = first_;
    e_.repeat_seconds = repeat_seconds_;
    e_.most_growth = std::uint64_t{64} << 20;
    std::copy(queries_.begin() + static_cast<std::ptrdiff_t>(first_), queries_.end(), queries_of(e_) + first_);
  }

  /// Whether another one is needed.
  bool one_host() {
    prepare();
    const Ending ending = HostProcess(library_, memory_, e_, options_, false).wait();
    if (!ending.said.empty()) result_.said = ending.said;
    if (queries_.empty()) require_loaded(library_, e_, ending);  // else it has been loaded before, with none
    switch (ending.kind) {
      case Ending::Kind::finished: first_ = queries_.size(); return false;
      case Ending::Kind::stopped: result_.complete = false; return false;
      case Ending::Kind::crashed: ++result_.crashes; break;
      case Ending::Kind::hung: ++result_.hangs; break;
      case Ending::Kind::too_much_memory: ++result_.memory; break;
    }
    if (first_ == queries_.size() && repeat_seconds_ == 0) return false;  // it had nothing more to do
    e_.phase.load() == HostPhase::repeating ? leave_out(ending) : go_on_behind(ending);
    if (result_.hangs < options_.most_hangs) return true;
    result_.complete = false;
    return false;
  }

  /// The query that was asked last, if that is one of those which the last host was to ask.
  std::size_t last_asked() const {
    const std::uint64_t i = e_.calls == 0 ? first_ : e_.at.load();
    return i >= first_ && i < queries_.size() ? i : first_;
  }

  static AnswerState state(Ending::Kind kind) {
    if (kind == Ending::Kind::hung) return AnswerState::hung;
    return kind == Ending::Kind::too_much_memory ? AnswerState::too_much_memory : AnswerState::crashed;
  }

  /// A host that died before its first call of all died of its first query.
  void go_on_behind(const Ending& ending) {
    const std::size_t i = last_asked();
    if (i >= queries_.size()) return give_up_repeating();
    lost_[i] = state(ending.kind);
    result_.endings[i] = ending.words;
    first_ = i + 1;
  }

  void leave_out(const Ending& ending) {
    constexpr int most = 3;
    first_ = queries_.size();
    if (const std::uint64_t i = e_.at; e_.calls > 0 && i < queries_.size()) {
      answers_[i].not_again = 1;
      result_.endings[i] = ending.words + ", when asked again";
    }
    if (++left_out_ >= most) give_up_repeating();
  }

  void give_up_repeating() {
    first_ = queries_.size();
    repeat_seconds_ = 0;
  }

  /// Each query up to `first_` has been asked, and so has an answer, unless the library has overwritten it.
  void take_answers() {
    for (std::size_t i = 0; i < queries_.size(); ++i) {
      GivenAnswer answer = answers_[i];
      if (lost_[i] != AnswerState::not_asked) {
        answer.state = lost_[i];
      } else if (answer.state != AnswerState::answered) {
        answer = {};
        if (i < first_) lose(i, answer);
      }
      result_.answers.push_back(answer);
    }
  }

  void lose(std::size_t i, GivenAnswer& answer) {
    answer.state = AnswerState::crashed;
    result_.endings[i] = "it was asked, but there is no answer: the library writes to memory that is not its own";
    ++result_.crashes;
  }

  double ns_per_query() const {
    const std::size_t whole = std::min<std::uint64_t>(e_.passes, most_passes);
    if (whole > 0 && e_.pass_calls > 0) {
      std::vector<double> passes(e_.pass_seconds.begin(), e_.pass_seconds.begin() + static_cast<long>(whole));
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

  /// What was needed but once is no leak.
  void look_for_leaks() {
    if (e_.repeated == 0) return;
    const auto growth = [&](std::size_t from, std::size_t to) {
      return static_cast<std::int64_t>(e_.resident[to] - e_.resident[from]);
    };
    result_.repeated = e_.repeated;
    result_.growth = growth(0, 2);
    const bool stopped_early = growth(0, 1) >= static_cast<std::int64_t>(e_.most_growth);
    result_.leaks = growth(0, 1) >= leak_slack && (growth(1, 2) >= leak_slack || stopped_early);
  }

  const std::optional<fs::path>& library_;
  const HostOptions& options_;
  const std::vector<AskedQuery>& queries_;
  SharedMemory memory_;
  Exchange& e_;
  GivenAnswer* answers_;
  std::vector<AnswerState> lost_;  ///< how a query ended its host; not_asked: it did not
  std::size_t first_ = 0;          ///< the first query that no host has been asked
  double repeat_seconds_;
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
  if (options.in_process && library) return ask_in_process(*library, kind, queries, tolerance);
  return Asking(library, kind, queries, tolerance, options).run();
}

}  // namespace noli::audit
