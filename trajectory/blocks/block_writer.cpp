// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "trajectory/blocks/block_file.h"
#include "trajectory/blocks/bytes.h"
#include "trajectory/blocks/crc32c.h"

namespace noli {

std::string block_format::block_header(FourLetters kind, std::uint64_t length) {
  std::string bytes;
  put(bytes, kind);
  put(bytes, length);
  return bytes;
}

void put_block(FourLetters kind, std::uint64_t length, const PayloadSource& payload, const ByteConsumer& consumer) {
  const std::string header = block_format::block_header(kind, length);
  std::uint32_t crc = crc32c(header);
  std::uint64_t size = 0;
  consumer(header);
  payload([&](std::string_view bytes) {
    crc = crc32c(bytes, crc);
    size += bytes.size();
    consumer(bytes);
  });
  if (size != length) throw std::logic_error("a payload of another length than its block says");
  std::string checksum;
  put(checksum, crc);
  consumer(checksum);
}

Sha256Digest next_running_hash(const Sha256Digest& a, const Sha256Digest& b) {
  Sha256 hash;
  hash.update(bytes_of(a));
  hash.update(bytes_of(b));
  return hash.digest();
}

BlockWriter::BlockWriter(std::unique_ptr<Sink> sink, FourLetters content) : sink_(std::move(sink)) {
  std::string header(block_format::magic);
  put(header, block_format::version);
  put(header, content);
  write(header);
}

BlockWriter::BlockWriter(std::unique_ptr<Sink> sink, const CommitPoint& committed)
    : sink_(std::move(sink)), committed_(committed) {
  discard();
}

void BlockWriter::write(std::string_view bytes) {
  sink_->write(bytes);
  hash_.update(bytes);
  size_ += bytes.size();
}

void BlockWriter::append(FourLetters kind, std::string_view payload) {
  append(kind, payload.size(), [payload](const ByteConsumer& consumer) { consumer(payload); });
}

void BlockWriter::append(FourLetters kind, std::uint64_t length, const PayloadSource& payload) {
  put_block(kind, length, payload, [this](std::string_view bytes) { write(bytes); });
}

void BlockWriter::commit() {
  const Sha256Digest group = hash_.digest();
  const Sha256Digest running = next_running_hash(committed_.running, group);
  std::string payload;
  put(payload, committed_.groups);
  payload.append(bytes_of(group)).append(bytes_of(running));
  sink_->sync();
  append(block_format::commit, payload);
  sink_->sync();
  committed_ = {size_, committed_.groups + 1, running, group};
  hash_ = {};
}

void BlockWriter::discard() {
  sink_->truncate(committed_.offset);
  size_ = committed_.offset;
  hash_ = {};
}

}  // namespace noli
