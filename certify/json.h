// SPDX-License-Identifier: Apache-2.0
//
// Writes JSON with keys in a fixed order and numbers with 17 significant digits, so that equal results are equal bytes.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include <noli/contact.h>

namespace noli {

using Json = nlohmann::ordered_json;

/// A number for JSON and text: 17 significant digits, which identify one double.
std::string digits17(double number);

/// A number >= 0 for people: rounded to four digits, but never from below 1 to 1, so that a time before the end of a
/// step does not look like its end.
std::string digits4(double number);

/// The document with an indentation of two and a newline at its end. Bytes that are not UTF-8 (in file names) are
/// replaced. Numbers that are not finite become null.
std::string to_text(const Json& document);

/// The value, or null.
template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

/// {"comparison": n, ..., "gmp": n}
Json stages_json(const StageCounters& stages);

}  // namespace noli
