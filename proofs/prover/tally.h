// SPDX-License-Identifier: Apache-2.0
//
// The findings of one task of a verification. The tallies of all tasks, added up in order, are the result.
#pragma once

#include <algorithm>
#include <vector>

#include "proofs/prover/earliest.h"
#include "proofs/prover/verifier.h"

namespace noli {

/// Keeps the least `limit` of the values added.
template <class T, bool (*Less)(const T&, const T&)>
class Least {
 public:
  explicit Least(std::size_t limit) : limit_(limit) {}

  void add(const T& value) {
    if (limit_ == 0) return;
    if (heap_.size() == limit_) {
      if (!Less(value, heap_.front())) return;
      std::pop_heap(heap_.begin(), heap_.end(), Less);
      heap_.pop_back();
    }
    heap_.push_back(value);
    std::push_heap(heap_.begin(), heap_.end(), Less);
  }

  void add(const Least& other) {
    for (const T& value : other.heap_) add(value);
  }

  /// The values in ascending order. Leaves this empty.
  std::vector<T> take() {
    std::sort_heap(heap_.begin(), heap_.end(), Less);
    return std::move(heap_);
  }

 private:
  std::size_t limit_;
  std::vector<T> heap_;  ///< the greatest in front
};

inline bool initial_less(const InitialIntersection& a, const InitialIntersection& b) {
  return a.first_cell != b.first_cell ? a.first_cell < b.first_cell : a.second_cell < b.second_cell;
}

/// `First` finds the first of all contacts.
template <class First>
struct TallyWith {
  TallyWith(std::size_t max_reports, const First& none)
      : reports(max_reports), initial_reports(max_reports), earliest(none) {}

  std::array<std::uint64_t, all_feature_pairs.size()> contacts{};
  std::uint64_t initial_intersections = 0;
  std::uint64_t going_on = 0;  ///< as in Findings
  Least<FeatureContact, canonical_less> reports;
  Least<InitialIntersection, initial_less> initial_reports;
  First earliest;
  StageCounters stages;
  std::uint64_t obligations = 0;
  std::uint64_t cell_pairs = 0;

  /// Moves the reports out.
  Findings findings(bool complete) {
    return {complete,   contacts, initial_intersections, reports.take(), initial_reports.take(), stages, obligations,
            cell_pairs, going_on};
  }

  /// Whether there is anything to report.
  bool found_any() const {
    return initial_intersections > 0 || std::any_of(contacts.begin(), contacts.end(), [](auto n) { return n > 0; });
  }

  /// Whether there is no proof, because something meets.
  bool something_meets() const { return found_any() || going_on > 0; }

  void add_contact(const FeatureContact& contact) {
    ++contacts[static_cast<std::size_t>(contact.pair)];
    reports.add(contact);
    earliest.add(contact);
  }

  void add_initial(std::uint32_t a, std::uint32_t b) {
    ++initial_intersections;
    initial_reports.add({std::min(a, b), std::max(a, b)});
  }

  TallyWith& operator+=(const TallyWith& other) {
    for (std::size_t i = 0; i < contacts.size(); ++i) contacts[i] += other.contacts[i];
    initial_intersections += other.initial_intersections;
    going_on += other.going_on;
    reports.add(other.reports);
    initial_reports.add(other.initial_reports);
    earliest.add(other.earliest);
    stages += other.stages;
    obligations += other.obligations;
    cell_pairs += other.cell_pairs;
    return *this;
  }
};

/// The tally of a step between two frames.
using Tally = TallyWith<EarliestOf<ExactlyInStep>>;

}  // namespace noli
