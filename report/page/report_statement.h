// SPDX-License-Identifier: Apache-2.0
//
// The statement of `noli verify` in the words of a page: every member, those too that say no or 0, because each is a
// condition of what was found. The page opens with those that differ from their defaults.
#pragma once

#include <string>

#include "certify/json.h"

namespace noli::report {

/// A value as a text: "yes", "none", "a; b".
std::string value_in_words(const Json& value);

/// Rows [name, text, shown]; shown: the claim, and what differs from its default. Precondition: an object.
Json statement_in_words(const Json& statement);

}  // namespace noli::report
