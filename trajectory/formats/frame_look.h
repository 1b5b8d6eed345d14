// SPDX-License-Identifier: Apache-2.0
//
// Takes a look at the bytes of a frame: counts, number type, and whether its cells are spelled like those of another
// frame. Except for VTU and VTP it takes a small part of the time of parsing.
//
//   OBJ          lines that begin with v, f, l and p; the text of the last three is compared
//   PLY, ASCII   the header, and all lines but those of vertices
//   PLY, binary  the header, and all bytes but those of vertices
//   VTU, VTP     all of it is parsed, and the cells are compared, however they are spelled
//
// Otherwise it does not check coordinates and indices. Different spellings of the same cells (with texture indices, for
// example) count as different; only parsing can tell.
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
  /// if only parsing can find the cells.
  std::optional<std::uint64_t> cells;
};

/// The hash of the bytes of a file. Throws Stopped.
Sha256Digest frame_hash(std::string_view bytes);

/// Throws InputError for a malformed header of a PLY file, for a malformed VTU or VTP file, and for other extensions;
/// Stopped.
FrameLook look_at_frame(std::string_view bytes, const std::filesystem::path& path);

/// The size and hash of any file. Reads it part by part, until `stop` returns true. Throws InputError, ReadInterrupted.
FrameFacts file_facts(const std::filesystem::path& path, const std::function<bool()>& stop = {});

/// How finely decimal text gives coordinates, that is, how far rounding to that text may have moved them. Whether
/// numbers were rounded cannot be known: 0.5 may be a half, or 0.46 with one decimal.
///   digits     of one number: from its first nonzero digit to its last one, zeros at the end included. The text has
///              the largest count of all numbers
///   decimals   of one number: digits after the point, as an exponent moves it; the largest count of all numbers
///   unit       10^k: the place of the last of `digits` digits in the number of the largest magnitude. With %.6f it is
///              10^-6; with %g or %e that of the coarsest coordinate. If all numbers with decimals have equally many,
///              and more than there are digits (0.000001 next to 4), it is the place of the last decimal
class TextDigits {
 public:
  /// Takes one word of a file. Words that are not numbers are ignored.
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

/// This many digits distinguish every float64, or float32, from all others, so text that has them need not be rounded.
inline constexpr std::size_t digits_of_float64 = 17, digits_of_float32 = 9;

}  // namespace noli
