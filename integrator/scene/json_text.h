// SPDX-License-Identifier: Apache-2.0
//
// JSON from a file, with errors that a person can find: line and column, and the name that was most likely meant.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace noli::integrator {

/// Objects keep the order of the file.
using Json = nlohmann::ordered_json;

/// Parses the whole text; `file` is what errors call it. Throws InputError with line and column: text that is not JSON,
/// numbers beyond the range of double; and with the JSON pointer: a field that an object has twice, more than 64
/// levels.
Json parse_json(std::string_view text, const std::string& file);

/// A value as a message shows it: JSON on one line, shortened when long.
std::string brief(const Json& value);

/// How many characters have to be inserted, removed or replaced, or neighbours exchanged, to make one word of the other
/// (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The word of least distance, the first of several. Precondition: at least one word.
std::string nearest(std::string_view word, const std::vector<std::string>& words);

}  // namespace noli::integrator
