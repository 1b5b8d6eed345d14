// SPDX-License-Identifier: Apache-2.0
//
// Append-only block files, to which a run is written while it is made. FORMAT.md has the bytes.
//
// Notation
//   block     kind (four letters), length, payload, and the CRC-32C of these
//   group     blocks and the commit block that closes them: a header, a window
//   commit    the number of the group from 0, the SHA-256 of the group's bytes before it, and a running hash: the
//             SHA-256 of the previous running hash and this group's hash. So the last commit stands for the whole file.
//   open      blocks after the last commit, left by a crash, a full disk or a kill. They do not count.
//
// A group is written and synced to the disk, then its commit block is written and synced. So whatever happens, the file
// is good up to the end of a group. A file that ends in an open group is not an error, but readers can see it. Damage
// before the last commit block is an error.
//
// run_file.h gives the blocks of trajectories their meaning.
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

/// Passes a payload to a consumer, in any number of parts.
using PayloadSource = std::function<void(const ByteConsumer&)>;

/// Passes the bytes of a block to the consumer, from its kind to its checksum. Throws std::logic_error when the payload
/// does not have this length.
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

/// Writes groups. All functions throw what the sink throws; after that the writer must not be used.
class BlockWriter {
 public:
  /// Begins a new file; `content` says what it is about. Precondition: the sink is empty.
  BlockWriter(std::unique_ptr<Sink> sink, FourLetters content);
  /// Goes on after a commit given by BlockReader::committed(), and cuts off what follows. Precondition: at least one
  /// group is committed.
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

/// The commits of a file, from the headers of its blocks alone.
struct CommitLook {
  std::uint64_t count = 0;              ///< of commits
  std::uint64_t last_group = 0;         ///< offset of the group that the last commit closes
  std::optional<Sha256Digest> running;  ///< the running hash of the commit that was asked for
};

struct Block {
  FourLetters kind = 0;
  std::uint64_t offset = 0;  ///< of the block's first byte in the file
  std::string payload;

  std::uint64_t payload_offset() const { return offset + block_format::block_header_size; }
};

/// Reads the blocks of a file, one after another; holds one at a time. A length is accepted only if the file has that
/// many bytes left.
class BlockReader {
 public:
  /// Throws InputError when the file cannot be opened, or does not begin as a block file about `content` in a known
  /// version.
  BlockReader(const std::filesystem::path& path, FourLetters content);
  /// The same for bytes in memory; `name` is what errors call them.
  BlockReader(std::string bytes, std::string name, FourLetters content);

  /// The next block, commit blocks included; nothing at the end of the file, or where its open group is torn. Blocks
  /// count only once the commit block of their group follows. Throws InputError when a commit does not match its group,
  /// or when a block is damaged although commits follow it. After an error the reader must not be used.
  std::optional<Block> next();

  /// Skips the group that comes next by the headers of its blocks. Of what it skips, only the checksum and number of
  /// the commit are checked, so committed() then has the hashes that the commit block tells. False if no commit
  /// follows; nothing changes then. Precondition: next() gave a commit last, or was not called yet. Throws InputError
  /// for damage before a commit, as next() does, and for a commit out of order.
  bool skip_group();

  /// Makes what follows a commit the next to be read. Precondition: committed() of a reader of this file gave it.
  void continue_after(const CommitPoint& commit);

  /// Counts the commit blocks by the headers of all blocks, and gives the running hash of the commit that closes
  /// `group` (from 1). Nothing is checked.
  CommitLook look_at_commits(std::uint64_t group = 0);
  /// The block at this place; nothing where it is damaged.
  std::optional<Block> look_at_block(std::uint64_t offset);

  /// For readers that wait for more: continues with the file as it is now, after the last commit that was passed;
  /// also after an error. Precondition: there was a commit. Throws InputError when the file has become shorter.
  void look_again();

  /// The end of the last commit that was passed.
  const CommitPoint& committed() const { return committed_; }
  /// After next() returned nothing: where the open group begins, if the file ends in one.
  std::optional<std::uint64_t> open_group() const;
  const std::string& name() const { return name_; }

 private:
  /// What the header of a block tells.
  struct BlockPlace {
    FourLetters kind;
    std::uint64_t end;  ///< of the block in the file
  };

  void open(FourLetters content);
  /// Nothing if the file is too short for a block there.
  std::optional<BlockPlace> look_at_place(std::uint64_t offset);
  std::string read(std::uint64_t offset, std::uint64_t count);
  std::optional<std::string> read_block(std::uint64_t offset, std::string& header, std::string& body);
  bool commit_follows(std::uint64_t from);
  void require_next_commit(const Block& block) const;
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
