// SPDX-License-Identifier: Apache-2.0
#include "noli/audit/minimise_query.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace noli::audit {

namespace {

/// x with at most `bits` significant bits, cut off.
double cut(double x, int bits) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(std::trunc(std::ldexp(mantissa, bits)), exponent - bits);
}

class Minimiser {
 public:
  Minimiser(const AnyQuery& query, const std::function<bool(const AnyQuery&)>& fails, std::size_t budget)
      : query_(query), complexity_(complexity(query_)), fails_(fails), budget_(budget) {}

  AnyQuery run() {
    for (bool progress = true; progress && budget_ > 0;) {
      progress = scale_axes();
      progress |= merge_points();
      progress |= simplify_coordinates();
    }
    return query_;
  }

 private:
  bool accept(const AnyQuery& candidate) {
    const int simpler_by = complexity_ - complexity(candidate);
    if (simpler_by <= 0 || budget_ == 0) return false;
    --budget_;
    if (!fails_(candidate)) return false;
    query_ = candidate;
    complexity_ -= simpler_by;
    return true;
  }

  bool scale_axes() {
    bool progress = false;
    for (std::size_t axis = 0; axis < axes(); ++axis) {
      double greatest = 0;
      for (std::size_t i = 0; i < query_.size(); ++i) {
        greatest = std::max({greatest, std::abs(query_.x_t0[i][axis]), std::abs(query_.x_t1[i][axis])});
      }
      if (greatest > 0) progress |= scale_axis(axis, -std::ilogb(greatest));
    }
    return progress;
  }

  bool scale_axis(std::size_t axis, int exponent) {
    AnyQuery candidate = query_;
    for (std::size_t i = 0; i < query_.size(); ++i) {
      candidate.x_t0[i][axis] = std::ldexp(candidate.x_t0[i][axis], exponent);
      candidate.x_t1[i][axis] = std::ldexp(candidate.x_t1[i][axis], exponent);
    }
    return accept(candidate);
  }

  /// Points that stand still, and points equal to others.
  bool merge_points() {
    bool progress = false;
    for (std::size_t i = 0; i < query_.size(); ++i) {
      AnyQuery candidate = query_;
      candidate.x_t1[i] = candidate.x_t0[i];
      progress |= accept(candidate);
      for (std::size_t j = 0; j < query_.size(); ++j) {
        candidate = query_;
        candidate.x_t0[i] = candidate.x_t0[j];
        candidate.x_t1[i] = candidate.x_t1[j];
        progress |= accept(candidate);
      }
    }
    return progress;
  }

  bool simplify_coordinates() {
    bool progress = false;
    for (auto points : {&AnyQuery::x_t0, &AnyQuery::x_t1}) {
      for (std::size_t i = 0; i < query_.size(); ++i) {
        for (std::size_t axis = 0; axis < axes(); ++axis) progress |= simplify_coordinate(points, i, axis);
      }
    }
    return progress;
  }

  bool simplify_coordinate(std::array<Point3, 4> AnyQuery::*points, std::size_t i, std::size_t axis) {
    for (const double value : simpler_numbers((query_.*points)[i][axis])) {
      AnyQuery candidate = query_;
      (candidate.*points)[i][axis] = value;
      if (std::isfinite(value) && accept(candidate)) return true;
    }
    return false;
  }

  std::size_t axes() const { return static_cast<std::size_t>(query_.dimension); }

  AnyQuery query_;
  int complexity_;
  const std::function<bool(const AnyQuery&)>& fails_;
  std::size_t budget_;
};

}  // namespace

std::vector<double> simpler_numbers(double x) {
  std::vector<double> candidates = {0.0, 1.0, -1.0, std::abs(x), std::trunc(x), std::trunc(x / 2), x / 2, x * 2};
  for (const int bits : {1, 2, 3, 5, 8, 12, 16, 20, 26, 32, 40, 48, 52}) candidates.push_back(cut(x, bits));
  return candidates;
}

int complexity(double x) {
  if (x == 0) return std::signbit(x) ? 1 : 0;
  int exponent = 0;
  auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::abs(std::frexp(x, &exponent)), 53));
  int bits = 53;
  for (; mantissa % 2 == 0; mantissa /= 2) --bits;
  return 1 + bits + std::abs(exponent - 1) + (std::signbit(x) ? 1 : 0);
}

int complexity(const AnyQuery& query) {
  int sum = 0;
  for (std::size_t i = 0; i < query.size(); ++i) {
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(query.dimension); ++axis) {
      sum += complexity(query.x_t0[i][axis]) + complexity(query.x_t1[i][axis]);
    }
  }
  return sum;
}

AnyQuery minimise(const AnyQuery& query, const std::function<bool(const AnyQuery&)>& fails, std::size_t budget) {
  return Minimiser(query, fails, budget).run();
}

}  // namespace noli::audit
