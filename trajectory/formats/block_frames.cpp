// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/block_frames.h"

#include <utility>

namespace noli {

BlockFrames::BlockFrames(const std::filesystem::path& path)
    : StoredFrames({path}), reader_(path), count_(reader_->count()) {
  FrameFacts& facts = facts_of(0);
  facts.numbers = "float64";
  facts.vertices = reader_->mesh().vertex_count;
  facts.cells = reader_->mesh().cell_count();
  facts.frames = count_;
}

std::optional<Frame> BlockFrames::read(std::size_t k) {
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

}  // namespace noli
