// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>
#include <random>
#include <string>

#include "trajectory/blocks/crc32c.h"
#include "trajectory/blocks/sha256.h"
#include "trajectory/blocks/sha256_blocks.h"

namespace noli {
namespace {

std::string random_text(std::size_t size) {
  std::mt19937_64 random(size);
  std::string text(size, '\0');
  for (char& c : text) c = static_cast<char>(random());
  return text;
}

TEST(Crc32c, HasThePublishedCheckValue) {
  EXPECT_EQ(crc32c("123456789"), 0xE3069283u);
  EXPECT_EQ(crc32c_plain("123456789"), 0xE3069283u);
}

TEST(Crc32c, HasTheValuesOfRfc3720) {
  std::string ascending, descending;
  for (int i = 0; i < 32; ++i) {
    ascending += static_cast<char>(i);
    descending += static_cast<char>(31 - i);
  }
  EXPECT_EQ(crc32c(std::string(32, '\0')), 0x8A9136AAu);
  EXPECT_EQ(crc32c(std::string(32, '\xff')), 0x62A8AB43u);
  EXPECT_EQ(crc32c(ascending), 0x46DD794Eu);
  EXPECT_EQ(crc32c(descending), 0x113FDB5Cu);
  EXPECT_EQ(crc32c(""), 0u);
}

TEST(Crc32c, TheInstructionOfTheProcessorGivesWhatPlainCodeGives) {
  if (!has_crc_instruction()) {
    std::puts("skipped: this processor has no instruction for CRC-32C");
    GTEST_SKIP();
  }
  const std::string text = random_text(100);
  for (std::size_t size = 0; size <= text.size(); ++size) {
    const std::string_view part = std::string_view(text).substr(0, size);
    EXPECT_EQ(crc32c_plain(part, 7), crc32c_by_instruction(part, 7)) << size;
  }
}

TEST(Crc32c, InPartsIsTheSame) {
  const std::string text = random_text(100);
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    EXPECT_EQ(crc32c(text.substr(cut), crc32c(text.substr(0, cut))), crc32c(text)) << cut;
  }
}

TEST(Crc32c, SeesEveryFlippedBit) {
  const std::string text = random_text(37);
  for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
    std::string other = text;
    other[bit / 8] = static_cast<char>(other[bit / 8] ^ (1 << bit % 8));
    EXPECT_NE(crc32c(other), crc32c(text)) << bit;
  }
}

TEST(Sha256, HasThePublishedValues) {
  EXPECT_EQ(hex(sha256("")), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hex(sha256("abc")), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hex(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq")),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(hex(sha256(std::string(1000000, 'a'))), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, InPartsIsTheSameForEveryLength) {
  const std::string text = random_text(200);
  for (std::size_t size = 0; size <= text.size(); ++size) {
    Sha256 parts;
    for (std::size_t at = 0; at < size; at += 7)
      parts.update(std::string_view(text).substr(at, std::min<std::size_t>(7, size - at)));
    EXPECT_EQ(parts.digest(), sha256(text.substr(0, size))) << size;
  }
}

TEST(Sha256, ADigestOnTheWayChangesNothing) {
  Sha256 hash;
  hash.update("a");
  EXPECT_EQ(hash.digest(), sha256("a"));
  hash.update("bc");
  EXPECT_EQ(hash.digest(), sha256("abc"));
}

TEST(Sha256, TheInstructionsOfTheProcessorGiveWhatPlainCodeGives) {
  if (!has_sha_instructions()) {
    std::puts("skipped: this processor has no instructions for SHA-256");
    GTEST_SKIP();
  }
  const std::string text = random_text(64 * 20);
  Sha256State plain = {1, 2, 3, 4, 5, 6, 7, 0xffffffff}, fast = plain;
  sha256_blocks_plain(plain, text);
  sha256_blocks_by_instructions(fast, text);
  EXPECT_EQ(plain, fast);
}

}  // namespace
}  // namespace noli
