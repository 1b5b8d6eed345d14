// SPDX-License-Identifier: Apache-2.0
//
// Converts a query of the kernel to the oracle's input.
#pragma once

#include <noli/query.h>
#include "oracle/oracle.h"

namespace noli::test {

template <FeaturePair Pair, int Dim>
oracle::Motion motion_of(const Query<Pair, Dim>& query) {
  oracle::Motion result;
  constexpr std::array pairs = {oracle::Pair::vertex_face, oracle::Pair::edge_edge, oracle::Pair::vertex_edge,
                                oracle::Pair::vertex_vertex};
  result.pair = pairs[static_cast<std::size_t>(Pair)];
  result.dimension = Dim;
  for (std::size_t i = 0; i < query.x_t0.size(); ++i) {
    for (std::size_t k = 0; k < Dim; ++k) {
      result.x_t0[i][k] = query.x_t0[i][k];
      result.x_t1[i][k] = query.x_t1[i][k];
    }
  }
  return result;
}

}  // namespace noli::test
