// SPDX-License-Identifier: Apache-2.0
#include "bench/textbook.h"

#include "audit/ccd/plugins/textbook.h"

namespace noli::bench {
namespace {

plugins::Points points_of(const std::array<Point3, 4>& x) {
  const auto vec = [&](std::size_t i) { return plugins::Vec{x[i][0], x[i][1], x[i][2]}; };
  return {vec(0), vec(1), vec(2), vec(3)};
}

}  // namespace

bool textbook_meet(const VertexFace3& query) {
  return plugins::textbook_root(NOLI_CCD_VERTEX_FACE, points_of(query.x_t0), points_of(query.x_t1)) >= 0;
}

bool textbook_meet(const EdgeEdge3& query) {
  return plugins::textbook_root(NOLI_CCD_EDGE_EDGE, points_of(query.x_t0), points_of(query.x_t1)) >= 0;
}

}  // namespace noli::bench
