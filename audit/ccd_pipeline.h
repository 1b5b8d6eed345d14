// SPDX-License-Identifier: Apache-2.0
//
// Audits whole pipelines of collision detection on one step of a mesh: the library's search for candidates
// (noli_ccd_candidates), then its query for each of them. The truth is every contact of the step, from the verifier,
// with its exact first time.
//
// Words
//   not found    a contact that is not among the candidates
//   and as in audit/ccd_audit.h: false positive, false negative (of the query), late, early, bad time
//
// What this does not do: count contacts other than vertex-face and edge-edge, or look at a candidate more than once. It
// does not start a process again that crashed: the rest is not looked at.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "noli/audit/ccd_audit.h"
#include "noli/proofs/prover/verifier.h"

namespace noli::audit {

struct PipelineRequest {
  std::vector<std::filesystem::path> libraries;
  std::filesystem::path before, after;  ///< frames of one mesh
  std::vector<double> tolerances;
  std::size_t max_reports = 5;  ///< for each library and tolerance
  HostOptions host;
};

/// A contact of the step that a library does not tell as it is.
struct PipelineFinding {
  FeatureContact contact;  ///< numbers of the frames' vertices
  std::string what;        ///< "not_found", "false_negative", "failure", "bad_time" or "late"
  std::string words;       ///< times, as parts of the step
};

/// One library with one tolerance. Pairs of numbers are [vertex-face, edge-edge].
struct PipelineAudit {
  std::filesystem::path plugin;
  double tolerance = 0;
  std::array<std::uint64_t, 2> candidates{}, false_positives{};
  std::uint64_t not_found = 0, false_negatives = 0, bad_times = 0;
  std::uint64_t failures = 0;   ///< of the search or of queries
  std::uint64_t bad_pairs = 0;  ///< candidates that are no two features without a vertex in common; not asked
  TimeErrors late, early;
  std::vector<PipelineFinding> reports;  ///< of contacts, in their order; at most max_reports
  std::string ending;  ///< how the process ended before all was done, in words; "" if it did not
  Ending::Kind end = Ending::Kind::finished;
  double search_seconds = 0, query_seconds = 0;

  std::uint64_t findings() const;
};

struct PipelineOutcome {
  std::uint64_t vertices = 0, edges = 0, faces = 0;
  std::array<std::uint64_t, 2> contacts{};
  double noli_seconds = 0;  ///< what the verifier takes to find them all, on one thread
  std::vector<PipelineAudit> audits;
  bool complete = true;

  std::uint64_t findings() const;
};

/// Throws InputError (a library or frame is not as it has to be; different meshes) and what HostProcess throws.
PipelineOutcome audit_pipeline(const PipelineRequest& request);

}  // namespace noli::audit
