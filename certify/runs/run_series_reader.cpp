// SPDX-License-Identifier: Apache-2.0
#include "certify/runs/run_series_reader.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include <noli/errors.h>
#include "certify/runs/run_series_check.h"

namespace noli {

SeriesReader::SeriesReader(const std::filesystem::path& run) : RunReader(run), run_(run) {}

std::optional<RunWindow> SeriesReader::next_window() {
  std::optional<RunWindow> window = RunReader::next_window();
  if (window) take_row(*window);
  return window;
}

void SeriesReader::skip_to(const CommitPoint& commit) {
  state_.reset();
  RunReader::skip_to(commit);
}

void SeriesReader::take_row(const RunWindow& window) {
  const std::optional<WindowState> before = std::exchange(state_, std::nullopt);
  why_none_ = not_a_row(window.state);
  if (!why_none_.empty()) return;
  try {
    state_ = decode_state(window.state);
    check_row(state_->row, window, scene(), before ? &before->row : nullptr);
    check_anchors(state_->anchors, window, scene());
  } catch (const std::invalid_argument& error) {
    refuse(error.what());
  }
}

const WindowState& SeriesReader::state() const {
  if (!state_) refuse(why_none_);
  return *state_;
}

void SeriesReader::refuse(const std::string& problem) const {
  throw InputError(trajectory_path(run_).string(), "", fmt::format("the state of window {}: {}", windows(), problem));
}

}  // namespace noli
