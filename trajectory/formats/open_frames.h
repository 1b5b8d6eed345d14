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

/// `names`: files in the order of time: PLY and OBJ, one block file of frames, one .npz, or .npy files, - for standard
/// input. Throws InputError
/// for what is no frame by its name, and for headers that are not as they have to be; reads no frame yet.
/// `reading.bodies`: these, joined, instead of `names`.
std::unique_ptr<FrameSource> open_frames(const std::vector<std::filesystem::path>& names,
                                         const FrameReading& reading = {});

}  // namespace noli
