// SPDX-License-Identifier: Apache-2.0
#include "app/process.h"

#include <fcntl.h>
#include <gmp.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>

#include "app/exit_code.h"
#include "trajectory/stop.h"

namespace noli::app {
namespace {

std::atomic<bool> heard_everywhere{false};
std::atomic<bool> user_asked{false};
std::atomic<int> requests{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "a signal handler may write it");

/// Once a second: what begins to wait after somebody asked is interrupted too, though it came a moment too late for the
/// first signal.
extern "C" void remind(int) { ::alarm(1); }

extern "C" void interrupt(int) {
  user_asked.store(true);
  if (heard_everywhere.load()) ask_to_stop(StopReason::interrupted);
  requests.fetch_add(1, std::memory_order_relaxed);
  ::alarm(1);
}

extern "C" void time_has_passed(int) {
  ask_to_stop(StopReason::out_of_time);
  ::alarm(1);
}

int signal_of_limit() { return SIGRTMIN; }

/// Without SA_RESTART, so that waiting for a pipe that nobody writes to ends too.
void on_signal(int signal, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  sigaction(signal, &action, nullptr);
}

/// Of this process; made when it is asked for first.
timer_t timer_of_limit() {
  static const timer_t timer = [] {
    struct sigevent event = {};
    event.sigev_notify = SIGEV_SIGNAL;
    event.sigev_signo = signal_of_limit();
    timer_t made = {};
    if (::timer_create(CLOCK_MONOTONIC, &event, &made) != 0) {
      throw std::system_error(errno, std::generic_category(), "a timer for the time limit");
    }
    return made;
  }();
  return timer;
}

// --- What the machine does -----------------------------------------------------------------------------------------

[[noreturn]] void end_with(std::string_view line) {
  // Nothing is left to do when not even this can be written.
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
  ::_exit(static_cast<int>(ExitCode::failure));
}

void* or_end(void* memory) {
  if (memory == nullptr) end_with("noli: error: out of memory\n");
  return memory;
}

/// An exception that nobody may catch, as one that leaves a destructor.
[[noreturn]] void end_of_exception() {
  try {
    if (const std::exception_ptr exception = std::current_exception()) std::rethrow_exception(exception);
  } catch (const std::bad_alloc&) {
    end_with("noli: error: out of memory\n");
  } catch (...) {
  }
  end_with("noli: error: internal error: terminated\n");
}

void* gmp_allocate(std::size_t size) { return or_end(std::malloc(size)); }
void* gmp_reallocate(void* old, std::size_t, std::size_t size) { return or_end(std::realloc(old, size)); }
void gmp_free(void* memory, std::size_t) { std::free(memory); }

void hold_standard_descriptors() {
  for (int descriptor = 0; descriptor <= 2; ++descriptor) {
    if (::fcntl(descriptor, F_GETFD) != -1) continue;
    // The lowest free number is taken, so this is `descriptor`. Read-only: writing to a closed output must still fail.
    [[maybe_unused]] const int held = ::open("/dev/null", O_RDONLY);
  }
}

/// Whoever started this may have kept signals from it, for as long as it lives.
void hear_signals() {
  sigset_t heard;
  ::sigemptyset(&heard);
  for (const int signal : {signal_of_limit(), SIGALRM, SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&heard, signal);
  ::pthread_sigmask(SIG_UNBLOCK, &heard, nullptr);
}

}  // namespace

const std::atomic<bool>& interrupted() { return user_asked; }

int interruptions() { return requests.load(std::memory_order_relaxed); }

void hear_stops_everywhere() {
  heard_everywhere.store(true);
  if (user_asked.load()) ask_to_stop(StopReason::interrupted);  // a moment too early
}

void stop_after(std::chrono::nanoseconds limit) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(limit);
  struct itimerspec when = {};
  when.it_value.tv_sec = static_cast<std::time_t>(seconds.count());
  when.it_value.tv_nsec = static_cast<long>((limit - seconds).count());
  if (limit.count() <= 0) when.it_value.tv_nsec = 1;  // 0 would mean never
  if (::timer_settime(timer_of_limit(), 0, &when, nullptr) != 0) {
    throw std::system_error(errno, std::generic_category(), "the time limit");
  }
}

void install_signal_handlers() {
  on_signal(signal_of_limit(), time_has_passed);
  on_signal(SIGALRM, remind);
  on_signal(SIGINT, interrupt);
  on_signal(SIGTERM, interrupt);
  on_signal(SIGHUP, interrupt);
  on_signal(SIGCHLD, SIG_DFL);  // who ignores it hands that down, and then children end without a trace
  on_signal(SIGPIPE, SIG_IGN);
  on_signal(SIGXFSZ, SIG_IGN);  // a file beyond the limit of its size is then an error of write
  hear_signals();
}

void return_large_memory() {
#ifdef __GLIBC__
  constexpr int large = 128 * 1024;  // what glibc begins with; to set it ends its growth
  mallopt(M_MMAP_THRESHOLD, large);
#endif
}

void prepare_for_the_worst() {
  hold_standard_descriptors();
  mp_set_memory_functions(gmp_allocate, gmp_reallocate, gmp_free);
  std::set_terminate(end_of_exception);
}

}  // namespace noli::app
