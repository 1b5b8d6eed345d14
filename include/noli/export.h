// SPDX-License-Identifier: Apache-2.0
//
// Exports a run as frames, in files that other programs read.
//
// Notation
//   frame i   the positions at the time i / fps, i = 0, 1, ..., interpolated from the world lines and rounded. Straight
//             lines between frames are not the certified motion
//
//   noli::ExportRequest request;
//   request.run = "run";
//   request.pattern = "frames/sheet_%04d.vtu";
//   noli::run_export(request);
//
// Units: SI. Errors: as run_export says. Thread safety: any number of exports may run at once, each with its own
// pattern and stop; nothing is printed. The callback comes from the calling thread.
// It does not verify the run: run_verify in noli/verify.h does.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace noli {

struct ExportRequest {
  std::filesystem::path run;
  double fps = 60;
  std::string pattern;  ///< with one %d or %0Nd, where the number of the frame goes; its ending names the format
  bool force = false;   ///< existing files of that pattern may be replaced or removed
  std::function<void(double share)> progress = {};  ///< called with the share of the windows that is done, in [0, 1]
  const std::atomic<bool>* stop = nullptr;          ///< polled; when it becomes true, the outcome has the frames so far
};

struct ExportOutcome {
  std::uint64_t frames = 0;
  std::uint64_t windows = 0;
  double end = 0;             ///< of the run [s]
  std::string pvd;            ///< the series that ParaView opens, if the format is vtu
  std::uint64_t removed = 0;  ///< files of an earlier export that were not replaced
  bool open_window = false;
  bool interrupted = false;  ///< it was stopped: the frames are those of the run's beginning
  bool recorded = false;     ///< the run recorded frames, and these were written
};

/// Writes the frames, one in memory at a time. If the run recorded only frames, it writes those and ignores fps. At the
/// end the only files of that pattern are those just written. A stop before the first frame throws Stopped: no file
/// is written or removed. Throws InputError (no run, a damaged one), Stopped, UsageError (pattern; a place that cannot
/// be written to; existing files of that pattern without `force`), std::system_error (disk).
ExportOutcome run_export(const ExportRequest& request);

}  // namespace noli
