// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/block_frames.h"

#include <utility>

namespace noli {

BlockFrames::BlockFrames(const std::filesystem::path& path)
    : OneFileFrames(path), reader_(path), count_(reader_->count()) {
  describe("float64", reader_->mesh().vertex_count, reader_->mesh().cell_count(), count_);
}

std::optional<Frame> BlockFrames::read(std::size_t k) {
  if (k < next_) {
    reader_.emplace(file());
    next_ = 0;
  }
  std::optional<std::vector<Position>> positions;
  for (; next_ <= k; ++next_) {
    positions = reader_->next();
    if (!positions) break;
  }
  require_unchanged();
  if (!positions) return std::nullopt;
  return Frame{reader_->mesh(), std::move(*positions)};
}

}  // namespace noli
