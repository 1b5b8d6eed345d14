// SPDX-License-Identifier: Apache-2.0
//
// Parses JSON with errors that a person can locate: line and column, and the name that was most likely meant.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace noli::integrator {

/// Objects keep the order of the file.
using Json = nlohmann::ordered_json;

/// Parses the whole text; errors name `file`. Throws InputError with line and column: text that is not JSON, numbers
/// beyond the range of double; and with the JSON pointer: a field that an object has twice, more than 64 levels.
Json parse_json(std::string_view text, const std::string& file);

/// A value for a message: JSON on one line, shortened when long.
std::string brief(const Json& value);

/// The number of insertions, deletions, replacements and exchanges of neighbours that turn one word into the other
/// (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The nearest word, the first one of several, if so few letters differ that it may be meant.
std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& words);

/// "the nearest is X" in quotes; if none is near, "expected one of X, Y, ...".
std::string nearest_or_all(std::string_view word, const std::vector<std::string>& words);

}  // namespace noli::integrator
