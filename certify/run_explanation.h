// SPDX-License-Identifier: Apache-2.0
//
// Summarises what happened in a run, from its files alone.
//
// Notation, in addition to that of include/noli/explain.h
//   bound              from certificates, for all pairs: none was nearer than eta(L + 1), L the deepest layer that was
//                      ever active
//   part               from the beginning of the run, or a resumption, to an end in the log. A part that was killed has
//                      no end, and its clocks and certificates are not in the log
//
// It verifies nothing (`noli verify RUN` does).
#pragma once

#include <filesystem>
#include <optional>

#include <noli/explain.h>
#include "certify/runs/run_log_facts.h"
#include "certify/runs/run_series.h"
#include "certify/simulate/phase_clock.h"

namespace noli {

/// The summary of a run, with facts from its log.
struct RunExplanation : RunSummary {
  LogFacts log;

  /// The least eta(L + 1) of all materials [m]; nothing without contact, or when the log is incomplete.
  std::optional<double> bound() const;
};

/// Throws InputError (no run, a damaged one, of an earlier version).
RunExplanation explain_run(const std::filesystem::path& run);

}  // namespace noli
