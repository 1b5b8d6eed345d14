// SPDX-License-Identifier: Apache-2.0
#include "bench/child.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <exception>
#include <stdexcept>

namespace noli::bench {
namespace {

[[noreturn]] void run_child(int out, const std::function<double()>& measure) {
  try {
    const double seconds = measure();
    if (::write(out, &seconds, sizeof seconds) == sizeof seconds) ::_exit(0);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "measurement failed: %s\n", error.what());
  }
  ::_exit(1);
}

}  // namespace

Measured in_child(const std::function<double()>& measure) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) run_child(ends[1], measure);
  ::close(ends[1]);
  Measured measured;
  const bool read = ::read(ends[0], &measured.seconds, sizeof(double)) == sizeof(double);
  ::close(ends[0]);
  struct rusage usage = {};
  int status = 0;
  if (::wait4(child, &status, 0, &usage) != child || status != 0 || !read)
    throw std::runtime_error("a measurement failed");
  measured.peak_bytes = static_cast<double>(usage.ru_maxrss) * 1024;
  return measured;
}

}  // namespace noli::bench
