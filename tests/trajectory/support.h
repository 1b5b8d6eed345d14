// SPDX-License-Identifier: Apache-2.0
//
// Helpers for the tests of the readers.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include <noli/errors.h>
#include <noli/mesh.h>
#include "tests/support/temporary_folder.h"

namespace noli::testing {

/// The message of the InputError that `f` throws; a test failure and "" if it throws none.
template <class F>
std::string input_error(F&& f) {
  try {
    f();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no InputError was thrown";
  return "";
}

/// Positions as bits, so that -0 and 0 differ in comparisons.
inline std::vector<std::array<std::uint64_t, 3>> bits(const std::vector<Position>& positions) {
  std::vector<std::array<std::uint64_t, 3>> result;
  result.reserve(positions.size());
  for (const Position& x : positions) result.push_back(std::bit_cast<std::array<std::uint64_t, 3>>(x));
  return result;
}

}  // namespace noli::testing
