// SPDX-License-Identifier: Apache-2.0
//
// Differences are told as "KIND: what, exactly": a finding that is made smaller has to stay one of its kind.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace noli::audit {

inline std::string_view kind_of(std::string_view difference) { return difference.substr(0, difference.find(':')); }

/// Whether there still is a difference, and of this kind.
inline bool is_of_kind(const std::optional<std::string>& difference, std::string_view kind) {
  return difference && kind_of(*difference) == kind;
}

}  // namespace noli::audit
