// SPDX-License-Identifier: Apache-2.0
#include "certify/process/this_program.h"

#include <sys/resource.h>

#include <system_error>
#include <utility>

namespace noli {
namespace {

std::filesystem::path& folder_of_programs() {
  static std::filesystem::path folder;
  return folder;
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

void keep_programs_in(std::filesystem::path folder) { folder_of_programs() = std::move(folder); }

std::filesystem::path beside_this_program(const std::string& name) {
  const std::filesystem::path& folder = folder_of_programs();
  return (folder.empty() ? this_program_file().parent_path() : folder) / name;
}

}  // namespace noli
