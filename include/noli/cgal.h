// SPDX-License-Identifier: Apache-2.0
//
// The kernel's predicates as functors over the points of a CGAL kernel. Also converts times of impact to and from
// CGAL's algebraic numbers, and to MPFR's numbers.
//
//   noli::Vertex_face_contact_3<K>         does a moving vertex meet a moving face during the step?  -> bool
//   noli::Vertex_face_time_of_impact_3<K>  when first?                -> std::optional<noli::TimeOfImpact>
//   noli::Vertex_face_first_contact_3<K>   when, and of what kind?    -> std::optional<noli::FirstContact>
// and the same for Edge_edge_..._3, Vertex_edge_..._3, Vertex_vertex_..._3, Vertex_edge_..._2, Vertex_vertex_..._2.
// Each takes the points at t = 0, then the same at t = 1, in the order of noli/query.h.
//
//   const noli::Edge_edge_time_of_impact_3<K> time_of_impact;
//   const auto time = time_of_impact(a0, a1, b0, b1,    // at t = 0
//                                    c0, c1, d0, d1);   // at t = 1
//
// Preconditions: coordinates are doubles. A kernel with another number type may be used as long as the values of its
// coordinates are doubles. Otherwise std::domain_error is thrown: rounding would change the question. As for
// noli/contact.h, the floating-point environment rounds to nearest.
// Thread safety: functors have no state.
// Needs CGAL (only its packages under the LGPL are used); GMP and MPFR come with it.
#pragma once

#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/Gmpz.h>
#include <CGAL/number_utils.h>
#include <mpfr.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <noli/contact.h>
#include <noli/time_of_impact.h>

namespace noli {
namespace cgal_detail {

template <class FT>
double exactly_double(const FT& x) {
  if constexpr (std::is_floating_point_v<FT>) {
    static_assert(sizeof(FT) <= sizeof(double), "coordinates must fit doubles");
    return x;
  } else {
    const double rounded = CGAL::to_double(x);
    if (!std::isfinite(rounded) || FT(rounded) != x) throw std::domain_error("a coordinate is no double");
    return rounded;
  }
}

template <int Dim, class CgalPoint>
Point<Dim> point(const CgalPoint& p) {
  Point<Dim> result;
  for (int i = 0; i < Dim; ++i) result[static_cast<std::size_t>(i)] = exactly_double(p.cartesian(i));
  return result;
}

template <class K, int Dim>
using PointOf = std::conditional_t<Dim == 3, typename K::Point_3, typename K::Point_2>;

/// The points at t = 0, then those at t = 1.
template <class Query, class CgalPoint>
Query query(const std::array<const CgalPoint*, 2 * Query::size>& p) {
  Query result;
  for (std::size_t i = 0; i < Query::size; ++i) {
    result.x_t0[i] = point<Query::dimension>(*p[i]);
    result.x_t1[i] = point<Query::dimension>(*p[Query::size + i]);
  }
  return result;
}

/// A functor that takes 2 n points.
template <class K, class Query, class Answer>
struct Functor {
  using Point = PointOf<K, Query::dimension>;
  using result_type = std::invoke_result_t<Answer, const Query&>;

  template <class... Points>
  requires(sizeof...(Points) == 2 * Query::size &&
           (std::is_convertible_v<const Points&, const Point&> && ...)) result_type
  operator()(const Points&... points) const {
    return Answer{}(query<Query, Point>({&static_cast<const Point&>(points)...}));
  }
};

struct Meet {
  template <class Query>
  bool operator()(const Query& q) const {
    return meet(q);
  }
};

struct First {
  template <class Query>
  std::optional<FirstContact> operator()(const Query& q) const {
    return first_contact(q);
  }
};

struct Time {
  template <class Query>
  std::optional<TimeOfImpact> operator()(const Query& q) const {
    auto first = first_contact(q);
    return first ? std::optional(std::move(first->time)) : std::nullopt;
  }
};

}  // namespace cgal_detail

// clang-format off
template <class K> using Vertex_face_contact_3   = cgal_detail::Functor<K, VertexFace3, cgal_detail::Meet>;
template <class K> using Edge_edge_contact_3     = cgal_detail::Functor<K, EdgeEdge3, cgal_detail::Meet>;
template <class K> using Vertex_edge_contact_3   = cgal_detail::Functor<K, VertexEdge3, cgal_detail::Meet>;
template <class K> using Vertex_vertex_contact_3 = cgal_detail::Functor<K, VertexVertex3, cgal_detail::Meet>;
template <class K> using Vertex_edge_contact_2   = cgal_detail::Functor<K, VertexEdge2, cgal_detail::Meet>;
template <class K> using Vertex_vertex_contact_2 = cgal_detail::Functor<K, VertexVertex2, cgal_detail::Meet>;

template <class K> using Vertex_face_first_contact_3   = cgal_detail::Functor<K, VertexFace3, cgal_detail::First>;
template <class K> using Edge_edge_first_contact_3     = cgal_detail::Functor<K, EdgeEdge3, cgal_detail::First>;
template <class K> using Vertex_edge_first_contact_3   = cgal_detail::Functor<K, VertexEdge3, cgal_detail::First>;
template <class K> using Vertex_vertex_first_contact_3 = cgal_detail::Functor<K, VertexVertex3, cgal_detail::First>;
template <class K> using Vertex_edge_first_contact_2   = cgal_detail::Functor<K, VertexEdge2, cgal_detail::First>;
template <class K> using Vertex_vertex_first_contact_2 = cgal_detail::Functor<K, VertexVertex2, cgal_detail::First>;

template <class K> using Vertex_face_time_of_impact_3   = cgal_detail::Functor<K, VertexFace3, cgal_detail::Time>;
template <class K> using Edge_edge_time_of_impact_3     = cgal_detail::Functor<K, EdgeEdge3, cgal_detail::Time>;
template <class K> using Vertex_edge_time_of_impact_3   = cgal_detail::Functor<K, VertexEdge3, cgal_detail::Time>;
template <class K> using Vertex_vertex_time_of_impact_3 = cgal_detail::Functor<K, VertexVertex3, cgal_detail::Time>;
template <class K> using Vertex_edge_time_of_impact_2   = cgal_detail::Functor<K, VertexEdge2, cgal_detail::Time>;
template <class K> using Vertex_vertex_time_of_impact_2 = cgal_detail::Functor<K, VertexVertex2, cgal_detail::Time>;
// clang-format on

using AlgebraicKernel = CGAL::Algebraic_kernel_d_1<CGAL::Gmpz>;

/// The same number, as a CGAL algebraic number.
AlgebraicKernel::Algebraic_real_1 to_algebraic_real_1(const TimeOfImpact& time);

/// The same number, as a TimeOfImpact. Throws std::domain_error unless it is in [0, 1].
TimeOfImpact from_algebraic_real_1(const AlgebraicKernel::Algebraic_real_1& x);

/// Sets `result` to the time, correctly rounded to the precision of `result`. Returns MPFR's ternary value: the sign of
/// (result - time), 0 if exact.
int to_mpfr(const TimeOfImpact& time, mpfr_ptr result, mpfr_rnd_t rounding);

}  // namespace noli
