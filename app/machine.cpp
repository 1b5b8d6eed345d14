// SPDX-License-Identifier: Apache-2.0
#include "app/machine.h"

#include <fcntl.h>
#include <gmp.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>

#include "app/exit_code.h"

namespace noli::app {
namespace {

[[noreturn]] void end_with(std::string_view line) {
  // Nothing is left to do when not even this can be written.
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
  ::_exit(static_cast<int>(ExitCode::failure));
}

void* or_end(void* memory) {
  if (memory == nullptr) end_with("noli: out of memory\n");
  return memory;
}

/// An exception that nobody may catch, as one that leaves a destructor.
[[noreturn]] void end_of_exception() {
  try {
    if (const std::exception_ptr exception = std::current_exception()) std::rethrow_exception(exception);
  } catch (const std::bad_alloc&) {
    end_with("noli: out of memory\n");
  } catch (...) {
  }
  end_with("noli: internal error: terminated\n");
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

}  // namespace

std::uint64_t peak_memory_bytes() {
  struct rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::filesystem::path this_program_file() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error);
}

std::filesystem::path beside_this_program(const std::string& name) { return this_program_file().parent_path() / name; }

void prepare_for_the_worst() {
  hold_standard_descriptors();
  mp_set_memory_functions(gmp_allocate, gmp_reallocate, gmp_free);
  std::set_terminate(end_of_exception);
}

}  // namespace noli::app
