// SPDX-License-Identifier: Apache-2.0
#include <noli/export.h>

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include <noli/errors.h>
#include "certify/export_frames.h"
#include "certify/runs/frame_times.h"
#include "certify/runs/run_log_facts.h"
#include "certify/runs/run_series_reader.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/sample.h"
#include "trajectory/stop.h"

namespace noli {
namespace {

/// Before the first frame, so that earlier files of the pattern stay.
void end_if_asked(const ExportRequest& request) {
  if (const auto reason = stop_asked()) throw Stopped(*reason, request.run.string());
}

class Export {
 public:
  Export(const ExportRequest& request, const FrameWriter& write)
      : request_(request),
        write_(write),
        reader_(open_run(request.run)),
        files_(request.pattern, request.force ? FrameFiles::Existing::replaced : FrameFiles::Existing::refused) {}

  ExportOutcome operator()() {
    outcome_.recorded = reader_.header().record == RecordMode::frames;
    const auto windows = static_cast<double>(std::max<std::uint64_t>(reader_.look().windows, 1));
    while (auto window = reader_.next_window()) {
      write_frames(*window);
      if (is_interrupted()) break;
      ++outcome_.windows;
      if (request_.progress) request_.progress(std::min(1.0, static_cast<double>(outcome_.windows) / windows));
      outcome_.end = window->end;
    }
    if (files_.count() == 0) end_if_asked(request_);
    if (outcome_.windows == 0 && !outcome_.interrupted) {
      throw InputError(request_.run.string(), "", "has no windows that are committed; there is nothing to export");
    }
    outcome_.open_window = !outcome_.interrupted && reader_.open_window().has_value();
    files_.finish();
    outcome_.frames = files_.count();
    outcome_.removed = files_.removed();
    outcome_.pvd = files_.series();
    return std::move(outcome_);
  }

 private:
  void write_frames(const RunWindow& window) {
    for_each_frame(window, request_.fps, [&](double t, const std::vector<Position>& positions) {
      if (is_interrupted()) return false;
      files_.add(t, {reader_.mesh(), positions}, write_);
      return true;
    });
  }

  bool is_interrupted() {
    outcome_.interrupted = outcome_.interrupted || stop_asked().has_value();
    return outcome_.interrupted;
  }

  const ExportRequest& request_;
  const FrameWriter& write_;
  SeriesReader reader_;
  FrameFiles files_;
  ExportOutcome outcome_;
};

}  // namespace

ExportOutcome export_frames(const ExportRequest& request, const FrameWriter& write) {
  const StopOfThread stop_of_thread(request.stop);
  end_if_asked(request);
  return Export(request, write)();
}

ExportOutcome run_export(const ExportRequest& request) {
  return export_frames(request, frame_writer_of(request.pattern));
}

}  // namespace noli
