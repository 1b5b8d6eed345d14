// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/cells/exact_direction.h"

#include <algorithm>

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

}  // namespace

std::optional<IntegerVector> exact_direction(const std::vector<IntegerVector>& differences, const Integer& least2) {
  using formula::operator-;
  const auto& d = differences;
  const Question question{d, least2};
  std::optional<IntegerVector> found;
  const auto take = [&](const IntegerVector& n) {
    if (separates(n, question)) found = shortened(n, question);
    return found.has_value();
  };
  for (const IntegerVector& w : d) {
    if (take(w)) return found;
  }
  for (std::size_t i = 0; i < d.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (take(across(d[i], d[j] - d[i]))) return found;
    }
  }
  for (std::size_t i = 0; i < d.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        const IntegerVector n = formula::cross(d[j] - d[i], d[k] - d[i]);
        if (take(n) || take({-n[0], -n[1], -n[2]})) return found;
      }
    }
  }
  return std::nullopt;
}

}  // namespace noli
