// SPDX-License-Identifier: Apache-2.0
#include "app/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace noli::app {
namespace {

/// Of the terminal that errors go to; a longer line would leave rests of itself.
std::size_t line_length() {
  struct winsize size = {};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 20) return 79;
  return size.ws_col - 1U;
}

/// As many whole letters of UTF-8 as fit.
std::string shortened(const std::string& text, std::size_t most) {
  std::size_t end = 0, letters = 0;
  for (; end < text.size(); ++end) {
    if ((text[end] & 0xC0) != 0x80 && ++letters > most) break;
  }
  return text.substr(0, end);
}

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
                                       100 * share, left(share), at.empty() ? "" : "  " + at);
  std::fputs(("\r\x1b[K" + shortened(text, line_length())).c_str(), stderr);
  shown_ = true;
  since_last_ = Stopwatch();
}

std::string Progress::left(double share) const {
  constexpr double least = 0.02;  // earlier estimates are too rough
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
