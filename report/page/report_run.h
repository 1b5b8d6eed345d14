// SPDX-License-Identifier: Apache-2.0
//
// What a report shows of a run: its motion, its series, how it ended.
//
// What this does not do: it verifies nothing. Each window was verified exactly before it was committed; what `noli
// verify` or the checker says of the run now is a result of its own.
#pragma once

#include <filesystem>
#include <functional>

#include "report/page/report_page.h"
#include "trajectory/formats/frame_source.h"

namespace noli::report {

struct ReportLimits {
  double fps = 60;                                  ///< frames a second of simulated time, at most
  std::size_t most_bytes = 9'000'000;               ///< of the packed motion
  std::function<void(double share)> progress = {};  ///< called with the share of the windows that is done, in [0, 1]
};

/// Fills title, verdict, facts, scene and plots. Throws InputError (no run, a damaged one), ReadInterrupted. The
/// verdict is that of the run's own end: it stays, whatever others say of the windows before it.
void report_run(const std::filesystem::path& run, const ReportLimits& limits, ReportPage& report);

/// How a verdict looks at its frames.
struct ReportedFrames {
  bool at_rest = false;  ///< each by itself, or moving from one to the next
  bool flat = false;     ///< in two dimensions
};

/// The same of frames; fills scene alone. Throws InputError.
void report_frames(FrameSource& frames, const ReportedFrames& how, const ReportLimits& limits, ReportPage& report);

}  // namespace noli::report
