// SPDX-License-Identifier: Apache-2.0
//
// What ended a run, as its log tells it: the pair and the time.
//
// What this does not do: it decides nothing; a log that does not say it, or is damaged, gives no words.
#pragma once

#include <string>

#include "certify/json.h"
#include "certify/runs/run_log_facts.h"

namespace noli::report {

/// Of the part that ended last: "edge a[1]-a[2] meets edge b[6]-b[7], crossing, at 0.25 s" or "vertex a[0] and vertex
/// b[1], at 0.25 s", of energy "from 1 J to 3 J at 0.25 s"; or nothing.
std::string what_ended(const LogFacts& log);

/// The features that met and when, as a page's member `focus` (report_page.h); null unless a contact ended the run.
Json pair_that_ended(const LogFacts& log);

}  // namespace noli::report
