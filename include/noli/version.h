// SPDX-License-Identifier: Apache-2.0
//
// The version of this Noli.
//
//   std::puts(noli::version_text().c_str());
//
// Thread safety: any thread.
#pragma once

#include <string>

namespace noli {

/// What `noli --version` prints: version, commit, arithmetic libraries, and whether rounding works on this machine now.
std::string version_text();

/// The version alone: "0.1.0".
std::string version_number();

/// The commit alone, abbreviated by git; "unknown" outside a checkout.
std::string version_commit();

}  // namespace noli
