// SPDX-License-Identifier: Apache-2.0
//
// Writes the tokens of a proof as bytes (proofs/FORMAT.md, sections 2 and 4).
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <noli/mesh.h>
#include "kernel/arithmetic/integer.h"

namespace noli {

/// Appends a uint.
void put_uint(std::string& bytes, std::uint64_t value);
/// Appends a sint.
void put_sint(std::string& bytes, const Integer& value);
/// The payload of block TREE, in which each node over m > 1 leaves has the first m / 2 of them in its left child.
std::string encoded_tree(std::span<const std::uint32_t> leaf_cells);

/// The same for a node over some trees, halved in the same way.
std::string encoded_join(std::span<const std::string> trees);

/// The first byte of each token; proofs/FORMAT.md has the rest.
enum class TokenCode : std::uint8_t {
  halve = 0x00,
  left = 0x01,
  right = 0x02,
  parts = 0x03,
  one = 0x04,
  both = 0x05,
  excluded = 0x06,
  axis = 0x08,  ///< plus 2 k for axis k, plus 1 if the first group is the lower one
  last_axis = 0x0d,
  empty = 0x0e,
  short_direction = 0x10,
  direction = 0x11,
  half_space = 0x12,  ///< the checkers accept it, but Tokens never writes it
  drop = 0x20,        ///< plus k for common vertex k
  last_drop = 0x22,
  ring = 0x30
};

/// A list of tokens, in pieces that are added as it grows; tokens are never moved.
class Tokens {
 public:
  static constexpr bool on = true;
  /// A payload of TOKS is no longer than this, and no token goes beyond its payload.
  static constexpr std::size_t longest_payload = 1 << 20;
  /// A place in the list is the number of a piece times this, plus an offset.
  static constexpr std::size_t longest_piece = 1 << 16;

  void halve() { put(TokenCode::halve); }
  void left() { put(TokenCode::left); }
  void right() { put(TokenCode::right); }
  void parts() { put(TokenCode::parts); }
  void one() { put(TokenCode::one); }
  void both() { put(TokenCode::both); }
  void excluded() { put(TokenCode::excluded); }
  /// S along an axis; `up`: the first group is the one with the greater coordinates.
  void axis(std::size_t k, bool up) { axis(axis_code(k, up)); }
  void axis(std::uint8_t code) { put(static_cast<TokenCode>(code)); }
  static constexpr std::uint8_t axis_code(std::size_t k, bool up) {
    return static_cast<std::uint8_t>(static_cast<std::size_t>(TokenCode::axis) + 2 * k + (up ? 0 : 1));
  }
  /// The code of the least of some separating axes (proofs/prover/hierarchy.h); 0 without any.
  static std::uint8_t axis_code_of(unsigned axes) {
    static constexpr auto codes = [] {
      std::array<std::uint8_t, 9> all{};
      for (std::size_t k = 0; k < 3; ++k) {
        all[k] = axis_code(k, true);
        all[4 + k] = axis_code(k, false);
      }
      return all;
    }();
    return codes[static_cast<std::size_t>(std::countr_zero(axes | 1U << 8))];
  }
  void empty() { put(TokenCode::empty); }
  void drop(std::size_t k) { put(static_cast<TokenCode>(static_cast<std::size_t>(TokenCode::drop) + k)); }
  /// W along a path from v: the cell and the vertex of each of its steps.
  void ring(VertexId v, const std::vector<std::array<std::uint32_t, 2>>& steps);
  /// S with components of at most ten bits, -512 to 511.
  void direction(const std::array<int, 3>& n) {
    char* const at = room(5);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word |= (static_cast<std::uint32_t>(n[k]) & 0x3ff) << (10 * k);
    at[0] = static_cast<char>(TokenCode::short_direction);
    for (std::size_t i = 0; i < 4; ++i) at[1 + i] = static_cast<char>(word >> (8 * i));
    end_ += 5;
  }
  void direction(const std::array<Integer, 3>& n);

  /// The place of the next token.
  std::size_t place() const { return pieces_.empty() ? 0 : (pieces_.size() - 1) * longest_piece + used(); }
  /// Forgets the tokens from a place on.
  void truncate(std::size_t place);
  /// Passes the tokens between two places to `take`, in pieces that fit a payload each.
  void give(std::size_t begin, std::size_t end, const std::function<void(std::string_view)>& take) const;
  void give(const std::function<void(std::string_view)>& take) const { give(0, place(), take); }

 private:
  struct Piece {
    std::unique_ptr<char[]> bytes;  // not a string: that would be filled with zeros first
    std::size_t size;               ///< capacity while it is the last piece, then the bytes used
  };

  std::size_t used() const { return static_cast<std::size_t>(end_ - pieces_.back().bytes.get()); }
  /// Room for a token of this many bytes.
  char* room(std::size_t bytes) {
    if (static_cast<std::size_t>(limit_ - end_) < bytes) add_piece(bytes);
    return end_;
  }
  void add_piece(std::size_t bytes);
  [[gnu::always_inline]] void put(TokenCode code) {
    *room(1) = static_cast<char>(code);
    ++end_;
  }
  void append(const std::string& token);

  std::vector<Piece> pieces_;
  char* end_ = nullptr;    ///< the place of the next token, in the last piece
  char* limit_ = nullptr;  ///< the end of the last piece
};

/// Replaces Tokens if no proof is wanted; does nothing.
struct NoTokens {
  static constexpr bool on = false;

  void left() {}
  void right() {}
  void parts() {}
  void excluded() {}
  void empty() {}
  void halve() {}
  void drop(std::size_t /*k*/) {}
  static constexpr std::size_t place() { return 0; }
  void truncate(std::size_t /*place*/) {}
};

/// Tokens, with others inserted.
struct JoinedTokens {
  Tokens tokens;
  std::vector<std::size_t> places;      ///< in the tokens, ascending: where the others are inserted
  std::vector<JoinedTokens> inserted;   ///< one for each place
  std::size_t begin = 0;                ///< the tokens before it do not count
  std::optional<std::size_t> end = {};  ///< nor those from here on

  void give(const std::function<void(std::string_view)>& take) const;
};

/// Joins small pieces, so that a payload has some 64 kB.
class TokenBlocks {
 public:
  explicit TokenBlocks(const std::function<void(std::string_view)>& take) : take_(take) {}
  void operator()(std::string_view bytes) {
    bytes_ += bytes;
    if (bytes_.size() >= enough) flush();
  }
  void flush() {
    if (!bytes_.empty()) take_(bytes_);
    bytes_.clear();
  }

 private:
  static constexpr std::size_t enough = 1 << 16;
  static_assert(enough + Tokens::longest_piece <= Tokens::longest_payload);

  const std::function<void(std::string_view)>& take_;
  std::string bytes_;
};

}  // namespace noli
