// SPDX-License-Identifier: Apache-2.0
//
// Writes `series.h5` of a run from its windows: energies, momenta, works, counts and lengths of steps
// (certify/runs/step_histogram.h) at the ends of windows, and frames.
#pragma once

#include <filesystem>
#include <functional>

#include <noli/run.h>

namespace noli {

/// Creates or replaces RUN/series.h5. Frames are at the multiples of 1 / frame_rate; if the run recorded only frames,
/// they are those. `stop` is called after each window and frame. In memory: one window. Throws InputError (damaged run,
/// or its folder has a link in place of the file), WriteError (disk, noli_series), std::system_error.
SeriesEnd write_series_file(const std::filesystem::path& run, double frame_rate, const std::function<bool()>& stop);

}  // namespace noli
