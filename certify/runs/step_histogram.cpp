// SPDX-License-Identifier: Apache-2.0
#include "certify/runs/step_histogram.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace noli {
namespace {

constexpr std::size_t bin_count = 4 * 2048 + 1;

/// The place of a step's bin, counted from 0: bin b is at b - least_step_bin.
std::size_t place_of(double step) {
  // The leading digits of 2^(1/8), 2^(3/8), 2^(5/8), 2^(7/8).
  constexpr std::array<double, 4> ends = {0x1.172b83c7d517bp+0, 0x1.4bfdad5362a27p+0, 0x1.8ace5422aa0dbp+0,
                                          0x1.d5818dcfba487p+0};
  const auto bits = std::bit_cast<std::uint64_t>(step);
  const auto leading = std::bit_cast<double>((bits & 0x000fffffffffffff) | 0x3ff0000000000000);
  std::size_t place = 4 * (bits >> 52);
  for (const double end : ends) place += leading >= end ? 1 : 0;
  return place;
}

}  // namespace

std::int64_t step_bin(double step) { return static_cast<std::int64_t>(place_of(step)) + least_step_bin; }

double bin_begin(std::int64_t bin) {
  return std::min(std::exp2((2 * static_cast<double>(bin) - 1) / 8), std::numeric_limits<double>::max());
}

std::uint64_t StepHistogram::ticks() const {
  std::uint64_t sum = 0;
  for (const Bin& bin : bins) sum += bin.ticks;
  return sum;
}

void StepHistogram::add(const StepHistogram& other) {
  if (other.bins.empty()) return;
  smallest = bins.empty() ? other.smallest : std::min(smallest, other.smallest);
  std::vector<Bin> sum;
  auto a = bins.begin();
  auto b = other.bins.begin();
  while (a != bins.end() || b != other.bins.end()) {
    if (b == other.bins.end() || (a != bins.end() && a->number < b->number)) {
      sum.push_back(*a++);
    } else if (a == bins.end() || b->number < a->number) {
      sum.push_back(*b++);
    } else {
      sum.push_back({a->number, a->ticks + b->ticks});
      ++a, ++b;
    }
  }
  bins = std::move(sum);
}

double StepHistogram::quantile(double share) const {
  const double wanted = share * static_cast<double>(ticks());
  double below = 0;
  for (const Bin& bin : bins) {
    const double here = static_cast<double>(bin.ticks);
    if (below + here >= wanted) return bin_begin(bin.number) * std::exp2(0.25 * (wanted - below) / here);
    below += here;
  }
  return bin_begin(bins.back().number + 1);
}

StepHistogram step_histogram(const WorldLines& lines, std::span<const std::uint8_t> fixed) {
  const double begin = lines.first_time(), end = lines.last_time(), scale = 0x1p32 / (end - begin);
  // Maps the window's times to ticks: 0 at its begin, 2^32 at its end.
  const auto ticks = [begin, end, scale](double t) {
    return t == end ? std::uint64_t{1} << 32 : static_cast<std::uint64_t>(std::min((t - begin) * scale, 0x1p32));
  };
  std::vector<std::uint64_t> counts(bin_count, 0);
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < lines.vertex_count(); ++v) {
    if (fixed[v] != 0) continue;
    const auto times = lines.times(static_cast<VertexId>(v));
    std::uint64_t last = 0;
    for (std::size_t k = 1; k < times.size(); ++k) {
      const double step = times[k] - times[k - 1];
      const std::uint64_t now = ticks(times[k]);
      counts[place_of(step)] += now - last;
      smallest = std::min(smallest, step);
      last = now;
    }
  }
  StepHistogram result;
  for (std::size_t place = 0; place < counts.size(); ++place) {
    if (counts[place] > 0) result.bins.push_back({static_cast<std::int64_t>(place) + least_step_bin, counts[place]});
  }
  if (!result.bins.empty()) result.smallest = smallest;
  return result;
}

}  // namespace noli
