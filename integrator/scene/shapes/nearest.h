// SPDX-License-Identifier: Apache-2.0
//
// The name that somebody who mistyped one most likely meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace noli::integrator {

/// How many characters have to be inserted, removed or replaced, or neighbours exchanged, to make one word of the other
/// (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The word of least distance, the first of several. Precondition: at least one word.
std::string nearest(std::string_view word, const std::vector<std::string>& words);

}  // namespace noli::integrator
