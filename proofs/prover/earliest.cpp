// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/earliest.h"

#include <algorithm>

#include "proofs/prover/feature_pairs.h"

namespace noli {

bool canonical_less(const FeatureContact& a, const FeatureContact& b) {
  return a.pair != b.pair ? a.pair < b.pair : a.vertices < b.vertices;
}

FeatureContact canonical(FeaturePair pair, const std::array<VertexId, 4>& vertices, TimeEnclosure first) {
  FeatureContact contact{pair, vertices, first};
  auto& v = contact.vertices;
  if (pair == FeaturePair::edge_edge) {
    if (v[1] < v[0]) std::swap(v[0], v[1]);
    if (v[3] < v[2]) std::swap(v[2], v[3]);
    if (std::pair(v[2], v[3]) < std::pair(v[0], v[1])) v = {v[2], v[3], v[0], v[1]};
  } else if (pair == FeaturePair::vertex_edge) {
    if (v[2] < v[1]) std::swap(v[1], v[2]);
  } else if (pair == FeaturePair::vertex_vertex) {
    if (v[1] < v[0]) std::swap(v[0], v[1]);
  }
  return contact;
}

ContactAtTime ExactlyInStep::operator()(const FeatureContact& contact) const {
  const auto time_of = [&]<FeaturePair Pair, int Dim>() {
    Query<Pair, Dim> query;
    for (std::size_t i = 0; i < query.size; ++i) {
      std::copy_n(x_t0[contact.vertices[i]].begin(), Dim, query.x_t0[i].begin());
      std::copy_n(x_t1[contact.vertices[i]].begin(), Dim, query.x_t1[i].begin());
    }
    return first_contact(query).value().time;
  };
  ContactAtTime exact{contact, with_pair(contact.pair, dimension, time_of)};
  exact.contact.first = {exact.time.lower(), exact.time.upper()};
  return exact;
}

}  // namespace noli
