// SPDX-License-Identifier: Apache-2.0
//
// Decides contact on Bernstein coefficients, with subdivision: for a coplanarity polynomial and its insides
// (formula.h).
//
// Notation
//   f                 the coplanarity polynomial, of degree n
//   g_k               the insides, of degree 2 (1 in the plane). All polynomials are in the Bernstein basis of a piece
//                     of the step, up to one positive factor per polynomial
//   certain sign      of a number: +1, -1, or 0 for "not known"
// On a piece, by the convex hull property of the coefficients:
//   no contact  when all coefficients of f have one certain sign, or when some g_j is certainly positive and some g_k
//               certainly negative throughout
//   contact     when all g_k have the same certain sign throughout and f has certain, opposite signs at the two ends
// When f certainly has exactly one root in the piece (Descartes), a few Newton steps shrink the piece to a sliver
// around it on which the g_k are judged; otherwise the piece is split where f seems to have its extremum.
//
// It never decides that f is zero somewhere without changing sign, nor that a contact lies on the border of a feature.
// Such queries come out as `unknown`. Newton's method only proposes; the signs at the ends decide.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>

#include <noli/contact.h>

namespace noli::bernstein {

enum class Verdict { apart, contact, unknown };

/// A piece [begin, begin + width] of the step and the polynomials on it. g_sign: the certain sign of g_k on the whole
/// piece, if known; the coefficients of such a g_k are no longer kept up to date.
template <class T, std::size_t Degree, std::size_t Insides, std::size_t InsideDegree>
struct Piece {
  using Number = T;
  static constexpr std::size_t insides = Insides;
  std::array<T, Degree + 1> f;
  std::array<std::array<T, InsideDegree + 1>, Insides> g;
  std::array<int, Insides> g_sign{};
  double begin = 0;
  double width = 1;
};

/// Bernstein coefficients from a form (formula.h), times a common positive factor.
template <class T, std::size_t N>
std::array<T, N> scaled_coefficients(std::array<T, N> form) {
  if constexpr (N > 2) {
    form.front() = form.front() * T(double(N - 1));
    form.back() = form.back() * T(double(N - 1));
  }
  return form;
}

/// de Casteljau at x: `right` enters as the coefficients on [0, 1] and leaves as those on [x, 1]; returns those on [0,
/// x].
template <class T, std::size_t N>
std::array<T, N> split_at(std::array<T, N>& right, const T& x) {
  const T y = T(1) - x;
  std::array<T, N> left;
  left[0] = right[0];
  for (std::size_t level = 1; level < N; ++level) {
    for (std::size_t i = 0; i + level < N; ++i) right[i] = right[i] * y + right[i + 1] * x;
    left[level] = right[0];
  }
  return left;
}

/// de Casteljau's value at x. Written out: as a loop over an array it is several times slower.
template <class T>
T value_at(const std::array<T, 3>& c, const T& x) {
  const T y = T(1) - x;
  const T p0 = c[0] * y + c[1] * x, p1 = c[1] * y + c[2] * x;
  return p0 * y + p1 * x;
}

template <class T>
T value_at(const std::array<T, 4>& c, const T& x) {
  const T y = T(1) - x;
  const T p0 = c[0] * y + c[1] * x, p1 = c[1] * y + c[2] * x, p2 = c[2] * y + c[3] * x;
  const T q0 = p0 * y + p1 * x, q1 = p1 * y + p2 * x;
  return q0 * y + q1 * x;
}

/// About where a polynomial of degree 2 or 3 has its extremum in (0, 1), as a multiple of 1/64 away from the ends.
template <std::size_t N>
double proposed_split(const std::array<double, N>& c) {
  double x = 0.5;
  if constexpr (N == 3) {
    x = (c[1] - c[0]) / ((c[1] - c[0]) - (c[2] - c[1]));
  } else if constexpr (N == 4) {
    const double d0 = c[1] - c[0], d1 = c[2] - c[1], d2 = c[3] - c[2];
    if (d0 * d2 < 0) x = d0 / (d0 - d1 + std::copysign(std::sqrt(d1 * d1 - d0 * d2), d0));
  }
  if (!(x > 0.0625)) return 0.0625;  // also when x is not a number
  if (x > 0.9375) return 0.9375;
  return std::floor(x * 64) * 0x1p-6;
}

struct ProposedRoot {
  double x;
  double slope;  ///< |derivative| near x
};

/// An approximate root in (0, 1); c has opposite signs at the ends. Takes a few safeguarded Newton steps: once one is
/// shorter than 2^-17, the remaining error is about its square.
template <std::size_t N>
ProposedRoot proposed_root(const std::array<double, N>& c) {
  std::array<double, N> a;  // power basis
  if constexpr (N == 4) {
    a = {c[0], 3 * (c[1] - c[0]), 3 * ((c[2] - c[1]) - (c[1] - c[0])),
         (c[3] - c[2]) - 2 * (c[2] - c[1]) + (c[1] - c[0])};
  } else {
    a = {c[0], 2 * (c[1] - c[0]), (c[2] - c[1]) - (c[1] - c[0])};
  }
  double low = 0, high = 1;
  double x = c.front() / (c.front() - c.back());
  double derivative = 0;
  for (int step = 0; step < 16; ++step) {
    double value = a[N - 1];
    derivative = 0;
    for (std::size_t i = N - 1; i-- > 0;) {
      derivative = derivative * x + value;
      value = value * x + a[i];
    }
    ((value < 0) == (c.front() < 0) ? low : high) = x;
    double next = x - value / derivative;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    const double change = std::abs(next - x);
    x = next;
    if (change < 0x1p-17) break;
  }
  return {x, std::abs(derivative)};
}

/// The search. Signs knows how certain the sign of a number is; it provides
///   int f(T), int g(k, T)               the certain sign of a coefficient, or 0
///   int f_value(T)                      the same for a value computed by value_at
///   int g_on(k, coefficients, low, high)  the certain sign of g_k on all of [low, high], or 0
///   double center(T)                    any double in the range of the number
///   double f_noise()                    about how large a value of f must be for a certain sign
///   Signs finer()                       the signs on a part of the piece, with the rounding of one more subdivision
template <class Piece, class Signs>
class Search {
 public:
  using T = typename Piece::Number;

