// SPDX-License-Identifier: Apache-2.0
//
// Where a run is at one time, for pictures.
#pragma once

#include <filesystem>

#include "certify/runs/run_series_reader.h"

namespace noli::report {

/// A sample of the world lines or, of a run that recorded frames alone, the frame that is nearest. Reads windows up to
/// there. Throws InputError when the run does not reach that time; ReadInterrupted.
RunFrame run_frame_at(SeriesReader& reader, const std::filesystem::path& run, double time);

}  // namespace noli::report
