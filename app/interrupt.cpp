// SPDX-License-Identifier: Apache-2.0
#include "noli/app/interrupt.h"

#include <unistd.h>

#include <csignal>

namespace noli::app {
namespace {

std::atomic<bool> stop_requested{false};
std::atomic<int> requests{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "a signal handler may write it");

/// Once a second: what begins to wait after the user asked is interrupted too, though it came a moment too late for the
/// user's own signal.
extern "C" void remind(int) { ::alarm(1); }

extern "C" void request_stop(int) {
  stop_requested.store(true, std::memory_order_relaxed);
  requests.fetch_add(1, std::memory_order_relaxed);
  ::alarm(1);
}

/// Without SA_RESTART, so that waiting for a pipe that nobody writes to ends too (ReadInterrupted).
void on_signal(int signal, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  sigaction(signal, &action, nullptr);
}

}  // namespace

const std::atomic<bool>& interrupted() { return stop_requested; }

int interruptions() { return requests.load(std::memory_order_relaxed); }

void install_signal_handlers() {
  on_signal(SIGALRM, remind);
  on_signal(SIGINT, request_stop);
  on_signal(SIGTERM, request_stop);
  on_signal(SIGHUP, request_stop);
  on_signal(SIGPIPE, SIG_IGN);
  on_signal(SIGXFSZ, SIG_IGN);  // a file beyond the limit of its size is then an error of write
}

}  // namespace noli::app
