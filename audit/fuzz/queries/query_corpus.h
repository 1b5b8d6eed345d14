// SPDX-License-Identifier: Apache-2.0
//
// A folder of queries that reached something new, one for each signature.
//
// A signature has, with hyphens between them:
//   pair          vertex_face, edge_edge, vertex_edge, vertex_vertex
//   dimension     2d, 3d
//   stage         the stage of the kernel's cascade that settled whether they meet (include/noli/contact.h)
//   kind          of contact: apart, touching, crossing, persistent
//   when          they first meet: at_begin, inside, at_end, never
//   roots         how many different roots the orientation of their points has in [0, 1]: 0_roots, ..., 3_roots;
//                 coplanar when it is zero throughout; no_orientation for pairs that have none
//   answer        of a library, where one is asked: no_hit, hit_exact, hit_late, hit_early_N_bits (N = 0, 8, ..., 48:
//                 by 2^-N of the step at most), hit_no_time, hit_bad_time, false_hit, failure, crash, hang, memory
// It depends on the query (and the library) alone, so what a folder holds can be judged anew at any time.
//
// What this does not do: forget. A file stays, even when its query no longer reaches what its name says.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <noli/contact.h>
#include <noli/time_of_impact.h>
#include "audit/ccd/library_answers.h"
#include "audit/fuzz/fuzzing.h"
#include "audit/fuzz/queries/saved_query.h"
#include "certify/queries/any_query.h"

namespace noli::audit {

/// The stage of the kernel that settled a query.
std::optional<Stage> deciding_stage(const StageCounters& counters);

/// What a query reached in the kernel. `first`: the first time of contact, rounded down; not used when apart.
std::string signature(const AnyQuery& query, std::optional<Stage> stage, ContactKind kind, double first);

/// The same, with what a library said.
std::string signature_of_answer(const LibraryAnswer& answer, const std::optional<double>& exact);

struct CorpusQuery {
  SavedQuery saved;
  std::string name;       ///< of its file, without ".csv"
  std::size_t index = 0;  ///< in its file, from 0
};

/// Signatures that some queries reached, each with one such query and whether that query is in contact.
struct ReachingQuery {
  SavedQuery saved;
  bool contact = false;
};
using Reached = std::map<std::string, ReachingQuery>;

/// What a run did with its corpus.
struct CorpusTally {
  std::uint64_t replayed = 0;    ///< queries that were in the folder
  std::uint64_t signatures = 0;  ///< reached, those of the folder's queries included
  std::uint64_t kept = 0;        ///< files that were added
  friend bool operator==(const CorpusTally&, const CorpusTally&) = default;
};

class QueryCorpus {
 public:
  /// Reads all files *.csv of the folder, in the order of their names. A folder that is not there is empty. Throws
  /// InputError.
  explicit QueryCorpus(std::filesystem::path folder);

  const std::vector<CorpusQuery>& queries() const { return queries_; }

  /// Takes note that this was reached; false if it had been before.
  bool reached(const std::string& signature) { return reached_.insert(signature).second; }

  /// Writes the query to SIGNATURE.csv, or SIGNATURE-2.csv if there is such a file. Throws std::system_error.
  void keep(const std::string& signature, const SavedQuery& saved, bool contact);

  /// Adds the queries with new signatures to the corpus.
  void keep_new(const Reached& reached, NotSaved& not_saved);

  std::uint64_t kept() const { return kept_; }
  void count(CorpusTally& tally) const { tally.signatures = reached_.size(), tally.kept = kept_; }

 private:
  std::filesystem::path folder_;
  std::vector<CorpusQuery> queries_;
  std::set<std::string> reached_;
  std::uint64_t kept_ = 0;
};

}  // namespace noli::audit
