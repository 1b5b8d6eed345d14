// SPDX-License-Identifier: Apache-2.0
//
// Reads frames of HDF5 through noli_series (certify/series), a child with limits of its own.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include <noli/frames.h>
#include "trajectory/formats/frame_source.h"

namespace noli {

/// open_frames() (trajectory/formats/open_frames.h), which also reads HDF5 if noli_series is beside this program.
std::unique_ptr<FrameSource> open_all_frames(const std::vector<std::filesystem::path>& names,
                                             FrameReading reading = {});

}  // namespace noli
