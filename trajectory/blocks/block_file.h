// SPDX-License-Identifier: Apache-2.0
//
// Append-only block files: what a run is written to as it is made. FORMAT.md has the bytes.
//
// Notation
//   block     kind (four letters), length, payload, CRC-32C of these
//   group     blocks and the commit block that closes them: a header, a window
//   commit    the number of the group from 0, the SHA-256 of the group's bytes before it, and a running hash, which is
//             the SHA-256 of the running hash before and this one. So the last commit stands for the whole file.
//   open      blocks after the last commit: what a crash, a full disk or a kill leaves. Nobody vouches for them.
//
// A group is written, then synced to the disk, then its commit block is written and synced: whatever happens, the file
// is good up to the end of a group. A file that ends in an open group is no error, but is told. One that is damaged
// before its last commit block is an error.
//
// What this does not do: it does not know what the blocks mean (run_file.h does for trajectories).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "trajectory/blocks/block_sink.h"
#include "trajectory/blocks/sha256.h"

namespace noli {

/// Four letters, the first of which is the lowest byte.
using FourLetters = std::uint32_t;
constexpr FourLetters four_letters(const char (&letters)[5]) {
  FourLetters code = 0;
  for (int i = 3; i >= 0; --i) code = code << 8 | static_cast<unsigned char>(letters[i]);
  return code;
}

/// The letters in quotes, for messages.
std::string letters_of(FourLetters code);

namespace block_format {
inline constexpr std::string_view magic{"\x89NOLI\r\n\x1a",
                                        8};  ///< a transfer that changes line ends or bit 7 spoils it
inline constexpr std::uint32_t version = 1;
inline constexpr FourLetters commit = four_letters("CMIT");
inline constexpr std::size_t file_header_size = 16;  ///< magic, version, content
inline constexpr std::size_t block_header_size = 12;
inline constexpr std::size_t checksum_size = 4;
inline constexpr std::size_t commit_payload_size = 72;
inline constexpr std::size_t commit_size = block_header_size + commit_payload_size + checksum_size;

/// Kind and length as a block begins.
std::string block_header(FourLetters kind, std::uint64_t length);
}  // namespace block_format

/// Takes bytes that come in parts.
using ByteConsumer = std::function<void(std::string_view)>;

/// Gives a payload to a consumer, in as many parts as it likes.
using PayloadSource = std::function<void(const ByteConsumer&)>;

/// Gives the bytes of a block, from its kind to its checksum. Throws std::logic_error when the payload has another
/// length.
void put_block(FourLetters kind, std::uint64_t length, const PayloadSource& payload, const ByteConsumer& consumer);

/// The end of a committed group.
struct CommitPoint {
  std::uint64_t offset = 0;  ///< of the first byte after its commit block
  std::uint64_t groups = 0;  ///< how many groups are committed
  Sha256Digest running{};    ///< the running hash; zeros before the first commit
  Sha256Digest group{};      ///< the hash of the last group; zeros before the first commit

  friend bool operator==(const CommitPoint&, const CommitPoint&) = default;
};

/// Hash of `a` and `b`, one after the other: the next running hash.
Sha256Digest next_running_hash(const Sha256Digest& a, const Sha256Digest& b);

/// Writes groups. All functions throw what the sink throws; then nothing more may be written but what resume() allows.
class BlockWriter {
 public:
  /// A new file; `content` says what it is about. Precondition: the sink is empty.
  BlockWriter(std::unique_ptr<Sink> sink, FourLetters content);
  /// Goes on after a commit, which BlockReader::committed() gave; what follows it is cut off. Precondition: it is one,
  /// not the beginning of the file.
  BlockWriter(std::unique_ptr<Sink> sink, const CommitPoint& committed);

  void append(FourLetters kind, std::string_view payload);
  /// The same for a payload that is not in memory at once.
  void append(FourLetters kind, std::uint64_t length, const PayloadSource& payload);
  /// Closes the group: syncs, writes the commit block, syncs.
  void commit();
  /// Drops the blocks since the last commit. Precondition: there was one.
  void discard();

  const CommitPoint& committed() const { return committed_; }
  /// The hash that commit() would write for the open group.
  Sha256Digest open_group_hash() const { return hash_.digest(); }

 private:
  void write(std::string_view bytes);

  std::unique_ptr<Sink> sink_;
  CommitPoint committed_;
  Sha256 hash_;             ///< of the open group
  std::uint64_t size_ = 0;  ///< of the file
};

/// What the headers of blocks say.
struct CommitLook {
  std::uint64_t count = 0;              ///< of commits
  std::uint64_t last_group = 0;         ///< where the group begins that the last of them closes
  std::optional<Sha256Digest> running;  ///< as one of them has it
};

struct Block {
  FourLetters kind = 0;
  std::uint64_t offset = 0;  ///< of the block's first byte in the file
  std::string payload;

  std::uint64_t payload_offset() const { return offset + block_format::block_header_size; }
};

/// Reads the blocks of a file, one after another; holds one at a time. A length is believed only when the file has as
/// many bytes left.
class BlockReader {
 public:
  /// Throws InputError when the file cannot be opened, or does not begin as a block file about `content` of a version
  /// that is known.
  BlockReader(const std::filesystem::path& path, FourLetters content);
  /// The same for bytes in memory; `name` is what errors call them.
  BlockReader(std::string bytes, std::string name, FourLetters content);

  /// The next block, commit blocks included; nothing at the end of the file, or where its open group is torn. Whether
  /// blocks belong to a group is known when its commit block comes. Throws InputError when a commit does not fit what
  /// it closes, or a block is damaged although commits follow it. After an error the reader must not be used.
  std::optional<Block> next();

  /// How many commit blocks the file has, by the headers of its blocks alone, and the running hash that the one which
  /// closes this group, counted from 1, has. Nothing is checked.
  CommitLook look_at_commits(std::uint64_t group = 0);
  /// The block at this place; nothing where it is damaged.
  std::optional<Block> look_at_block(std::uint64_t offset);

  /// Whoever waits for more: the file as it is now, behind the last commit that next() passed; also after an error.
  /// Precondition: there was a commit. Throws InputError when the file has become shorter than that.
  void look_again();

  /// The end of the last commit that next() passed.
  const CommitPoint& committed() const { return committed_; }
  /// Once next() gave nothing: where the open group begins, if the file ends in one.
  std::optional<std::uint64_t> open_group() const;
  const std::string& name() const { return name_; }

 private:
  void open(FourLetters content);
  std::string read(std::uint64_t offset, std::uint64_t count);
  std::optional<std::string> read_block(std::uint64_t offset, std::string& header, std::string& body);
  bool commit_follows(std::uint64_t from);
  void check_commit(const Block& block);
  [[noreturn]] void fail(std::uint64_t offset, const std::string& problem) const;

  std::string name_;
  std::unique_ptr<std::istream> stream_;
  std::uint64_t size_ = 0;  ///< of the file when it was opened
  std::uint64_t at_ = 0;    ///< of the next block
  CommitPoint committed_;
  Sha256 hash_;  ///< of the open group
};

}  // namespace noli
