// SPDX-License-Identifier: Apache-2.0
//
// A quick look at the bytes of a frame: counts, number type, and whether its cells are spelled as those of another. It
// takes a small part of the time that parsing takes.
//
//   OBJ          lines that begin with v, f, l and p; the text of the last three is what is compared
//   PLY, ASCII   the header, and all lines but those of vertices
//   PLY, binary  the header, and all bytes but those of vertices
//
// What this does not do: it finds no fault in a coordinate or an index, and other spellings of the same cells (with
// texture indices, say) differ for it. Who needs to know parses the frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include <noli/frames.h>
#include "trajectory/blocks/sha256.h"

namespace noli {

struct FrameLook {
  FrameFacts facts;
  /// Equal for equal counts of vertices and equal spellings of cells; different spellings almost surely differ. Nothing
  /// where cells can only be found by parsing.
  std::optional<std::uint64_t> cells;
};

/// The hash of the bytes of a file. Throws Stopped.
Sha256Digest frame_hash(std::string_view bytes);

/// Throws InputError for a header of a PLY file that is not as it has to be, and for other extensions; Stopped.
FrameLook look_at_frame(std::string_view bytes, const std::filesystem::path& path);

/// Of any file: bytes and hash alone. It is read part by part, until `stop` says true. Throws InputError,
/// ReadInterrupted.
FrameFacts file_facts(const std::filesystem::path& path, const std::function<bool()>& stop = {});

/// How finely decimal text gives coordinates: what rounding to that text may have moved. It cannot be known whether
/// numbers were rounded: 0.5 may be a half, or 0.46 with one decimal.
///   digits     of one number: from its first digit that is not 0 to its last one, zeros at the end included; the most
///              of all numbers is what the text is said to have
///   decimals   of one number: digits behind the point, where an exponent moves it; the most of all numbers
///   unit       10^k. The place of the last of so many digits in the number of the largest magnitude: with %.6f 10^-6;
///              with %g or %e that of the coarsest coordinate. Where all numbers with decimals have as many, and more
///              than there are digits (0.000001 beside 4), it is the place of the last decimal
class TextDigits {
 public:
  /// Takes one word of a file. Words that are no numbers count nothing.
  void add(std::string_view word);

  std::size_t digits() const { return digits_; }
  std::size_t decimals() const { return decimals_; }
  /// k of the unit 10^k; nothing before the first number.
  std::optional<int> unit() const;
  /// "text with 9 digits, 6 decimals"
  std::string text() const;

 private:
  std::size_t digits_ = 0, decimals_ = 0;
  std::optional<std::size_t> least_decimals_;  ///< of the numbers that have any
  std::optional<int> largest_;                 ///< k of the first digit of the largest number
  bool any_ = false;
};

/// So many digits tell every float64, or float32, from all others: text that has them need not have been rounded.
inline constexpr std::size_t digits_of_float64 = 17, digits_of_float32 = 9;

}  // namespace noli
