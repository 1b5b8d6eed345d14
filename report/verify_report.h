// SPDX-License-Identifier: Apache-2.0
//
// The words of `noli verify`: its JSON, and its answer for people and machines.
#pragma once

#include <string>

#include <noli/verify.h>
#include "certify/json.h"
#include "report/answer.h"
#include "report/verify_text.h"

namespace noli::report {

/// All of it. Everything that a clock or the machine decides is under "timing"; the rest depends on the input and on
/// the options that `statement` repeats alone.
Json verify_json(const VerifyRequest& request, const VerifyOutcome& outcome);

/// Contacts and notes; with --verbose also the statement, the files, and the work. The place of the verdict is a step,
/// a time and two features.
Answer verify_answer(const VerifyRequest& request, const VerifyOutcome& outcome, TextOptions wanted = {});

/// How many pairs each stage decided, and obligations and pairs of cells.
Json work_json(const VerifyOutcome& outcome);

/// How many threads verify.
int threads_used(const VerifyRequest& request);

}  // namespace noli::report