  Verdict run(Piece piece, const Signs& signs, int depth) {
    switch (judge(piece, signs)) {
      case Judgement::apart: return Verdict::apart;
      case Judgement::contact: return found(piece.begin, piece.begin + piece.width);
      case Judgement::one_root: return judge_root(piece, signs);
      case Judgement::hopeless: return lost(piece);
      case Judgement::open: break;
    }
    if (depth == 0) return lost(piece);
    const Signs finer = signs.finer();
    const Piece left = split_off_left(piece, proposed_split(centers(piece.f, signs)));
    const Verdict before = run(left, finer, depth - 1);
    if (before == Verdict::contact) return before;
    const Verdict after = run(piece, finer, depth - 1);
    return after == Verdict::apart ? before : after;
  }

  /// After a contact: an interval that contains the first one.
  TimeEnclosure enclosure() const { return enclosure_; }

 private:
  enum class Judgement { apart, contact, one_root, hopeless, open };

  template <std::size_t N>
  static std::array<double, N> centers(const std::array<T, N>& c, const Signs& signs) {
    std::array<double, N> result;
    for (std::size_t i = 0; i < N; ++i) result[i] = signs.center(c[i]);
    return result;
  }

  static Piece split_off_left(Piece& piece, double x) {
    Piece left = piece;
    left.f = split_at(piece.f, T(x));
    for (std::size_t k = 0; k < Piece::insides; ++k) {
      if (piece.g_sign[k] == 0) left.g[k] = split_at(piece.g[k], T(x));
    }
    left.width = piece.width * x;  // exact: x is a multiple of 1/64, and the depth is bounded
    piece.begin += left.width;
    piece.width -= left.width;
    return left;
  }

