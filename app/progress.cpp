// SPDX-License-Identifier: Apache-2.0
#include "app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace noli::app {
namespace {

constexpr std::size_t line_length = 110;  ///< a longer line would leave rests of itself

}  // namespace

Progress::Progress(std::string label) : label_(std::move(label)), terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (shown_) std::fputs("\r\x1b[K", stderr);
}

void Progress::show(double share, const std::string& at) {
  if (!terminal_ || (shown_ && since_last_.seconds() < 0.1)) return;
  constexpr int width = 20;
  const int full = std::clamp(static_cast<int>(share * width), 0, width);
  const std::string text = fmt::format("noli: {} [{:=<{}}{:<{}}] {:3.0f} %{}{}", label_, "", full, "", width - full,
                                       100 * share, at.empty() ? "" : "  " + at, left(share));
  std::fputs(("\r\x1b[K" + text.substr(0, line_length)).c_str(), stderr);
  shown_ = true;
  since_last_ = Stopwatch();
}

std::string Progress::left(double share) const {
  constexpr double least = 0.02;  // before that nobody knows
  const double seconds = since_begin_.seconds();
  if (share < least || share >= 1 || seconds < 1) return "";
  const double rest = seconds * (1 - share) / share;
  if (rest < 100) return fmt::format("  {:.0f} s left", rest);
  return rest < 6000 ? fmt::format("  {:.0f} min left", rest / 60) : fmt::format("  {:.0f} h left", rest / 3600);
}

void ProgressBars::show(std::string_view work, double share, const std::string& at) {
  if (!bar_ || work_ != work) bar_.emplace(work_ = work);
  bar_->show(share, at);
}

}  // namespace noli::app
