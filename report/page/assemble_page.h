// SPDX-License-Identifier: Apache-2.0
//
// Assembles the page of `noli report` from a run or frames, results and pictures.
//
//   PageAssembly assembly(request);
//   assembly.show_motion(progress);
//   const AssembledPage assembled = assembly.finish();
//
// What this does not do: it decides nothing again, and writes no file (report_page.h).
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <noli/frames.h>
#include "certify/json.h"
#include "report/page/report_page.h"
#include "report/page/report_run.h"

namespace noli::report {

struct PageRequest {
  std::vector<std::filesystem::path> inputs;  ///< at least one, in any order; names as in frame_names.h
  ReportLimits limits;                        ///< without `progress`
  FrameOrder order = FrameOrder::checked;     ///< `checked`: as the result of `noli verify` says
  std::vector<std::string> keys;              ///< of arrays; empty: as that result says
  std::optional<std::string> title;           ///< else that of the run, or the name of a result or of the first input
};

struct AssembledPage {
  ReportPage report;
  bool lacks_motion = false;  ///< it has a verdict about frames or a run without these
};

class PageAssembly {
 public:
  /// Sorts the inputs by kind, reads the results and orders the frames. Throws UsageError for inputs that a page does
  /// not show, or not together; InputError for a result that cannot be read.
  explicit PageAssembly(PageRequest request);

  /// The run among the inputs.
  const std::optional<std::filesystem::path>& run() const { return run_; }

  /// Reads the motion of the run, of the repair or of the frames. `progress`: called with the share that is done, in
  /// [0, 1]. Precondition: not called before. Throws UsageError; InputError where a result is about other files;
  /// ReadInterrupted.
  void show_motion(std::function<void(double share)> progress);

  /// Adds the verdicts, the pictures and where all comes from. Precondition: show_motion() was called. Throws as that.
  AssembledPage finish();

 private:
  struct ResultFile {
    std::filesystem::path path;
    Json json;
  };

  void sort_inputs();
  void read_result_file(const std::filesystem::path& path);
  void put_frames_in_order();
  void put_repair();
  void put_frames();
  FrameReading reading() const;
  void put_verdict_of_verify();
  void put_pictures();
  void put_other_words();
  void put_sources();
  bool has_title() const;
  void put_title();

  PageRequest request_;
  std::optional<std::filesystem::path> run_;
  std::vector<std::filesystem::path> frames_, results_, pictures_;
  std::optional<ResultFile> verified_, repaired_;  ///< the results about the motion that is shown
  ReportPage report_;
};

}  // namespace noli::report
