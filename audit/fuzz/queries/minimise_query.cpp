// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/minimise_query.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

namespace noli::audit {

namespace {

/// What a different number costs, in the unit of `complexity`: as much as a number of a dozen bits.
constexpr int price_of_a_number = 12;

template <class Query, class Function>
void for_each_coordinate(Query& query, const Function& function) {
  for (auto* points : {&query.x_t0, &query.x_t1}) {
    for (std::size_t i = 0; i < query.size(); ++i) {
      for (std::size_t axis = 0; axis < static_cast<std::size_t>(query.dimension); ++axis) function((*points)[i][axis]);
    }
  }
}

/// The different numbers of a query, the simplest first.
std::vector<double> numbers(const AnyQuery& query) {
  std::vector<double> result;
  for_each_coordinate(query, [&](double x) { result.push_back(x == 0 ? 0.0 : x); });
  const auto simpler = [](double a, double b) { return std::pair(complexity(a), a) < std::pair(complexity(b), b); };
  std::sort(result.begin(), result.end(), simpler);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

int cost(const AnyQuery& query) {
  return complexity(query) + price_of_a_number * static_cast<int>(distinct_coordinates(query));
}

/// x with at most `bits` significant bits, cut off.
double cut(double x, int bits) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(std::trunc(std::ldexp(mantissa, bits)), exponent - bits);
}

class Minimiser {
 public:
  Minimiser(const AnyQuery& query, const FirstFailure& first_failure, std::size_t budget)
      : query_(query), cost_(cost(query_)), first_failure_(first_failure), budget_(budget) {}

  AnyQuery run() {
    for (bool progress = true; progress && budget_ > 0;) {
      progress = flatten_axes();
      progress |= scale_axes();
      progress |= cut_the_step();
      progress |= merge_points();
      progress |= move_axes();
      progress |= shear_axes();
      progress |= slide_points();
      progress |= replace_numbers();
      progress |= stop_along_axes();
      progress |= simplify_coordinates();
      if (!progress) progress = simplify_pairs();
    }
    return query_;
  }

 private:
  /// Takes the first of the candidates that is simpler and fails.
  bool accept_one(const std::vector<AnyQuery>& candidates) {
    std::vector<AnyQuery> worth_it;
    for (const AnyQuery& candidate : candidates) {
      if (worth_it.size() < budget_ && is_finite(candidate) && cost(candidate) < cost_) worth_it.push_back(candidate);
    }
    if (worth_it.empty()) return false;
    const auto found = first_failure_(worth_it);
    budget_ -= found ? *found + 1 : worth_it.size();
    if (!found) return false;
    query_ = worth_it[*found];
    cost_ = cost(query_);
    return true;
  }

  static bool is_finite(const AnyQuery& query) {
    bool finite = true;
    for_each_coordinate(query, [&](double x) { finite = finite && std::isfinite(x); });
    return finite;
  }

  /// A copy in which `change` has been applied to each point, at both ends of the step.
  template <class Change>
  AnyQuery with_points(const Change& change) const {
    AnyQuery candidate = query_;
    for (std::size_t i = 0; i < query_.size(); ++i) {
      change(candidate.x_t0[i]);
      change(candidate.x_t1[i]);
    }
    return candidate;
  }

  /// All in a plane, or on a line.
  bool flatten_axes() {
    std::vector<AnyQuery> candidates;
    for (std::size_t axis = 0; axis < axes(); ++axis) {
      candidates.push_back(with_points([&](Point3& x) { x[axis] = 0; }));
    }
    return accept_one(candidates);
  }

  /// Only the first or the last half of the step.
  bool cut_the_step() {
    std::vector<AnyQuery> candidates(2, query_);
    for (std::size_t i = 0; i < query_.size(); ++i) {
      for (std::size_t axis = 0; axis < axes(); ++axis) {
        const double middle = query_.x_t0[i][axis] / 2 + query_.x_t1[i][axis] / 2;
        candidates[0].x_t1[i][axis] = candidates[1].x_t0[i][axis] = middle;
      }
    }
    return accept_one(candidates);
  }

  /// A coordinate of a point that is the same throughout.
  bool stop_along_axes() {
    bool progress = false;
    for (std::size_t i = 0; i < query_.size(); ++i) {
      for (std::size_t axis = 0; axis < axes(); ++axis) {
        std::vector<double> values = numbers(query_);
        values.insert(values.begin(), {0, 1, -1});
        std::vector<AnyQuery> candidates(values.size(), query_);
        for (std::size_t k = 0; k < values.size(); ++k) {
          candidates[k].x_t0[i][axis] = candidates[k].x_t1[i][axis] = values[k];
        }
        progress |= accept_one(candidates);
      }
    }
    return progress;
  }

  bool scale_axes() {
    bool progress = false;
    for (std::size_t axis = 0; axis < axes(); ++axis) {
      double greatest = 0;
      with_points([&](Point3& x) { greatest = std::max(greatest, std::abs(x[axis])); });
      if (!(greatest > 0)) continue;
      const int exponent = -std::ilogb(greatest);
      progress |= accept_one({with_points([&](Point3& x) { x[axis] = std::ldexp(x[axis], exponent); })});
    }
    return progress;
  }

