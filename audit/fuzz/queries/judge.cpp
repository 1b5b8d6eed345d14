// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/judge.h"

#include <fmt/format.h>

#include <exception>
#include <utility>

#include "audit/fuzz/queries/oracle_bridge.h"
#include "kernel/failure_time.h"
#include "kernel/thickness.h"
#include "oracle/certificate.h"

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

std::string when(const std::optional<double>& t) { return t ? fmt::format("from {:.17g}", *t) : "never"; }

std::optional<std::string> compare(const ProbeDecision& decision, const Probe& probe, const ProbeTruth& truth) {
  if (probe.eta && (decision.within != truth.within_t.has_value() || decision.within_t != truth.within_t)) {
    return fmt::format("distance: found within {} {} (as yes or no: {}), the oracle says {}", *probe.eta,
                       when(decision.within_t), decision.within ? "yes" : "no", when(truth.within_t));
  }
  if (decision.failure != truth.failure) {
    return fmt::format("failure time: found {:.17g}, the oracle says {:.17g}", decision.failure, truth.failure);
  }
  return std::nullopt;
}

oracle::Line oracle_line(const AnyQuery& query, const Probe& probe, std::size_t which) {
  const std::size_t i = probe.points[which];
  return {query.x_t0[i], query.x_t1[i], probe.rays[which]};
}

template <int Dim>
Point<Dim> cut(const Point3& x) {
  Point<Dim> result;
  for (std::size_t k = 0; k < Dim; ++k) result[k] = x[k];
  return result;
}

/// Calls ask(line) for the line of a or b, a Ray or a MotionSegment.
template <int Dim, class Ask>
double with_line(const AnyQuery& query, const Probe& probe, std::size_t which, const Ask& ask) {
  const std::size_t i = probe.points[which];
  const Point<Dim> x = cut<Dim>(query.x_t0[i]), y = cut<Dim>(query.x_t1[i]);
  return probe.rays[which] ? ask(Ray<Dim>{0, x, y}) : ask(MotionSegment<Dim>{0, x, 1, y});
}

template <int Dim>
double kernel_failure_time(const AnyQuery& query, const Probe& probe) {
  return with_line<Dim>(query, probe, 0, [&](const auto& a) {
    return with_line<Dim>(query, probe, 1, [&](const auto& b) {
      return failure_time(a, b, cut<Dim>(probe.normal), probe.gap, probe.from);
    });
  });
}

}  // namespace

ProbeTruth truth_of(const AnyQuery& query, const Probe& probe) {
  std::optional<oracle::Time> within;
  if (probe.eta) within = oracle::first_within(oracle_motion(query), *probe.eta);
  const oracle::Certificate certificate{query.dimension, oracle_line(query, probe, 0), oracle_line(query, probe, 1),
                                        probe.normal, probe.gap};
  return {within ? std::optional(within->lower()) : std::nullopt, oracle::failure_time(certificate, probe.from)};
}

std::optional<std::string> difference(const AnyQuery& query, const Probe& probe, const ProbeTruth& truth,
                                      const DecideProbe& decide) {
  try {
    return compare(decide(query, probe), probe, truth);
  } catch (const std::exception& error) {
    return fmt::format("threw, asked for a distance or failure time: {}", error.what());
  }
}

ProbeDecision probe_with_kernel(const AnyQuery& query, const Probe& probe) {
  ProbeDecision decision;
  if (probe.eta) {
    visit(query, [&](const auto& typed) {
      decision.within = within_distance(typed, *probe.eta);
      if (const auto first = first_within(typed, *probe.eta)) decision.within_t = first->lower();
    });
  }
  decision.failure = query.dimension == 2 ? kernel_failure_time<2>(query, probe) : kernel_failure_time<3>(query, probe);
  return decision;
}

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
