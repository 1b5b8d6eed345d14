// SPDX-License-Identifier: Apache-2.0
#include <noli/time_of_impact.h>

#include "kernel/arithmetic/scaled_integers.h"
#include "kernel/first_contact_search.h"

namespace noli {
namespace {

/// Whether the forms of formula.h fit: sums of products of up to three differences of coordinates, at most 32 terms
/// each.
template <std::size_t limbs>
bool fits(const exact::ExponentRange& range) {
  return range.bits() <= static_cast<int>(64 * limbs) - 6;
}

}  // namespace

template <FeaturePair Pair, int Dim>
std::optional<FirstContact> first_contact(const Query<Pair, Dim>& query) {
  const exact::ExponentRange range = exact::exponent_range(query);
  if (fits<1>(range)) return condition::first_contact_of<Pair>(exact::scaled<Wide<1>>(query, range));
  if (fits<2>(range)) return condition::first_contact_of<Pair>(exact::scaled<Wide<2>>(query, range));
  return condition::first_contact_of<Pair>(exact::scaled<Integer>(query, range));
}

template std::optional<FirstContact> first_contact(const VertexFace3&);
template std::optional<FirstContact> first_contact(const EdgeEdge3&);
template std::optional<FirstContact> first_contact(const VertexEdge3&);
template std::optional<FirstContact> first_contact(const VertexVertex3&);
template std::optional<FirstContact> first_contact(const VertexEdge2&);
template std::optional<FirstContact> first_contact(const VertexVertex2&);

}  // namespace noli
