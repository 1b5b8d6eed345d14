// SPDX-License-Identifier: Apache-2.0
#include "certify/step_parts.h"

#include <algorithm>
#include <span>
#include <utility>

#include "certify/verification.h"
#include "proofs/prover/earliest.h"
#include "proofs/prover/tally.h"

namespace noli {
namespace {

template <class Value>
void add_list(std::vector<Value>& sum, const std::vector<Value>& more) {
  sum.insert(sum.end(), more.begin(), more.end());
}

template <class Value>
void keep_least(std::vector<Value>& list, bool (*less)(const Value&, const Value&), std::size_t most) {
  std::ranges::sort(list, less);
  if (list.size() > most) list.resize(most);
}

}  // namespace

StepResult sum_of(std::vector<StepResult> parts, std::size_t most) {
  StepResult sum = std::move(parts.at(0));
  sum.first.reset();
  for (const StepResult& part : std::span(parts).subspan(1)) {
    sum.complete = sum.complete && part.complete;
    for (std::size_t i = 0; i < sum.contacts.size(); ++i) sum.contacts[i] += part.contacts[i];
    sum.initial_intersections += part.initial_intersections;
    add_list(sum.reports, part.reports);
    add_list(sum.initial_reports, part.initial_reports);
    sum.stages += part.stages;
    sum.obligations += part.obligations;
    sum.cell_pairs += part.cell_pairs;
  }
  keep_least(sum.reports, canonical_less, most);
  keep_least(sum.initial_reports, initial_less, most);
  return sum;
}

std::optional<FirstInStep> earliest_of(const std::vector<FirstInStep>& parts, int dimension,
                                       std::span<const Position> x_t0, std::span<const Position> x_t1) {
  EarliestOf<ExactlyInStep> earliest({x_t0, x_t1, dimension}, 1);
  for (const FirstInStep& part : parts) {
    FeatureContact contact = part.contact;
    contact.first = {0, 1};  // the exact time alone decides, whatever enclosure a file has
    earliest.add(contact);
  }
  const auto first = earliest.first();
  if (!first) return std::nullopt;
  return first_in_step(first->contact, query_of(first->contact, dimension, x_t0, x_t1));
}

}  // namespace noli
