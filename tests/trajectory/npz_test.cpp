// SPDX-License-Identifier: Apache-2.0
//
// Archives of numpy: members of 4 GB and more, and archives that lie.
#include "trajectory/formats/arrays/npz.h"

#include <sys/resource.h>

#include <optional>

#include "support.h"
#include "tests/support/zip_writer.h"
#include "trajectory/formats/open_frames.h"

namespace noli {
namespace {

using test::ZipMember;
using test::ZipWriter;
using testing::input_error;

namespace fs = std::filesystem;

std::uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

/// All bytes of a member.
std::string bytes_of(const NpzFile& file, std::size_t number = 0) {
  const auto bytes = file.open(number);
  std::string all, part(1 << 16, 0);
  while (const std::size_t got = bytes->read(part.data(), part.size())) all.append(part, 0, got);
  return all;
}

// --- large members ---------------------------------------------------------------------------------------------------

/// Frames of 50,000 vertices, of which all but the last are the same, and a face behind them.
class LargeNpz : public ::testing::Test {
 protected:
  static constexpr std::uint64_t vertices = 50'000, frame_bytes = vertices * 24;

  /// A frame with this x of vertex 0. With noise it is not deflated to less than a two hundredth, which is refused.
  static std::string frame(double first, bool noise) {
    std::string numbers = test::little_endian(first);
    std::uint32_t random = 1;
    while (noise && numbers.size() < 12'000) {
      random = random * 1664525 + 1013904223;
      numbers += test::little_endian(static_cast<double>(random));
    }
    numbers.resize(frame_bytes, 0);
    return numbers;
  }
  static std::string header(std::uint64_t frames) {
    return test::npy("{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(frames) + ", " +
                         std::to_string(vertices) + ", 3), }",
                     "");
  }
  fs::path write(std::uint64_t frames, bool deflated, std::uint32_t wrong = 0) const {
    ZipWriter zip(folder / "large.npz");
    zip.add("x.npy", {{header(frames)}, {frame(0, deflated), frames - 1}, {frame(7, deflated)}}, deflated).crc ^= wrong;
    zip.add("f.npy", {{test::NumpyArray{"<i8", {1, 3}, {4, 2, 0}}.bytes()}});
    zip.finish();
    return folder / "large.npz";
  }
  /// Reads the first two frames and then the last one.
  static void expect_frames(const fs::path& file, std::uint64_t frames) {
    const auto source = open_frames({file}, {.keys = {"x", "f"}});
    ASSERT_EQ(source->count(), frames);
    for (const std::uint64_t k : {std::uint64_t{0}, std::uint64_t{1}, frames - 1}) {
      const auto found = source->read(k);
      ASSERT_TRUE(found);
      ASSERT_EQ(found->positions.size(), vertices);
      EXPECT_EQ(found->positions[0][0], k + 1 == frames ? 7 : 0);
      EXPECT_EQ(found->mesh.faces, (std::vector<std::array<VertexId, 3>>{{4, 2, 0}}));
    }
  }

  static constexpr std::uint64_t of_5_gb = 4200;
  test::TemporaryFolder folder;
};

/// Python writes a zip64 end record from 2 GB on.
TEST_F(LargeNpz, BeginIn2And3And5Gb) {
  for (const std::uint64_t frames : {std::uint64_t{1700}, std::uint64_t{2500}, of_5_gb}) {
    const NpzFile file(write(frames, false));
    ASSERT_EQ(file.members().size(), 2U);
    EXPECT_EQ(file.members()[0].size, header(frames).size() + frames * frame_bytes);
    EXPECT_EQ(bytes_of(file, 1), (test::NumpyArray{"<i8", {1, 3}, {4, 2, 0}}.bytes())) << "behind the large member";
    EXPECT_EQ(open_frames({folder / "large.npz"}, {.keys = {"x", "f"}})->read(1)->positions[0][0], 0);
  }
}

TEST_F(LargeNpz, StoredAreReadToTheirEndSlow) {
  const fs::path file = write(of_5_gb, false);
  const std::uint64_t before = peak_memory();
  expect_frames(file, of_5_gb);
  EXPECT_LT(peak_memory() - before, std::uint64_t{100} << 20);
}

TEST_F(LargeNpz, DeflatedAreReadToTheirEndSlow) {
  const fs::path file = write(of_5_gb, true);
  EXPECT_LT(fs::file_size(file), std::uint64_t{100} << 20);
  const std::uint64_t before = peak_memory();
  expect_frames(file, of_5_gb);
  EXPECT_LT(peak_memory() - before, std::uint64_t{100} << 20);
}

TEST_F(LargeNpz, WithAWrongSumAreRefusedSlow) {
  const fs::path file = write(of_5_gb, true, 1);
  const auto source = open_frames({file}, {.keys = {"x", "f"}});
  EXPECT_TRUE(source->read(of_5_gb - 2));
  EXPECT_NE(input_error([&] { source->read(of_5_gb - 1); }).find("checksum is wrong"), std::string::npos);
}

// --- archives that lie -----------------------------------------------------------------------------------------------

class HostileNpz : public ::testing::Test {
 protected:
  /// What is said of an archive with one member when all of it is read. `lie` changes what the archive says of it.
  template <class Lie>
  std::string refusal(bool deflated, const Lie& lie, const std::vector<test::ZipPart>& parts = {{"0123456789", 100}}) {
    ZipWriter zip(folder / "a.npz");
    lie(zip.add("x.npy", parts, deflated));
    zip.finish();
    return refusal_of(folder / "a.npz");
  }
  static std::string refusal_of(const fs::path& file) {
    return input_error([&] { bytes_of(NpzFile(file)); });
  }
  /// An archive with this directory in place of its own.
  std::string refusal_of_directory(const std::string& directory, std::uint64_t entries) {
    ZipWriter zip(folder / "d.npz");
    zip.add("x.npy", {{"abc"}});
    zip.finish(directory, entries);
    return refusal_of(folder / "d.npz");
  }

