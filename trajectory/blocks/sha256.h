// SPDX-License-Identifier: Apache-2.0
//
// SHA-256, as FIPS 180-4 defines it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace noli {

using Sha256Digest = std::array<std::uint8_t, 32>;

/// The hash of a text that comes in parts:
///   Sha256 hash;
///   hash.update(a);
///   hash.update(b);
///   hash.digest()   the hash of ab; more may follow
class Sha256 {
 public:
  void update(std::string_view bytes);
  Sha256Digest digest() const;

 private:
  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<char, 64> block_{};  ///< the first size_ % 64 bytes wait for the rest of their block
  std::uint64_t size_ = 0;        ///< bytes so far
};

Sha256Digest sha256(std::string_view bytes);

/// 64 hexadecimal digits in lower case.
std::string hex(const Sha256Digest& digest);

/// The digest that hex() wrote as this text; nothing for any other text.
std::optional<Sha256Digest> digest_of_hex(std::string_view text);

/// The bytes of a digest, for writing and hashing.
inline std::string_view bytes_of(const Sha256Digest& digest) {
  return {reinterpret_cast<const char*>(digest.data()), digest.size()};
}

}  // namespace noli
