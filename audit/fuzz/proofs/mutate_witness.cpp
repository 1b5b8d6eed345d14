// SPDX-License-Identifier: Apache-2.0
//
// Mutations of witnesses of contact (proofs/FORMAT.md, section 5).
#include <gmpxx.h>

#include <array>
#include <optional>

#include "audit/fuzz/proofs/mutating.h"

namespace noli::audit {

namespace {

using namespace mutating;

/// Coefficients, the constant term first.
using Coefficients = std::vector<mpz_class>;

struct Weighted {
  std::uint32_t vertex;
  Coefficients weight;
};

struct WitnessParts {
  std::array<std::uint32_t, 2> cells{};
  std::array<std::vector<Weighted>, 2> sides;
  Coefficients g;
  mpz_class e, l, u;
};

/// Reads from a payload; after its end everything is 0.
class PayloadReader {
 public:
  explicit PayloadReader(const std::string& payload) : payload_(payload) {}

  std::uint32_t u32() {
    std::uint32_t value = 0;
    for (unsigned i = 0; i < 4; ++i) value |= std::uint32_t{byte()} << 8 * i;
    return value;
  }
  std::uint8_t byte() { return at_ < payload_.size() ? static_cast<std::uint8_t>(payload_[at_++]) : std::uint8_t{0}; }
  mpz_class uint() {
    mpz_class value;
    for (mp_bitcnt_t shift = 0;; shift += 7) {
      const std::uint8_t next = byte();
      mpz_class part = next & 0x7f;
      mpz_mul_2exp(part.get_mpz_t(), part.get_mpz_t(), shift);
      value += part;
      if ((next & 0x80) == 0) return value;
    }
  }
  mpz_class sint() {
    const mpz_class twice = uint();
    return mpz_odd_p(twice.get_mpz_t()) != 0 ? mpz_class(-(twice + 1) / 2) : mpz_class(twice / 2);
  }
  Coefficients poly() {
    Coefficients f(byte());
    for (mpz_class& c : f) c = sint();
    return f;
  }

