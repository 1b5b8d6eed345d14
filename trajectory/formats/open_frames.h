// SPDX-License-Identifier: Apache-2.0
//
// Opens frames, whatever holds them.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "trajectory/formats/frame_source.h"

namespace noli {

/// Whether a file has frames, by its name or its first bytes.
bool holds_frames(const std::filesystem::path& path);

/// `names`: files in the order of time (PLY, OBJ, VTU and VTP; .npy; HDF5), one .npz, one block file of frames, or -
/// for standard input. `reading.bodies`: these, joined, instead of `names`; `reading.given`: those. Reads no frame yet.
/// Throws InputError for an unknown kind of file and for bad headers.
std::unique_ptr<FrameSource> open_frames(const std::vector<std::filesystem::path>& names,
                                         const FrameReading& reading = {});

}  // namespace noli
