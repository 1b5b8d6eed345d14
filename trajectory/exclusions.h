// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace noli {

/// Which pairs of cells are not compared: those of two groups of vertices, or of one, that a scene lets pass through
/// each other.
struct Exclusions {
  using Pair = std::array<std::uint16_t, 2>;

  std::vector<std::uint16_t>
      groups;               ///< of each vertex; the vertices of a cell are of one group. Empty if there are no
                            ///< pairs
  std::vector<Pair> pairs;  ///< {a, b} with a <= b, ascending, each once

  bool empty() const { return pairs.empty(); }
  bool excluded(std::uint16_t a, std::uint16_t b) const {
    return std::binary_search(pairs.begin(), pairs.end(), Pair{std::min(a, b), std::max(a, b)});
  }
  friend bool operator==(const Exclusions&, const Exclusions&) = default;
};

}  // namespace noli
