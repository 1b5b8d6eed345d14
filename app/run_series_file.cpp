// SPDX-License-Identifier: Apache-2.0
#include "noli/app/run_series_file.h"

#include <array>
#include <cmath>
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

/// How long the series are.
struct Extent {
  std::uint64_t windows = 0, frames = 0;
};

std::uint64_t frames_in(const RunWindow& window, double rate) {
  if (!window.lines) return window.frames.size();
  std::uint64_t count = 0;
  for_each_frame_time(window.index, window.begin, window.end, rate, [&count](double) { return ++count > 0; });
  return count;
}

Extent measure(const std::filesystem::path& run, double rate) {
  RunReader reader(run);
  Extent extent;
  while (const auto window = reader.next_window()) {
    ++extent.windows;
    extent.frames += frames_in(*window, rate);
  }
  return extent;
}

/// The series of a window, from the bytes that the run keeps of its state.
SeriesRow row_of(const RunWindow& window, const std::filesystem::path& run) {
  try {
    return decode_row(window.state);
  } catch (const std::invalid_argument& error) {
    throw InputError(trajectory_path(run).string(), "",
                     "the state of window " + std::to_string(window.index) + ": " + error.what());
  }
}

class Series {
 public:
  Series(const std::filesystem::path& run, double rate)
      : rate_(rate), extent_(measure(run, rate)), reader_(run), file_(run / "series.h5") {
    declare();
    std::uint64_t row = 0;
    while (const auto window = reader_.next_window()) {
      write(row++, row_of(*window, run));
      write_frames(*window);
    }
    file_.close();
  }

 private:
  static std::string of(const char* group, std::size_t kind) {
    return std::string(group) + "/" + std::string(name(static_cast<ForceKind>(kind)));
  }

  void declare() {
    const std::uint64_t n = extent_.windows;
    file_.declare("time", "s", {n});
    file_.declare("energy/kinetic", "J", {n});
    file_.declare("energy/kinetic_mean", "J", {n});
    for (std::size_t k = 0; k < integrator::force_kinds; ++k) {
      file_.declare(of("energy/potential", k), "J", {n});
      file_.declare(of("work", k), "J", {n});
      file_.declare(of("damping_work", k), "J", {n});
    }
    file_.declare("momentum", "N s", {n, 3});
    file_.declare("angular_momentum", "N m s", {n, 3});
    file_.declare("events", "1", {n});
    file_.declare("breakpoints", "1", {n});
    file_.declare("frames/time", "s", {extent_.frames});
    file_.declare("frames/positions", "m", {extent_.frames, reader_.mesh().vertex_count, 3});
  }

  void put(const std::string& name, std::uint64_t row, double value) {
    file_.write_row(name, row, std::array<double, 1>{value});
  }

  void write(std::uint64_t i, const SeriesRow& row) {
    put("time", i, row.time);
    put("energy/kinetic", i, row.kinetic);
    put("energy/kinetic_mean", i, row.kinetic_mean);
    for (std::size_t k = 0; k < integrator::force_kinds; ++k) {
      put(of("energy/potential", k), i, row.potential[k]);
      put(of("work", k), i, row.work[k]);
      put(of("damping_work", k), i, row.damping_work[k]);
    }
    file_.write_row("momentum", i, row.momentum);
    file_.write_row("angular_momentum", i, row.angular_momentum);
    put("events", i, static_cast<double>(row.events));
    put("breakpoints", i, static_cast<double>(row.breakpoints));
  }

  void write_frames(const RunWindow& window) {
    if (!window.lines) {
      for (const RunFrame& frame : window.frames) write_frame(frame.time, frame.positions);
      return;
    }
    for_each_frame_time(window.index, window.begin, window.end, rate_, [&](double t) {
      write_frame(t, sample(*window.lines, t));
      return true;
    });
  }

  void write_frame(double time, const std::vector<Position>& positions) {
    put("frames/time", frame_, time);
    std::vector<double> flat;
    flat.reserve(3 * positions.size());
    for (const Position& x : positions) flat.insert(flat.end(), x.begin(), x.end());
    file_.write_row("frames/positions", frame_++, flat);
  }

  double rate_;
  Extent extent_;
  RunReader reader_;
  SeriesFile file_;
  std::uint64_t frame_ = 0;
};

}  // namespace

bool write_series_file(const std::filesystem::path& run, double frame_rate) {
  if (!SeriesFile::available()) return false;
  const Series written(run, frame_rate);
  return true;
}

}  // namespace noli::app
