// SPDX-License-Identifier: Apache-2.0
//
// noli_ccd_host [--sandbox] [LIBRARY]: asks a library the queries in the shared memory that its descriptor 3 is, and
// ends. Without a library it asks the textbook method that is built in. noli_ccd_host [--sandbox] --frames LIBRARY: the
// same for a step of a mesh (host/pipeline.h). noli_ccd_host --sandbox --probe: tells whether there is a sandbox.
//
// All of it for `noli audit ccd`: whatever a library does to a process, it does to this one.
//
// First each query once, its time taken by itself. Then all again and again, without a look at the clock in between but
// every so often: how long a query takes on the average, whether memory grows, whether answers stay the same.
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <limits>

#include "audit/ccd/host/exchange.h"
#include "audit/ccd/host/library.h"
#include "audit/ccd/host/pipeline.h"
#include "audit/ccd/host/sandbox.h"
#include "audit/ccd/plugins/textbook.h"

#if defined(__SANITIZE_ADDRESS__)
/// What the sanitizer keeps of freed memory, for all threads and for each, would look like a leak; what is not freed at
/// the end is no fault of the host's.
extern "C" const char* __asan_default_options() {
  return "quarantine_size_mb=0:thread_local_quarantine_size_kb=0:detect_leaks=0";
}
#endif

namespace noli::audit {
namespace {

int ask_textbook(int kind, const double* x_t0, const double* x_t1, double /*tolerance*/, double* time) {
  return plugins::textbook_query(kind, x_t0, x_t1, time);
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

class Host {
 public:
  explicit Host(Exchange& exchange) : e_(exchange), queries_(queries_of(e_)), answers_(answers_of(e_)) {}

  void run(Ask ask) {
    ask_ = ask;
    enter(e_, HostPhase::answering);
    for (std::uint64_t i = e_.first; i < e_.count; ++i) answer(i);
    e_.first = e_.count;
    enter(e_, HostPhase::repeating);
    repeat();
    enter(e_, HostPhase::done);
  }

 private:
  /// Asks, and leaves word of what is under way. What the library gets is a copy: beside the queries are the answers,
  /// and one that writes a little too far would change them.
  int call(std::uint64_t i, double& time) {
    e_.at.store(i, std::memory_order_relaxed);
    e_.calls.store(++calls_, std::memory_order_relaxed);
    time = std::numeric_limits<double>::quiet_NaN();
    asked_[1] = queries_[i];
    return ask_(e_.kind, asked_[1].x_t0.data(), asked_[1].x_t1.data(), e_.tolerance, &time);
  }

  void answer(std::uint64_t i) {
    double time = 0;
    const double begin = seconds();
    const int code = call(i, time);
    GivenAnswer& answer = answers_[i];
    answer.ns = (seconds() - begin) * 1e9;
    answer.code = code;
    answer.time = time;
    answer.state = AnswerState::answered;
  }

  bool repeats(std::uint64_t i) const {
    return answers_[i].state == AnswerState::answered && answers_[i].not_again == 0;
  }

  void ask_again(std::uint64_t i) {
    double time = 0;
    const int code = call(i, time);
    const GivenAnswer& first = answers_[i];
    if (code != first.code || (code == NOLI_CCD_HIT && !same(time, first.time))) answers_[i].changed = 1;
  }

  /// Passes over all that can be asked again.
  void repeat() {
    std::uint64_t answered = 0;
    for (std::uint64_t i = 0; i < e_.count; ++i) answered += repeats(i) ? 1 : 0;
    if (answered == 0 || !(e_.repeat_seconds > 0)) return;
    constexpr std::uint64_t least_calls = 256;  // beside which a look at the clock is nothing
    const std::uint64_t rounds = (least_calls + answered - 1) / answered;
    e_.pass_calls = rounds * answered;
    const std::uint64_t calls_before = calls_;
    give_up_ = seconds() + 4 * e_.repeat_seconds;  // in the middle of a pass
    repeat_in_halves(e_, [&] { return pass(rounds); });
    e_.repeated = calls_ - calls_before;
  }

  bool pass(std::uint64_t rounds) {
    const double begin = seconds();
    for (std::uint64_t round = 0; round < rounds; ++round) {
      for (std::uint64_t i = 0; i < e_.count; ++i) {
        if (repeats(i)) ask_again(i);
        if (i % 64 == 63 && is_over()) return false;
      }
    }
    if (e_.passes < most_passes) e_.pass_seconds[e_.passes++] = seconds() - begin;
    return !is_over();
  }

  /// Looks at the clock, and now and then at the memory.
  bool is_over() {
    constexpr double between_looks = 0.01;
    const double now = seconds();
    if (now < next_look_) return now > give_up_ || grown_;
    next_look_ = now + between_looks;
    grown_ = resident_bytes() > e_.resident[0] + e_.most_growth;
    return now > give_up_ || grown_;
  }

  Exchange& e_;
  AskedQuery* queries_;
  GivenAnswer* answers_;
  std::array<AskedQuery, 3> asked_{};  ///< the middle one, with room on either side
  Ask ask_ = nullptr;
  std::uint64_t calls_ = 0;
  double give_up_ = 0, next_look_ = 0;
  bool grown_ = false;
};

constexpr int descriptor = 3;  ///< of the shared memory

/// Nothing where it is not there, or too small.
void* shared_memory() {
  struct stat status = {};
  if (::fstat(descriptor, &status) != 0 || status.st_size < static_cast<off_t>(sizeof(HostStatus))) return nullptr;
  void* const memory =
      ::mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  return memory == MAP_FAILED ? nullptr : memory;
}

void ask_queries(void* memory, const char* library) {
  auto& exchange = *static_cast<Exchange*>(memory);
  const Ask ask = library != nullptr ? load(exchange, library, false).ask : ask_textbook;
  if (ask != nullptr) Host(exchange).run(ask);
}

void ask_pipeline(void* memory, const char* path) {
  auto& exchange = *static_cast<PipelineExchange*>(memory);
  const Library library = load(exchange, path, exchange.needs_search != 0);
  if (library.ask != nullptr) Pipeline(exchange, descriptor, library).run();
}

}  // namespace
}  // namespace noli::audit

int main(int argc, char** argv) {
  using namespace noli::audit;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const struct rlimit none = {0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  const bool sandbox = argc > 1 && std::strcmp(argv[1], "--sandbox") == 0;
  if (sandbox) --argc, ++argv;
#if defined(SYS_close_range)
  ::syscall(SYS_close_range, 4U, ~0U, 0U);  // what whoever started `noli` has left open
#endif
  if (sandbox && argc > 1 && std::strcmp(argv[1], "--probe") == 0) return enter_sandbox() ? 0 : no_sandbox;
  void* const memory = shared_memory();
  if (memory == nullptr) {
    std::fputs("noli_ccd_host: a part of noli; expected to be started by `noli audit`\n", stderr);
    return 3;
  }
  if (sandbox && !enter_sandbox()) return no_sandbox;
  const bool pipeline = argc > 2 && std::strcmp(argv[1], "--frames") == 0;
  if (pipeline) {
    ask_pipeline(memory, argv[2]);
  } else {
    ask_queries(memory, argc > 1 ? argv[1] : nullptr);
  }
  std::_Exit(0);  // without what the library registered for the end
}
