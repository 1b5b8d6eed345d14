// SPDX-License-Identifier: Apache-2.0
#include "trajectory/blocks/frames_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <utility>

#include <noli/errors.h>
#include "trajectory/blocks/bytes.h"
#include "trajectory/blocks/run_payload.h"
#include "trajectory/cells.h"
#include "trajectory/text.h"

namespace noli {
namespace {

constexpr FourLetters frames_content = four_letters("FRMS");

/// The magic, version and content of a file. Empty if it is not a regular file or is too short.
std::string head_of(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return "";
  std::string head(block_format::file_header_size, 0);
  std::ifstream file(path, std::ios::binary);
  return file.read(head.data(), static_cast<std::streamsize>(head.size())) ? head : "";
}

}  // namespace

/// Frames are written at once, and synced together.
class FramesWriter::Unsynced : public Sink {
 public:
  explicit Unsynced(std::unique_ptr<Sink> sink) : sink_(std::move(sink)) {}
  void write(std::string_view bytes) override { sink_->write(bytes); }
  void sync() override {
    if (last_) sink_->sync();
  }
  void truncate(std::uint64_t size) override { sink_->truncate(size); }
  void finish() {
    last_ = true;
    sync();
  }

 private:
  std::unique_ptr<Sink> sink_;
  bool last_ = false;
};

bool begins_as_blocks(const std::filesystem::path& path) { return head_of(path).starts_with(block_format::magic); }

bool is_frames_file(const std::filesystem::path& path) {
  const std::string head = head_of(path);
  return head.starts_with(block_format::magic) && head.ends_with("FRMS");
}

FramesWriter::FramesWriter(std::unique_ptr<Sink> sink, const Mesh& mesh)
    : vertices_(mesh.vertex_count),
      sink_(nullptr),
      blocks_(
          [&] {
            auto unsynced = std::make_unique<Unsynced>(std::move(sink));
            sink_ = unsynced.get();
            return unsynced;
          }(),
          frames_content) {
  blocks_.append(run_kind::mesh, run_block::encode_mesh(mesh));
  blocks_.commit();
}

void FramesWriter::append(std::span<const Position> positions) {
  if (positions.size() != vertices_) throw std::logic_error("a frame has another number of vertices than its mesh");
  constexpr std::size_t part = 4096;  // positions
  blocks_.append(run_kind::frame, sizeof(double) + positions.size_bytes(), [&](const ByteConsumer& consumer) {
    std::string bytes;
    put(bytes, static_cast<double>(frames_));
    consumer(bytes);
    for (std::size_t at = 0; at < positions.size(); at += part) {
      bytes.clear();
      put_all(bytes, coordinates(positions.subspan(at, std::min(part, positions.size() - at))));
      consumer(bytes);
    }
  });
  blocks_.commit();
  ++frames_;
}

void FramesWriter::finish() { sink_->finish(); }

FramesReader::FramesReader(const std::filesystem::path& path) : blocks_(path, frames_content) {
  const auto mesh = read(run_kind::mesh);
  if (!mesh) throw InputError(blocks_.name(), "", "ends before its mesh");
  mesh_ = run_block::decode_mesh({blocks_.name(), *mesh});
  drop_redundant_cells(mesh_);  // as all readers do
  read_commit();
  const std::uint64_t groups = blocks_.look_at_commits().count;
  count_ = groups > 0 ? groups - 1 : 0;
}

std::optional<std::vector<Position>> FramesReader::next() {
  const auto block = read(run_kind::frame);
  if (!block) {
    if (!blocks_.open_group()) return std::nullopt;
    throw InputError(blocks_.name(), byte_place(*blocks_.open_group()), "the file is cut off within a frame");
  }
  RunFrame frame = run_block::decode_frame({blocks_.name(), *block}, 3, mesh_.vertex_count);
  if (frame.time != static_cast<double>(frames_)) {
    throw InputError(blocks_.name(), byte_place(block->offset),
                     fmt::format("frame {}; expected frame {}", frame.time, frames_));
  }
  read_commit();
  ++frames_;
  return std::move(frame.positions);
}

std::optional<Block> FramesReader::read(FourLetters kind) {
  auto block = blocks_.next();
  if (block && block->kind != kind) {
    throw InputError(blocks_.name(), byte_place(block->offset),
                     fmt::format("expected block {}, found {}", letters_of(kind), letters_of(block->kind)));
  }
  return block;
}

void FramesReader::read_commit() {
  if (!read(block_format::commit))
    throw InputError(blocks_.name(), "", "the file is cut off: its last group has no commit");
}

}  // namespace noli
