// SPDX-License-Identifier: Apache-2.0
#include "trajectory/blocks/block_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <stdexcept>
#include <system_error>

#include "run_samples.h"
#include "support.h"
#include "trajectory/blocks/bytes.h"
#include "trajectory/blocks/crc32c.h"

namespace noli {
namespace {

using namespace noli::testing;

constexpr FourLetters content = four_letters("TEST"), kind_a = four_letters("AAAA"), kind_b = four_letters("BBBB");

std::string raw_block(FourLetters kind, const std::string& payload) {
  std::string bytes = block_format::block_header(kind, payload.size()) + payload;
  put(bytes, crc32c(bytes));
  return bytes;
}

std::string file_header() {
  std::string bytes(block_format::magic);
  put(bytes, block_format::version);
  put(bytes, content);
  return bytes;
}

/// The commit block that belongs after `group`.
std::string raw_commit(std::uint64_t number, const std::string& group, const Sha256Digest& running_before) {
  std::string payload;
  put(payload, number);
  payload += bytes_of(sha256(group));
  payload += bytes_of(next_running_hash(running_before, sha256(group)));
  return raw_block(block_format::commit, payload);
}

std::vector<Block> read_blocks(const std::string& bytes) {
  std::vector<Block> blocks;
  BlockReader reader(bytes, "file", content);
  while (auto block = reader.next()) blocks.push_back(std::move(*block));
  return blocks;
}

TEST(BlockFile, HasTheBytesOfItsDefinition) {
  MemoryFile file;
  BlockWriter writer(sink_to(file), content);
  writer.append(kind_a, "payload");
  writer.commit();
  writer.append(kind_b, "");
  writer.commit();
  const std::string first = file_header() + raw_block(kind_a, "payload"), second = raw_block(kind_b, "");
  const Sha256Digest running = next_running_hash({}, sha256(first));
  EXPECT_EQ(file.bytes, first + raw_commit(0, first, {}) + second + raw_commit(1, second, running));
  EXPECT_EQ(writer.committed(),
            (CommitPoint{file.bytes.size(), 2, next_running_hash(running, sha256(second)), sha256(second)}));
}

TEST(BlockFile, APayloadInPartsIsTheSame) {
  MemoryFile file;
  BlockWriter writer(sink_to(file), content);
  const auto parts = [](const ByteConsumer& consumer) {
    for (const char* part : {"pay", "", "load"}) consumer(part);
  };
  writer.append(kind_a, 7, parts);
  EXPECT_EQ(file.bytes, file_header() + raw_block(kind_a, "payload"));
  EXPECT_THROW(writer.append(kind_a, 8, parts), std::logic_error);
}

TEST(BlockFile, LettersAreInTheOrderTheyAreRead) {
  std::string bytes;
  put(bytes, four_letters("WXYZ"));
  EXPECT_EQ(bytes, "WXYZ");
}

TEST(BlockFile, IsReadBack) {
  MemoryFile file;
  BlockWriter writer(sink_to(file), content);
  writer.append(kind_a, "one");
  writer.append(kind_b, std::string(1000, 'x'));
  writer.commit();
  BlockReader reader(file.bytes, "file", content);
  const auto a = reader.next(), b = reader.next();
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->kind, kind_a);
  EXPECT_EQ(a->payload, "one");
  EXPECT_EQ(a->offset, block_format::file_header_size);
  EXPECT_EQ(b->payload, std::string(1000, 'x'));
  EXPECT_EQ(reader.committed().groups, 0u) << "not before the commit was read";
  EXPECT_EQ(reader.next()->kind, block_format::commit);
  EXPECT_EQ(reader.committed(), writer.committed());
  EXPECT_FALSE(reader.next());
  EXPECT_FALSE(reader.open_group());
}

TEST(BlockFile, ATornEndIsTold) {
  const std::string group = file_header() + raw_block(kind_a, "a"), good = group + raw_commit(0, group, {});
  for (const std::string& tail : {std::string("x"), raw_block(kind_a, "b"), raw_block(kind_a, "b") + "CMIT"}) {
    BlockReader reader(good + tail, "file", content);
    while (reader.next()) {
    }
    EXPECT_EQ(reader.open_group(), good.size());
    EXPECT_EQ(reader.committed().offset, good.size());
  }
}

TEST(BlockFile, ACommitFarBehindADamagedBlockIsFound) {
  const std::string first = file_header() + raw_block(kind_a, "a");
  const std::string second = raw_block(kind_b, std::string((std::size_t{1} << 20) + 12345, 'C'));
  const Sha256Digest running = next_running_hash({}, sha256(first));
  std::string bytes = first + raw_commit(0, first, {}) + second + raw_commit(1, second, running);
  bytes[first.size() + block_format::commit_size + 5] = '\x7f';  // in the length
  EXPECT_EQ(input_error([&] { read_blocks(bytes); }),
            "file: byte 121: truncated: a block of 1081145 bytes, but only 1061013 bytes remain; committed blocks "
            "follow, so this is not a truncated end");
}

TEST(BlockFile, ACommitAcrossTheStepsOfTheSearchIsFound) {
  const std::size_t step = std::size_t{1} << 20;
  const std::string first = file_header() + raw_block(kind_a, "a"), good = first + raw_commit(0, first, {});
  const Sha256Digest running = next_running_hash({}, sha256(first));
  for (const std::size_t before : {step - 1, step, step + 1, step - block_format::commit_size, step - 40}) {
    const std::string second = raw_block(kind_b, std::string(before - 16, 'C'));
    ASSERT_EQ(second.size(), before);
    std::string bytes = good;
    bytes += second;
    bytes += raw_commit(1, second, running);
    EXPECT_EQ(read_blocks(bytes).size(), 4u);
    bytes[good.size() + 20] = 'D';
    EXPECT_THROW(read_blocks(bytes), InputError) << before;
  }
}

struct BadFile {
  const char* name;
  std::string bytes;
  std::string message;
  friend void PrintTo(const BadFile& bad, std::ostream* out) { *out << bad.name; }
};

std::vector<BadFile> bad_files() {
  const std::string group = file_header() + raw_block(kind_a, "a");
  const Sha256Digest one = {1};
  std::string short_commit = raw_commit(0, group, {}).substr(12, 71);
  return {
      {"empty", "", "file: byte 0: truncated: expected at least 16 bytes, the header of a block file"},
      {"short", file_header().substr(0, 15),
       "file: byte 15: truncated: expected at least 16 bytes, the header of a block file"},
      {"magic", "ply\nformat ascii 1.0\n", "file: byte 0: expected a block file, which begins with 89 'NOLI' 0d 0a 1a"},
      {"version", file_header().replace(8, 1, "\x02"), "file: byte 8: version 2 is not known; expected version 1"},
      {"content", file_header().replace(12, 4, "PROF"), "file: byte 12: is about 'PROF', expected 'TEST'"},
      {"number", group + raw_commit(1, group, {}), "file: byte 45: commit 1 where commit 0 was expected"},
      {"hash", group + raw_commit(0, group + "b", {}),
       "file: byte 53: the hash does not match the blocks since the last commit"},
      {"running", group + raw_commit(0, group, one),
       "file: byte 85: the running hash does not match the earlier commits"},
      {"size", group + raw_block(block_format::commit, short_commit),
       "file: byte 33: a commit of 71 bytes, expected 72"},
      {"damaged", (group + raw_commit(0, group, {})).replace(28, 1, "b"),
       "file: byte 16: damaged: the checksum of block 'AAAA' does not match; committed blocks follow, so this is not a "
       "truncated end"},
  };
}

class BlockFileErrors : public ::testing::TestWithParam<BadFile> {};
INSTANTIATE_TEST_SUITE_P(All, BlockFileErrors, ::testing::ValuesIn(bad_files()),
                         [](const auto& bad) { return bad.param.name; });

TEST_P(BlockFileErrors, SayWhatAndWhere) {
  EXPECT_EQ(input_error([&] { read_blocks(GetParam().bytes); }), GetParam().message);
}

TEST(BlockFileErrors, OfTheFileSystem) {
  const test::TemporaryFolder folder;
  const auto read = [&](const std::string& name) { BlockReader(folder / name, content).next(); };
  EXPECT_EQ(input_error([&] { read("absent"); }),
            (folder / "absent").string() + ": cannot be opened: No such file or directory");
  EXPECT_EQ(input_error([&] { BlockReader(folder.path(), content).next(); }),
            folder.path().string() + ": is not a regular file; expected one");
}

/// The disk has space for one more byte.
TEST(FileSink, AFullDiskIsAnError) {
  const test::TemporaryFolder folder;
  FileSink sink(folder / "file", FileSink::Open::create);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  struct rlimit before = {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const struct rlimit one = {1, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &one), 0);
  std::string error;
  try {
    sink.write("xy");
  } catch (const std::system_error& full) {
    error = full.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(error, (folder / "file").string() + ": File too large");
}

TEST(FileSink, WritesToFilesOnly) {
  try {
    FileSink("/dev/null", FileSink::Open::existing).write("x");
    ADD_FAILURE();
  } catch (const std::system_error& error) {
    EXPECT_STREQ(error.what(), "/dev/null: is not a regular file: Invalid argument");
  }
}

TEST(FileSink, WritesBehindWhatItKeeps) {
  const test::TemporaryFolder folder;
  {
    FileSink sink(folder / "file", FileSink::Open::create);
    sink.write("abcdef");
    sink.truncate(2);
    sink.write("x");
    sink.sync();
  }
  EXPECT_EQ(test::read_text(folder / "file"), "abx");
}

}  // namespace
}  // namespace noli
