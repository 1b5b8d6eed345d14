// SPDX-License-Identifier: Apache-2.0
//
// Options as a dict of Python: those that it has are set.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <noli/frames.h>
#include "python/src/background.h"
#include "report/answer.h"
#include "trajectory/formats/frame_names.h"

namespace noli::python {

template <class Value>
void put(const pybind11::dict& options, const char* name, Value& member) {
  if (options.contains(name)) member = options[name].cast<Value>();
}

/// "order": of frames in files.
inline FrameOrder order_of(const pybind11::dict& options) {
  std::string order = "checked";
  put(options, "order", order);
  return order == "natural" ? FrameOrder::natural : order == "given" ? FrameOrder::given : FrameOrder::checked;
}

/// "bodies": (name, names of files, whether it stands still) of each, in order. Notes on that are added to `notes`.
inline std::vector<BodyFrames> bodies_in_files(const pybind11::dict& options, std::vector<std::string>& notes) {
  std::vector<std::tuple<std::string, std::vector<std::filesystem::path>, bool>> rows;
  put(options, "bodies", rows);
  std::vector<BodyFrames> bodies;
  for (auto& [name, files, still] : rows) bodies.push_back({name, named_frames(std::move(files)), still});
  order_bodies(bodies, order_of(options), notes);
  return bodies;
}

/// What the command prints, without its advice, which is about options of the command.
inline std::string text_of(report::Answer answer, bool details = false) {
  answer.next.clear();
  return answer.text_above(details) + answer.last_line();
}

/// "time_limit", in seconds from now.
inline std::optional<std::chrono::steady_clock::time_point> deadline_of(const pybind11::dict& options) {
  using Clock = std::chrono::steady_clock;
  if (!options.contains("time_limit")) return std::nullopt;
  const std::chrono::duration<double> limit(options["time_limit"].cast<double>());
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);
}

/// For a request of Noli, which is done in the background: calls `progress` unless that is None. Both outlive it.
inline std::function<void(std::string_view, double)> progress_to(const pybind11::object& progress,
                                                                 Background& background) {
  if (progress.is_none()) return {};
  return [&progress, &background](std::string_view work, double share) {
    if (!background.is_due()) return;
    background.call([&] { progress(std::string(work), share); });
  };
}

}  // namespace noli::python