 private:
  const std::string& payload_;
  std::size_t at_ = 0;
};

WitnessParts parse(const std::string& payload) {
  PayloadReader reader(payload);
  WitnessParts w;
  for (std::uint32_t& cell : w.cells) cell = reader.u32();
  for (auto& side : w.sides) {
    side.resize(reader.byte());
    for (Weighted& one : side) {
      one.vertex = reader.u32();
      one.weight = reader.poly();
    }
  }
  w.g = reader.poly();
  w.e = reader.uint();
  w.l = reader.sint();
  w.u = reader.sint();
  return w;
}

void put_uint(std::string& bytes, mpz_class value) {
  while (value >= 128) {
    bytes += static_cast<char>(mpz_class(value % 128).get_ui() | 0x80);
    value /= 128;
  }
  bytes += static_cast<char>(value.get_ui());
}

void put_sint(std::string& bytes, const mpz_class& value) {
  put_uint(bytes, value < 0 ? mpz_class(-2 * value - 1) : mpz_class(2 * value));
}

void put_poly(std::string& bytes, const Coefficients& f) {
  bytes += static_cast<char>(f.size());
  for (const mpz_class& c : f) put_sint(bytes, c);
}

std::string bytes_of(const WitnessParts& w) {
  std::string bytes;
  for (const std::uint32_t cell : w.cells) put(bytes, cell);
  for (const auto& side : w.sides) {
    bytes += static_cast<char>(side.size());
    for (const Weighted& one : side) {
      put(bytes, one.vertex);
      put_poly(bytes, one.weight);
    }
  }
  put_poly(bytes, w.g);
  put_uint(bytes, w.e < 0 ? mpz_class(0) : w.e);
  put_sint(bytes, w.l);
  put_sint(bytes, w.u);
  return bytes;
}

mpz_class other_number(Random& random, const mpz_class& n) {
  constexpr std::array<int, 8> steps = {1, -1, 1, -1, 2, -7, 64, -100};
  switch (random.below(6)) {
    case 0: return -n;
    case 1: return 2 * n;
    case 2: return random.one_in(2) ? mpz_class(0) : mpz_class(n * 1024 + 1);
    default: return n + random.one_of(steps);
  }
}

Coefficients product(const Coefficients& f, const Coefficients& g) {
  if (f.empty() || g.empty()) return {};
  Coefficients result(f.size() + g.size() - 1);
  for (std::size_t i = 0; i < f.size(); ++i) {
    for (std::size_t j = 0; j < g.size(); ++j) result[i + j] += f[i] * g[j];
  }
  return result;
}

/// A polynomial that is positive, or not quite.
Coefficients some_factor(Random& random) {
  switch (random.below(9)) {
    case 0: return {2};
    case 1: return {1, 1};
    case 2: return {3, -1, 1};
    case 3: return {-1};
    case 4: return {0, 1};
    case 5: return {1, -2, 1};
    case 6: return {2, -1};
    case 7: return {0};
    default: return {1, -1};
  }
}

template <class Change>
bool changed_witness(Mutating& m, const Change& change) {
  ProofBlock* const block = some_block(m, {witness});
  if (block == nullptr) return false;
  WitnessParts w = parse(block->payload);
  change(w);
  block->payload = bytes_of(w);
  return true;
}

bool polynomials(Mutating& m) {
  return changed_witness(m, [&](WitnessParts& w) {
    std::vector<Coefficients*> all = {&w.g, &w.g};
    for (auto& side : w.sides) {
      for (Weighted& one : side) all.push_back(&one.weight);
    }
    Coefficients& f = *all[some_index(m.random, all)];
    switch (m.random.below(6)) {
      case 0: f.emplace_back(m.random.between(-1, 1)); break;
      case 1:
        if (!f.empty()) f.pop_back();
        break;
      case 2: f = product(f, some_factor(m.random)); break;
      default:
        if (!f.empty()) {
          mpz_class& c = f[some_index(m.random, f)];
          c = other_number(m.random, c);
        }
    }
  });
}

/// All weights times a polynomial, or one side's: still good where it is positive; so is g times one.
bool weights(Mutating& m) {
  return changed_witness(m, [&](WitnessParts& w) {
    const Coefficients factor = m.random.one_in(6) ? w.g : some_factor(m.random);
    const std::uint64_t which = m.random.below(3);
    for (std::size_t side = 0; side < 2; ++side) {
      if (which == side) continue;
      for (Weighted& one : w.sides[side]) one.weight = product(one.weight, factor);
    }
    if (m.random.one_in(4)) w.g = product(w.g, some_factor(m.random));
  });
}

bool time_of_witness(Mutating& m) {
  return changed_witness(m, [&](WitnessParts& w) {
    switch (m.random.below(7)) {
      case 0: w.l = other_number(m.random, w.l); break;
      case 1: w.u = other_number(m.random, w.u); break;
      case 2: {  // the same interval in smaller units, or nearly
        const std::int64_t more = m.random.between(1, 30);
        w.e += more;
        w.l <<= static_cast<mp_bitcnt_t>(more);
        w.u <<= static_cast<mp_bitcnt_t>(more);
        w.l += m.random.between(-1, 1);
        w.u += m.random.between(-1, 1);
        break;
      }
      case 3: w.e = other_number(m.random, w.e); break;
      case 4: std::swap(w.l, w.u); break;
      case 5: w.u = w.l; break;
      default: w.l = w.l - m.random.between(0, 2), w.u = w.u + m.random.between(0, 2);
    }
  });
}

bool places(Mutating& m) {
  return changed_witness(m, [&](WitnessParts& w) {
    auto& side = w.sides[m.random.below(2)];
    std::uint32_t& cell = w.cells[m.random.below(2)];
    switch (m.random.below(7)) {
      case 0: std::swap(w.sides[0], w.sides[1]); break;
      case 1: std::swap(w.cells[0], w.cells[1]); break;
      case 2: cell += m.random.one_in(2) ? 1U : ~0U; break;
      case 3: cell = w.cells[0]; break;
      case 4:
        if (!side.empty()) side[some_index(m.random, side)].vertex = static_cast<std::uint32_t>(m.random.below(8));
        break;
      case 5:
        if (!side.empty()) side.pop_back();
        break;
      default:
        if (!side.empty()) side.push_back(side.front());
    }
  });
}

}  // namespace

std::vector<ProofMutation> mutations_of_witnesses() {
  return {{"polynomials of a witness", 9, polynomials},
          {"weights of a witness", 7, weights},
          {"time of a witness", 6, time_of_witness},
          {"places of a witness", 7, places}};
}

}  // namespace noli::audit
