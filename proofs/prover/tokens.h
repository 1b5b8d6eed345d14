// SPDX-License-Identifier: Apache-2.0
//
// The tokens of a proof as bytes (proofs/FORMAT.md, sections 2 and 4).
//
// What this does not do: it knows of no obligations.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "kernel/arithmetic/integer.h"
#include "trajectory/mesh.h"

namespace noli {

/// Appends a uint.
void put_uint(std::string& bytes, std::uint64_t value);
/// Appends a sint.
void put_sint(std::string& bytes, const Integer& value);

/// Tokens in pieces that fit a block each.
class Tokens {
 public:
  /// A piece ends before it is longer than the 2^20 bytes of a block: the longest token has less than 4,096.
  static constexpr std::size_t piece_size = (1 << 20) - 4096;

  void halve() { put(0x00); }
  void left() { put(0x01); }
  void right() { put(0x02); }
  void parts() { put(0x03); }
  void one() { put(0x04); }
  void both() { put(0x05); }
  void excluded() { put(0x06); }
  /// S along an axis; `up`: the first group is the one with the greater coordinates.
  void axis(std::size_t k, bool up) { put(static_cast<std::uint8_t>(0x08 + 2 * k + (up ? 0 : 1))); }
  void empty() { put(0x0e); }
  void drop(std::uint8_t k) { put(static_cast<std::uint8_t>(0x20 + k)); }
  /// W along a path from v: the cell and the vertex of each of its steps.
  void ring(VertexId v, const std::vector<std::array<std::uint32_t, 2>>& steps);
  /// S with components of at most ten bits, -512 to 511.
  void direction(const std::array<int, 3>& n);
  void direction(const std::array<Integer, 3>& n);

  const std::vector<std::string>& pieces() const { return pieces_; }

 private:
  std::string& room() {
    if (pieces_.empty() || pieces_.back().size() > piece_size) pieces_.emplace_back();
    return pieces_.back();
  }
  void put(std::uint8_t byte) { room().push_back(static_cast<char>(byte)); }

  std::vector<std::string> pieces_;
};

}  // namespace noli
