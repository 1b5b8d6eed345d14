// SPDX-License-Identifier: Apache-2.0
//
// Mutations of the tokens of proofs (proofs/FORMAT.md, sections 3 and 4).
#include <array>
#include <numeric>

#include "audit/fuzz/proofs/mutating.h"
#include "proofs/prover/tokens/tokens.h"

namespace noli::audit {

namespace {

using namespace mutating;

/// What a token that is not empty begins with, which need not be a code that exists.
TokenCode code_at(const std::string& token, std::size_t at = 0) {
  return static_cast<TokenCode>(static_cast<std::uint8_t>(token[at]));
}

std::string first_byte(TokenCode code) { return std::string(1, static_cast<char>(code)); }

/// How many varints follow a token's first byte; of token W that depends on the first of them.
std::size_t varints_after(TokenCode code) {
  switch (code) {
    case TokenCode::direction: return 3;
    case TokenCode::half_space: return 10;
    default: return 0;
  }
}

/// Where the varint at `at` ends; past the end if it is not whole.
std::size_t end_of_varint(const std::string& payload, std::size_t at) {
  while (at < payload.size() && (payload[at] & 0x80) != 0) ++at;
  return at + 1;
}

std::size_t end_of_token(const std::string& payload, std::size_t at) {
  const TokenCode code = code_at(payload, at++);
  if (code == TokenCode::short_direction) return at + 4;
  std::size_t varints = varints_after(code);
  if (code == TokenCode::ring) {
    const auto edges = static_cast<unsigned char>(at < payload.size() ? payload[at] : 0) & 0x7fU;
    varints = 2 + 2 * std::size_t{edges};
  }
  for (; varints > 0; --varints) at = end_of_varint(payload, at);
  return at;
}

/// Changes the tokens of a block that has at least `least` of them.
template <class Change>
bool change_tokens(Mutating& m, std::size_t least, const Change& change) {
  ProofBlock* const block = some_block(m, {mutating::tokens});
  if (block == nullptr) return false;
  std::vector<std::string> tokens;
  for (std::size_t at = 0; at < block->payload.size();) {
    const std::size_t end = std::min(end_of_token(block->payload, at), block->payload.size());
    tokens.push_back(block->payload.substr(at, end - at));
    at = end;
  }
  if (tokens.size() < least || !change(tokens)) return false;
  block->payload = std::accumulate(tokens.begin(), tokens.end(), std::string());
  return true;
}

/// Changes one random token of a block, all that fit equally likely. `change` also gets all tokens of the block.
template <class Fits, class Change>
bool change_token(Mutating& m, const Fits& fits, const Change& change) {
  return change_tokens(m, 1, [&](std::vector<std::string>& tokens) {
    std::vector<std::string*> some;
    for (std::string& token : tokens) {
      if (fits(token)) some.push_back(&token);
    }
    if (some.empty()) return false;
    change(*some[some_index(m.random, some)], tokens);
    return true;
  });
}

bool any_token(const std::string& /*token*/) { return true; }

/// The token S with small numbers.
std::string direction_token(Random& random) {
  std::string token = first_byte(TokenCode::short_direction);
  std::uint32_t bits = 0;
  for (unsigned i = 0; i < 3; ++i) {
    const auto n = static_cast<std::uint32_t>(random.one_in(2) ? random.between(-1, 1) : random.between(-512, 511));
    bits |= (n & 1023U) << 10 * i;
  }
  put(token, bits);
  return token;
}

std::string scaled_number(std::uint64_t shift, std::int64_t n) { return uint_bytes(shift) + sint_bytes(n); }

/// From least to greatest, times a power of two below 2^shifts.
std::string some_scaled_number(Random& random, std::uint64_t shifts, std::int64_t least, std::int64_t greatest) {
  const std::uint64_t shift = random.below(shifts);
  return scaled_number(shift, random.between(least, greatest));
}

/// The token P with a plane that nearly rests.
std::string plane_token(Random& random) {
  constexpr std::array<std::uint64_t, 5> shifts = {0, 0, 1, 3, 60};
  std::string token = first_byte(TokenCode::half_space) + uint_bytes(random.one_of(shifts));
  for (int i = 0; i < 3; ++i) token += sint_bytes(random.between(-3, 3));
  token += some_scaled_number(random, 9, -2, 2);
  token += some_scaled_number(random, 9, -30, 29);
  return token + some_scaled_number(random, 9, 0, 3);
}

std::string path_token(Random& random) {
  constexpr std::array<std::uint64_t, 6> lengths = {0, 1, 1, 2, 3, 256};
  const std::uint64_t m = random.one_of(lengths);
  std::string token = first_byte(TokenCode::ring) + uint_bytes(m);
  for (std::uint64_t i = 0; i < 2 * m + 1; ++i) token += uint_bytes(random.below(6));
  return token;
}

/// The first bytes of tokens without numbers, of those that are along an axis, and two bytes next to them (07, 23) that
/// no token has.
constexpr auto plain_bytes = [] {
  constexpr int empty = static_cast<int>(TokenCode::empty), drop = static_cast<int>(TokenCode::drop),
                behind = static_cast<int>(TokenCode::last_drop) + 1;
  std::array<char, empty + 1 + behind - drop + 1> all{};
  std::iota(all.begin(), all.begin() + empty + 1, '\0');
  std::iota(all.begin() + empty + 1, all.end(), static_cast<char>(drop));
  return all;
}();

std::string some_token(Random& random, const std::vector<std::string>& items) {
  switch (random.below(8)) {
    case 0: return items[some_index(random, items)];
    case 1: return direction_token(random);
    case 2: {
      std::string token = first_byte(TokenCode::direction);
      for (int i = 0; i < 3; ++i) token += sint_bytes(random.between(-1'000'000, 1'000'000) << random.below(40));
      return token;
    }
    case 3: return plane_token(random);
    case 4: return path_token(random);
    default: return {random.one_in(10) ? static_cast<char>(random.below(256)) : random.one_of(plain_bytes)};
  }
}

bool token_deleted(Mutating& m) {
  return change_token(m, any_token, [](std::string& token, const auto&) { token.clear(); });
}

bool token_doubled(Mutating& m) {
  return change_token(m, any_token, [](std::string& token, const auto&) { token += token; });
}

bool tokens_swapped(Mutating& m) {
  return change_tokens(m, 2, [&](std::vector<std::string>& tokens) {
    const std::size_t k = some_index(m.random, tokens);
    std::swap(tokens[k], tokens[m.random.one_in(2) ? (k + 1) % tokens.size() : some_index(m.random, tokens)]);
    return true;
  });
}

bool token_replaced(Mutating& m) {
  return change_tokens(m, 1, [&](std::vector<std::string>& tokens) {
    const std::string other = some_token(m.random, tokens);
    tokens[some_index(m.random, tokens)] = other;
    return true;
  });
}

bool token_inserted(Mutating& m) {
  return change_token(m, any_token, [&](std::string& token, const std::vector<std::string>& tokens) {
    token = some_token(m.random, tokens) + token;
  });
}

/// T before a token that is then needed twice, which is good; or three times, or once; or very often.
bool split_inserted(Mutating& m) {
  return change_token(m, any_token, [&](std::string& token, const auto&) {
    constexpr std::array<std::size_t, 7> depths = {1, 1, 1, 3, 20, 1023, 1025};
    const std::size_t depth = m.random.one_of(depths), times = depth + 1 - (m.random.one_in(4) ? 1 : 0);
    std::string all(depth, static_cast<char>(TokenCode::halve));
    for (std::size_t i = 0; i < times; ++i) all += token;
    token = all;
  });
}

/// A coefficient of S, in either of its forms, of P or W.
bool coefficient(Mutating& m) {
  const auto has_one = [](const std::string& token) { return token.size() > 1; };
  return change_token(m, has_one, [&](std::string& token, const auto&) {
    if (code_at(token) == TokenCode::short_direction) {
      const auto shift = static_cast<unsigned>(10 * m.random.below(3));
      change_field<std::uint32_t>(token, 1, [&](std::uint32_t bits) {
        const auto n = static_cast<std::uint32_t>(other_integer(m.random, bits >> shift & 1023U)) & 1023U;
        return (bits & ~(1023U << shift)) | n << shift;
      });
    } else {
      const std::size_t at = 1 + m.random.below(token.size() - 1);
      constexpr std::array<int, 6> changes = {1, -1, 2, -2, 3, 64};
      token[at] = static_cast<char>((token[at] & 0x80) | ((token[at] + m.random.one_of(changes)) & 0x7f));
    }
  });
}

/// A direction along an axis is written as a plane at rest, whose bounds are met, or missed by one.
bool direction_as_plane(Mutating& m) {
  const auto along_axis = [](const std::string& token) {
    return token.size() == 1 && TokenCode::axis <= code_at(token) && code_at(token) <= TokenCode::last_axis;
  };
  return change_token(m, along_axis, [&](std::string& token, const auto&) {
    const int k = token[0] - static_cast<int>(TokenCode::axis), axis = k / 2;
    const std::int64_t sign = k % 2 == 0 ? 1 : -1;
    constexpr std::array<std::uint64_t, 6> shifts = {0, 0, 1, 4, 4096, 4097};
    std::string plane = first_byte(TokenCode::half_space) + uint_bytes(m.random.one_of(shifts));
    for (int i = 0; i < 3; ++i) plane += sint_bytes(i == axis ? sign : 0);
    plane += scaled_number(0, m.random.one_in(3) ? m.random.between(-1, 1) : 0);
    plane += some_scaled_number(m.random, 5, -6, 6);
    token = plane + scaled_number(0, m.random.one_in(3) ? m.random.between(-1, 4) : 0);
  });
}

/// TOKS is cut in two, or an empty one is added.
bool blocks_of_tokens(Mutating& m) {
  for (ProofGroup& group : m.groups) {
    for (std::size_t i = 0; i < group.size(); ++i) {
      if (group[i].kind != mutating::tokens || m.random.one_in(2)) continue;
      const std::size_t cut = m.random.below(group[i].payload.size() + 1);
      const ProofBlock rest{mutating::tokens, group[i].payload.substr(cut)};
      group[i].payload.resize(cut);
      group.insert(group.begin() + static_cast<std::ptrdiff_t>(i) + 1, rest);
      return true;
    }
  }
  return false;
}

/// A number with more bytes than it needs, or than its place allows.
bool longer_number(Mutating& m) {
  ProofBlock* const block = some_block(m, {mutating::tokens, tree, witness});
  if (block == nullptr || block->payload.empty()) return false;
  const std::size_t k = some_index(m.random, block->payload);
  block->payload[k] = static_cast<char>(block->payload[k] | 0x80);
  constexpr std::array<std::size_t, 4> lengths = {0, 0, 9, 1199};
  std::string more(m.random.one_of(lengths), '\x80');
  more += static_cast<char>(m.random.below(2));
  block->payload.insert(k + 1, more);
  return true;
}

}  // namespace

std::vector<ProofMutation> mutations_of_tokens() {
  return {{"token deleted", 3, token_deleted},       {"token doubled", 3, token_doubled},
          {"tokens swapped", 3, tokens_swapped},     {"token replaced", 6, token_replaced},
          {"token inserted", 4, token_inserted},     {"split inserted", 5, split_inserted},
          {"coefficient", 9, coefficient},           {"direction as plane", 5, direction_as_plane},
          {"blocks of tokens", 2, blocks_of_tokens}, {"longer number", 1, longer_number}};
}

}  // namespace noli::audit
