// SPDX-License-Identifier: Apache-2.0
//
// The statement of `noli verify` in the words of a page: every member, those too that say no or 0, because each is a
// condition of what was found.
#pragma once

#include "certify/json.h"

namespace noli::report {

/// Pairs of texts. Precondition: an object.
Json statement_in_words(const Json& statement);

}  // namespace noli::report
