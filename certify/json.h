// SPDX-License-Identifier: Apache-2.0
//
// JSON as `noli` writes it: keys in a fixed order, numbers with 17 significant digits, so that equal results are equal
// bytes.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include <noli/contact.h>

namespace noli {

using Json = nlohmann::ordered_json;

/// A number as JSON and the text have it: 17 significant digits, which name one double only.
std::string digits17(double number);

/// A number that is not negative, to be read at a glance: rounded to four digits, but never from below 1 to 1, so that
/// no time before the end of a step reads as its end.
std::string digits4(double number);

/// The document with an indentation of two and a newline at its end. Bytes that are no UTF-8 (in names of files) are
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
