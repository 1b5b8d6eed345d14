// SPDX-License-Identifier: Apache-2.0
//
// Fuzzing of somebody else's library of continuous collision detection: adversarial queries
// (audit/fuzz/queries/query_generators.h), those about vertex and face or two edges in 3D, asked of the library in a
// process of its own (audit/ccd/library_answers.h). The truth is the kernel's exact answer and first time; of a finding
// that is saved it is the oracle's too.
//
// Notation
//   block    as in audit/fuzz/fuzzing.h; block b is of generator b mod (number of those generators)
//   finding  a query on which the library has a fault that counts (audit/ccd/library_answers.h)
// Of the findings the simplest of each fault, kind of contact and generator is shrunk against the library and saved. At
// most `max_findings` are kept, missed crossings and ordinary queries before others; all are counted. What is shrunk
// keeps its fault and its kind of contact. Findings that are equal when shrunk become one.
//
// What this does not do: ask anything twice, measure time, or look for leaks (audit/ccd/ccd_audit.h).
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "audit/ccd/library_answers.h"
#include "audit/fuzz/queries/fuzz_queries.h"
#include "audit/fuzz/queries/query_corpus.h"

namespace noli::audit {

struct LibraryFuzzOptions : QueryFuzzSettings {
  LibraryUnderTest asked;
  bool first_only = false;  ///< stop behind the first block that has a finding
};

using FaultCounts = std::array<std::uint64_t, library_fault_count>;

struct LibraryFinding {
  FaultFound found{};          ///< of the shrunk query
  std::string generator;       ///< or "corpus/NAME"
  std::uint64_t block = 0;     ///< options.limits.seed, block and index make the query again
  std::size_t index = 0;       ///< within the block, or the corpus' file
  AnyQuery query, shrunk;      ///< as generated; simpler, with the same fault
  std::uint64_t alike = 0;     ///< how many findings were like it, with this generator
  std::filesystem::path file;  ///< where `shrunk` is
};

/// What a generator's queries came to.
struct LibraryTally {
  std::string name, attacks;
  std::uint64_t asked = 0, contacts = 0;
  FaultCounts faults{};  ///< those that do not count included
};

/// Items are queries that were asked, those of the corpus included.
struct LibraryFuzzReport : FuzzTotals {
  std::uint64_t contacts = 0;  ///< among them
  FaultCounts faults{};
  std::vector<LibraryFinding> findings;
  std::vector<LibraryTally> generators;
  CorpusTally corpus;
  bool knows_times = false;
};

/// With `limits.count` and without hangs or memory limits the report is the same for any number of threads. Throws
/// InputError (a library or a corpus that is not as it has to be), and what ask_library throws. What cannot be saved is
/// in `not_saved`.
LibraryFuzzReport fuzz_library(const LibraryFuzzOptions& options);

/// A simpler query with the same fault, and the fault of it. Precondition: it has that fault.
struct ShrunkForLibrary {
  AnyQuery query;
  FaultFound found;
};
ShrunkForLibrary shrink_for_library(const LibraryUnderTest& library, const AnyQuery& query, const FaultFound& fault,
                                    bool knows_times);

/// The faults of each of some queries, all of one pair; nothing where there is none that counts, or where it was not
/// asked any more, as it hung too often before.
struct FaultsFound {
  std::vector<std::optional<FaultFound>> faults;
  std::size_t asked = 0;
};
FaultsFound faults_of(const LibraryUnderTest& library, FeaturePair pair, std::span<const AnyQuery> queries,
                      bool knows_times);

}  // namespace noli::audit
