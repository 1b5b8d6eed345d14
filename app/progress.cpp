// SPDX-License-Identifier: Apache-2.0
#include "app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace noli::app {

Progress::Progress(std::string label) : label_(std::move(label)), terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (shown_) std::fputs("\r\x1b[K", stderr);
}

void Progress::show(double share) {
  if (!terminal_ || (shown_ && since_last_.seconds() < 0.1)) return;
  constexpr int width = 40;
  const int full = std::clamp(static_cast<int>(share * width), 0, width);
  std::fputs(fmt::format("\r{} [{:=<{}}{:<{}}] {:3.0f} %", label_, "", full, "", width - full, 100 * share).c_str(),
             stderr);
  shown_ = true;
  since_last_ = Stopwatch();
}

void ProgressBars::show(std::string_view work, double share) {
  if (!bar_ || work_ != work) bar_.emplace(work_ = work);
  bar_->show(share);
}

}  // namespace noli::app
