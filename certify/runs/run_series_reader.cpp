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

void SeriesReader::take_row(const RunWindow& window) {
  const std::optional<SeriesRow> before = std::exchange(row_, std::nullopt);
  why_none_ = not_a_row(window.state);
  if (!why_none_.empty()) return;
  try {
    row_ = decode_row(window.state);
    check_row(*row_, window, scene(), before ? &*before : nullptr);
    check_anchors(decode_anchors(window.state), window, scene());
  } catch (const std::invalid_argument& error) {
    refuse(error.what());
  }
}

const SeriesRow& SeriesReader::row() const {
  if (!row_) refuse(why_none_);
  return *row_;
}

void SeriesReader::refuse(const std::string& problem) const {
  throw InputError(trajectory_path(run_).string(), "", fmt::format("the state of window {}: {}", windows(), problem));
}

}  // namespace noli
