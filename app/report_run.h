// SPDX-License-Identifier: Apache-2.0
//
// What a report shows of a run: its motion, its series, how it ended.
//
// What this does not do: it verifies nothing. Each window was verified exactly before it was committed; what `noli
// verify` or the checker says of the run now is a result of its own.
#pragma once

#include <filesystem>

#include "noli/app/report_page.h"

namespace noli::app {

struct ReportLimits {
  double fps = 60;                     ///< frames a second of simulated time, at most
  std::size_t most_bytes = 9'000'000;  ///< of the packed motion
};

/// Fills title, verdict, facts, scene and plots. Throws InputError (no run, a damaged one), ReadInterrupted.
void report_run(const std::filesystem::path& run, const ReportLimits& limits, ReportPage& report);

/// The same of frames, which are `steps` of a verdict at rest or moving; fills scene alone. Throws InputError.
void report_frames(const std::vector<std::filesystem::path>& frames, bool at_rest, const ReportLimits& limits,
                   ReportPage& report);

}  // namespace noli::app
