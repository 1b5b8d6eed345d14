// SPDX-License-Identifier: Apache-2.0
#include "certify/runs/run_series_file.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <noli/errors.h>
#include "certify/runs/frame_times.h"
#include "certify/runs/run_series_reader.h"
#include "certify/runs/series_file.h"
#include "trajectory/blocks/bytes.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/sample.h"

namespace noli {
namespace {

using integrator::ForceKind;

using Stop = std::function<bool()>;

/// The lengths of the series.
struct Extent {
  std::uint64_t windows = 0, frames = 0;
  std::int64_t first_bin = 0;  ///< of steps
  std::uint64_t bins = 0;
  std::uint64_t materials = 0, scripts = 0;

  void add(const SeriesRow& row) {
    materials = row.contact_work.size();
    scripts = row.script_work.size();
    add(row.steps);
  }

 private:
  void add(const StepHistogram& steps) {
    if (steps.bins.empty()) return;
    const std::int64_t first = steps.bins.front().number, last = steps.bins.back().number;
    const std::int64_t end = bins == 0 ? last + 1 : std::max(last + 1, first_bin + static_cast<std::int64_t>(bins));
    first_bin = bins == 0 ? first : std::min(first, first_bin);
    bins = static_cast<std::uint64_t>(end - first_bin);
  }
};

std::uint64_t frames_in(const RunWindow& window, double rate, const Stop& stop) {
  if (!window.lines) return window.frames.size();
  std::uint64_t count = 0;
  for_each_frame_time(window.index, window.begin, window.end, rate, [&](double) { return ++count > 0 && !stop(); });
  return count;
}

/// Nothing if it was stopped.
std::optional<Extent> measure(const std::filesystem::path& run, double rate, const Stop& stop) {
  SeriesReader reader(run);
  Extent extent;
  while (const auto window = reader.next_window()) {
    ++extent.windows;
    extent.add(reader.row());
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

  /// Precondition: `row` is one row of the array.
  void append(std::span<const double> row) {
    constexpr std::size_t enough = 1 << 14;
    waiting_.insert(waiting_.end(), row.begin(), row.end());
    ++rows_;
    if (waiting_.size() >= enough) flush();
  }

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

std::string in_group(const char* group, std::size_t kind) {
  return std::string(group) + "/" + std::string(name(static_cast<ForceKind>(kind)));
}

/// Calls each(name, unit, values) for each series of a row, except the histogram of steps and the series whose size
/// depends on the scene.
template <class Each>
void each_series(const SeriesRow& row, const Each& each) {
  const auto one = [&each](const std::string& name, const char* unit, double value) {
    each(name, unit, std::span<const double>(&value, 1));
  };
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  one("time", "s", row.time);
  one("energy/kinetic", "J", row.kinetic);
  one("energy/kinetic_mean", "J", row.kinetic_mean);
  for (std::size_t k = 0; k < integrator::force_kinds; ++k) {
    one(in_group("energy/potential", k), "J", row.potential[k]);
    one(in_group("work", k), "J", row.work[k]);
    one(in_group("damping_work", k), "J", row.damping_work[k]);
    one(in_group("held_work", k), "J", row.held_work[k]);
  }
  one("restitution_work", "J", row.restitution_work);
  one("energy/held_ahead", "J", row.held_ahead);
  one("integration", "J", row.integration);
  each("momentum", "N s", row.momentum);
  each("angular_momentum", "N m s", row.angular_momentum);
  one("events", "1", static_cast<double>(row.events_in_all()));
  for (std::size_t k = 0; k < integrator::force_kinds; ++k) {
    one(in_group("events_of", k), "1", static_cast<double>(row.events[k]));
  }
  one("breakpoints", "1", static_cast<double>(row.breakpoints));
  one("contact/deepest_layer", "1", static_cast<double>(row.deepest.layer));
  one("contact/least_distance", "m", row.nearest.layer > 0 ? row.nearest.distance : none);
  one("histograms/smallest_step", "s", row.steps.smallest);
}

class Series {
 public:
  Series(const std::filesystem::path& run, double rate, const Extent& extent, const Stop& stop)
      : run_(run),
        rate_(rate),
        stop_(stop),
        extent_(extent),
        reader_(run),
        file_(run / "series.h5", {.file = series_program().file, .stop = stop}) {
    declare();
  }

  /// False if it was stopped.
  bool write() {
    while (const auto window = reader_.next_window()) {
      write(reader_.row());
      if (!write_frames(*window)) return false;
    }
    for (auto& [name, column] : columns_) column.flush();
    file_.close();
    return true;
  }

 private:
  void declare(const std::string& name, const std::string& unit, const SeriesShape& shape) {
    columns_.try_emplace(name, file_, name, unit, shape);
  }

  void declare() {
    const std::uint64_t n = extent_.windows;
    each_series(SeriesRow{}, [&](const std::string& name, const char* unit, std::span<const double> values) {
      declare(name, unit, values.size() == 1 ? SeriesShape{n} : SeriesShape{n, values.size()});
    });
    if (extent_.materials > 0) declare("contact/work", "J", {n, extent_.materials, 3});
    if (extent_.scripts > 0) declare("script_work", "J", {n, extent_.scripts});
    declare("histograms/step_share", "1", {n, extent_.bins});
    std::vector<double> ends;
    for (std::uint64_t i = 0; i <= extent_.bins; ++i) {
      ends.push_back(bin_begin(extent_.first_bin + static_cast<std::int64_t>(i)));
    }
    file_.add("histograms/step_ends", "s", ends);
    declare_mesh();
    declare("frames/time", "s", {extent_.frames});
    declare("frames/positions", "m", {extent_.frames, reader_.mesh().vertex_count, 3});
  }

  /// What the positions of frames are positions of.
  void declare_mesh() {
    const Mesh& mesh = reader_.mesh();
    add_cells("mesh/faces", mesh.faces);
    add_cells("mesh/edges", mesh.edges);
    const std::vector<std::int64_t> points(mesh.points.begin(), mesh.points.end());
    file_.add("mesh/points", "1", points);
  }

  template <std::size_t N>
  void add_cells(const char* name, const std::vector<std::array<VertexId, N>>& cells) {
    std::vector<std::int64_t> numbers;
    for (const auto& cell : cells) numbers.insert(numbers.end(), cell.begin(), cell.end());
    file_.add(name, "1", numbers, {cells.size(), N});
  }

  Column& column(const std::string& name) { return columns_.at(name); }

  void write(const SeriesRow& row) {
    each_series(row, [this](const std::string& name, const char*, std::span<const double> values) {
      column(name).append(values);
    });
    if (!row.contact_work.empty()) column("contact/work").append(works(row.contact_work));
    if (!row.script_work.empty()) column("script_work").append(row.script_work);
    column("histograms/step_share").append(shares(row.steps));
  }

  /// The works of each material: potential, friction, restitution.
  static std::vector<double> works(const std::vector<ContactWork>& materials) {
    std::vector<double> row;
    for (const ContactWork& m : materials) row.insert(row.end(), {m.potential, m.friction, m.restitution});
    return row;
  }

  /// The share of each bin of the run.
  std::vector<double> shares(const StepHistogram& steps) const {
    std::vector<double> row(extent_.bins, 0);
    const double all = static_cast<double>(steps.ticks());
    for (const auto& bin : steps.bins) {
      row[static_cast<std::size_t>(bin.number - extent_.first_bin)] = static_cast<double>(bin.ticks) / all;
    }
    return row;
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
    column("frames/time").append(std::span(&time, 1));
    column("frames/positions").append(coordinates(positions));
  }

  const std::filesystem::path& run_;
  double rate_;
  const Stop& stop_;
  Extent extent_;
  SeriesReader reader_;
  SeriesFile file_;
  std::map<std::string, Column> columns_;
};

}  // namespace

const char* name(SeriesEnd end) {
  switch (end) {
    case SeriesEnd::written: return "written";
    case SeriesEnd::unavailable: return "unavailable";
    case SeriesEnd::stopped: return "stopped";
    case SeriesEnd::failed: return "failed";
  }
  return "";
}

SeriesEnd write_series_file(const std::filesystem::path& run, double frame_rate, const Stop& stop) {
  if (!series_program().available()) return SeriesEnd::unavailable;
  const auto extent = measure(run, frame_rate, stop);
  try {
    const bool written = extent && Series(run, frame_rate, *extent, stop).write();
    return written ? SeriesEnd::written : SeriesEnd::stopped;
  } catch (const SeriesStopped&) {
    return SeriesEnd::stopped;
  }
}

}  // namespace noli
