// SPDX-License-Identifier: Apache-2.0
#include "audit/ccd/library_answers.h"

#include <fmt/format.h>
#include <noli/ccd_plugin.h>

#include <cmath>

namespace noli::audit {

namespace {

int plugin_kind(FeaturePair pair) { return pair == FeaturePair::edge_edge ? NOLI_CCD_EDGE_EDGE : NOLI_CCD_VERTEX_FACE; }

/// In contact at 1/2, in the middle of both features.
AnyQuery plain_query(FeaturePair pair) {
  AnyQuery query{pair, 3, {}, {}};
  if (pair == FeaturePair::edge_edge) {
    query.x_t0 = {{{-1, 0, 1}, {1, 0, 1}, {0, -1, 0}, {0, 1, 0}}};
  } else {
    query.x_t0 = {{{0, 0, 1}, {-4, -4, 0}, {4, -4, 0}, {0, 8, 0}}};
  }
  query.x_t1 = query.x_t0;
  for (std::size_t i = 0; i < first_size(pair); ++i) query.x_t1[i][2] = -1;
  return query;
}

std::string words(const ExactContact& exact) {
  return fmt::format("they meet at {:.17g} ({})", exact.time, name(exact.kind));
}

std::optional<FaultFound> fault_of_time(double time, const ExactContact& exact, bool knows_times,
                                        double late_tolerance) {
  const auto found = [&](LibraryFault fault) {
    return FaultFound{fault, exact.kind, fmt::format("{}: {:.17g}, {}", name(fault), time, words(exact))};
  };
  if (std::isnan(time)) return knows_times ? std::optional(found(LibraryFault::no_time)) : std::nullopt;
  if (!(time >= 0 && time <= 1)) return found(LibraryFault::bad_time);
  const bool near_enough = time > exact.time && time - exact.time <= late_tolerance;
  if (time == exact.time || near_enough) return std::nullopt;
  return found(time > exact.time ? LibraryFault::late : LibraryFault::early);
}

}  // namespace

std::vector<LibraryAnswer> ask(const LibraryUnderTest& library, FeaturePair pair, std::span<const AnyQuery> queries) {
  std::vector<AskedQuery> all;
  for (const AnyQuery& query : queries) all.push_back(asked(query));
  HostOptions host = library.host;
  host.repeat_seconds = 0;
  LibraryAnswers answers = ask_library(library.path, plugin_kind(pair), all, library.tolerance, host);
  std::vector<LibraryAnswer> result;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    result.push_back({answers.answers[i], std::move(answers.endings[i])});
  }
  return result;
}

bool knows_times(const LibraryUnderTest& library) {
  for (const FeaturePair pair : {FeaturePair::vertex_face, FeaturePair::edge_edge}) {
    const AnyQuery query = plain_query(pair);
    const GivenAnswer given = ask(library, pair, std::span(&query, 1)).at(0).given;
    if (given.state == AnswerState::answered && given.code > 0 && !std::isnan(given.time)) return true;
  }
  return false;
}

std::optional<ExactContact> exact_contact(const AnyQuery& query) {
  return visit(query, [](const auto& typed) {
    const auto first = first_contact(typed);
    return first ? std::optional(ExactContact{first->time.lower(), first->kind}) : std::nullopt;
  });
}

std::optional<FaultFound> fault_of(const LibraryAnswer& answer, const std::optional<ExactContact>& exact,
                                   bool knows_times, double late_tolerance) {
  const auto found = [&](LibraryFault fault, const std::string& more) {
    return FaultFound{fault, exact ? exact->kind : ContactKind::apart, fmt::format("{}: {}", name(fault), more)};
  };
  if (answer.given.state == AnswerState::not_asked) return std::nullopt;
  if (const auto ended = ending_of(answer.given.state)) return found(*ended, answer.ending);
  const int code = answer.given.code;
  if (code != NOLI_CCD_HIT && code != NOLI_CCD_NO_HIT)
    return found(LibraryFault::failure, fmt::format("code {}", code));
  const bool hit = code != NOLI_CCD_NO_HIT;
  if (hit && exact) return fault_of_time(answer.given.time, *exact, knows_times, late_tolerance);
  if (hit) return found(LibraryFault::false_positive, "hit, but they stay apart");
  if (!exact) return std::nullopt;
  return found(LibraryFault::false_negative, "no hit, " + words(*exact));
}

int rank(LibraryFault fault) {
  switch (fault) {
    case LibraryFault::false_negative: return 0;
    case LibraryFault::crash: return 1;
    case LibraryFault::hang: return 2;
    case LibraryFault::memory: return 3;
    case LibraryFault::failure: return 4;
    case LibraryFault::bad_time: return 5;
    case LibraryFault::no_time: return 6;
    case LibraryFault::false_positive: return 7;
    case LibraryFault::early: return 8;
    case LibraryFault::late: return 9;
  }
  return 10;
}

}  // namespace noli::audit
