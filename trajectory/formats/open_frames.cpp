// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/open_frames.h"

#include <unistd.h>

#include <algorithm>

#include <noli/errors.h>
#include "trajectory/blocks/frames_file.h"
#include "trajectory/formats/arrays/array_frames.h"
#include "trajectory/formats/arrays/converted_frames.h"
#include "trajectory/formats/arrays/frames_in_memory.h"
#include "trajectory/formats/arrays/stream_frames.h"
#include "trajectory/formats/block_frames.h"
#include "trajectory/formats/frame_inputs.h"
#include "trajectory/formats/frames.h"
#include "trajectory/formats/joined_frames.h"

namespace noli {

bool holds_frames(const std::filesystem::path& path) {
  return is_frame_name(path) || is_array_name(path) || is_hdf5_name(path) || is_frames_file(path);
}

std::unique_ptr<FrameSource> open_frames(const std::vector<std::filesystem::path>& names, const FrameReading& reading) {
  if (reading.given) return std::make_unique<FramesInMemory>(names.at(0).string(), reading.given);
  if (!reading.bodies.empty()) return std::make_unique<JoinedFrames>(reading.bodies, reading);
  const bool of_arrays = !names.empty() && is_array_name(names[0]);
  if (!reading.keys.empty() && !of_arrays) {
    throw UsageError("--keys: names arrays of a .npz file; expected one, or no --keys");
  }
  const auto dash = std::ranges::find(names, "-");
  if (dash != names.end()) {
    if (names.size() > 1) throw UsageError("-: standard input has all frames; expected no other file");
    return std::make_unique<StreamFrames>(std::make_unique<FileBytes>(::dup(STDIN_FILENO), "standard input"));
  }
  if (names.size() == 1 && !is_frame_name(names[0]) && is_frames_file(names[0])) {
    return std::make_unique<BlockFrames>(names[0]);
  }
  if (!names.empty() && is_hdf5_name(names[0])) {
    if (reading.hdf5 == nullptr) {
      throw InputError(names[0].string(), "",
                       "is an HDF5 file; noli_series, which reads it, is missing (build with NOLI_WITH_HDF5=ON)");
    }
    return std::make_unique<ConvertedFrames>(names, reading.hdf5, reading.polygons);
  }
  if (of_arrays) return std::make_unique<ArrayFrames>(names, reading.keys);
  return std::make_unique<FrameInputs>(names, reading.polygons, reading.ahead);
}

}  // namespace noli
