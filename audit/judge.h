// SPDX-License-Identifier: Apache-2.0
//
// Compares what the code under test says of a query with what the oracle says.
#pragma once

#include <optional>
#include <string>

#include "noli/audit/fuzz_queries.h"
#include "noli/tests/oracle/oracle.h"

namespace noli::audit {

/// What the oracle says.
struct Truth {
  ContactKind kind = ContactKind::apart;
  std::optional<oracle::Time> time;
};

Truth truth_of(const AnyQuery& query);

/// The first difference in words, or nothing: contact, kind, first time rounded down, enclosure of the first time; or
/// that `decide` threw.
std::optional<std::string> difference(const AnyQuery& query, const Truth& truth, const Decide& decide,
                                      StageCounters& stages);

}  // namespace noli::audit
