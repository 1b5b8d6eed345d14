// SPDX-License-Identifier: Apache-2.0
//
// What happened in a run, from its files alone.
//
// Notation, beside that of include/noli/explain.h
//   bound              what certificates say of all pairs: none was nearer than eta(L + 1), L the deepest layer that
//                      was ever active
//   part               from the run's begin or a resumption to its end, if it came to one: a part that was killed has
//                      none, and what it would have said of clocks and certificates is lost
//
// What this does not do: it verifies nothing (`noli verify RUN` does).
#pragma once

#include <filesystem>
#include <optional>

#include <noli/explain.h>
#include "certify/runs/run_log_facts.h"
#include "certify/runs/run_series.h"
#include "certify/simulate/phase_clock.h"

namespace noli {

/// With what its log says.
struct RunExplanation : RunSummary {
  LogFacts log;

  /// Of these materials, the least eta(L + 1) [m]; nothing without contact, or when the log does not tell it all.
  std::optional<double> bound() const;
};

/// Throws InputError (no run, a damaged one, of an earlier version).
RunExplanation explain_run(const std::filesystem::path& run);

}  // namespace noli
