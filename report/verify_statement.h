// SPDX-License-Identifier: Apache-2.0
//
// What `noli verify` was asked and about what motion: the statement of its result.
#pragma once

#include <noli/verify.h>
#include "certify/json.h"

namespace noli::report {

/// Pairs of a condition and what it is, in the order in which people read them.
Json statement_json(const VerifyRequest& request, const VerifyOutcome& outcome);

}  // namespace noli::report
