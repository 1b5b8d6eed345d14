// SPDX-License-Identifier: Apache-2.0
#include "noli/audit/ccd_library.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <noli/ccd_plugin.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "noli/audit/elf_header.h"
#include "noli/trajectory/error.h"

extern char** environ;

namespace noli::audit {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using std::chrono::nanoseconds;

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

/// Memory that a host shares, with the queries in it.
class SharedMemory {
 public:
  explicit SharedMemory(const std::vector<AskedQuery>& queries) : size_(exchange_bytes(queries.size())) {
    descriptor_ = ::memfd_create("noli_ccd", MFD_CLOEXEC);
    if (descriptor_ < 0 || ::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) fail("shared memory");
    memory_ = ::mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, 0);
    if (memory_ == MAP_FAILED) fail("shared memory");
    exchange_ = new (memory_) Exchange;
    exchange_->count = queries.size();
    std::uninitialized_copy(queries.begin(), queries.end(), queries_of(*exchange_));
    std::uninitialized_fill_n(answers_of(*exchange_), queries.size(), GivenAnswer{});
  }
  ~SharedMemory() {
    if (memory_ != MAP_FAILED) ::munmap(memory_, size_);
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  Exchange& exchange() const { return *exchange_; }
  int descriptor() const { return descriptor_; }

 private:
  std::size_t size_;
  int descriptor_ = -1;
  void* memory_ = MAP_FAILED;
  Exchange* exchange_ = nullptr;
};

/// Starts a program with the memory as its descriptor 3 and no other input or output, in a group of processes of its
/// own, so that it does not share the signals of the terminal.
pid_t start(const fs::path& program, const std::optional<fs::path>& library, int memory) {
  std::vector<std::string> words = {program.string()};
  if (library) words.push_back(fs::absolute(*library).string());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, memory, 3);
  for (int end = 0; end < 3; ++end) posix_spawn_file_actions_addopen(&actions, end, "/dev/null", O_RDWR, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t pid = 0;
  const int error = ::posix_spawn(&pid, argv[0], &actions, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::system_error(error, std::generic_category(), words[0]);
  return pid;
}

/// How a process came to its end.
struct Ending {
  enum class Kind { finished, crashed, hung, too_much_memory, stopped } kind = Kind::finished;
  std::string words;
};

/// A host at work. Ended with the object.
class HostProcess {
 public:
  HostProcess(const std::optional<fs::path>& library, const SharedMemory& memory, const HostOptions& options)
      : options_(options), exchange_(memory.exchange()), pid_(start(options.host, library, memory.descriptor())) {}
  ~HostProcess() { end_it(); }
  HostProcess(const HostProcess&) = delete;
  HostProcess& operator=(const HostProcess&) = delete;

  Ending wait() {
    nanoseconds pause = std::chrono::microseconds(100);
    begin_call();
    for (;;) {
      if (const auto status = ended()) return ending(*status);
      if (stopped()) return ended_by_us(Ending::Kind::stopped, "stopped");
      if (hangs()) {
        return ended_by_us(Ending::Kind::hung, fmt::format("no answer after {:g} s", seconds(options_.query_limit)));
      }
      if (resident_bytes() > options_.most_memory) {
        return ended_by_us(Ending::Kind::too_much_memory, fmt::format("more than {} bytes", options_.most_memory));
      }
      std::this_thread::sleep_for(pause);
      pause = std::min<nanoseconds>(2 * pause, std::chrono::milliseconds(5));
    }
  }

 private:
  static double seconds(nanoseconds time) { return std::chrono::duration<double>(time).count(); }

  bool stopped() const {
    if (options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed)) return true;
    return options_.deadline && Clock::now() >= *options_.deadline;
  }

  std::optional<int> ended() {
    int status = 0;
    const pid_t pid = ::waitpid(pid_, &status, WNOHANG);
    if (pid < 0 && errno != EINTR) fail("waiting for a process");
    if (pid != pid_) return std::nullopt;
    pid_ = -1;
    return status;
  }

  Ending ending(int status) const {
    if (WIFSIGNALED(status)) {
      const int signal = WTERMSIG(status);
      return {Ending::Kind::crashed, fmt::format("signal {} ({})", signal, ::strsignal(signal))};
    }
    const bool done = exchange_.phase.load(std::memory_order_acquire) == HostPhase::done;
    if (done && WEXITSTATUS(status) == 0) return {};
    return {Ending::Kind::crashed, fmt::format("it ended the program, with code {}", WEXITSTATUS(status))};
  }

  Ending ended_by_us(Ending::Kind kind, const std::string& words) {
    end_it();
    return {kind, words};
  }

  void end_it() {
    if (pid_ < 0) return;
    ::kill(-pid_, SIGKILL);
    ::kill(pid_, SIGKILL);  // before it has a group of its own
    while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
  }

  /// What the process has computed so far, all its threads together.
  nanoseconds computed() const {
    clockid_t clock = 0;
    struct timespec time = {};
    if (::clock_getcpuclockid(pid_, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return nanoseconds(0);
    return std::chrono::seconds(time.tv_sec) + nanoseconds(time.tv_nsec);
  }

  void begin_call() {
    calls_ = exchange_.calls.load(std::memory_order_relaxed);
    begin_ = Clock::now();
    computed_ = computed();
  }

  /// On a busy machine a process may not run for long: what counts is what it computes, or ten times the limit.
  bool hangs() {
    if (exchange_.calls.load(std::memory_order_relaxed) != calls_) {
      begin_call();
      return false;
    }
    const bool loading = exchange_.phase.load(std::memory_order_relaxed) == HostPhase::loading;
    const nanoseconds limit =
        loading ? std::max<nanoseconds>(options_.query_limit, std::chrono::seconds(10)) : options_.query_limit;
    const auto waited = Clock::now() - begin_;
    return waited >= limit && (computed() - computed_ >= limit || waited >= 10 * limit);
  }

  std::uint64_t resident_bytes() const {
    std::ifstream file("/proc/" + std::to_string(pid_) + "/statm");
    std::uint64_t all = 0, resident = 0;
    if (!(file >> all >> resident)) return 0;
    return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  }

  const HostOptions& options_;
  const Exchange& exchange_;
  pid_t pid_;
  std::uint64_t calls_ = 0;
  Clock::time_point begin_;
  nanoseconds computed_{0};
};

/// Throws InputError if the library could not be loaded.
void require_loaded(const std::optional<fs::path>& library, const Exchange& exchange, const Ending& ending) {
  const auto refuse = [&](const std::string& problem) {
    throw InputError(library ? library->string() : "textbook", "", problem);
  };
  using Kind = Ending::Kind;
  if (ending.kind == Kind::stopped) return;
  if (ending.kind != Kind::finished) {
    if (exchange.phase.load() == HostPhase::loading) refuse("cannot be loaded: " + ending.words + " meanwhile");
    return;
  }
  switch (exchange.loaded) {
    case LoadResult::ok: return;
    case LoadResult::not_loaded: refuse(fmt::format("cannot be loaded: {}", exchange.message.data())); break;
    case LoadResult::no_version: refuse("has no function noli_ccd_version (include/noli/ccd_plugin.h)"); break;
    case LoadResult::no_query: refuse("has no function noli_ccd_query (include/noli/ccd_plugin.h)"); break;
    case LoadResult::other_version:
      refuse(fmt::format("is for version {} of the interface; expected {}", exchange.version, NOLI_CCD_VERSION));
  }
}

/// The queries of one file, asked by as many hosts as it takes.
class Asking {
 public:
  Asking(const std::optional<fs::path>& library, int kind, const std::vector<AskedQuery>& queries, double tolerance,
         const HostOptions& options)
      : library_(library), options_(options), memory_(queries), e_(memory_.exchange()) {
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
    const Ending ending = HostProcess(library_, memory_, options_).wait();
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
  if (::access(options.host.c_str(), X_OK) != 0) {
    throw std::runtime_error(options.host.string() + " is not there; expected it beside this program");
  }
  return Asking(library, kind, queries, tolerance, options).run();
}

}  // namespace noli::audit
