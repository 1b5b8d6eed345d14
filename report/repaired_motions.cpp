// SPDX-License-Identifier: Apache-2.0
#include "report/repaired_motions.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include <noli/errors.h>
#include "certify/process/hdf5_frames.h"
#include "report/page/report_inputs.h"
#include "trajectory/cells.h"
#include "trajectory/formats/frames.h"
#include "trajectory/sample.h"

namespace noli::report {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const Json& list, const fs::path& path) {
  std::vector<fs::path> files;
  for (const Json& of : list) {
    files.emplace_back(of.at("file").get<std::string>());
    if (fs::exists(files.back())) continue;
    throw InputError(
        path.string(), "",
        fmt::format(
            "names {}, which is missing; run this in the folder where noli repair ran, with the frames still in place",
            files.back().string()));
  }
  return files;
}

/// The frames of a list of files, which have the hashes that the result says.
std::unique_ptr<FrameSource> open(const Json& list, const FrameReading& reading, const fs::path& path) {
  auto frames = open_all_frames(files_of(list, path), reading);
  const std::size_t count = frames->count().value_or(0);
  for (std::size_t k = 0; k < count; ++k) frames->look_at(k);
  ResultInputs(list, path, "repair").require_files(frames->facts());
  return frames;
}

}  // namespace

TimedFrames::TimedFrames(std::unique_ptr<FrameSource> source, std::vector<double> times)
    : source_(std::move(source)), times_(std::move(times)), sequence_(*source_, Motion::constant) {
  sequence_.next();
  before_.assign(sequence_.x_t0().begin(), sequence_.x_t0().end());
}

bool TimedFrames::next() {
  before_.assign(sequence_.x_t0().begin(), sequence_.x_t0().end());
  return sequence_.next();
}

std::vector<Position> TimedFrames::at(double time) {
  while (times_.at(sequence_.step()) < time && next()) {
  }
  std::vector<Position> x(sequence_.x_t0().begin(), sequence_.x_t0().end());
  const std::size_t k = sequence_.step();
  if (k == 0 || times_[k] == time) return x;
  const double s = std::clamp((time - times_[k - 1]) / (times_[k] - times_[k - 1]), 0.0, 1.0);
  for (std::size_t v = 0; v < x.size(); ++v) x[v] = sample_between(before_[v], x[v], s);
  return x;
}

RepairedMotions repaired_motions(const Json& result, const fs::path& path) {
  const Json &inputs = result.at("inputs"), &outputs = result.at("outputs");
  if (outputs.empty()) throw InputError(path.string(), "", "has no repaired frame");
  auto given = open(inputs, reading_of(inputs, result.at("bodies")), path);
  auto repaired = open(outputs, {}, path);
  std::vector<double> given_times, times;
  for (std::size_t k = 0; k < given->count().value_or(0); ++k) given_times.push_back(static_cast<double>(k));
  for (const Json& frame : outputs) times.push_back(frame.at("time").get<double>());
  const std::string first = given->name(0), first_repaired = repaired->name(0);
  RepairedMotions motions{{},
                          std::make_unique<TimedFrames>(std::move(given), std::move(given_times)),
                          std::make_unique<TimedFrames>(std::move(repaired), std::move(times))};
  require_same_mesh(motions.given->mesh(), first, motions.repaired->mesh(), first_repaired);
  motions.mesh = motions.given->mesh();
  if (result.at("points").get<bool>()) add_particles(motions.mesh);
  return motions;
}

}  // namespace noli::report
