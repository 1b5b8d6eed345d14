// SPDX-License-Identifier: Apache-2.0
#include "certify/repair/repaired_run.h"

#include <array>
#include <utility>

#include <noli/errors.h>
#include "certify/repair/step_lines.h"
#include "trajectory/blocks/run_checks.h"
#include "trajectory/blocks/run_manifest.h"

namespace noli {

RepairedRun::RepairedRun(const std::filesystem::path& folder, RepairedScene scene, const WindowOptions& options)
    : scene_(std::move(scene)), options_(options), folder_(folder, "--run") {
  folder_.lock();
}

/// The scene.json of the run. Names of files may have bytes that are not UTF-8, which are replaced.
Json RepairedRun::document() const {
  const Json named = {{"title", scene_.title},
                      {"dimension", scene_.run.header.dimension},
                      {"duration", static_cast<double>(scene_.steps)},
                      {"window", scene_.run.header.window_length},
                      {"repair", {{"frames", scene_.pattern}, {"sha256", hex(scene_.fingerprint)}}}};
  return Json::parse(to_text(named));
}

/// Precondition: the folder has a run that has begun.
void RepairedRun::require_this_repair() const {
  if (read_manifest(folder_.path()).model_sha256 == scene_.fingerprint) return;
  throw InputError(folder_.path().string(), "",
                   "belongs to another repair; choose another folder, or resume with the same frames and options");
}

void RepairedRun::refuse(const char* why) const {
  throw InputError(folder_.path().string(), "",
                   std::string(why) + "; --force without --resume starts over and replaces it");
}

void RepairedRun::claim(bool force, bool resume) {
  folder_.lock();
  bool replace = force;
  if (resume && std::filesystem::exists(folder_.path())) {
    if (folder_.has_begun()) require_this_repair();
    replace = true;
  }
  folder_.claim(replace);
}

void RepairedRun::begin() {
  folder_.make(true);
  writer_.emplace(folder_.path(), scene_.run);
  folder_.begin(document(), scene_.fingerprint, facts());
}

bool RepairedRun::go_on(std::size_t steps, std::span<const Position> x, const std::function<bool()>& stop) {
  folder_.lock();
  if (!folder_.has_begun()) refuse("has no steps of this repair");
  require_this_repair();
  const KnownWindows known = folder_.go_on(document(), scene_.fingerprint);
  // Each window is in the log, with its hash, before its step is in the table of frames.
  logged_ = known.count;
  if (logged_ < steps) refuse("lacks steps of this repair");
  reader_.emplace(folder_.path());
  reader_->expect(known);
  if (reader_->scene() != scene_.run) refuse("is about another mesh");
  std::vector<Position> end;
  for (; steps_ < steps; ++steps_) {
    if (stop()) return false;
    std::optional<RunWindow> window = reader_->next_window();
    if (!window) refuse("lacks steps of this repair");
    end = std::move(window->positions);
  }
  if (steps > 0 && !same_bits(end, in_run(x))) refuse("has a different motion than this repair");
  return true;
}

void RepairedRun::add_straight(std::span<const Position> x, const std::vector<Position>& y) {
  if (take_existing(y)) return;
  write(lines_through_frames(x, std::array{1.0}, std::span(&y, 1), steps_, dimension()));
}

bool RepairedRun::add(const FilteredStep& moved, std::span<const Position> x, std::span<const double> times) {
  if (take_existing(moved.end)) return true;
  WorldLines lines = lines_of_step(moved, x, steps_, dimension());
  if (!verifier_) verifier_.emplace(scene_.run.mesh, x, options_);
  const WindowResult found = verifier_->verify(lines, options_);
  if (!found.complete && found.contact_count() == 0) return false;
  if (found.contact_count() > 0) {
    std::vector<std::vector<Position>> frames;
    for (const double t : times) frames.push_back(moved.at(t));
    lines = lines_through_frames(x, times, frames, steps_, dimension());
    ++straight_windows_;
  }
  write(lines);
  return true;
}

/// Passes over the next step, if the run has it from before it was stopped.
bool RepairedRun::take_existing(std::span<const Position> end) {
  if (!reader_) return false;
  const std::optional<RunWindow> window = reader_->next_window();
  if (!window) {
    start_writing();
    return false;
  }
  if (!same_bits(window->positions, in_run(end))) refuse("has a different motion than this repair");
  // A kill may have come between its commit and its line.
  if (steps_ >= logged_) {
    folder_.log({reader_->windows(), reader_->running_hash()}, window->end, window->breakpoints);
  }
  ++steps_;
  return true;
}

void RepairedRun::start_writing() {
  writer_.emplace(folder_.path(), *reader_);
  reader_.reset();
  folder_.resumed(committed(), facts());
}

void RepairedRun::write(const WorldLines& lines) {
  // Nothing goes on from velocities.
  const std::vector<Position> velocities(lines.vertex_count(), Position{});
  writer_->append_window({.index = steps_, .lines = lines, .velocities = velocities});
  writer_->commit();
  folder_.log(committed(), lines.last_time(), count_breakpoints(lines));
  ++steps_;
}

void RepairedRun::finish(const char* why, const std::function<bool()>& stop) {
  if (reader_) {
    do {
      if (stop()) return;
    } while (reader_->next_window());
    start_writing();
  }
  if (!writer_) return;
  Json entry = {{"event", "end"}, {"end", why}};
  committed().tell(entry);
  folder_.log(entry);
}

/// In two dimensions without a third coordinate.
std::vector<Position> RepairedRun::in_run(std::span<const Position> x) const {
  std::vector<Position> result(x.begin(), x.end());
  if (dimension() == 2) {
    for (Position& p : result) p[2] = 0;
  }
  return result;
}

}  // namespace noli
