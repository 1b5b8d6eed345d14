// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/tokens/tokens.h"

#include <algorithm>
#include <cstring>

namespace noli {

void put_uint(std::string& bytes, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) bytes.push_back(static_cast<char>(value | 0x80));
  bytes.push_back(static_cast<char>(value));
}

void put_sint(std::string& bytes, const Integer& value) {
  Integer coded = value.sign() < 0 ? -value * Integer(2) - Integer(1) : value * Integer(2);
  do {
    const auto low = static_cast<std::uint8_t>(mpz_get_ui(coded.get()) & 0x7f);
    coded >>= 7;
    bytes.push_back(static_cast<char>(coded.is_zero() ? low : low | 0x80));
  } while (!coded.is_zero());
}

namespace {

void put_tree(std::string& bytes, std::span<const std::uint32_t> leaf_cells) {
  if (leaf_cells.size() == 1) return put_uint(bytes, std::uint64_t{leaf_cells[0]} + 1);
  put_uint(bytes, 0);
  put_tree(bytes, leaf_cells.first(leaf_cells.size() / 2));
  put_tree(bytes, leaf_cells.subspan(leaf_cells.size() / 2));
}

}  // namespace

std::string encoded_tree(std::span<const std::uint32_t> leaf_cells) {
  std::string bytes;
  put_tree(bytes, leaf_cells);
  return bytes;
}

std::string encoded_join(std::span<const std::string> trees) {
  if (trees.size() == 1) return trees[0];
  std::string bytes;
  put_uint(bytes, 0);
  bytes += encoded_join(trees.first(trees.size() / 2));
  return bytes += encoded_join(trees.subspan(trees.size() / 2));
}

void Tokens::add_piece(std::size_t bytes) {
  // Many lists are short, so pieces begin short and double: at most about half of a list is unused.
  constexpr std::size_t first_size = 1024;
  std::size_t size = first_size;
  if (!pieces_.empty()) {
    // Less than longest_piece, so that a place at its end differs from one at the beginning of the next piece.
    size = std::min(2 * static_cast<std::size_t>(limit_ - pieces_.back().bytes.get()), longest_piece - 1);
    pieces_.back().size = used();
  }
  size = std::max(size, bytes);
  pieces_.push_back({std::make_unique_for_overwrite<char[]>(size), size});
  end_ = pieces_.back().bytes.get();
  limit_ = end_ + size;
}

void Tokens::append(const std::string& token) {
  std::memcpy(room(token.size()), token.data(), token.size());
  end_ += token.size();
}

void Tokens::truncate(std::size_t place) {
  if (pieces_.empty()) return;
  const std::size_t last = place / longest_piece;
  if (last + 1 < pieces_.size()) {  // the free rest of an earlier piece is not used again
    pieces_.resize(last + 1);
    limit_ = pieces_.back().bytes.get() + pieces_.back().size;
  }
  end_ = pieces_.back().bytes.get() + place % longest_piece;
}

void Tokens::give(std::size_t begin, std::size_t end, const std::function<void(std::string_view)>& take) const {
  while (begin < end) {
    const std::size_t i = begin / longest_piece, from = begin % longest_piece;
    const std::size_t to = end / longest_piece == i ? end % longest_piece : pieces_[i].size;
    if (from < to) take({pieces_[i].bytes.get() + from, to - from});
    begin = (i + 1) * longest_piece;
  }
}

void JoinedTokens::give(const std::function<void(std::string_view)>& take) const {
  std::size_t from = begin;
  for (std::size_t i = 0; i < places.size(); ++i) {
    tokens.give(from, places[i], take);
    inserted[i].give(take);
    from = places[i];
  }
  tokens.give(from, end.value_or(tokens.place()), take);
}

void Tokens::direction(const std::array<Integer, 3>& n) {
  std::string bytes(1, static_cast<char>(TokenCode::direction));
  for (const Integer& part : n) put_sint(bytes, part);
  append(bytes);
}

void Tokens::ring(VertexId v, const std::vector<std::array<std::uint32_t, 2>>& steps) {
  std::string bytes(1, static_cast<char>(TokenCode::ring));
  put_uint(bytes, steps.size());
  put_uint(bytes, v);
  for (const auto& [cell, next] : steps) {
    put_uint(bytes, cell);
    put_uint(bytes, next);
  }
  append(bytes);
}

}  // namespace noli
