// SPDX-License-Identifier: Apache-2.0
//
// Audits libraries of continuous collision detection: what they answer (audit/ccd/ccd_library.h) against what is true.
// The truth is the kernel's exact answer and exact first time.
//
// Words
//   false positive   "hit" where the features stay apart
//   false negative   "no hit" where they meet
//   late             a time of impact after the first time at which they meet; a simulation that goes there is through
//   early            one before it, or the very time, rounded down
//   no time          none (NaN) for a contact, by a library that gives some in the same file
//   bad time         one outside [0, 1]
//   changed          asked again, the library gave another answer
// Findings are all of these but false positives and early times, and failures, crashes, hangs and leaks.
//
// What this does not do: it writes nothing (app/audit/audit_ccd_command.cpp).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "audit/ccd/ccd_library.h"
#include "trajectory/formats/query_csv.h"

namespace noli::audit {

struct AuditRequest {
  std::vector<std::filesystem::path> libraries;
  std::vector<std::filesystem::path> files;
  std::vector<double> tolerances = {1e-6};
  std::size_t max_reports = 5;  ///< for each library, tolerance and file
  HostOptions host;
  std::function<void(double)> progress;  ///< share of the work that is done
};

/// How far times of impact are from the exact ones, as parts of the step.
class TimeErrors {
 public:
  void add(double error, double relative);
  void add(const TimeErrors& other);
  std::size_t count() const { return errors_.size(); }
  /// 0 where there are none.
  double median() const { return quantile(errors_, 0.5); }
  double worst() const { return quantile(errors_, 1); }
  double median_relative() const { return quantile(relative_, 0.5); }
  double worst_relative() const { return quantile(relative_, 1); }

 private:
  static double quantile(std::vector<double> values, double share);

  std::vector<double> errors_, relative_;
};

struct AuditCounts {
  std::uint64_t queries = 0, answered = 0, failures = 0;
  std::uint64_t false_positives = 0, false_negatives = 0;
  std::uint64_t times = 0;  ///< given, of hits that are contacts
  std::uint64_t bad_times = 0, changed = 0;
  std::uint64_t no_times = 0;  ///< of contacts that were hit, by a library that gave some
  std::uint64_t crashes = 0, hangs = 0, memory = 0, leaks = 0;
  TimeErrors late, early;
  double unit_seconds = 0;  ///< what the textbook method takes for all queries
  double seconds = 0;       ///< what the library takes for them
  double slowest_ns = 0;    ///< of the first answers

  AuditCounts& operator+=(const AuditCounts& other);
  /// How many findings there are.
  std::uint64_t findings() const;
  double ns_per_query() const;
  /// How many times as long as the textbook method; 0 where that was not measured.
  double units() const;
};

struct AuditFinding {
  std::size_t query = 0;  ///< from 1, in its file
  std::string what;       ///< "false_negative", "late", ...
  std::string words;      ///< more of it, if there is more
};

/// One library with one tolerance on one file.
struct FileAudit {
  std::size_t file = 0;  ///< in AuditOutcome::files
  AuditCounts counts;
  std::vector<AuditFinding> findings;        ///< at most max_reports; late times behind all others
  std::vector<std::size_t> false_positives;  ///< queries, from 1; at most max_reports
  double growth_per_query = 0;               ///< bytes of memory, when asked again
  bool complete = true;
};

/// One library with one tolerance.
struct LibraryAudit {
  std::filesystem::path plugin;
  double tolerance = 0;
  std::string description;  ///< what it says that it is; "" if it says nothing
  std::string said;         ///< the end of what it wrote last to its standard error
  std::vector<FileAudit> files;
  AuditCounts total;
};

struct AuditedFile {
  std::filesystem::path path;
  QueryKind kind = QueryKind::vertex_face;
  std::uint64_t queries = 0, contacts = 0, labelled = 0;
  std::vector<std::size_t> wrong_labels;  ///< queries, from 1, whose label is not the exact answer
  double unit_ns = 0;                     ///< the textbook method, a query
};

struct AuditOutcome {
  std::vector<AuditedFile> files;
  std::vector<LibraryAudit> audits;  ///< library by library, tolerance by tolerance
  bool complete = true;              ///< false: interrupted, out of time, or a library was given up

  std::uint64_t findings() const;
  std::uint64_t wrong_labels() const;
};

/// Throws InputError (a library or file is not as it has to be; a file of other queries than these libraries know) and
/// what ask_library throws.
AuditOutcome audit_ccd(const AuditRequest& request);

}  // namespace noli::audit
