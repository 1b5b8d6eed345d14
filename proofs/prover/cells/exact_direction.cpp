// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/cells/exact_direction.h"

#include <algorithm>
#include <cmath>

#include "kernel/formula.h"

namespace noli {

namespace {

/// What a direction has to separate, and by how much.
struct Question {
  const std::vector<IntegerVector>& differences;
  const Integer& least2;
};

bool separates(const IntegerVector& n, const Question& question) {
  const Integer least = question.least2 * formula::dot(n, n);
  return std::all_of(question.differences.begin(), question.differences.end(), [&](const IntegerVector& w) {
    const Integer along = formula::dot(n, w);
    return along.sign() > 0 && (least.is_zero() || along * along > least);
  });
}

/// n rounded to this many bits in its longest component.
IntegerVector rounded(const IntegerVector& n, std::size_t bits) {
  std::size_t most = 0;
  for (const Integer& part : n) most = std::max(most, part.bit_length());
  if (most <= bits) return n;
  const std::size_t drop = most - bits;
  IntegerVector result = n;
  for (Integer& part : result) {
    part += Integer(1) << (drop - 1);
    part >>= drop;
  }
  return result;
}

/// The direction with the fewest bits, of some numbers to try, that still separates; nothing if it needs more bits than
/// a proof allows.
std::optional<IntegerVector> shortened(const IntegerVector& n, const Question& question) {
  constexpr std::array<std::size_t, 14> tried = {9,   15,  22,  30,   40,   60,   90,
                                                 130, 200, 400, 1000, 2400, 5000, most_direction_bits};
  for (const std::size_t bits : tried) {
    IntegerVector shorter = rounded(n, bits);
    if (separates(shorter, question)) return shorter;
  }
  return std::nullopt;
}

/// The vector from the origin to the line through w along u, times |u|^2.
IntegerVector across(const IntegerVector& w, const IntegerVector& u) {
  const Integer uu = formula::dot(u, u), wu = formula::dot(w, u);
  return {w[0] * uu - u[0] * wu, w[1] * uu - u[1] * wu, w[2] * uu - u[2] * wu};
}

/// A vector in doubles, times a power of two of its own: its longest component is in [1/2, 1), and each is off by less
/// than 2^-51.
using Rounded = std::array<double, 3>;

Rounded in_doubles(const IntegerVector& v) {
  Rounded result{};
  std::array<long, 3> exponents{};
  long greatest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = mpz_get_d_2exp(&exponents[k], v[k].get());
    if (result[k] != 0) greatest = std::max(greatest, exponents[k]);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = std::ldexp(result[k], static_cast<int>(std::max(exponents[k] - greatest, -2000L)));
  }
  return result;
}

double dot(const Rounded& a, const Rounded& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Rules out directions before exact arithmetic looks at them. Of the integers, which have hundreds of bits, it takes
/// the differences exactly, and rounds only then: all components are at most 1, so the terms of the few sums and
/// products below are at most 18, and their errors add up to less than 2^-43.
class RoundedSearch {
 public:
  explicit RoundedSearch(const std::vector<IntegerVector>& differences) {
    for (const IntegerVector& w : differences) w_.push_back(in_doubles(w));
  }

  /// Whether the exact direction, a positive multiple of n up to rounding, has a difference behind it for certain.
  bool fails(const Rounded& n) const {
    return std::any_of(w_.begin(), w_.end(), [&n](const Rounded& w) { return dot(n, w) < -0x1p-40; });
  }

  bool point_fails(std::size_t i) const { return fails(w_[i]); }

  /// across() of point i and u.
  bool line_fails(std::size_t i, const Rounded& u) const {
    const Rounded& w = w_[i];
    const double uu = dot(u, u), wu = dot(w, u);
    return fails({w[0] * uu - u[0] * wu, w[1] * uu - u[1] * wu, w[2] * uu - u[2] * wu});
  }

 private:
  std::vector<Rounded> w_;
};

Rounded cross(const Rounded& u, const Rounded& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

Rounded negative(const Rounded& n) { return {-n[0], -n[1], -n[2]}; }

}  // namespace

std::optional<IntegerVector> exact_direction(const std::vector<IntegerVector>& differences, const Integer& least2) {
  using formula::operator-;
  const auto& d = differences;
  const Question question{d, least2};
  const RoundedSearch rounded_search(d);
  std::optional<IntegerVector> found;
  const auto take = [&](const IntegerVector& n) {
    if (separates(n, question)) found = shortened(n, question);
    return found.has_value();
  };
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (!rounded_search.point_fails(i) && take(d[i])) return found;
  }
  // u[i (i - 1) / 2 + j], j < i: from point i to point j.
  std::vector<Rounded> u;
  for (std::size_t i = 0; i < d.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const IntegerVector along = d[j] - d[i];
      u.push_back(in_doubles(along));
      if (!rounded_search.line_fails(i, u.back()) && take(across(d[i], along))) return found;
    }
  }
  for (std::size_t i = 0; i < d.size(); ++i) {
    const Rounded* const from = u.data() + (i > 0 ? i * (i - 1) / 2 : 0);
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        const Rounded n = cross(from[j], from[k]);
        const bool forward = !rounded_search.fails(n), backward = !rounded_search.fails(negative(n));
        if (!forward && !backward) continue;
        const IntegerVector exact = formula::cross(d[j] - d[i], d[k] - d[i]);
        if (forward && take(exact)) return found;
        if (backward && take({-exact[0], -exact[1], -exact[2]})) return found;
      }
    }
  }
  return std::nullopt;
}

}  // namespace noli
