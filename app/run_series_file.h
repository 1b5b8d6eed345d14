// SPDX-License-Identifier: Apache-2.0
//
// `series.h5` of a run, made from its windows: energies, momenta, works and counts at the ends of windows, and frames.
#pragma once

#include <filesystem>

namespace noli::app {

/// Writes RUN/series.h5, or replaces it. Frames are at the multiples of 1 / frame_rate; of a run that recorded frames
/// alone, those that it has. False when Noli was built without HDF5. Throws InputError (damaged run),
/// std::system_error.
bool write_series_file(const std::filesystem::path& run, double frame_rate);

}  // namespace noli::app
