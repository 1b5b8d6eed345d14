// SPDX-License-Identifier: Apache-2.0
#include "noli/audit/judge.h"

#include <fmt/format.h>

#include <exception>
#include <utility>

#include "noli/audit/oracle_bridge.h"

namespace noli::audit {

namespace {

std::optional<std::string> compare(const Decision& decision, const Truth& truth) {
  const bool contact = truth.kind != ContactKind::apart;
  if (decision.contact.has_value() != contact) {
    return fmt::format("contact: found {}, the oracle says {}", decision.contact ? "one" : "none", name(truth.kind));
  }
  if (decision.kind != truth.kind) {
    return fmt::format("kind: found {}, the oracle says {}", name(decision.kind), name(truth.kind));
  }
  if (!contact) return std::nullopt;
  if (const double lower = truth.time->lower(); decision.lower != lower) {
    return fmt::format("first time: found {:.17g}, the oracle says {:.17g}", decision.lower, lower);
  }
  const auto [begin, end] = *decision.contact;
  if (truth.time->compare(begin) < 0 || truth.time->compare(end) > 0) {
    return fmt::format("enclosure: found [{:.17g}, {:.17g}], the oracle says {:.17g}", begin, end, truth.time->lower());
  }
  return std::nullopt;
}

}  // namespace

Truth truth_of(const AnyQuery& query) {
  oracle::Answer answer = oracle::first_contact(oracle_motion(query));
  return {contact_kind(answer.kind), std::move(answer.time)};
}

std::optional<std::string> difference(const AnyQuery& query, const Truth& truth, const Decide& decide,
                                      StageCounters& stages) {
  try {
    return compare(decide(query, stages), truth);
  } catch (const std::exception& error) {
    return fmt::format("threw: {}", error.what());
  }
}

Decision decide_with_kernel(const AnyQuery& query, StageCounters& stages) {
  return visit(query, [&stages](const auto& typed) {
    Decision decision;
    decision.contact = contact(typed, &stages);
    if (const auto first = first_contact(typed)) {
      decision.kind = first->kind;
      decision.lower = first->time.lower();
    }
    return decision;
  });
}

}  // namespace noli::audit
