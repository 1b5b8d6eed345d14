// SPDX-License-Identifier: Apache-2.0
#include "trajectory/blocks/sha256.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>

#include "trajectory/blocks/sha256_blocks.h"

namespace noli {
namespace {

/// The padding after the text (FIPS 180-4, section 5.1.1): a one bit, zeros up to eight bytes before a multiple of 64,
/// and the size in bits.
std::string padding(std::uint64_t size) {
  std::string bytes(1 + (119 - size % 64) % 64, '\0');
  bytes[0] = static_cast<char>(0x80);
  for (int shift = 56; shift >= 0; shift -= 8) bytes += static_cast<char>(size * 8 >> shift & 0xff);
  return bytes;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

}  // namespace

void Sha256::update(std::string_view bytes) {
  const std::size_t waiting = size_ % 64;
  size_ += bytes.size();
  if (waiting > 0) {
    const std::size_t taken = std::min(bytes.size(), 64 - waiting);
    std::copy_n(bytes.data(), taken, block_.data() + waiting);
    bytes.remove_prefix(taken);
    if (waiting + taken < 64) return;
    sha256_blocks(state_, {block_.data(), 64});
  }
  const std::size_t whole = bytes.size() / 64 * 64;
  sha256_blocks(state_, bytes.substr(0, whole));
  std::copy_n(bytes.data() + whole, bytes.size() - whole, block_.data());
}

Sha256Digest Sha256::digest() const {
  Sha256 padded = *this;
  padded.update(padding(size_));
  Sha256Digest digest;
  for (std::size_t i = 0; i < 32; ++i) {
    digest[i] = static_cast<std::uint8_t>(padded.state_[i / 4] >> (24 - 8 * (i % 4)) & 0xff);
  }
  return digest;
}

Sha256Digest sha256(std::string_view bytes) {
  Sha256 hash;
  hash.update(bytes);
  return hash.digest();
}

std::string hex(const Sha256Digest& digest) { return fmt::format("{:02x}", fmt::join(digest, "")); }

std::optional<Sha256Digest> digest_of_hex(std::string_view text) {
  Sha256Digest digest{};
  bool good = text.size() == 2 * digest.size();
  for (std::size_t i = 0; good && i < digest.size(); ++i) {
    const int high = hex_digit(text[2 * i]), low = hex_digit(text[2 * i + 1]);
    good = high >= 0 && low >= 0;
    digest[i] = static_cast<std::uint8_t>(16 * high + low);
  }
  return good ? std::optional(digest) : std::nullopt;
}

}  // namespace noli
