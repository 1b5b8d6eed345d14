// SPDX-License-Identifier: Apache-2.0
//
// What a library of continuous collision detection answers to single queries, and what is wrong with it: for fuzzing,
// where nobody knows beforehand which queries will be asked.
//
// Faults, of a query whose features meet first at t*
//   false_negative   "no hit", but they meet
//   late             a time after t*, by more than `late_tolerance`
//   bad_time         one outside [0, 1]
//   no_time          none (NaN), though the library knows times (`knows_times`)
//   failure          an answer but "hit" and "no hit"
//   crash, hang, memory   how the process ended in which the library ran
// and of one that claims to be exact also
//   false_positive   "hit", but they stay apart
//   early            a time that is not t* rounded down to double
//
// What this does not do: ask anything twice, so memory that leaks and answers that change are not found
// (audit/ccd/ccd_audit.h finds them).
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <noli/time_of_impact.h>
#include "audit/ccd/ccd_library.h"
#include "certify/queries/any_query.h"

namespace noli::audit {

/// A library, and what it says of itself.
struct LibraryUnderTest {
  std::filesystem::path path;
  double tolerance = 1e-6;    ///< passed to the library; a length
  bool exact = false;         ///< it claims to be: false positives and early times are faults
  double late_tolerance = 0;  ///< times that are late by no more than that are no faults; part of the step
  HostOptions host;           ///< nothing is asked again, whatever `repeat_seconds`
};

enum class LibraryFault {
  false_negative,
  late,
  bad_time,
  no_time,
  failure,
  crash,
  hang,
  memory,
  false_positive,
  early
};

constexpr std::size_t library_fault_count = 10;

/// The name used in JSON: "false_negative", ...
constexpr std::string_view name(LibraryFault fault) {
  constexpr std::array<std::string_view, library_fault_count> names = {
      "false_negative", "late", "bad_time", "no_time", "failure", "crash", "hang", "memory", "false_positive", "early"};
  return names[static_cast<std::size_t>(fault)];
}

/// Whether the library answered, if wrongly.
constexpr bool is_answer(LibraryFault fault) {
  return fault != LibraryFault::failure && fault != LibraryFault::crash && fault != LibraryFault::hang &&
         fault != LibraryFault::memory;
}

/// How a query ended the process in which it was asked, if it did.
constexpr std::optional<LibraryFault> ending_of(AnswerState state) {
  switch (state) {
    case AnswerState::crashed: return LibraryFault::crash;
    case AnswerState::hung: return LibraryFault::hang;
    case AnswerState::too_much_memory: return LibraryFault::memory;
    case AnswerState::not_asked:
    case AnswerState::answered: break;
  }
  return std::nullopt;
}

/// The two pairs of features that libraries answer for, both in 3D.
constexpr bool is_library_query(const QueryType& type) {
  return type.dimension == 3 && (type.pair == FeaturePair::vertex_face || type.pair == FeaturePair::edge_edge);
}

struct LibraryAnswer {
  GivenAnswer given;
  std::string ending;  ///< how the process ended at this query, in words; "" where it did not
};

/// Asks them in one process, or in as many as it takes; after `host.most_hangs` hangs the rest is not asked. All
/// queries are of that pair. Throws what ask_library throws.
std::vector<LibraryAnswer> ask(const LibraryUnderTest& library, FeaturePair pair, std::span<const AnyQuery> queries);

/// Whether it gives times of impact at all: for a vertex that falls through the middle of a face, or for two edges
/// that cross. One that does not leaves them NaN.
bool knows_times(const LibraryUnderTest& library);

/// What the kernel says of features that meet.
struct ExactContact {
  double time;  ///< the first, rounded down
  ContactKind kind;
};

/// Nothing when they stay apart.
std::optional<ExactContact> exact_contact(const AnyQuery& query);

struct FaultFound {
  LibraryFault fault;
  ContactKind kind;   ///< of the contact; apart where there is none
  std::string words;  ///< "late: 0.50000000000000011, they meet at 0.5 (crossing)"
  /// Whether it is the same fault with the same kind of contact; where there is no answer the kind does not matter.
  bool is_like(const FaultFound& other) const {
    return fault == other.fault && (kind == other.kind || !is_answer(fault));
  }
};

/// What is wrong with an answer, false positives and early times included: whether they count is the caller's to say
/// (`counts`). Nothing for a query that was not asked.
std::optional<FaultFound> fault_of(const LibraryAnswer& answer, const std::optional<ExactContact>& exact,
                                   bool knows_times, double late_tolerance = 0);

/// The order in which findings are listed: missed contacts first, then crashes and failures, late times last.
int rank(LibraryFault fault);

/// Whether it is a finding with a library that claims that.
constexpr bool counts(LibraryFault fault, bool exact) {
  return exact || (fault != LibraryFault::false_positive && fault != LibraryFault::early);
}

}  // namespace noli::audit
