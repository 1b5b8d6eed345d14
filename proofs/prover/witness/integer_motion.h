// SPDX-License-Identifier: Apache-2.0
//
// The motion of a step in integers, for witnesses.
//
// Notation
//   integer time   time in the step's units of 2^q (proofs/FORMAT.md, STEP)
//   segment        of a vertex, between two breakpoints
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "kernel/motion_points.h"
#include "proofs/prover/tokens/proof_file.h"
#include "proofs/prover/witness/dependency.h"
#include "trajectory/world_lines.h"

namespace noli::witness {

/// The step in integers: time in units of 2^q, with `first_bits` more bits for times in between.
class IntegerMotion {
 public:
  static constexpr std::size_t first_bits = 64;

  /// `shift`: added to all times, exactly; `eta`: a length that must be an integer too.
  IntegerMotion(const WorldLines& lines, double shift, int dimension, double eta)
      : lines_(lines),
        shift_(shift),
        dimension_(static_cast<std::size_t>(dimension)),
        scale_(units_of(lines, dimension, shift, eta)) {}

  std::size_t dimension() const { return dimension_; }
  const WorldLines& lines() const { return lines_; }
  /// A length in the common unit of coordinates.
  Integer length(double x) const { return scale_.integer_place(x); }
  /// A time of a breakpoint.
  Integer time(double t) const { return scale_.integer_time(t + shift_); }
  /// Any time of the lines, times 2^first_bits; rounded down or up.
  Integer fraction(double t, bool up) const {
    const Dyadic exact =
        ldexp(Dyadic::from_double(t) + Dyadic::from_double(shift_), static_cast<int>(first_bits) - scale_.time.low);
    return up ? -rounded_down({-exact.m, exact.e}) : rounded_down(exact);
  }

  static Integer rounded_down(Dyadic x) { return std::move(x.m >>= x.e); }

 private:
  const WorldLines& lines_;
  double shift_;
  std::size_t dimension_;
  motion::Scale scale_;
};

/// Some vertices from a time on, each on the segment that begins there or contains it; at the end of the step they
/// rest. All positions are multiplied by one number that makes them integers.
class Segments {
 public:
  Segments(const IntegerMotion& motion, std::span<const VertexId> vertices, const Integer& from, std::size_t e) {
    for (const VertexId v : vertices) {
      const auto times = motion.lines().times(v);
      const auto positions = motion.lines().positions(v);
      std::size_t low = 0;
      for (std::size_t high = times.size(); high - low > 1;) {
        const std::size_t middle = (low + high) / 2;
        (motion.time(times[middle]) << e <= from ? low : high) = middle;
      }
      const bool rests = low + 1 == times.size();
      Segment s{v, motion.time(times[low]), {}, {}, {}};
      s.t1 = rests ? s.t0 + Integer(1) : motion.time(times[low + 1]);
      for (std::size_t k = 0; k < motion.dimension(); ++k) {
        s.x0[k] = motion.length(positions[low][k]);
        s.x1[k] = motion.length(positions[rests ? low : low + 1][k]);
      }
      scale_ = motion::common_multiple(scale_, s.t1 - s.t0);
      segments_.push_back(std::move(s));
    }
  }

  const Integer& scale() const { return scale_; }
  /// The position of a vertex, in integer time.
  PolynomialPosition position(VertexId v) const {
    const Segment& s = of(v);
    const Integer factor = divide_exactly(scale_, s.t1 - s.t0);
    PolynomialPosition x;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = Polynomial({factor * (s.x0[k] * s.t1 - s.x1[k] * s.t0), factor * (s.x1[k] - s.x0[k])});
    }
    return x;
  }
  /// The position at the time at / 2^e, times 2^e.
  std::array<Integer, 3> position_at(VertexId v, const Integer& at, std::size_t e) const {
    const Segment& s = of(v);
    const Integer factor = divide_exactly(scale_, s.t1 - s.t0);
    std::array<Integer, 3> x;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = factor * (s.x0[k] * ((s.t1 << e) - at) + s.x1[k] * (at - (s.t0 << e)));
    }
    return x;
  }

 private:
  struct Segment {
    VertexId v;
    Integer t0, t1;
    std::array<Integer, 3> x0, x1;
  };
  const Segment& of(VertexId v) const { return *std::ranges::find(segments_, v, &Segment::v); }

  std::vector<Segment> segments_;
  Integer scale_{1};
};

}  // namespace noli::witness
