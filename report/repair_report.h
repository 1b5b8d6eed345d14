// SPDX-License-Identifier: Apache-2.0
//
// The words of `noli repair`: its JSON, and its answer for people and machines.
#pragma once

#include <noli/repair.h>
#include "certify/json.h"
#include "report/answer.h"

namespace noli::report {

/// "proved" or "no_contact" as noli verify says of the new frames; "cannot_be" where what is given leaves no way;
/// "undecided".
const char* repair_verdict(const RepairOutcome& outcome);

/// Schema repair.
Json repair_json(const RepairRequest& request, const RepairOutcome& outcome);

Answer repair_answer(const RepairRequest& request, const RepairOutcome& outcome);

}  // namespace noli::report
