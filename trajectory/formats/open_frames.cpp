// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/open_frames.h"

#include <unistd.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <noli/errors.h>
#include "trajectory/blocks/frames_file.h"
#include "trajectory/formats/arrays/array_frames.h"
#include "trajectory/formats/arrays/converted_frames.h"
#include "trajectory/formats/arrays/frames_in_memory.h"
#include "trajectory/formats/arrays/stream_frames.h"
#include "trajectory/formats/frame_inputs.h"
#include "trajectory/formats/frames.h"
#include "trajectory/formats/joined_frames.h"
#include "trajectory/formats/stored_frames.h"

namespace noli {
namespace {

/// The frames in a block file of frames.
class BlockFrames : public StoredFrames {
 public:
  /// Throws InputError: no such file, or none of frames.
  explicit BlockFrames(const std::filesystem::path& path)
      : StoredFrames({path}), reader_(path), count_(reader_->count()) {
    FrameFacts& facts = facts_of(0);
    facts.numbers = "float64";
    facts.vertices = reader_->mesh().vertex_count;
    facts.cells = reader_->mesh().cell_count();
    facts.frames = count_;
  }

  std::optional<std::size_t> count() const override { return count_; }
  std::optional<Frame> read(std::size_t k) override {
    if (k < next_) {
      reader_.emplace(facts()[0].file);
      next_ = 0;
    }
    std::optional<std::vector<Position>> positions;
    for (; next_ <= k; ++next_) {
      positions = reader_->next();
      if (!positions) break;
    }
    require_unchanged();
    if (!positions) return std::nullopt;
    if (k + 1 == count_) require_same_bytes();
    return Frame{reader_->mesh(), std::move(*positions)};
  }
  std::vector<std::string> notes() const override { return {}; }

 private:
  std::optional<FramesReader> reader_;
  std::size_t next_ = 0, count_ = 0;
};

}  // namespace

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
