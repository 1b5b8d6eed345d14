// SPDX-License-Identifier: Apache-2.0
//
// A progress bar on standard error, when that is a terminal; else nothing.
#pragma once

#include <string>

#include "noli/app/machine.h"

namespace noli::app {

class Progress {
 public:
  explicit Progress(std::string label);
  ~Progress();  ///< removes the bar
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows a share of the work in [0, 1], at most ten times a second. Calls must not overlap.
  void show(double share);

 private:
  std::string label_;
  bool terminal_;
  bool shown_ = false;
  Stopwatch since_last_;
};

}  // namespace noli::app
