// SPDX-License-Identifier: Apache-2.0
//
// The motion of a step in integers, for witnesses.
//
// Notation
//   integer time   time in units of 2^q, the step's (proofs/FORMAT.md, STEP)
//   segment        of a vertex, between two breakpoints
//
// What this does not do: it is not fast.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "kernel/arithmetic/scaled_integers.h"
#include "proofs/prover/witness/polynomials.h"
#include "trajectory/world_lines.h"

namespace noli::witness {

using PolyVector = std::array<Poly, 3>;

/// The step in integers: time in units of 2^q, of which `first_bits` more are taken for times between them.
class IntegerMotion {
 public:
  static constexpr unsigned long first_bits = 64;

  /// `shift`: added to all times, exactly; `eta`: a length that is to be an integer too.
  IntegerMotion(const WorldLines& lines, double shift, int dimension, double eta)
      : lines_(lines), shift_(shift), dimension_(static_cast<std::size_t>(dimension)) {
    exact::ExponentRange space, time;
    for (VertexId v = 0; v < lines.vertex_count(); ++v) {
      for (const double t : lines.times(v)) time.add(t + shift);
      for (const Position& p : lines.positions(v)) {
        for (std::size_t k = 0; k < dimension_; ++k) space.add(p[k]);
      }
    }
    space.add(eta);
    space_ = space.high < space.low ? 0 : space.low;
    time_ = time.high < time.low ? 0 : time.low;
  }

  std::size_t dimension() const { return dimension_; }
  const WorldLines& lines() const { return lines_; }
  /// A coordinate in the unit of all of them.
  mpz_class length(double x) const { return integer(x, space_); }
  /// A time of a breakpoint.
  mpz_class time(double t) const { return integer(t + shift_, time_); }
  /// Any time of the lines, times 2^first_bits; rounded down, or up.
  mpz_class fraction(double t, bool up) const {
    mpq_class exact(t);
    exact += mpq_class(shift_);
    const long bits = static_cast<long>(first_bits) - time_;
    exact *= bits >= 0 ? mpq_class(mpz_class(1) << static_cast<unsigned long>(bits))
                       : mpq_class(1, mpz_class(1) << static_cast<unsigned long>(-bits));
    mpz_class result;
    (up ? mpz_cdiv_q : mpz_fdiv_q)(result.get_mpz_t(), exact.get_num_mpz_t(), exact.get_den_mpz_t());
    return result;
  }

 private:
  static mpz_class integer(double x, int unit) {
    if (x == 0) return 0;
    const exact::OddBinary parts(x);
    return mpz_class(static_cast<long>(parts.mantissa)) << static_cast<unsigned long>(parts.exponent - unit);
  }

  const WorldLines& lines_;
  double shift_;
  std::size_t dimension_;
  int space_ = 0, time_ = 0;
};

/// Some vertices from a time on, each on the segment that begins there or has it within; at the end of the step they
/// rest. All positions are multiplied by the same number, which makes them integers.
class Segments {
 public:
  Segments(const IntegerMotion& motion, std::span<const VertexId> vertices, const mpz_class& from, unsigned long e) {
    for (const VertexId v : vertices) {
      const auto times = motion.lines().times(v);
      const auto positions = motion.lines().positions(v);
      std::size_t low = 0;
      for (std::size_t high = times.size(); high - low > 1;) {
        const std::size_t middle = (low + high) / 2;
        (motion.time(times[middle]) << e <= from ? low : high) = middle;
      }
      const bool rests = low + 1 == times.size();
      Segment s{v, motion.time(times[low]), 0, {}, {}};
      s.t1 = rests ? mpz_class(s.t0 + 1) : motion.time(times[low + 1]);
      for (std::size_t k = 0; k < motion.dimension(); ++k) {
        s.x0[k] = motion.length(positions[low][k]);
        s.x1[k] = motion.length(positions[rests ? low : low + 1][k]);
      }
      scale_ = lcm(scale_, mpz_class(s.t1 - s.t0));
      segments_.push_back(std::move(s));
    }
  }

  const mpz_class& scale() const { return scale_; }
  /// Of a vertex, in integer time.
  PolyVector position(VertexId v) const {
    const Segment& s = of(v);
    const mpz_class factor = scale_ / (s.t1 - s.t0);
    PolyVector x;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = trimmed({factor * (s.x0[k] * s.t1 - s.x1[k] * s.t0), factor * (s.x1[k] - s.x0[k])});
    }
    return x;
  }
  /// At the time at / 2^e, times 2^e.
  std::array<mpz_class, 3> position_at(VertexId v, const mpz_class& at, unsigned long e) const {
    const Segment& s = of(v);
    const mpz_class factor = scale_ / (s.t1 - s.t0);
    std::array<mpz_class, 3> x;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = factor * (s.x0[k] * ((s.t1 << e) - at) + s.x1[k] * (at - (s.t0 << e)));
    }
    return x;
  }

 private:
  struct Segment {
    VertexId v;
    mpz_class t0, t1;
    std::array<mpz_class, 3> x0, x1;
  };
  const Segment& of(VertexId v) const { return *std::ranges::find(segments_, v, &Segment::v); }

  std::vector<Segment> segments_;
  mpz_class scale_ = 1;
};

}  // namespace noli::witness
