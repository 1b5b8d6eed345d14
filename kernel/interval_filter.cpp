// SPDX-License-Identifier: Apache-2.0
#include "kernel/interval_filter.h"

#include <CGAL/Interval_nt.h>

#include "kernel/formula.h"

namespace noli::interval_filter {
namespace {

using Interval = CGAL::Interval_nt<false>;  // the rounding mode is switched once per query, not per operation
using formula::Moving;

/// Certain signs of intervals: the Signs of bernstein.h.
struct IntervalSigns {
  static int sign(const Interval& x) { return (x.inf() > 0) - (x.sup() < 0); }
  static int f(const Interval& x) { return sign(x); }
  static int f_value(const Interval& x) { return sign(x); }
  static int g(std::size_t, const Interval& x) { return sign(x); }

  template <std::size_t N>
  static int g_on(std::size_t, const std::array<Interval, N>& c, double low, double high) {
    return sign(bernstein::value_at(c, Interval(low, high)));
  }

  static double center(const Interval& x) { return 0.5 * x.inf() + 0.5 * x.sup(); }
  static double f_noise() { return 0; }
  static IntervalSigns finer() { return {}; }
};

template <FeaturePair Pair, int Dim>
Moving<Interval, Dim> difference(const Query<Pair, Dim>& q, std::size_t to, std::size_t from) {
  Moving<Interval, Dim> result;
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    result.at_t0[axis] = Interval(q.x_t0[to][axis]) - Interval(q.x_t0[from][axis]);
    result.at_t1[axis] = Interval(q.x_t1[to][axis]) - Interval(q.x_t1[from][axis]);
  }
  return result;
}

/// Whether no product can overflow: an infinite bound times zero would be NaN.
template <FeaturePair Pair, int Dim>
bool in_range(const Query<Pair, Dim>& q) {
  double largest = 0;
  for (const auto* points : {&q.x_t0, &q.x_t1}) {
    for (const auto& point : *points) largest = std::max(largest, filter::magnitude(point));
  }
  return largest < 0x1p300;
}

/// The axis along which the cross product of two vectors looks largest at mid-time.
std::size_t clearest_axis(const Moving<Interval, 3>& a, const Moving<Interval, 3>& b) {
  filter::Vec<double, 3> size;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto c = formula::cross_component(a, b, axis);
    size[axis] = IntervalSigns::center(c[0] + c[1] + c[2]);
  }
  return filter::largest_component(size);
}

}  // namespace

filter::Decision decide(const VertexFace3& q) {
  if (!in_range(q)) return filter::undecided;
  const Interval::Protector protector;
  const formula::VertexFace<Interval> forms{{difference(q, 1, 0), difference(q, 2, 0), difference(q, 3, 0)}};
  return filter::search(forms, clearest_axis(difference(q, 2, 1), difference(q, 3, 1)), IntervalSigns());
}

filter::Decision decide(const EdgeEdge3& q) {
  if (!in_range(q)) return filter::undecided;
  const Interval::Protector protector;
  const formula::EdgeEdge<Interval> forms{difference(q, 1, 0), difference(q, 3, 2), difference(q, 2, 0)};
  return filter::search(forms, clearest_axis(forms.u, forms.v), IntervalSigns());
}

}  // namespace noli::interval_filter
