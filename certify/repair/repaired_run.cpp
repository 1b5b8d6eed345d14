// SPDX-License-Identifier: Apache-2.0
#include "certify/repair/repaired_run.h"

#include <array>
#include <utility>

#include <noli/errors.h>
#include "certify/repair/step_lines.h"
#include "trajectory/stop.h"

namespace noli {

RepairedRun::RepairedRun(const std::filesystem::path& folder, RepairedScene scene, std::span<const Position> x,
                         const WindowOptions& options)
    : scene_(std::move(scene)), options_(options), verifier_(scene_.run.mesh, x, options), folder_(folder, "--run") {
  folder_.lock();
}

void RepairedRun::begin(bool replace) {
  folder_.make(replace);
  writer_.emplace(folder_.path(), scene_.run);
  folder_.begin(scene_.document, scene_.repair, scene_.facts);
}

void RepairedRun::go_on(std::size_t steps, std::span<const Position> x) {
  if (!folder_.has_begun()) refuse();
  const KnownWindows known = folder_.go_on(scene_.document, scene_.repair);
  reader_.emplace(folder_.path());
  reader_->expect(known);
  if (reader_->scene() != scene_.run) refuse();
  std::vector<Position> end;
  for (; steps_ < steps; ++steps_) {
    end_if_stopped();
    std::optional<RunWindow> window = reader_->next_window();
    if (!window) refuse();
    end = std::move(window->positions);
  }
  if (steps > 0 && end != in_run(x)) refuse();
}

void RepairedRun::refuse() const {
  throw InputError(folder_.path().string(), "", "has not the steps of this repair; expected its run, or --force");
}

void RepairedRun::add_straight(std::span<const Position> x, const std::vector<Position>& y) {
  if (is_there_already(y)) return;
  write(lines_through_frames(x, std::array{1.0}, std::span(&y, 1), steps_, dimension()), y);
}

bool RepairedRun::add(const FilteredStep& moved, std::span<const Position> x, std::span<const double> times) {
  if (is_there_already(moved.end)) return true;
  WorldLines lines = lines_of_step(moved, x, steps_, dimension());
  const WindowResult found = verifier_.verify(lines, options_);
  if (!found.complete && found.contact_count() == 0) return false;
  if (found.contact_count() > 0) {
    std::vector<std::vector<Position>> frames;
    for (const double t : times) frames.push_back(moved.at(t));
    lines = lines_through_frames(x, times, frames, steps_, dimension());
    ++straight_;
  }
  write(lines, moved.end);
  return true;
}

/// Whether the run has the next step, from before it was killed.
bool RepairedRun::is_there_already(std::span<const Position> end) {
  if (!reader_) return false;
  const std::optional<RunWindow> window = reader_->next_window();
  if (!window) {
    start_writing();
    return false;
  }
  if (window->positions != in_run(end)) refuse();
  ++steps_;
  return true;
}

void RepairedRun::start_writing() {
  writer_.emplace(folder_.path(), *reader_);
  reader_.reset();
  folder_.resumed({writer_->windows(), writer_->running_hash()}, scene_.facts);
}

void RepairedRun::write(const WorldLines& lines, std::span<const Position> end) {
  // Nothing continues from velocities.
  const std::vector<Position> velocities(end.size(), Position{});
  writer_->append_window({.index = steps_, .lines = lines, .velocities = velocities});
  writer_->commit();
  std::size_t breakpoints = 0;
  for (VertexId v = 0; v < lines.vertex_count(); ++v) breakpoints += lines.times(v).size();
  Json entry = {{"event", "window"},       {"window", steps_},           {"time", lines.last_time()},
                {"verdict", "no_contact"}, {"breakpoints", breakpoints}, {"running", hex(writer_->running_hash())}};
  folder_.log(entry);
  ++steps_;
}

void RepairedRun::finish(const char* why) {
  if (reader_) {
    while (reader_->next_window()) {
    }
    start_writing();
  }
  if (!writer_) return;
  Json entry = {{"event", "end"}, {"end", why}};
  CommittedWindows{writer_->windows(), writer_->running_hash()}.tell(entry);
  folder_.log(entry);
}

std::vector<Position> RepairedRun::in_run(std::span<const Position> x) const {
  std::vector<Position> result(x.begin(), x.end());
  if (dimension() == 2) {
    for (Position& p : result) p[2] = 0;
  }
  return result;
}

}  // namespace noli
