// SPDX-License-Identifier: Apache-2.0
//
// Block files, one committed group after another (trajectory/FORMAT.md).
#pragma once

#include <fstream>
#include <memory>
#include <optional>

#include "base.h"

namespace noli::checker {

struct Block {
  std::string kind, payload;
  std::uint64_t offset = 0;  ///< of the payload
};

class BlockFile {
 public:
  BlockFile(std::string name, const std::string& content) : name_(std::move(name)), file_(name_, std::ios::binary) {
    if (!file_) reject(name_, "cannot be opened");
    file_.seekg(0, std::ios::end);
    size_ = static_cast<std::uint64_t>(std::max<std::streamoff>(0, file_.tellg()));
    file_.seekg(0);
    const std::string head = read(16);
    if (head.substr(0, 8) != std::string("\x89NOLI\r\n\x1a", 8)) fail(0, "is no block file");
    if (head.substr(8, 4) != std::string("\1\0\0\0", 4)) fail(8, "expected version 1");
    if (head.substr(12) != content) fail(12, "expected content " + content);
    group_.add(head);
  }

  const std::string& name() const { return name_; }
  std::string place(std::uint64_t offset) const { return name_ + ", byte " + std::to_string(offset); }

  /// The next block of the open group, but for CMIT; none at its end, and none at the end of the file, where ended() is
  /// true. What is behind the last commit is rejected, so blocks count only when their group has ended.
  std::optional<Block> next() {
    if (at_ == size_) {
      if (blocks_ != 0 || groups_ == 0) fail(committed_, "the last group has no commit: it is not complete");
      ended_ = true;
      return std::nullopt;
    }
    if (size_ - at_ < 16) fail(at_, "the file ends within a block");
    const std::string head = read(12);
    std::uint64_t length;
    std::memcpy(&length, head.data() + 4, 8);
    if (length > size_ - at_ - 4) fail(at_ - 8, "a length of " + std::to_string(length) + " goes beyond the file");
    Block block{head.substr(0, 4), {}, at_};
    block.payload = read(length);
    Crc32c crc;
    crc.add(head);
    crc.add(block.payload);
    const std::string sum = read(4);
    if (sum != std::string(reinterpret_cast<const char*>(std::array{crc.value()}.data()), 4))
      fail(at_ - 4, "the checksum is wrong");
    if (block.kind == "CMIT") {
      commit(block);
      return std::nullopt;
    }
    group_.add(head);
    group_.add(block.payload);
    group_.add(sum);
    ++blocks_;
    return block;
  }
  /// The next block, which has to be of that kind.
  Block expect(const std::string& kind) {
    auto block = next();
    if (!block || block->kind != kind)
      fail(block ? block->offset - 12 : at_, "expected a block " + kind + (block ? ", found " + block->kind : ""));
    return std::move(*block);
  }
  void expect_commit() {
    if (next() || ended_) fail(at_, "expected a commit");
  }
  bool ended() const { return ended_; }
  /// Of the last group that was committed.
  const Sha256::Digest& group_hash() const { return last_; }

 private:
  [[noreturn]] void fail(std::uint64_t offset, const std::string& why) const { reject(place(offset), why); }

  std::string read(std::uint64_t bytes) {
    if (bytes > size_ - at_) fail(at_, "the file is too short");
    std::string result(bytes, '\0');
    file_.read(result.data(), static_cast<std::streamsize>(bytes));
    if (static_cast<std::uint64_t>(file_.gcount()) != bytes) fail(at_, "cannot be read");
    at_ += bytes;
    return result;
  }

  void commit(const Block& block) {
    Cursor c(block.payload, name_, block.offset);
    if (c.left() != 72 || c.u64() != groups_) fail(block.offset, "a commit has the wrong length or number");
    const Sha256::Digest found = last_ = group_.digest();
    Sha256 both;
    both.add_raw(running_);
    both.add_raw(found);
    running_ = both.digest();
    if (c.raw<Sha256::Digest>() != found || c.raw<Sha256::Digest>() != running_)
      fail(block.offset, "a hash of the group is wrong");
    group_ = {};
    blocks_ = 0;
    ++groups_;
    committed_ = at_;
  }

  std::string name_;
  std::ifstream file_;
  std::uint64_t size_ = 0, at_ = 0, groups_ = 0, blocks_ = 0, committed_ = 0;
  bool ended_ = false;
  Sha256 group_;
  Sha256::Digest running_{}, last_{};
};

}  // namespace noli::checker
