// SPDX-License-Identifier: Apache-2.0
//
// The field that a figure is drawn in: scales, ticks, and what is written beside them.
#pragma once

#include <string>
#include <vector>

#include "report/figures/svg.h"

namespace noli::report {

/// From a number to a pixel, linearly.
struct Scale {
  double low = 0, high = 1;  ///< low < high
  double from = 0, to = 1;   ///< pixels

  double operator()(double x) const { return from + (x - low) / (high - low) * (to - from); }
};

/// The decimal logarithm, to pixels; what is beyond the ends is drawn at them.
struct LogScale {
  double low, high;  ///< 0 < low < high
  double from, to;

  double operator()(double x) const;
};

/// Whole powers of ten around the values that are above 0.
LogScale logarithmic_scale(const std::vector<double>& values, double from, double to);

/// A tick and its words.
struct Tick {
  double value;
  std::string words;
};

/// Multiples of 1, 2 or 5 times a power of ten from low to high, at most about `most`. Precondition: low < high, both
/// finite, most >= 2.
std::vector<Tick> linear_ticks(double low, double high, int most);

/// The same for a logarithmic scale: powers of ten; if fewer than three, 2 and 5 times those too. Precondition: 0 < low
/// < high, both finite.
std::vector<Tick> logarithmic_ticks(double low, double high);

/// A rectangle with ticks on its left and below.
struct Field {
  Scale x, y;

  void axes(Svg& svg, const std::string& x_words, const std::string& y_words) const;
};

}  // namespace noli::report
