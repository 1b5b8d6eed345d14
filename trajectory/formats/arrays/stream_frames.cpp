// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/arrays/stream_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <noli/errors.h>
#include "trajectory/blocks/sha256.h"
#include "trajectory/cells.h"
#include "trajectory/formats/arrays/array_choice.h"
#include "trajectory/formats/arrays/array_values.h"

namespace noli {

/// The bytes, counted and hashed on their way.
class StreamFrames::Hashed : public ByteStream {
 public:
  explicit Hashed(std::unique_ptr<ByteStream> bytes) : bytes_(std::move(bytes)) {}

  std::size_t read(char* to, std::size_t size) override {
    const std::size_t got = bytes_->read(to, size);
    hash_.update({to, got});
    count_ += got;
    return got;
  }
  std::uint64_t count() const { return count_; }
  Sha256Digest digest() const { return hash_.digest(); }

 private:
  std::unique_ptr<ByteStream> bytes_;
  Sha256 hash_;
  std::uint64_t count_ = 0;
};

StreamFrames::StreamFrames(std::unique_ptr<ByteStream> bytes, std::string file)
    : bytes_(std::make_unique<Hashed>(std::move(bytes))), stream_(file == "-" ? "standard input" : file), facts_(1) {
  facts_[0].file = std::move(file);
  facts_[0].frames = 0;
}

StreamFrames::~StreamFrames() = default;

std::string StreamFrames::name(std::size_t k) const { return fmt::format("{}[{}]", facts_[0].file, k); }

std::optional<NpyHeader> StreamFrames::next_array() {
  auto header = read_npy_header(*bytes_, array_name(arrays_ + 1));
  if (header) ++arrays_;
  return header;
}

/// Up to the first array that has none.
void StreamFrames::read_cells() {
  auto header = next_array();
  std::vector<std::pair<std::vector<std::int64_t>, std::size_t>> cells;
  for (; header && is_cells(*header); header = next_array()) {
    const std::size_t corners = corners_of(*header);
    if (std::ranges::count(cells, corners, [](const auto& one) { return one.second; }) > 0) {
      throw InputError(
          array_name(), "",
          fmt::format("is {}, and so was an array before; expected one of each kind of cell, then positions, "
                      "which are real numbers",
                      header->text()));
    }
    cells.emplace_back(integers_of(*bytes_, *header, array_name()), corners);
  }
  if (!header) throw InputError(stream_, "", "ends before its first frame; expected cells, then positions");
  require_frame(*header);
  mesh_.vertex_count = header->shape[0];
  for (std::size_t i = 0; i < cells.size(); ++i) {
    append_cells(mesh_, cells[i].first, cells[i].second, array_name(i + 1));
  }
  drop_redundant_cells(mesh_);
  first_ = *header;
  facts_[0].numbers = header->type();
  facts_[0].vertices = mesh_.vertex_count;
  facts_[0].cells = mesh_.cell_count();
}

std::string StreamFrames::array_name(std::size_t array) const {
  return facts_[0].file == "-" ? fmt::format("{}, array {}", stream_, array) : name(frames_);
}

void StreamFrames::require_frame(const NpyHeader& header) const {
  if (!is_one_frame(header)) {
    throw InputError(
        array_name(), "",
        fmt::format("is {}; expected the positions of a frame, real numbers of shape (vertices, 3)", header.text()));
  }
  const bool first = frames_ == 0 && !first_;
  constexpr std::uint64_t most_vertices = 0xffffffff;
  if (first && (header.shape[0] == 0 || header.shape[0] > most_vertices)) {
    throw InputError(array_name(), "", fmt::format("is {}; expected 1 to {} vertices", header.text(), most_vertices));
  }
  if (!first && header.shape[0] != mesh_.vertex_count) {
    throw InputError(array_name(), "",
                     fmt::format("is {}, but frame 0 has {} vertices; all frames must have the same", header.text(),
                                 mesh_.vertex_count));
  }
}

std::optional<Frame> StreamFrames::read(std::size_t k) {
  if (k < frames_) throw std::logic_error("a stream is read once");
  std::optional<Frame> frame;
  while (frames_ <= k) {
    frame = next_frame();
    if (!frame) break;
  }
  facts_[0].bytes = bytes_->count();
  facts_[0].sha256 = bytes_->digest();
  facts_[0].looked_at = true;
  facts_[0].frames = frames_;
  return frame;
}

std::optional<Frame> StreamFrames::next_frame() {
  if (frames_ == 0) read_cells();
  const auto header = frames_ == 0 ? first_ : next_array();
  if (!header) return std::nullopt;
  require_frame(*header);
  const std::vector<double> numbers = reals_of(*bytes_, *header, array_name());
  Frame frame{mesh_, positions_of(numbers, static_cast<std::size_t>(header->shape[1]), array_name())};
  ++frames_;
  return frame;
}

}  // namespace noli
