// SPDX-License-Identifier: Apache-2.0
#include "certify/process/this_program.h"

#include <sys/resource.h>

#include <system_error>

namespace noli {

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

}  // namespace noli
