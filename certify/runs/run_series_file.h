// SPDX-License-Identifier: Apache-2.0
//
// `series.h5` of a run, made from its windows: energies, momenta, works, counts and how long steps are
// (certify/runs/step_histogram.h) at the ends of windows, and frames.
#pragma once

#include <filesystem>
#include <functional>

#include <noli/run.h>

namespace noli {

/// Writes RUN/series.h5, or replaces it. Frames are at the multiples of 1 / frame_rate; of a run that recorded frames
/// alone, those that it has. `stop` is asked after each window and frame. In memory: a window. Throws InputError
/// (damaged run, or its folder has a link where the file is written), WriteError (disk, noli_series),
/// std::system_error.
SeriesEnd write_series_file(const std::filesystem::path& run, double frame_rate, const std::function<bool()>& stop);

}  // namespace noli
