// SPDX-License-Identifier: Apache-2.0
//
// How much memory this process has resident.
//
// What this does not do: tell whose it is, the library's or the host's.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>

namespace noli::audit {

/// In bytes; 0 where it cannot be found out.
inline std::uint64_t resident_bytes() {
  std::FILE* const file = std::fopen("/proc/self/statm", "r");
  unsigned long long all = 0, resident = 0;
  const bool read = file != nullptr && std::fscanf(file, "%llu %llu", &all, &resident) == 2;
  if (file != nullptr) std::fclose(file);
  return read ? resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

}  // namespace noli::audit
