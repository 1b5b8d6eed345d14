// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/windows/window_earliest.h"

#include <algorithm>
#include <span>

#include "proofs/prover/earliest.h"
#include "proofs/prover/windows/window_features.h"

namespace noli {

void WindowEarliest::add(const FeatureContact& contact) {
  if (contact.first.begin > end_) return;
  candidates_.push_back(contact);
  if (contact.first.end < end_) {
    end_ = contact.first.end;
    std::erase_if(candidates_, [this](const FeatureContact& c) { return c.first.begin > end_; });
  }
  if (candidates_.size() > most_candidates) candidates_ = {reduce().contact};
}

void WindowEarliest::add(const WindowEarliest& other) {
  for (const FeatureContact& contact : other.candidates_) add(contact);
}

std::optional<FirstInWindow> WindowEarliest::first() {
  if (candidates_.empty()) return std::nullopt;
  return reduce();
}

FirstInWindow WindowEarliest::exactly(const FeatureContact& contact) const {
  ExactContact exact = exact_contact({contact.pair, contact.vertices}, *lines_, dimension_, contact.first);
  FirstInWindow first{contact, exact.kind, std::move(exact.time)};
  first.contact.first = {first.time.lower(), first.time.upper()};
  return first;
}

/// Precondition: there is a candidate.
FirstInWindow WindowEarliest::reduce() {
  std::sort(candidates_.begin(), candidates_.end(), [](const FeatureContact& a, const FeatureContact& b) {
    return a.first.end != b.first.end ? a.first.end < b.first.end : canonical_less(a, b);
  });
  FirstInWindow best = exactly(candidates_.front());
  for (const FeatureContact& other : std::span(candidates_).subspan(1)) {
    if (other.first.begin > best.contact.first.end) continue;
    FirstInWindow next = exactly(other);
    const auto order = next.time <=> best.time;
    if (order < 0 || (order == 0 && canonical_less(other, best.contact))) best = std::move(next);
  }
  end_ = best.contact.first.end;
  return best;
}

}  // namespace noli
