// SPDX-License-Identifier: Apache-2.0
//
// What a report shows of a repair: the repaired motion, and over it the given one.
//
// What this does not do: it decides nothing. That the repaired motion touches nothing is what `noli repair` says, of
// files with these hashes.
#pragma once

#include <filesystem>

#include "report/page/report_page.h"
#include "report/page/report_run.h"

namespace noli::report {

/// Fills verdict, facts, scene, focus and plots, and adds the result without its lists of files to the results. Reads
/// the frames that the result names. Throws InputError where these are not there, or have other bytes; ReadInterrupted.
void report_repair(const Json& result, const std::filesystem::path& path, const ReportLimits& limits,
                   ReportPage& report);

}  // namespace noli::report
