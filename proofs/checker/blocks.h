// SPDX-License-Identifier: Apache-2.0
//
// Block files, one committed group after another (trajectory/FORMAT.md).
#pragma once

#include "base.h"

namespace noli::checker {

struct Block {
  std::string kind;
  Reader data;  ///< the payload
};

class BlockFile {
 public:
  BlockFile(const std::string& name, std::string_view content) : name_(name), input_(name) {
    const std::string head = input_.read(16);
    require(head.starts_with(std::string_view("\x89NOLI\r\n\x1a\1\0\0\0", 12)), 0, "expected a block file, version 1");
    require(head.substr(12) == content, 12, "the file has another content");
    group_.add(head);
  }

  /// The next block of the open group, but for CMIT; none at its end, and none at the end of the file, where ended() is
  /// true. What is behind the last commit is rejected, so blocks count only when their group has ended.
  std::optional<Block> next() {
    block_at_ = at_;
    const std::string head = input_.read(12);
    ended_ = head.empty() && groups_ > 0 && blocks_ == 0;
    if (ended_) return std::nullopt;
    complete(head.size() == 12);
    std::string payload = input_.read(Reader(head.substr(4), name_).u64());
    const std::string sum = input_.read(4);
    complete(sum.size() == 4);
    at_ += 16 + payload.size();
    require(Reader(sum, name_).u32() == crc32c(payload, crc32c(head)), at_ - 4, "the checksum is wrong");
    Block block{head.substr(0, 4), Reader(std::move(payload), name_, block_at_ + 12)};
    if (block.kind == "CMIT") return commit(block.data);
    for (const std::string_view part : {std::string_view(head), block.data.all(), std::string_view(sum)})
      group_.add(part);
    ++blocks_;
    return block;
  }
  /// The payload of a block, which has to be of that kind.
  Reader as(const std::string& kind, std::optional<Block> block) const {
    require(block && block->kind == kind, block_at_, "expected a block " + kind);
    return std::move(block->data);
  }
  Reader expect(const std::string& kind) { return as(kind, next()); }
  void expect_commit() { require(!next(), block_at_, "expected a commit"); }
  bool ended() const { return ended_; }
  /// Of the last group that was committed.
  const Sha256::Digest& group_hash() const { return last_; }

 private:
  void require(bool condition, std::uint64_t offset, const std::string& why) const {
    if (!condition) throw Rejected{name_ + ", byte " + std::to_string(offset), why};
  }
  void complete(bool block) const {
    require(block, committed_,
            "an open group, behind " + std::to_string(groups_) + " that have a commit (the first is the head)");
  }
  std::nullopt_t commit(Reader& c) {
    c.require(c.left() == 72, "expected 72 bytes");
    c.require(c.u64() == groups_, "a commit has the wrong number");
    last_ = group_.digest();
    Sha256 both;
    both.add_raw(running_);
    both.add_raw(last_);
    running_ = both.digest();
    c.require(c.raw<Sha256::Digest>() == last_, "the hash of the group is wrong");
    c.require(c.raw<Sha256::Digest>() == running_, "the running hash is wrong");
    group_ = {};
    blocks_ = 0;
    ++groups_;
    committed_ = at_;
    return std::nullopt;
  }

  std::string name_;
  Input input_;
  std::uint64_t at_ = 16, block_at_ = 16, groups_ = 0, blocks_ = 0, committed_ = 0;
  bool ended_ = false;
  Sha256 group_;
  Sha256::Digest running_{}, last_{};
};

}  // namespace noli::checker