  /// The signs of the insides on the whole piece. inside_signs() also fills in those that have become certain.
  struct SignSummary {
    bool positive = false, negative = false, open = false;

    void add(int sign) {
      positive |= sign > 0;
      negative |= sign < 0;
      open |= sign == 0;
    }
    bool disagree() const { return positive && negative; }
    bool agree() const { return !open && positive != negative; }
  };

  static SignSummary inside_signs(Piece& piece, const Signs& signs) {
    SignSummary result;
    for (std::size_t k = 0; k < Piece::insides; ++k) {
      if (piece.g_sign[k] == 0) piece.g_sign[k] = common_sign(piece.g[k], [&](const T& x) { return signs.g(k, x); });
      result.add(piece.g_sign[k]);
    }
    return result;
  }

  template <std::size_t N, class SignOf>
  static int common_sign(const std::array<T, N>& c, SignOf&& sign_of) {
    int sum = 0;
    for (const T& x : c) sum += sign_of(x);
    constexpr int all = static_cast<int>(N);
    return (sum == all) - (sum == -all);
  }

  Judgement judge(Piece& piece, const Signs& signs) const {
    constexpr std::size_t n = std::tuple_size_v<decltype(piece.f)>;
    std::array<int, n> sign;
    for (std::size_t i = 0; i < n; ++i) sign[i] = signs.f(piece.f[i]);
    if (common_sign(piece.f, [&](const T& x) { return signs.f(x); }) != 0) return Judgement::apart;
    const SignSummary insides = inside_signs(piece, signs);
    if (insides.disagree()) return Judgement::apart;
    if (sign.front() * sign.back() >= 0) return sign == std::array<int, n>{} ? Judgement::hopeless : Judgement::open;
    const bool one = n == 3 || sign[1] == sign.front() || sign[n - 2] == sign.back();
    if (one) return Judgement::one_root;
    return insides.agree() ? Judgement::contact : Judgement::open;
  }

  /// f certainly has one root in the piece, and certainly changes sign.
  Verdict judge_root(const Piece& piece, const Signs& signs) {
    const ProposedRoot root = proposed_root(centers(piece.f, signs));
    double reach = std::max(0x1p-32, 4 * signs.f_noise() / root.slope);
    for (int attempt = 0; attempt < 3; ++attempt, reach *= 16) {
      const double low = std::max(0.0, root.x - reach), high = std::min(1.0, root.x + reach);
      if (!(high - low < 0.25)) break;
      if (signs.f_value(value_at(piece.f, T(low))) * signs.f_value(value_at(piece.f, T(high))) >= 0) continue;
      return judge_sliver(piece, signs, low, high);
    }
    return lost(piece);
  }

  /// The one root of f in the piece is between low and high.
  Verdict judge_sliver(const Piece& piece, const Signs& signs, double low, double high) {
    SignSummary insides;
    for (std::size_t k = 0; k < Piece::insides; ++k) {
      insides.add(piece.g_sign[k] != 0 ? piece.g_sign[k] : signs.g_on(k, piece.g[k], low, high));
    }
    if (insides.disagree()) return Verdict::apart;
    if (!insides.agree()) return lost(piece);
    constexpr double outward = 0x1p-50;  // above the rounding of the two products and sums, which stay in [0, 1]
    return found(std::max(0.0, piece.begin + piece.width * low - outward),
                 std::min(1.0, piece.begin + piece.width * high + outward));
  }

  Verdict found(double begin, double end) {
    enclosure_ = {std::min(first_lost_, begin), end};
    return Verdict::contact;
  }

  Verdict lost(const Piece& piece) {
    first_lost_ = std::min(first_lost_, piece.begin);
    return Verdict::unknown;
  }

  double first_lost_ = 1;
  TimeEnclosure enclosure_;
};

}  // namespace noli::bernstein
