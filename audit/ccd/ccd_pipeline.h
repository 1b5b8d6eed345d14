// SPDX-License-Identifier: Apache-2.0
//
// Audits whole pipelines of collision detection on one step of a mesh: the library's search for candidates
// (noli_ccd_candidates), then its query for each of them. The truth is every contact of the step, from the verifier,
// with its exact first time.
//
// Words
//   through      who goes to the first time of impact that the library tells, or, if it tells none, to the end of the
//                step, goes through a contact
//   not found    a contact that is not among the candidates
//   and as in audit/ccd/ccd_audit.h: false positive, false negative (of the query), late, early, bad time
//
// What this does not do: count contacts other than vertex-face and edge-edge, or compare answers when it asks again. It
// does not start a process again that crashed: the rest is not looked at.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "audit/ccd/ccd_audit.h"
#include "proofs/prover/verifier.h"
#include "trajectory/formats/frame_look.h"
#include "trajectory/formats/polygons.h"

namespace noli::audit {

struct PipelineRequest {
  std::vector<std::filesystem::path> libraries;
  std::filesystem::path before, after;  ///< frames of one mesh
  std::vector<double> tolerances;
  std::size_t max_reports = 5;  ///< for each library and tolerance
  HostOptions host;
  PolygonRule polygons = PolygonRule::fan;
  bool needs_search = true;      ///< else a library without a search is asked about all pairs
  bool exact = false;            ///< early times and a false positive are reported too
  bool knows_times = false;      ///< contacts that are hit without a time are reported
  bool looks_for_leaks = false;  ///< does it all again, for host.repeat_seconds
};

/// A contact of the step that a library does not tell as it is, or a pair that is none.
struct PipelineFinding {
  FeatureContact contact;       ///< numbers of the frames' vertices
  std::string what;             ///< "not_found", "false_negative", "failure", "bad_time" or "late"; see PipelineRequest
  std::string words;            ///< times, as parts of the step
  std::optional<double> exact;  ///< the first time, rounded down; nothing where they stay apart
};

/// One library with one tolerance. Pairs of numbers are [vertex-face, edge-edge].
struct PipelineAudit {
  std::filesystem::path plugin;
  double tolerance = 0;
  std::array<std::uint64_t, 2> candidates{}, false_positives{};
  bool searched = true;  ///< false: the search for candidates failed
  bool through = false;
  bool leaks = false;
  std::optional<FeatureContact> asked;   ///< the last query, where it was not all done
  bool in_search = false;                ///< the process ended there
  std::optional<FeatureContact> failed;  ///< the first query without an answer
  std::uint64_t not_found = 0, false_negatives = 0, bad_times = 0;
  std::uint64_t failures = 0;   ///< of the search or of queries
  std::uint64_t bad_pairs = 0;  ///< candidates that are no two features without a vertex in common; not asked
  TimeErrors late, early;
  std::vector<PipelineFinding> reports;  ///< of contacts, in their order; at most max_reports
  Ending ending;                         ///< of the process; without words where all was done
  double search_seconds = 0, query_seconds = 0;

  std::uint64_t findings() const;
};

struct PipelineOutcome {
  std::uint64_t vertices = 0, edges = 0, faces = 0;
  std::array<std::uint64_t, 2> contacts{};
  std::optional<double> first_time;  ///< of the first of them, rounded down
  double noli_seconds = 0;           ///< what the verifier takes to find them all, on one thread
  std::vector<PipelineAudit> audits;
  bool complete = true;
  std::vector<FrameFacts> inputs;  ///< the two frames, where they are files
  std::vector<std::string> notes;  ///< what to know of them, a line each

  std::uint64_t findings() const;
};

/// Throws InputError (a library or frame is not as it has to be; different meshes) and what HostProcess throws.
PipelineOutcome audit_pipeline(const PipelineRequest& request);

/// The same for a step that is not in files: before and after are not looked at.
PipelineOutcome audit_pipeline(const PipelineRequest& request, const Mesh& mesh, std::span<const Position> x_t0,
                               std::span<const Position> x_t1);

}  // namespace noli::audit
