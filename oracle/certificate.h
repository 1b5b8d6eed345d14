// SPDX-License-Identifier: Apache-2.0
//
// Until when n . (a(t) - b(t)) > g holds for two points that move on lines: a linear condition, in rational arithmetic.
#pragma once

#include "oracle/motion.h"

namespace noli::oracle {

/// The point that is at x at time 0, and at y at time 1 or, if y is its velocity, at x + y. Everything is finite.
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

/// The largest double not greater than the least t >= from at which the certificate does not hold; `from` if it does
/// not there; infinity if it holds for ever. Precondition: from is finite and not negative.
double failure_time(const Certificate& certificate, double from);

}  // namespace noli::oracle
