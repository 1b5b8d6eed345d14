// SPDX-License-Identifier: Apache-2.0
//
// A number at both ends of the step, side by side in one register: the first stages treat both ends alike.
//
// Every operation is that of double on each of the two, so results do not depend on whether a machine has such
// registers. Comparisons with NaN are false, as for double; min and max of a NaN are unspecified.
#pragma once

#include <cmath>
#include <cstddef>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace noli {

#if defined(__SSE2__)

class BothEnds {
 public:
  BothEnds() = default;  ///< uninitialised
  BothEnds(double at_t0, double at_t1) : v_(_mm_set_pd(at_t1, at_t0)) {}
  explicit BothEnds(double at_both) : v_(_mm_set1_pd(at_both)) {}

  double at_t0() const { return _mm_cvtsd_f64(v_); }
  double at_t1() const { return _mm_cvtsd_f64(_mm_unpackhi_pd(v_, v_)); }

  BothEnds swapped() const { return BothEnds(_mm_shuffle_pd(v_, v_, 1)); }

  friend BothEnds operator+(BothEnds a, BothEnds b) { return BothEnds(_mm_add_pd(a.v_, b.v_)); }
  friend BothEnds operator-(BothEnds a, BothEnds b) { return BothEnds(_mm_sub_pd(a.v_, b.v_)); }
  friend BothEnds operator*(BothEnds a, BothEnds b) { return BothEnds(_mm_mul_pd(a.v_, b.v_)); }
  friend BothEnds min(BothEnds a, BothEnds b) { return BothEnds(_mm_min_pd(a.v_, b.v_)); }
  friend BothEnds max(BothEnds a, BothEnds b) { return BothEnds(_mm_max_pd(a.v_, b.v_)); }
  friend BothEnds abs(BothEnds a) { return BothEnds(_mm_andnot_pd(_mm_set1_pd(-0.0), a.v_)); }
  /// Whether a < b at both ends.
  friend bool below(BothEnds a, BothEnds b) { return _mm_movemask_pd(_mm_cmplt_pd(a.v_, b.v_)) == 3; }

 private:
  explicit BothEnds(__m128d v) : v_(v) {}
  __m128d v_;
};

#else

class BothEnds {
 public:
  BothEnds() = default;  ///< uninitialised
  BothEnds(double at_t0, double at_t1) : a_(at_t0), b_(at_t1) {}
  explicit BothEnds(double at_both) : a_(at_both), b_(at_both) {}

  double at_t0() const { return a_; }
  double at_t1() const { return b_; }

  BothEnds swapped() const { return {b_, a_}; }

  friend BothEnds operator+(BothEnds x, BothEnds y) { return {x.a_ + y.a_, x.b_ + y.b_}; }
  friend BothEnds operator-(BothEnds x, BothEnds y) { return {x.a_ - y.a_, x.b_ - y.b_}; }
  friend BothEnds operator*(BothEnds x, BothEnds y) { return {x.a_ * y.a_, x.b_ * y.b_}; }
  friend BothEnds min(BothEnds x, BothEnds y) { return {x.a_ < y.a_ ? x.a_ : y.a_, x.b_ < y.b_ ? x.b_ : y.b_}; }
  friend BothEnds max(BothEnds x, BothEnds y) { return {x.a_ > y.a_ ? x.a_ : y.a_, x.b_ > y.b_ ? x.b_ : y.b_}; }
  friend BothEnds abs(BothEnds x) { return {std::abs(x.a_), std::abs(x.b_)}; }
  /// Whether x < y at both ends.
  friend bool below(BothEnds x, BothEnds y) { return x.a_ < y.a_ && x.b_ < y.b_; }

 private:
  double a_, b_;
};

#endif

}  // namespace noli