  test::TemporaryFolder folder;
};

TEST_F(HostileNpz, MembersAreReadWhenAllIsTrue) {
  for (const bool deflated : {false, true}) {
    ZipWriter zip(folder / "a.npz");
    zip.add("x.npy", {{"0123456789", 100}}, deflated);
    zip.add("empty.npy", {}, deflated);
    zip.finish();
    const NpzFile file(folder / "a.npz");
    EXPECT_EQ(bytes_of(file).size(), 1000U);
    EXPECT_EQ(bytes_of(file, 1), "");
  }
}

TEST_F(HostileNpz, StreamsOfOneArchiveAreIndependent) {
  ZipWriter zip(folder / "a.npz");
  for (const char* const name : {"a.npy", "b.npy"})
    zip.add(name, {{std::string(1000, name[0])}, {"end"}}, name[0] == 'b');
  zip.finish();
  auto file = std::make_optional<NpzFile>(folder / "a.npz");
  const auto a = file->open(0), b = file->open(1), again = file->open(0);
  file.reset();
  std::array<std::string, 3> found;
  for (bool more = true; more;) {
    more = false;
    for (std::size_t i = 0; i < 3; ++i) {
      std::array<char, 7> part{};
      const std::size_t got = (i == 0 ? a : i == 1 ? b : again)->read(part.data(), part.size());
      found[i].append(part.data(), got);
      more = more || got > 0;
    }
  }
  EXPECT_EQ(found, (std::array<std::string, 3>{std::string(1000, 'a') + "end", std::string(1000, 'b') + "end",
                                               std::string(1000, 'a') + "end"}));
}

TEST_F(HostileNpz, EncryptedMembersAreRefused) {
  const std::string aes = refusal(false, [](ZipMember& member) { member.method = 99; });
  EXPECT_NE(aes.find("damaged directory"), std::string::npos) << "it does not say how it is encrypted: " << aes;
  EXPECT_NE(refusal(false, [](ZipMember& member) { member.flags = 1; }).find("is encrypted"), std::string::npos);
}

TEST_F(HostileNpz, OtherMethodsAreRefused) {
  for (const int method : {1, 9, 12, 14, 93, 95}) {
    const std::string said =
        refusal(false, [&](ZipMember& member) { member.method = static_cast<std::uint16_t>(method); });
    EXPECT_NE(said.find("expected a member that is stored or deflated"), std::string::npos) << method << said;
  }
}

TEST_F(HostileNpz, WrongSumsAndSizesAreRefused) {
  for (const bool deflated : {false, true}) {
    const auto refused = [&](const auto& lie) {
      const std::string said = refusal(deflated, lie);
      EXPECT_NE(said.find("a.npz: x: is damaged"), std::string::npos) << deflated << said;
    };
    refused([](ZipMember& member) { member.crc ^= 0x80000000; });
    refused([](ZipMember& member) { --member.size; });
    refused([](ZipMember& member) { ++member.size; });
    refused([](ZipMember& member) { member.size = 0; });
    refused([](ZipMember& member) { member.packed /= 2; });
    refused([](ZipMember& member) { member.packed = 0; });
    refused([](ZipMember& member) { member.size = std::uint64_t{1} << 20; });
    refused([](ZipMember& member) { member.size = member.packed = 0x7fffffffffffffff; });
    refused([](ZipMember& member) { member.size = member.packed = ~std::uint64_t{0}; });
  }
  EXPECT_NE(refusal(true, [](ZipMember& member) { member.method = 0; }).find("is damaged"), std::string::npos);
  EXPECT_NE(refusal(false, [](ZipMember& member) { member.method = 8; }).find("is damaged"), std::string::npos);
}

/// A sum is compared with the last byte, before a reader that stops there goes on.
TEST_F(HostileNpz, WrongSumsAreSeenAtTheLastByte) {
  for (const bool deflated : {false, true}) {
    ZipWriter zip(folder / "a.npz");
    zip.add("x.npy", {{"0123456789", 100}}, deflated).crc ^= 1;
    zip.finish();
    const auto bytes = NpzFile(folder / "a.npz").open(0);
    std::string all(1000, 0);
    EXPECT_EQ(bytes->read(all.data(), 999), 999U);
    EXPECT_NE(input_error([&] { bytes->read(all.data(), 1); }).find("checksum is wrong"), std::string::npos);
  }
}

/// A terabyte of zeros that is said to be one, or said to be short.
TEST_F(HostileNpz, BombsAreRefused) {
  const std::vector<test::ZipPart> zeros = {{std::string(1 << 20, 0), 1 << 10}};
  const auto terabyte = [](ZipMember& member) { member.size = std::uint64_t{1} << 40; };
  EXPECT_NE(refusal(true, terabyte, zeros).find("store it uncompressed (np.savez)"), std::string::npos);
  const auto little = [](ZipMember& member) { member.size = 1000; };
  EXPECT_NE(refusal(true, little, zeros).find("is damaged"), std::string::npos);
}

TEST_F(HostileNpz, CutArchivesAreRefused) {
  ZipWriter zip(folder / "whole.npz");
  zip.add("x.npy", {{"0123456789", 10}});
  zip.add("y.npy", {{"0123456789", 10}}, true);
  zip.finish();
  const std::string whole = test::read_text(folder / "whole.npz");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_NE(refusal_of(folder.write("cut.npz", whole.substr(0, length))), "") << length;
  }
  EXPECT_NE(refusal_of(folder.write("more.npz", whole + "comment")).find("cannot be read as an archive"),
            std::string::npos);
  EXPECT_NE(refusal_of(folder.write("before.npz", "before" + whole)).find("damaged directory"), std::string::npos);
}

/// The file begins with another archive, whose comment is what follows.
TEST_F(HostileNpz, AnotherDirectoryIsNotFound) {
  ZipWriter other(folder / "other.npz");
  other.add("evil.npy", {{"evil"}});
  other.finish();
  const std::string inner = test::read_text(folder / "other.npz");
  for (const std::size_t between : {0, 100, 65'000}) {
    ZipWriter zip(folder / "a.npz");
    zip.write(inner, 1);
    zip.add("x.npy", {{"true"}, {std::string(between, 'y')}});
    zip.finish();
    std::string text = test::read_text(folder / "a.npz");
    const auto comment = static_cast<std::uint16_t>(text.size() - inner.size());
    text.replace(inner.size() - 2, 2, test::little_endian(comment));
    const NpzFile file(folder.write("a.npz", text));
    ASSERT_EQ(file.members().size(), 1U);
    EXPECT_EQ(file.members()[0].key, "x");
    EXPECT_EQ(bytes_of(file).substr(0, 4), "true");
  }
}

TEST_F(HostileNpz, WrongDirectoriesAreRefused) {
  ZipMember member{"x.npy", 3, 3, 0, 0x352441c2, 0, 0};
  const std::string entry = ZipWriter::entry(member);
  for (const std::string& directory : {entry + "x", entry.substr(1), entry + entry.substr(0, 45), std::string()}) {
    EXPECT_NE(refusal_of_directory(directory, 1).find("damaged directory"), std::string::npos) << directory.size();
  }
  for (const std::uint64_t entries :
       {std::uint64_t{0}, std::uint64_t{2}, std::uint64_t{65'535}, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
    EXPECT_NE(refusal_of_directory(entry, entries).find("damaged directory"), std::string::npos) << entries;
  }
}

TEST_F(HostileNpz, HugeDirectoriesAreRefusedWithoutMemory) {
  const std::string entry = ZipWriter::entry({"x.npy", 3, 3, 0, 0x352441c2, 0, 0});
  std::string directory;
  const std::uint64_t entries = 2'000'000;
  for (std::uint64_t i = 0; i < entries; ++i) directory += entry;
  const std::uint64_t before = peak_memory();
  const std::string said = refusal_of_directory(directory, entries);
  EXPECT_NE(said.find("expected at most 16777216"), std::string::npos) << said;
  EXPECT_LT(peak_memory() - before, std::uint64_t{20} << 20);
}

TEST_F(HostileNpz, ArraysOfTheSameNameAreNotChosen) {
  const std::string x = test::NumpyArray{"<f8", {1, 1, 3}, {0, 0, 0}}.bytes();
  const fs::path file = folder.write("a.npz", test::stored_zip({{"x.npy", x}, {"x.npy", x}}));
  EXPECT_NE(input_error([&] { open_frames({file}, {.keys = {"x"}}); }).find("there are 2 arrays"), std::string::npos);
  EXPECT_NE(input_error([&] { open_frames({file}); }).find("several arrays may be the positions"), std::string::npos);
}

}  // namespace
}  // namespace noli
