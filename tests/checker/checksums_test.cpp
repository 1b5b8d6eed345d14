// SPDX-License-Identifier: Apache-2.0
//
// Tests the checker's checksums with examples of FIPS 180-4 and RFC 3720, with and without processor instructions.
#include "support.h"

namespace noli::checker::test {
namespace {

std::string hex(std::string_view bytes) {
  std::string text;
  for (const char byte : bytes) {
    std::array<char, 3> two{};
    std::snprintf(two.data(), two.size(), "%02x", static_cast<unsigned char>(byte));
    text += two.data();
  }
  return text;
}

void expect_sha256() {
  EXPECT_EQ(hex(sha256("")), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hex(sha256("abc")), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hex(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq")),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(hex(sha256(std::string(1'000'000, 'a'))),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

void expect_crc32c() {
  EXPECT_EQ(crc32c("123456789"), 0xe3069283u);
  EXPECT_EQ(crc32c("56789abcdefghijklmnop", crc32c("1234")), crc32c("123456789abcdefghijklmnop"));
  EXPECT_NE(crc32c("123456788"), 0xe3069283u);
}

TEST(Checksums, KnownValues) {
  expect_sha256();
  expect_crc32c();
}

#ifdef __x86_64__
TEST(Checksums, KnownValuesWithoutInstructions) {
  if (!by_instructions) std::puts("skipped: the same by instructions, which this processor has not");
  const bool before = std::exchange(by_instructions, false);
  expect_sha256();
  expect_crc32c();
  by_instructions = before;
}
#endif

}  // namespace
}  // namespace noli::checker::test
