// SPDX-License-Identifier: Apache-2.0
//
// The stage between exact integers of fixed width and GMP: Bernstein coefficients in CGAL::Interval_nt, for queries
// whose exponents do not fit the fixed width, or that double precision could not settle.
//
// Like every filter, it is silent about degenerate queries. Do not call it when directed rounding does not work
// (kernel/arithmetic/rounding.h).
#pragma once

#include <noli/query.h>
#include "kernel/double_filter.h"

namespace noli::interval_filter {

/// vertex_face and edge_edge in space; `unknown` for the others, whose exact decision is cheaper.
filter::Decision decide(const VertexFace3& query);
filter::Decision decide(const EdgeEdge3& query);

template <FeaturePair Pair, int Dim>
filter::Decision decide(const Query<Pair, Dim>&) {
  return filter::undecided;
}

}  // namespace noli::interval_filter
