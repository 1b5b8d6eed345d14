// SPDX-License-Identifier: Apache-2.0
#include <noli/contact.h>

#include <noli/time_of_impact.h>
#include "kernel/arithmetic/rounding.h"
#include "kernel/arithmetic/scaled_integers.h"
#include "kernel/double_filter.h"
#include "kernel/exact_contact.h"
#include "kernel/interval_filter.h"

namespace noli {
namespace {

using bernstein::Verdict;
using filter::Decision;
using filter::undecided;

/// The most bits B of a coordinate for which the widths in exact_contact.h suffice, with one limb and with two. Bits,
/// with the sign: a difference of coordinates has B + 1, a cross product's coefficient 2 B + 5, a determinant's 3 B +
/// 9.
/// The largest number in exact_times.h has 16 B + 54 in 16 C limbs, or 18 B + 57 in 18 C; at the roots of a cubic with
/// a double root it has 21 B + 59 in 21 C.
constexpr int one_limb_bits = 59;
constexpr int two_limb_bits = 123;

// --- The floating-point stages, by kind of query ---------------------------------------------------------------------

/// Out of line, like all later stages: most queries end earlier and should not pay for saving its registers.
template <class Filter, class Query>
[[gnu::noinline]] Decision bernstein_stage(const Query& query, const filter::Separation& separation,
                                           StageCounters& counters) {
  const Filter filter(query, separation);
  if (!filter.usable()) return undecided;
  bool near_border = false;
  Decision decision = filter::search_roots(filter, near_border);
  if (decision.verdict == Verdict::unknown && !near_border) {
    decision = filter::search(filter.forms(), filter.axis(), filter.signs());
  }
  if (decision.verdict != Verdict::unknown) counters.count(Stage::bernstein);
  return decision;
}

/// Sets `axis`, along which the configuration looks large, for the later stages.
template <class Filter, class Query>
Decision filtered(const Query& query, StageCounters& counters, std::size_t& axis) {
  const filter::Separation separation = filter::separate(query);
  if (separation.separated) {
    counters.count(Stage::direction);
    return {};
  }
  axis = filter::largest_component(separation.normal);
  return bernstein_stage<Filter>(query, separation, counters);
}

Decision float_stages(const VertexFace3& query, StageCounters& counters, std::size_t& axis) {
  return filtered<filter::VertexFaceFilter>(query, counters, axis);
}

Decision float_stages(const EdgeEdge3& query, StageCounters& counters, std::size_t& axis) {
  return filtered<filter::EdgeEdgeFilter>(query, counters, axis);
}

/// The other pairs of features are rare and cheap to decide exactly.
template <FeaturePair Pair, int Dim>
Decision float_stages(const Query<Pair, Dim>&, StageCounters&, std::size_t&) {
  return undecided;
}

// --- Exact integers of fixed width -----------------------------------------------------------------------------------

template <FeaturePair Pair, int Dim>
[[gnu::noinline]] Decision fixed_stage(const Query<Pair, Dim>& query, StageCounters& counters, std::size_t axis) {
  const exact::ExponentRange range = exact::exponent_range(query);
  Decision decision = undecided;
  if (range.bits() <= one_limb_bits) {
    decision = exact::decide<Pair>(exact::scaled<Wide<1>>(query, range), axis);
  } else if (range.bits() <= two_limb_bits) {
    decision = exact::decide<Pair>(exact::scaled<Wide<2>>(query, range), axis);
  }
  if (decision.verdict != Verdict::unknown) counters.count(Stage::fixed);
  return decision;
}

// --- Integers of any width -------------------------------------------------------------------------------------------

template <FeaturePair Pair, int Dim>
[[gnu::noinline]] Decision gmp_stage(const Query<Pair, Dim>& query, StageCounters& counters) {
  counters.count(Stage::gmp);
  const auto first = first_contact(query);
  if (!first) return {};
  return {Verdict::contact, {first->time.lower(), first->time.upper()}};
}

template <FeaturePair Pair, int Dim>
Decision decide(const Query<Pair, Dim>& query, StageCounters& counters) {
  static const RoundingReport rounding = rounding_self_test();
  if (filter::ordered_on_an_axis(query)) {
    counters.count(Stage::comparison);
    return {};
  }
  if (rounding.nearest_ok) {
    std::size_t axis = 0;
    const Decision decision = float_stages(query, counters, axis);
    if (decision.verdict != Verdict::unknown) return decision;
    const Decision exact = fixed_stage(query, counters, axis);
    if (exact.verdict != Verdict::unknown) return exact;
  }
  if (rounding.directed_ok) {
    const Decision decision = interval_filter::decide(query);
    if (decision.verdict != Verdict::unknown) {
      counters.count(Stage::interval);
      return decision;
    }
  }
  return gmp_stage(query, counters);
}

}  // namespace

template <FeaturePair Pair, int Dim>
std::optional<TimeEnclosure> contact(const Query<Pair, Dim>& query, StageCounters* counters) {
  StageCounters unused;
  const Decision decision = decide(query, counters != nullptr ? *counters : unused);
  if (decision.verdict == Verdict::apart) return std::nullopt;
  return decision.enclosure;
}

template std::optional<TimeEnclosure> contact(const VertexFace3&, StageCounters*);
template std::optional<TimeEnclosure> contact(const EdgeEdge3&, StageCounters*);
template std::optional<TimeEnclosure> contact(const VertexEdge3&, StageCounters*);
template std::optional<TimeEnclosure> contact(const VertexVertex3&, StageCounters*);
template std::optional<TimeEnclosure> contact(const VertexEdge2&, StageCounters*);
template std::optional<TimeEnclosure> contact(const VertexVertex2&, StageCounters*);

}  // namespace noli
