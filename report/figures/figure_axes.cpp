// SPDX-License-Identifier: Apache-2.0
#include "report/figures/figure_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace noli::report {

double LogScale::operator()(double x) const {
  return Scale{std::log10(low), std::log10(high), from, to}(std::log10(std::clamp(x, low, high)));
}

LogScale logarithmic_scale(const std::vector<double>& values, double from, double to) {
  double low = 1e300, high = 0;
  for (const double x : values) {
    if (!(x > 0)) continue;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  if (high == 0) low = high = 1;
  const double first = std::floor(std::log10(low)), last = std::max(std::ceil(std::log10(high)), first + 1);
  return {std::pow(10, first), std::pow(10, last), from, to};
}

std::vector<Tick> linear_ticks(double low, double high, int most) {
  const double least = (high - low) / most, power = std::pow(10, std::floor(std::log10(least)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= least) step = factor * power;
  }
  std::vector<Tick> ticks;
  const double first = std::ceil(low / step - 1e-9), last = std::floor(high / step + 1e-9);
  for (double i = first; i <= last && ticks.size() <= 2 * static_cast<std::size_t>(most); ++i) {
    // In decimal digits, so that 3 * 0.1 is 0.3.
    const int digits = std::max(1, static_cast<int>(std::ceil(std::log10(std::abs(i) + 1))) + 1);
    ticks.push_back({i * step, i == 0 ? "0" : fmt::format("{:.{}g}", i * step, digits)});
  }
  return ticks;
}

std::vector<Tick> logarithmic_ticks(double low, double high) {
  const int first = static_cast<int>(std::floor(std::log10(low))), last = static_cast<int>(std::ceil(std::log10(high)));
  const bool sparse = std::log10(high / low) < 3;
  std::vector<Tick> ticks;
  for (int power = first; power <= last; ++power) {
    for (const int factor : {1, 2, 5}) {
      const double value = factor * std::pow(10, power);
      if (value >= low && value <= high && (factor == 1 || sparse))
        ticks.push_back({value, fmt::format("{:g}", value)});
    }
  }
  return ticks;
}

void Field::axes(Svg& svg, const std::string& x_words, const std::string& y_words) const {
  constexpr double tick = 5;
  for (const Tick& t : linear_ticks(x.low, x.high, 8)) {
    svg.line({x(t.value), y.from}, {x(t.value), y.from + tick}, "#444444");
    svg.text({x(t.value), y.from + 20}, t.words, Anchor::middle);
  }
  for (const Tick& t : linear_ticks(y.low, y.high, 6)) {
    svg.line({x.from - tick, y(t.value)}, {x.from, y(t.value)}, "#444444");
    svg.text({x.from - 9, y(t.value) + 4.5}, t.words, Anchor::end);
  }
  svg.frame({x.from, y.to}, {x.to - x.from, y.from - y.to}, "#444444");
  svg.text({0.5 * (x.from + x.to), y.from + 42}, x_words, Anchor::middle);
  svg.text({x.from - 68, 0.5 * (y.from + y.to)}, y_words, Anchor::middle, true);
}

}  // namespace noli::report
