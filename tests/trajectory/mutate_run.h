// SPDX-License-Identifier: Apache-2.0
//
// Changes the payloads of a run's blocks as directed by a string of bytes, and repairs all checksums and commits, so
// that checksums cannot detect the damage.
//
//   changes  =  change*
//   change   =  which block, two bytes; which change, one byte; where in it, two bytes; which number, one byte
//
// Missing bytes at the end are 0. All counts wrap, so any bytes are valid changes.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "tests/trajectory/run_samples.h"
#include "trajectory/blocks/bytes.h"

namespace noli::testing {

class Choices {
 public:
  explicit Choices(std::string_view bytes) : bytes_(bytes) {}

  bool left() const { return !bytes_.empty(); }
  std::size_t one() {
    if (bytes_.empty()) return 0;
    const auto byte = static_cast<unsigned char>(bytes_.front());
    bytes_.remove_prefix(1);
    return byte;
  }
  std::size_t two() { return one() + 256 * one(); }

 private:
  std::string_view bytes_;
};

/// 64-bit patterns that tend to break readers.
inline const std::array<std::uint64_t, 18>& delicate_numbers() {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  constexpr auto infinity = std::numeric_limits<double>::infinity();
  static const std::array<std::uint64_t, 18> all = {0,
                                                    1,
                                                    2,
                                                    3,
                                                    0x7fffffff,
                                                    0x80000000,
                                                    0xffffffff,
                                                    std::uint64_t{1} << 32,
                                                    std::uint64_t{1} << 53,
                                                    ~std::uint64_t{0} >> 1,
                                                    ~std::uint64_t{0},
                                                    bits(-0.0),
                                                    bits(infinity),
                                                    bits(-infinity),
                                                    bits(std::numeric_limits<double>::quiet_NaN()),
                                                    bits(std::numeric_limits<double>::max()),
                                                    bits(std::numeric_limits<double>::denorm_min()),
                                                    bits(-1)};
  return all;
}

/// Changes bytes at `at`. A number that does not fit there is cut off.
inline void change_number(std::string& payload, std::size_t at, std::size_t which, std::size_t number) {
  std::string bytes;
  if (which == 0) put(bytes, delicate_numbers()[number % delicate_numbers().size()]);
  if (which == 1) put(bytes, static_cast<std::uint32_t>(delicate_numbers()[number % delicate_numbers().size()]));
  if (which == 2) bytes = static_cast<char>(payload[at] ^ (1 << number % 8));
  if (which == 3) bytes = static_cast<char>(number);
  if (which == 4) {  // near the old value
    std::string eight = payload.substr(at, 8);
    eight.resize(8, '\0');
    put(bytes, get<std::uint64_t>(eight.data()) + number - 128);
  }
  payload.replace(at, std::min(bytes.size(), payload.size() - at), bytes.substr(0, payload.size() - at));
}

inline void change_block(std::vector<Block>& blocks, std::size_t i, Choices& choices) {
  constexpr std::size_t numbers = 5;
  const std::size_t which = choices.one() % (numbers + 5), place = choices.two(), number = choices.one();
  std::string& payload = blocks[i].payload;
  if (which < numbers) {
    if (payload.empty()) return;
    // Doubles and counts change at a multiple of four, single bytes anywhere.
    const std::size_t step = which < 2 || which == 4 ? 4 : 1;
    return change_number(payload, place * step % payload.size(), which, number);
  }
  if (which == numbers) payload.resize(payload.size() - std::min(payload.size(), number));
  if (which == numbers + 1) payload.append(number, '\0');
  if (which == numbers + 2) std::swap(blocks[i], blocks[place % blocks.size()]);
  if (which == numbers + 3) blocks.insert(blocks.begin() + static_cast<std::ptrdiff_t>(i), Block(blocks[i]));
  if (which == numbers + 4) blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(i));
}

/// The file with these changes.
inline std::string mutated_run(const std::string& bytes, std::string_view changes) {
  return changed(bytes, [&](std::vector<Block>& blocks) {
    Choices choices(changes);
    while (choices.left() && !blocks.empty()) change_block(blocks, choices.two() % blocks.size(), choices);
  });
}

}  // namespace noli::testing
