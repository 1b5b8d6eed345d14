// SPDX-License-Identifier: Apache-2.0
//
// Random numbers that are the same on every machine: xoshiro256** seeded by splitmix64 (Blackman and Vigna 2018),
// written out.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace noli::audit {

class Random {
 public:
  /// The stream of a seed and a number within it, e.g. that of a block.
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0) {
    std::uint64_t state = seed ^ mix(stream + 0x632be59bd9b4e019U);
    for (std::uint64_t& word : state_) word = mix(state += 0x9e3779b97f4a7c15U);
  }

  std::uint64_t next() {
    const std::uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
    const std::uint64_t t = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  /// 0, ..., n - 1. Precondition: n > 0, far below 2^64.
  std::uint64_t below(std::uint64_t n) { return next() % n; }
  /// least, ..., greatest. Precondition: least <= greatest.
  std::int64_t between(std::int64_t least, std::int64_t greatest) {
    return least + static_cast<std::int64_t>(below(static_cast<std::uint64_t>(greatest - least) + 1));
  }
  bool one_in(std::uint64_t n) { return below(n) == 0; }
  /// A multiple of 2^-53 in [0, 1).
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  template <class T, std::size_t N>
  const T& one_of(const std::array<T, N>& items) {
    return items[below(N)];
  }

 private:
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }

  std::array<std::uint64_t, 4> state_{};
};

}  // namespace noli::audit
