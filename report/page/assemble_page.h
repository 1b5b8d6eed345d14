// SPDX-License-Identifier: Apache-2.0
//
// Assembles the page of `noli report` from a run or frames, results and pictures.
//
// What this does not do: it decides nothing again, and writes no file (report_page.h).
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <noli/frames.h>
#include "report/page/report_page.h"
#include "report/page/report_run.h"

namespace noli::report {

struct PageRequest {
  /// At least one, in any order; names as in trajectory/formats/frame_names.h.
  std::vector<std::filesystem::path> inputs;
  ReportLimits limits;
  FrameOrder order = FrameOrder::checked;  ///< `checked`: natural if the result of `noli verify` used that
  std::vector<std::string> keys;           ///< of arrays; empty: as that result says
  std::optional<std::string> title;        ///< else that of the run, or the name of a result or of the first input
};

struct AssembledPage {
  ReportPage report;
  bool lacks_motion = false;  ///< it has a verdict about frames or a run without these
};

/// `begins`: called with the run among the inputs, if there is one, before its motion is read. request.limits.progress:
/// called while the motion is read. `after_motion`: called once, after that. Throws UsageError for inputs that a page
/// does not show, or not together; InputError for a result that cannot be read or is about other files; HelperError;
/// Stopped; std::system_error.
AssembledPage assemble_page(const PageRequest& request,
                            const std::function<void(const std::filesystem::path& run)>& begins,
                            const std::function<void()>& after_motion);

}  // namespace noli::report
