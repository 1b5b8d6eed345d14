// SPDX-License-Identifier: Apache-2.0
//
// Compares what the code under test says of a query with what the oracle says.
#pragma once

#include <optional>
#include <string>

#include "audit/fuzz/queries/fuzz_queries.h"
#include "oracle/oracle.h"

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

/// What the oracle says of a probe.
struct ProbeTruth {
  std::optional<double> within_t;  ///< the first time within eta, rounded down
  double failure = 0;              ///< the failure time, rounded down
};

ProbeTruth truth_of(const AnyQuery& query, const Probe& probe);

/// The first difference in words, or nothing: within eta, when first, failure time; or that `decide` threw.
std::optional<std::string> difference(const AnyQuery& query, const Probe& probe, const ProbeTruth& truth,
                                      const DecideProbe& decide);

}  // namespace noli::audit
