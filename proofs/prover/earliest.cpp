// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/earliest.h"

#include <algorithm>

#include <noli/time_of_impact.h>

namespace noli {

namespace {

template <FeaturePair Pair, int Dim>
TimeOfImpact time_of(const FeatureContact& contact, std::span<const Position> x_t0, std::span<const Position> x_t1) {
  Query<Pair, Dim> query;
  for (std::size_t i = 0; i < query.size; ++i) {
    std::copy_n(x_t0[contact.vertices[i]].begin(), Dim, query.x_t0[i].begin());
    std::copy_n(x_t1[contact.vertices[i]].begin(), Dim, query.x_t1[i].begin());
  }
  return first_contact(query).value().time;
}

bool ends_earlier(const FeatureContact& a, const FeatureContact& b) {
  return a.first.end != b.first.end ? a.first.end < b.first.end : canonical_less(a, b);
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

TimeOfImpact exact_time(const FeatureContact& contact, std::span<const Position> x_t0, std::span<const Position> x_t1,
                        int dimension) {
  switch (contact.pair) {
    case FeaturePair::vertex_face: return time_of<FeaturePair::vertex_face, 3>(contact, x_t0, x_t1);
    case FeaturePair::edge_edge: return time_of<FeaturePair::edge_edge, 3>(contact, x_t0, x_t1);
    case FeaturePair::vertex_edge:
      return dimension == 2 ? time_of<FeaturePair::vertex_edge, 2>(contact, x_t0, x_t1)
                            : time_of<FeaturePair::vertex_edge, 3>(contact, x_t0, x_t1);
    case FeaturePair::vertex_vertex: break;
  }
  return dimension == 2 ? time_of<FeaturePair::vertex_vertex, 2>(contact, x_t0, x_t1)
                        : time_of<FeaturePair::vertex_vertex, 3>(contact, x_t0, x_t1);
}

void Earliest::add(const FeatureContact& contact) {
  if (contact.first.begin > end_) return;
  candidates_.push_back(contact);
  if (contact.first.end < end_) {
    end_ = contact.first.end;
    prune();
  }
  if (candidates_.size() > most_candidates) reduce();
}

void Earliest::add(const Earliest& other) {
  for (const FeatureContact& contact : other.candidates_) add(contact);
}

void Earliest::prune() {
  std::erase_if(candidates_, [this](const FeatureContact& c) { return c.first.begin > end_; });
}

std::optional<FeatureContact> Earliest::first() {
  if (candidates_.empty()) return std::nullopt;
  reduce();
  return candidates_.front();
}

/// Leaves only the first candidate. Precondition: there is one.
void Earliest::reduce() {
  std::sort(candidates_.begin(), candidates_.end(), ends_earlier);
  FeatureContact best = candidates_.front();
  TimeOfImpact best_time = exact_time(best, x_t0_, x_t1_, dimension_);
  end_ = best_time.upper();
  for (const FeatureContact& other : std::span(candidates_).subspan(1)) {
    if (other.first.begin > end_) continue;
    const bool both_at_zero = end_ == 0 && other.first.end == 0;
    if (both_at_zero && !canonical_less(other, best)) continue;
    TimeOfImpact time = both_at_zero ? best_time : exact_time(other, x_t0_, x_t1_, dimension_);
    const auto order = time <=> best_time;
    if (order > 0 || (order == 0 && !canonical_less(other, best))) continue;
    best = other;
    best_time = std::move(time);
    end_ = best_time.upper();
  }
  best.first = {best_time.lower(), end_};
  candidates_ = {best};
}

}  // namespace noli
