// SPDX-License-Identifier: Apache-2.0
//
// Computes in rational arithmetic until when n . (a(t) - b(t)) > g holds for two points that move on lines.
#pragma once

#include "oracle/motion.h"

namespace noli::oracle {

/// A point at x at time 0. At time 1 it is at y, or at x + y if y is its velocity. All coordinates are finite.
struct Line {
  Coordinates x{}, y{};
  bool is_velocity = false;
};

/// Only the first `dimension` coordinates count.
struct Certificate {
  int dimension = 3;
  Line a, b;
  Coordinates normal{};
  double gap = 0;
};

/// The largest double not greater than the least t >= from at which the certificate fails; `from` if it fails there;
/// infinity if it never fails. Precondition: from is finite and not negative.
double failure_time(const Certificate& certificate, double from);

}  // namespace noli::oracle
