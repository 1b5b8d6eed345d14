// SPDX-License-Identifier: Apache-2.0
//
// The member `plots` of a report's page (report_page.h): series of a run over time, thinned.
#pragma once

#include <span>

#include "certify/json.h"
#include "certify/runs/run_series.h"

namespace noli::report {

/// Energies, momentum, smallest step, nearest contact, events, of at most so many windows: of neighbours that are shown
/// as one, the last, the least or the sum, whichever the series is about. What does not occur in a run has no plot.
Json report_plots(std::span<const SeriesRow> rows);

}  // namespace noli::report
