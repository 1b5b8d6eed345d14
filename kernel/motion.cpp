// SPDX-License-Identifier: Apache-2.0
#include "kernel/motion.h"

#include "kernel/first_contact_search.h"
#include "kernel/motion_points.h"

namespace noli {
namespace {

/// The k-th derivative counts with the sign of (-1)^k.
int sign_before_end(const Polynomial& p) {
  const Dyadic end = Dyadic::from_integer(1);
  int sign = 1;
  for (Polynomial d = p; !d.is_zero(); d = d.derivative()) {
    if (const int s = d.sign_at(end)) return sign * s;
    sign = -sign;
  }
  return 0;
}

}  // namespace

template <FeaturePair Pair, int Dim>
std::optional<FirstContact> first_contact(const MotionQuery<Pair, Dim>& query) {
  return condition::first_contact_of<Pair>(motion::integer_points(query).points);
}

template <FeaturePair Pair, int Dim>
ContactKind kind_at_border(const MotionQuery<Pair, Dim>& before, const MotionQuery<Pair, Dim>& after) {
  const auto points_before = motion::integer_points(before).points;
  const auto points_after = motion::integer_points(after).points;
  if (condition::first_contact_of<Pair>(points_after)->kind == ContactKind::persistent) return ContactKind::persistent;
  auto condition_before = condition::make<Pair>(points_before);
  auto condition_after = condition::make<Pair>(points_after);
  AlgebraicNumber begin;
  if (!condition_after.transversal(condition::At{begin})) return ContactKind::touching;
  const Polynomial *f = condition_before.equality(), *g = condition_after.equality();
  if (f == nullptr || g == nullptr) return ContactKind::touching;
  return sign_before_end(*f) * condition::JustAfter{begin}.sign(*g) < 0 ? ContactKind::crossing : ContactKind::touching;
}

#define NOLI_MOTION(Pair, Dim)                                                                    \
  template std::optional<FirstContact> first_contact(const MotionQuery<FeaturePair::Pair, Dim>&); \
  template ContactKind kind_at_border(const MotionQuery<FeaturePair::Pair, Dim>&,                 \
                                      const MotionQuery<FeaturePair::Pair, Dim>&);
NOLI_MOTION(vertex_face, 3)
NOLI_MOTION(edge_edge, 3)
NOLI_MOTION(vertex_edge, 3)
NOLI_MOTION(vertex_vertex, 3)
NOLI_MOTION(vertex_edge, 2)
NOLI_MOTION(vertex_vertex, 2)
#undef NOLI_MOTION

}  // namespace noli