  /// Points that stand still, and points equal to others.
  bool merge_points() {
    bool progress = false;
    for (std::size_t i = 0; i < query_.size(); ++i) {
      std::vector<AnyQuery> candidates(1 + query_.size(), query_);
      for (std::size_t axis = 0; axis < axes(); ++axis) {
        candidates[0].x_t1[i][axis] = query_.x_t0[i][axis];
        for (std::size_t j = 0; j < query_.size(); ++j) {
          candidates[1 + j].x_t0[i][axis] = query_.x_t0[j][axis];
          candidates[1 + j].x_t1[i][axis] = query_.x_t1[j][axis];
        }
      }
      progress |= accept_one(candidates);
    }
    return progress;
  }

  /// The origin where a point is, throughout or at the end only.
  bool move_axes() {
    bool progress = false;
    for (std::size_t axis = 0; axis < axes(); ++axis) {
      std::vector<AnyQuery> candidates;
      for (std::size_t i = 0; i < query_.size(); ++i) {
        for (const double by : {query_.x_t0[i][axis], query_.x_t1[i][axis]}) {
          candidates.push_back(with_points([&](Point3& x) { x[axis] -= by; }));
          candidates.push_back(query_);
          for (std::size_t j = 0; j < query_.size(); ++j) candidates.back().x_t1[j][axis] -= by;
        }
      }
      progress |= accept_one(candidates);
    }
    return progress;
  }

  bool shear_axes() {
    std::vector<AnyQuery> candidates;
    for (std::size_t to = 0; to < axes(); ++to) {
      for (std::size_t from = 0; from < axes(); ++from) {
        for (const double by : {1.0, -1.0, 2.0, -2.0, 0.5, -0.5}) {
          if (from != to) candidates.push_back(with_points([&](Point3& x) { x[to] += by * x[from]; }));
        }
      }
    }
    return accept_one(candidates);
  }

  /// A point along the difference of two others, throughout: that changes no volume, so coplanar points stay coplanar
  /// and multiple roots stay multiple.
  bool slide_points() {
    bool progress = false;
    for (std::size_t i = 0; i < query_.size(); ++i) {
      std::vector<AnyQuery> candidates;
      for (std::size_t j = 0; j < query_.size(); ++j) {
        for (std::size_t k = 0; k < j; ++k) {
          for (const double by : {1.0, -1.0, 2.0, -2.0, 0.5, -0.5}) {
            if (i != j && i != k) candidates.push_back(with_point_moved(i, j, k, by));
          }
        }
      }
      progress |= accept_one(candidates);
    }
    return progress;
  }

  AnyQuery with_point_moved(std::size_t i, std::size_t j, std::size_t k, double by) const {
    AnyQuery candidate = query_;
    for (std::size_t axis = 0; axis < axes(); ++axis) {
      candidate.x_t0[i][axis] += by * (query_.x_t0[j][axis] - query_.x_t0[k][axis]);
      candidate.x_t1[i][axis] += by * (query_.x_t1[j][axis] - query_.x_t1[k][axis]);
    }
    return candidate;
  }

  /// Everywhere at once, by another number that is there, or by a simpler one.
  bool replace_numbers() {
    bool progress = false;
    const std::vector<double> all = numbers(query_);
    for (auto x = all.rbegin(); x != all.rend(); ++x) {
      std::vector<double> values = simpler_numbers(*x);
      values.insert(values.begin(), all.begin(), all.end());
      std::vector<AnyQuery> candidates;
      for (const double value : values) {
        candidates.push_back(query_);
        for_each_coordinate(candidates.back(), [&](double& y) { y = y == *x ? value : y; });
      }
      progress |= accept_one(candidates);
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
    std::vector<double> values = simpler_numbers((query_.*points)[i][axis]);
    const std::vector<double> others = numbers(query_);
    values.insert(values.end(), others.begin(), others.end());
    std::vector<AnyQuery> candidates(values.size(), query_);
    for (std::size_t k = 0; k < values.size(); ++k) (candidates[k].*points)[i][axis] = values[k];
    return accept_one(candidates);
  }

  /// Two coordinates at a time: for what hangs on a relation between numbers, such as a double root.
  bool simplify_pairs() {
    std::vector<double*> places;
    AnyQuery changed = query_;
    for_each_coordinate(changed, [&](double& x) { places.push_back(&x); });
    std::vector<AnyQuery> candidates;
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double first = *places[i], second = *places[j];
        for (const auto& [a, b] : {std::pair(0.0, 0.0), {0.0, 1.0}, {1.0, 0.0}, {1.0, 1.0}}) {
          *places[i] = a;
          *places[j] = b;
          candidates.push_back(changed);
        }
        *places[i] = first;
        *places[j] = second;
      }
    }
    return accept_one(candidates);
  }

  std::size_t axes() const { return static_cast<std::size_t>(query_.dimension); }

  AnyQuery query_;
  int cost_;
  const FirstFailure& first_failure_;
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
  for_each_coordinate(query, [&](double x) { sum += complexity(x); });
  return sum;
}

std::size_t distinct_coordinates(const AnyQuery& query) { return numbers(query).size(); }

AnyQuery minimise(const AnyQuery& query, const FirstFailure& first_failure, std::size_t budget) {
  return Minimiser(query, first_failure, budget).run();
}

AnyQuery minimise(const AnyQuery& query, const std::function<bool(const AnyQuery&)>& fails, std::size_t budget) {
  const FirstFailure one_by_one = [&](std::span<const AnyQuery> candidates) -> std::optional<std::size_t> {
    const auto found = std::find_if(candidates.begin(), candidates.end(), fails);
    if (found == candidates.end()) return std::nullopt;
    return static_cast<std::size_t>(found - candidates.begin());
  };
  return minimise(query, one_by_one, budget);
}

}  // namespace noli::audit
