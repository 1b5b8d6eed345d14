// SPDX-License-Identifier: Apache-2.0
//
// A progress bar on standard error, when that is a terminal; else nothing.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "certify/stopwatch.h"

namespace noli::app {

class Progress {
 public:
  explicit Progress(std::string label);
  ~Progress();  ///< removes the bar
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows a share of the work in [0, 1], what it is at (a few words, or nothing), and about how long the rest takes,
  /// at most ten times a second. Calls must not overlap.
  void show(double share, const std::string& at = "");

 private:
  std::string left(double share) const;

  std::string label_;
  bool terminal_;
  bool shown_ = false;
  Stopwatch since_begin_, since_last_;
};

/// One bar after another, for work that tells what it does.
class ProgressBars {
 public:
  void show(std::string_view work, double share, const std::string& at = "");

 private:
  std::string work_;
  std::optional<Progress> bar_;
};

/// What `work` returns, which is given something to call with the share that is done; the bar is gone then.
template <class Work>
auto with_progress(std::string label, const Work& work) {
  Progress bar(std::move(label));
  return work([&bar](double share) { bar.show(share); });
}

}  // namespace noli::app
