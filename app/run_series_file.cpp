// SPDX-License-Identifier: Apache-2.0
#include "noli/app/run_series_file.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "noli/app/frame_times.h"
#include "noli/app/run_series.h"
#include "noli/trajectory/error.h"
#include "noli/trajectory/run_file.h"
#include "noli/trajectory/sample.h"
#include "noli/trajectory/series_file.h"

namespace noli::app {
namespace {

using integrator::ForceKind;

using Stop = std::function<bool()>;

/// How long the series are.
struct Extent {
  std::uint64_t windows = 0, frames = 0;
};

std::uint64_t frames_in(const RunWindow& window, double rate, const Stop& stop) {
  if (!window.lines) return window.frames.size();
  std::uint64_t count = 0;
  for_each_frame_time(window.index, window.begin, window.end, rate, [&](double) { return ++count > 0 && !stop(); });
  return count;
}

/// Nothing when it was stopped.
std::optional<Extent> measure(const std::filesystem::path& run, double rate, const Stop& stop) {
  RunReader reader(run);
  Extent extent;
  while (const auto window = reader.next_window()) {
    ++extent.windows;
    extent.frames += frames_in(*window, rate, stop);
    if (stop()) return std::nullopt;
  }
  return extent;
}

/// An array of the file that is filled from its beginning, many rows at a time.
class Column {
 public:
  Column(SeriesFile& file, std::string name, const std::string& unit, const SeriesShape& shape)
      : file_(&file), name_(std::move(name)) {
    file.declare(name_, unit, shape);
  }

  /// Precondition: one row.
  void append(std::span<const double> row) {
    constexpr std::size_t enough = 1 << 14;
    waiting_.insert(waiting_.end(), row.begin(), row.end());
    ++rows_;
    if (waiting_.size() >= enough) flush();
  }
  void append(double value) { append(std::span(&value, 1)); }

  void flush() {
    if (waiting_.empty()) return;
    file_->write_rows(name_, written_, waiting_);
    written_ += rows_;
    rows_ = 0;
    waiting_.clear();
  }

 private:
  SeriesFile* file_;
  std::string name_;
  std::vector<double> waiting_;
  std::uint64_t written_ = 0, rows_ = 0;
};

class Series {
 public:
  Series(const std::filesystem::path& run, double rate, const Extent& extent, const Stop& stop)
      : run_(run), rate_(rate), stop_(stop), reader_(run), file_(run / "series.h5") {
    declare(extent);
  }

  /// Whether it was not stopped.
  bool write() {
    while (const auto window = reader_.next_window()) {
      write(row_of(*window, run_));
      if (!write_frames(*window)) return false;
    }
    for (auto& [name, column] : columns_) column.flush();
    file_.close();
    return true;
  }

 private:
  static std::string of(const char* group, std::size_t kind) {
    return std::string(group) + "/" + std::string(name(static_cast<ForceKind>(kind)));
  }

  void declare(const std::string& name, const std::string& unit, const SeriesShape& shape) {
    columns_.try_emplace(name, file_, name, unit, shape);
  }

  void declare(const Extent& extent) {
    const std::uint64_t n = extent.windows;
    declare("time", "s", {n});
    declare("energy/kinetic", "J", {n});
    declare("energy/kinetic_mean", "J", {n});
    for (std::size_t k = 0; k < integrator::force_kinds; ++k) {
      declare(of("energy/potential", k), "J", {n});
      declare(of("work", k), "J", {n});
      declare(of("damping_work", k), "J", {n});
    }
    declare("momentum", "N s", {n, 3});
    declare("angular_momentum", "N m s", {n, 3});
    declare("events", "1", {n});
    declare("breakpoints", "1", {n});
    declare("frames/time", "s", {extent.frames});
    declare("frames/positions", "m", {extent.frames, reader_.mesh().vertex_count, 3});
  }

  Column& column(const std::string& name) { return columns_.at(name); }

  void write(const SeriesRow& row) {
    column("time").append(row.time);
    column("energy/kinetic").append(row.kinetic);
    column("energy/kinetic_mean").append(row.kinetic_mean);
    for (std::size_t k = 0; k < integrator::force_kinds; ++k) {
      column(of("energy/potential", k)).append(row.potential[k]);
      column(of("work", k)).append(row.work[k]);
      column(of("damping_work", k)).append(row.damping_work[k]);
    }
    column("momentum").append(row.momentum);
    column("angular_momentum").append(row.angular_momentum);
    column("events").append(static_cast<double>(row.events));
    column("breakpoints").append(static_cast<double>(row.breakpoints));
  }

  bool write_frames(const RunWindow& window) {
    const auto write = [this](double t, const std::vector<Position>& positions) {
      write_frame(t, positions);
      return !stop_();
    };
    for (const RunFrame& frame : window.frames) {
      if (!write(frame.time, frame.positions)) return false;
    }
    if (!window.lines) return !stop_();
    for_each_frame_time(window.index, window.begin, window.end, rate_,
                        [&](double t) { return write(t, sample(*window.lines, t)); });
    return !stop_();
  }

  void write_frame(double time, const std::vector<Position>& positions) {
    column("frames/time").append(time);
    column("frames/positions").append(std::span<const double>(positions.front().data(), 3 * positions.size()));
  }

  const std::filesystem::path& run_;
  double rate_;
  const Stop& stop_;
  RunReader reader_;
  SeriesFile file_;
  std::map<std::string, Column> columns_;
};

}  // namespace

const char* name(SeriesEnd end) {
  switch (end) {
    case SeriesEnd::written: return "written";
    case SeriesEnd::unavailable: return "unavailable";
    case SeriesEnd::stopped: return "stopped";
  }
  return "";
}

SeriesEnd write_series_file(const std::filesystem::path& run, double frame_rate, const Stop& stop) {
  if (!SeriesFile::available()) return SeriesEnd::unavailable;
  const auto extent = measure(run, frame_rate, stop);
  const bool written = extent && Series(run, frame_rate, *extent, stop).write();
  return written ? SeriesEnd::written : SeriesEnd::stopped;
}

}  // namespace noli::app
