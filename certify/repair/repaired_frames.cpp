// SPDX-License-Identifier: Apache-2.0
#include "certify/repair/repaired_frames.h"

#include <fmt/format.h>

#include <cmath>

#include <noli/errors.h>
#include "trajectory/formats/frame_names.h"
#include "trajectory/formats/frames.h"
#include "trajectory/write_file.h"

namespace noli {
namespace {

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
  return cell + '"';
}

}  // namespace

RepairedFrames::RepairedFrames(const RepairRequest& request, const FrameSource& source)
    : request_(request),
      source_(source),
      files_(request.pattern, request.force),
      write_(frame_writer_of(request.pattern)) {
  for (const auto& frame : request.frames) {
    if (!files_.may_be(frame)) continue;
    throw UsageError("-o " + request.pattern + ": " + frame.string() + " is read; choose another folder or name");
  }
}

void RepairedFrames::write(double time, const Frame& frame, bool given) {
  const auto k = static_cast<std::size_t>(time);
  if (given && has_own_file(k)) {
    files_.add_copy(time, request_.frames[k]);
    ++copied_;
  } else {
    files_.add(time, frame, write_);
  }
}

bool RepairedFrames::has_own_file(std::size_t k) const {
  return request_.reading.bodies.empty() && source_.count() == request_.frames.size() &&
         is_frame_name(request_.frames[k]) && request_.frames[k].extension() == files_.ending();
}

void RepairedFrames::finish(RepairOutcome& outcome) {
  files_.finish();
  outcome.frames = files_.count();
  outcome.copied = copied_;
  outcome.removed = files_.removed();
  outcome.times = files_.folder() / "times.csv";
  write_times(outcome.times);
}

void RepairedFrames::write_times(const std::filesystem::path& table) const {
  std::string text = "file,time,given\n";
  for (std::uint64_t i = 0; i < files_.count(); ++i) {
    const double t = files_.times()[i];
    const std::string given = t == std::floor(t) ? csv_cell(source_.name(static_cast<std::size_t>(t))) : "";
    text += fmt::format("{},{},{}\n", csv_cell(files_.file(i).filename().string()), t, given);
  }
  write_file(table, text);
}

std::vector<std::filesystem::path> RepairedFrames::files() const {
  std::vector<std::filesystem::path> all;
  for (std::uint64_t i = 0; i < files_.count(); ++i) all.push_back(files_.file(i));
  return all;
}

}  // namespace noli
