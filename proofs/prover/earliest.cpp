// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/earliest.h"

#include <algorithm>

namespace noli {

namespace {

template <FeaturePair Pair, int Dim>
TimeOfImpact time_of(const FeatureContact& contact, const ExactlyInStep& step) {
  Query<Pair, Dim> query;
  for (std::size_t i = 0; i < query.size; ++i) {
    std::copy_n(step.x_t0[contact.vertices[i]].begin(), Dim, query.x_t0[i].begin());
    std::copy_n(step.x_t1[contact.vertices[i]].begin(), Dim, query.x_t1[i].begin());
  }
  return first_contact(query).value().time;
}

TimeOfImpact time_of(const FeatureContact& contact, const ExactlyInStep& step) {
  switch (contact.pair) {
    case FeaturePair::vertex_face: return time_of<FeaturePair::vertex_face, 3>(contact, step);
    case FeaturePair::edge_edge: return time_of<FeaturePair::edge_edge, 3>(contact, step);
    case FeaturePair::vertex_edge:
      return step.dimension == 2 ? time_of<FeaturePair::vertex_edge, 2>(contact, step)
                                 : time_of<FeaturePair::vertex_edge, 3>(contact, step);
    case FeaturePair::vertex_vertex: break;
  }
  return step.dimension == 2 ? time_of<FeaturePair::vertex_vertex, 2>(contact, step)
                             : time_of<FeaturePair::vertex_vertex, 3>(contact, step);
}

}  // namespace

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
  ContactAtTime exact{contact, time_of(contact, *this)};
  exact.contact.first = {exact.time.lower(), exact.time.upper()};
  return exact;
}

}  // namespace noli
