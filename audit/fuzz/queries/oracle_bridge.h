// SPDX-License-Identifier: Apache-2.0
//
// Queries as the oracle wants them, and its answers in the kernel's words.
#pragma once

#include <noli/time_of_impact.h>
#include "certify/queries/any_query.h"
#include "oracle/oracle.h"

namespace noli::audit {

constexpr oracle::Pair oracle_pair(FeaturePair pair) {
  switch (pair) {
    case FeaturePair::vertex_face: return oracle::Pair::vertex_face;
    case FeaturePair::edge_edge: return oracle::Pair::edge_edge;
    case FeaturePair::vertex_edge: return oracle::Pair::vertex_edge;
    case FeaturePair::vertex_vertex: break;
  }
  return oracle::Pair::vertex_vertex;
}

inline oracle::Motion oracle_motion(const AnyQuery& query) {
  return {oracle_pair(query.pair), query.dimension, query.x_t0, query.x_t1};
}

constexpr ContactKind contact_kind(oracle::Kind kind) {
  switch (kind) {
    case oracle::Kind::apart: return ContactKind::apart;
    case oracle::Kind::touching: return ContactKind::touching;
    case oracle::Kind::crossing: return ContactKind::crossing;
    case oracle::Kind::persistent: break;
  }
  return ContactKind::persistent;
}

}  // namespace noli::audit
