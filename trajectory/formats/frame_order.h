// SPDX-License-Identifier: Apache-2.0
//
// Compares the order in which frames are named with the numbers in their names.
//
// Notation
//   number    a run of digits of any length, in the name without its extension or in its folders. Right after '_', '='
//             or at the beginning of a name a '-' is its sign; elsewhere '-' only separates. `e-05` and `e+05` after
//             digits are an exponent; `e05` is not
//   family    the names that differ in their numbers only: `cloth_1.ply` and `cloth_10.obj`, not `body_1.ply`
//   12.5      may be a decimal or two numbers. Read as decimals 0.10 comes before 0.9, read as two numbers after it.
//             Where the two disagree the user is asked. They are surely decimals where one fraction of the family
//             begins with 0 and another has a different length (0.05, 0.1), or where one has an exponent. 1.2.3 is
//             three numbers
//   order     names of a family compare by their first number, then by the second, and so on. Numbers of folders come
//             before those of the file's own name
//
// What this does not do: it compares nothing across families, and it opens no file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace noli {

enum class FrameOrder {
  checked,  ///< as given, which has to be the order of the numbers
  natural,  ///< sorted by the numbers
  given     ///< as given, whatever the numbers say
};

/// Frames in the order of time.
struct OrderedFrames {
  std::vector<std::filesystem::path> frames;
  std::string how;                 ///< one line: how they were ordered
  std::vector<std::string> notes;  ///< one line each: against the numbers, sorted, numbers missing, files given twice
};

/// Orders the frames. FrameOrder::natural sorts each family within the places that it has; equal numbers stay as given,
/// and decimals are read as decimals. Throws InputError that shows two names which are given against their numbers.
OrderedFrames order_frames(std::vector<std::filesystem::path> frames, FrameOrder order = FrameOrder::checked);

/// The first of many notes; the last line then counts the others: "and 5 more gaps".
inline constexpr std::size_t most_notes_of_a_kind = 10;
void append_capped(std::vector<std::string>& notes, const std::vector<std::string>& more, std::string_view what);

}  // namespace noli
