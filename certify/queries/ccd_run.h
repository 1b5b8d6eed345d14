// SPDX-License-Identifier: Apache-2.0
//
// The work of `noli ccd`: decides files of queries, compares the answers with their labels, and measures time. It
// prints nothing.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include <noli/contact.h>
#include <noli/query.h>
#include <noli/time_of_impact.h>

namespace noli {

struct CcdRequest {
  std::vector<std::filesystem::path> files;
  std::optional<FeaturePair> pair;          ///< nothing: as in the name of each file
  int dimension = 3;                        ///< 2: z is ignored
  bool times = false;                       ///< also find the kind and time of each contact
  std::size_t max_reports = 100;            ///< the most disagreements to list
  const std::atomic<bool>* stop = nullptr;  ///< polled; when it becomes true, the outcome is not complete
  std::function<void(double)> progress;     ///< called with the share of the files that are done, in [0, 1]
};

/// A query whose label is not the exact answer.
struct Disagreement {
  std::size_t query = 0;  ///< from 1, in its file
  bool label = false;
};

/// A query in contact, with --times.
struct TimedContact {
  std::size_t query = 0;  ///< from 1, in its file
  ContactKind kind = ContactKind::touching;
  double time = 0;  ///< the largest double not above the exact time
};

struct CcdCounts {
  std::uint64_t queries = 0;  ///< decided
  std::uint64_t contacts = 0;
  std::uint64_t labelled = 0;
  std::uint64_t disagreements = 0;
  StageCounters stages;
  double ns_per_query = 0;  ///< mean; for files that take less than a second, the median of several passes

  CcdCounts& operator+=(const CcdCounts& other);
};

struct CcdFile {
  std::filesystem::path path;
  FeaturePair pair = FeaturePair::vertex_face;
  CcdCounts counts;
  std::vector<Disagreement> disagreements;  ///< at most max_reports
  std::vector<TimedContact> times;
};

struct CcdOutcome {
  std::vector<CcdFile> files;
  CcdCounts total;
  bool complete = true;  ///< false: interrupted

  bool refuted() const { return total.disagreements > 0; }
  bool holds() const { return complete && !refuted(); }
};

/// Reads all files, then decides them. Throws InputError, UsageError (no kind, no such kind in this dimension).
CcdOutcome run_ccd(const CcdRequest& request);

/// The kind of query in a file, if its name contains it.
std::optional<FeaturePair> query_kind(const std::filesystem::path& path);

}  // namespace noli
