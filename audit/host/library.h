// SPDX-License-Identifier: Apache-2.0
//
// What the host takes from a library, and its clock.
#pragma once

#include <dlfcn.h>
#include <noli/ccd_plugin.h>

#include <algorithm>
#include <chrono>
#include <cstring>

#include "noli/audit/host/exchange.h"

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

inline void enter(HostStatus& status, HostPhase phase) { status.phase.store(phase, std::memory_order_release); }

/// Without `ask`: the library has not what it has to have; the status says why.
inline Library load(HostStatus& status, const char* path, bool pipeline) {
  const auto refuse = [&](LoadResult why, const char* message = "") {
    status.loaded = why;
    std::copy_n(message, std::min(std::strlen(message), status.message.size() - 1), status.message.begin());
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
  return library;
}

}  // namespace noli::audit
