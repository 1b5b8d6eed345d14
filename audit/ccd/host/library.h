// SPDX-License-Identifier: Apache-2.0
//
// What the host takes from a library, its clock, and how much memory it has.
#pragma once

#include <dlfcn.h>
#include <noli/ccd_plugin.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "audit/ccd/host/exchange.h"

namespace noli::audit {

using Ask = decltype(&noli_ccd_query);
using Search = decltype(&noli_ccd_candidates);

struct Library {
  Ask ask = nullptr;
  Search search = nullptr;
};

inline double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// How much memory is resident, the library's and the host's, in bytes; 0 where it cannot be found out.
inline std::uint64_t resident_bytes() {
  std::FILE* const file = std::fopen("/proc/self/statm", "r");
  unsigned long long all = 0, resident = 0;
  const bool read = file != nullptr && std::fscanf(file, "%llu %llu", &all, &resident) == 2;
  if (file != nullptr) std::fclose(file);
  return read ? resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

/// Calls again() for half the time and for the other half, or until it returns false, with a look at the memory before,
/// between and after.
template <class Status, class Again>
void repeat_in_halves(Status& e, const Again& again) {
  e.resident[0] = resident_bytes();
  const double begin = seconds();
  for (std::size_t half = 1; half <= 2; ++half) {
    const double end = begin + 0.5 * static_cast<double>(half) * e.repeat_seconds;
    while (again() && seconds() < end) {
    }
    e.resident[half] = resident_bytes();
  }
}

inline void enter(HostStatus& status, HostPhase phase) { status.phase.store(phase, std::memory_order_release); }

/// As much of it as there is room for.
template <std::size_t size>
void write_words(const char* words, std::array<char, size>& where) {
  std::copy_n(words, std::min(std::strlen(words), size - 1), where.begin());
}

/// Without `ask`: the library has not what it has to have; the status says why.
inline Library load(HostStatus& status, const char* path, bool pipeline) {
  const auto refuse = [&](LoadResult why, const char* message = "") {
    status.loaded = why;
    write_words(message, status.message);
    enter(status, HostPhase::done);
    return Library{};
  };
  void* const handle = ::dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) return refuse(LoadResult::not_loaded, ::dlerror());
  const auto version = reinterpret_cast<decltype(&noli_ccd_version)>(::dlsym(handle, "noli_ccd_version"));
  if (version == nullptr) return refuse(LoadResult::no_version);
  status.version = version();
  if (status.version != NOLI_CCD_VERSION) return refuse(LoadResult::other_version);
  const Library library{reinterpret_cast<Ask>(::dlsym(handle, "noli_ccd_query")),
                        reinterpret_cast<Search>(::dlsym(handle, "noli_ccd_candidates"))};
  if (library.ask == nullptr) return refuse(LoadResult::no_query);
  if (pipeline && library.search == nullptr) return refuse(LoadResult::no_candidates);
  const auto describe = reinterpret_cast<decltype(&noli_ccd_description)>(::dlsym(handle, "noli_ccd_description"));
  if (const char* const words = describe != nullptr ? describe() : nullptr) write_words(words, status.description);
  return library;
}

}  // namespace noli::audit
