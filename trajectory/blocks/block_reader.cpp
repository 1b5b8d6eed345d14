// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

#include <noli/errors.h>
#include "trajectory/blocks/block_file.h"
#include "trajectory/blocks/bytes.h"
#include "trajectory/blocks/crc32c.h"
#include "trajectory/input_file.h"
#include "trajectory/text.h"

namespace noli {
namespace {

std::uint64_t size_of(std::istream& stream, const std::string& name) {
  stream.clear();
  stream.seekg(0, std::ios::end);
  const auto size = static_cast<std::streamoff>(stream.tellg());
  if (!stream || size < 0) throw InputError(name, "", "does not allow random access; expected a regular file");
  return static_cast<std::uint64_t>(size);
}

/// Whether the checksum at the end of `bytes`, a possible block, is that of the rest.
bool checksum_fits(std::string_view bytes) {
  const std::string_view covered = bytes.substr(0, bytes.size() - block_format::checksum_size);
  return get<std::uint32_t>(bytes.data() + covered.size()) == crc32c(covered);
}

Sha256Digest digest_at(const std::string& payload, std::size_t offset) {
  Sha256Digest digest;
  std::memcpy(digest.data(), payload.data() + offset, digest.size());
  return digest;
}

}  // namespace

std::string letters_of(FourLetters code) {
  std::string text;
  put(text, code);
  return in_quotes(text);
}

BlockReader::BlockReader(const std::filesystem::path& path, FourLetters content)
    : name_(path.string()), stream_(std::make_unique<std::ifstream>(open_regular_file(path))) {
  open(content);
}

BlockReader::BlockReader(std::string bytes, std::string name, FourLetters content)
    : name_(std::move(name)), stream_(std::make_unique<std::istringstream>(std::move(bytes))) {
  open(content);
}

void BlockReader::open(FourLetters content) {
  using namespace block_format;
  size_ = size_of(*stream_, name_);
  if (size_ < file_header_size) {
    fail(size_, fmt::format("truncated: expected at least {} bytes, the header of a block file", file_header_size));
  }
  const std::string header = read(0, file_header_size);
  if (!header.starts_with(magic)) fail(0, "expected a block file, which begins with 89 'NOLI' 0d 0a 1a");
  const auto found_version = get<std::uint32_t>(header.data() + magic.size());
  if (found_version != version) {
    fail(magic.size(), fmt::format("version {} is not known; expected version {}", found_version, version));
  }
  const auto found_content = get<std::uint32_t>(header.data() + magic.size() + 4);
  if (found_content != content) {
    fail(magic.size() + 4, fmt::format("is about {}, expected {}", letters_of(found_content), letters_of(content)));
  }
  hash_.update(header);
  at_ = file_header_size;
}

void BlockReader::fail(std::uint64_t offset, const std::string& problem) const {
  throw InputError(name_, byte_place(offset), problem);
}

/// Precondition: the file had these bytes when it was opened.
std::string BlockReader::read(std::uint64_t offset, std::uint64_t count) {
  std::string bytes(count, '\0');
  stream_->clear();
  stream_->seekg(static_cast<std::streamoff>(offset));
  stream_->read(bytes.data(), static_cast<std::streamsize>(count));
  if (static_cast<std::uint64_t>(stream_->gcount()) != count)
    fail(offset, fmt::format("cannot be read: expected {} bytes", count));
  return bytes;
}

/// Reads the bytes of a block. Returns what is wrong with them, or nothing.
std::optional<std::string> BlockReader::read_block(std::uint64_t offset, std::string& header, std::string& body) {
  using namespace block_format;
  const std::uint64_t left = size_ - offset;
  if (left < block_header_size) return fmt::format("truncated: {} bytes are not a block", left);
  header = read(offset, block_header_size);
  const auto length = get<std::uint64_t>(header.data() + 4);
  if (length > left - block_header_size || left - block_header_size - length < checksum_size) {
    return fmt::format("truncated: a block of {} bytes, but only {} bytes remain", length, left - block_header_size);
  }
  body = read(offset + block_header_size, length + checksum_size);
  const std::string_view payload(body.data(), length);
  if (get<std::uint32_t>(body.data() + length) != crc32c(payload, crc32c(header))) {
    return fmt::format("damaged: the checksum of block {} does not match", letters_of(get<FourLetters>(header.data())));
  }
  return std::nullopt;
}

/// Whether there is a whole commit block at `from` or later. If so, everything before it was once on the disk.
bool BlockReader::commit_follows(std::uint64_t from) {
  using namespace block_format;
  const std::string beginning = block_header(commit, commit_payload_size);
  constexpr std::uint64_t step = std::uint64_t{1} << 20;
  for (; size_ - from >= commit_size; from += std::min(step, size_ - from)) {
    const std::string bytes = read(from, std::min(step + commit_size - 1, size_ - from));
    for (std::size_t at = bytes.find(beginning); at != std::string::npos; at = bytes.find(beginning, at + 1)) {
      if (bytes.size() - at >= commit_size && checksum_fits(std::string_view(bytes).substr(at, commit_size)))
        return true;
    }
  }
  return false;
}

/// Its length and its number.
void BlockReader::require_next_commit(const Block& block) const {
  if (block.payload.size() != block_format::commit_payload_size) {
    fail(block.offset,
         fmt::format("a commit of {} bytes, expected {}", block.payload.size(), block_format::commit_payload_size));
  }
  const auto number = get<std::uint64_t>(block.payload.data());
  if (number != committed_.groups) {
    fail(block.payload_offset(), fmt::format("commit {} where commit {} was expected", number, committed_.groups));
  }
}

void BlockReader::check_commit(const Block& block) {
  require_next_commit(block);
  const Sha256Digest group = hash_.digest();
  if (digest_at(block.payload, 8) != group) {
    fail(block.payload_offset() + 8, "the hash does not match the blocks since the last commit");
  }
  const Sha256Digest running = next_running_hash(committed_.running, group);
  if (digest_at(block.payload, 40) != running) {
    fail(block.payload_offset() + 40, "the running hash does not match the earlier commits");
  }
  committed_ = {at_, committed_.groups + 1, running, group};
  hash_ = {};
}

std::optional<Block> BlockReader::next() {
  if (at_ == size_) return std::nullopt;
  std::string header, body;
  if (const auto problem = read_block(at_, header, body)) {
    if (commit_follows(at_)) fail(at_, *problem + "; committed blocks follow, so this is not a truncated end");
    at_ = size_;
    return std::nullopt;
  }
  Block block{get<FourLetters>(header.data()), at_, {}};
  at_ += header.size() + body.size();
  if (block.kind != block_format::commit) {
    hash_.update(header);
    hash_.update(body);
  }
  body.resize(body.size() - block_format::checksum_size);
  block.payload = std::move(body);
  if (block.kind == block_format::commit) check_commit(block);
  return block;
}

std::optional<BlockReader::BlockPlace> BlockReader::look_at_place(std::uint64_t offset) {
  using namespace block_format;
  if (size_ - offset < block_header_size + checksum_size) return std::nullopt;
  const std::string header = read(offset, block_header_size);
  const auto length = get<std::uint64_t>(header.data() + 4);
  if (length > size_ - offset - block_header_size - checksum_size) return std::nullopt;
  return BlockPlace{get<FourLetters>(header.data()), offset + block_header_size + length + checksum_size};
}

bool BlockReader::skip_group() {
  std::uint64_t at = at_;
  auto place = look_at_place(at);
  while (place && place->kind != block_format::commit) {
    at = place->end;
    place = look_at_place(at);
  }
  const std::optional<Block> block = place ? look_at_block(at) : std::nullopt;
  if (!block) {
    if (commit_follows(at)) fail(at, "damaged: committed blocks follow, so this is not a truncated end");
    return false;
  }
  require_next_commit(*block);
  committed_ = {place->end, committed_.groups + 1, digest_at(block->payload, 40), digest_at(block->payload, 8)};
  at_ = place->end;
  hash_ = {};
  return true;
}

void BlockReader::continue_after(const CommitPoint& commit) {
  if (commit.offset > size_) fail(size_, "the file has lost what was committed to it");
  committed_ = commit;
  at_ = commit.offset;
  hash_ = {};
}

CommitLook BlockReader::look_at_commits(std::uint64_t group) {
  using namespace block_format;
  CommitLook look;
  std::uint64_t open = file_header_size, at = file_header_size;
  while (const auto place = look_at_place(at)) {
    const bool commits = place->kind == commit;
    if (commits && ++look.count == group && place->end - at == commit_size) {
      look.running = digest_at(read(at + block_header_size, commit_payload_size), 40);
    }
    at = place->end;
    if (commits) look.last_group = std::exchange(open, at);
  }
  return look;
}

std::optional<Block> BlockReader::look_at_block(std::uint64_t offset) {
  std::string header, body;
  if (read_block(offset, header, body)) return std::nullopt;
  body.resize(body.size() - block_format::checksum_size);
  return Block{get<FourLetters>(header.data()), offset, std::move(body)};
}

void BlockReader::look_again() {
  size_ = size_of(*stream_, name_);
  if (size_ < committed_.offset) fail(size_, "the file has lost what was committed to it");
  at_ = committed_.offset;
  hash_ = {};
}

std::optional<std::uint64_t> BlockReader::open_group() const {
  return committed_.offset < size_ ? std::optional(committed_.offset) : std::nullopt;
}

}  // namespace noli
