// SPDX-License-Identifier: Apache-2.0
//
// Caps the notes on the order of frames. The order itself is in include/noli/frames.h.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <noli/frames.h>

namespace noli {

/// Appends the first of many notes; the last line then counts the others: "and 5 more gaps".
inline constexpr std::size_t most_notes_of_a_kind = 10;
void append_capped(std::vector<std::string>& notes, const std::vector<std::string>& more, std::string_view what);

}  // namespace noli
