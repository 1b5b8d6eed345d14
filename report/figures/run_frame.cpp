// SPDX-License-Identifier: Apache-2.0
#include "report/figures/run_frame.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include <noli/errors.h>
#include "trajectory/sample.h"
#include "trajectory/stop.h"

namespace noli::report {
namespace {

/// Keeps the frame that is nearest to the time asked for.
class Nearest {
 public:
  explicit Nearest(double time) : time_(time) {}

  void add(const RunWindow& window) {
    for (const RunFrame& frame : window.frames) add(frame.time, frame.positions);
    if (window.lines && window.begin <= time_ && time_ <= window.end) add(time_, sample(*window.lines, time_));
  }
  bool found() const { return found_; }
  bool is_passed(const RunWindow& window) const { return found_ && window.end > time_ + std::abs(best_.time - time_); }
  const RunFrame& best() const { return best_; }

 private:
  void add(double time, const std::vector<Position>& positions) {
    if (found_ && !(std::abs(time - time_) < std::abs(best_.time - time_))) return;
    best_ = {time, positions};
    found_ = true;
  }

  double time_;
  RunFrame best_;
  bool found_ = false;
};

}  // namespace

RunFrame run_frame_at(SeriesReader& reader, const std::filesystem::path& run, double time) {
  Nearest nearest(time);
  double end = 0;
  while (const auto window = reader.next_window()) {
    end_if_stopped();
    end = window->end;
    nearest.add(*window);
    if (nearest.is_passed(*window)) break;
  }
  if (nearest.found() && time >= 0 && time <= end) return nearest.best();
  if (end == 0) throw InputError(run.string(), "", "has no windows; there is nothing to show");
  throw InputError(run.string(), "", fmt::format("ends at {} s; expected a time up to then, found {} s", end, time));
}

}  // namespace noli::report
