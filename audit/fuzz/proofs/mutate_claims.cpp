// SPDX-License-Identifier: Apache-2.0
//
// Mutations of a proof's claim, steps and tree, and of its blocks as a whole (proofs/FORMAT.md, section 2).
#include <array>

#include "audit/fuzz/proofs/mutating.h"

namespace noli::audit {

namespace {

using namespace mutating;

constexpr std::size_t counts_at = 48;  ///< of the claim: the number of merged vertices

ProofBlock* claim_of(Mutating& m) {
  if (m.groups.empty() || m.groups[0].empty() || m.groups[0][0].kind != claim) return nullptr;
  return m.groups[0][0].payload.size() >= counts_at + 8 ? &m.groups[0][0] : nullptr;
}

/// A group behind the first; 0 if there is none.
std::size_t some_step(Mutating& m) { return m.groups.size() < 2 ? 0 : 1 + m.random.below(m.groups.size() - 1); }

bool step_fields(Mutating& m) {
  ProofBlock* const block = some_block(m, {step});
  if (block == nullptr || block->payload.size() != step_size) return false;
  std::string& payload = block->payload;
  constexpr std::array<std::uint32_t, 6> changes = {1, ~0U, ~1U, 5, 1200, static_cast<std::uint32_t>(-1100)};
  switch (m.random.below(6)) {
    case 0:
      return change_field<std::uint64_t>(payload, 0, [&](auto n) { return n + (m.random.one_in(2) ? 1 : ~0ULL); });
    case 1:
      return change_field<double>(payload, 8 + 8 * m.random.below(2),
                                  [&](double t) { return other_double(m.random, t); });
    case 2:
    case 3:
      return change_field<std::uint32_t>(payload, 24 + 4 * m.random.below(2),
                                         [&](auto n) { return n + m.random.one_of(changes); });
    case 4: payload[32] = static_cast<char>(payload[32] ^ (m.random.one_in(3) ? 2 : 1)); return true;
    default: payload[33 + m.random.below(32)] ^= static_cast<char>(1 << m.random.below(8)); return true;
  }
}

/// All integers grow, and tokens S stay what they are.
bool finer_units(Mutating& m) {
  constexpr std::array<int, 5> by = {1, 2, 7, 60, 900};
  bool changed = false;
  for (ProofBlock* const block : whole_steps(m)) {
    changed = change_field<std::uint32_t>(block->payload, 24 + 4 * m.random.below(2), [&](std::uint32_t n) {
      return static_cast<std::uint32_t>(std::max(-1200, static_cast<int>(n) - m.random.one_of(by)));
    });
  }
  return changed;
}

/// Steps left out, doubled, exchanged, cut off.
bool steps_moved(Mutating& m) {
  const std::size_t i = some_step(m);
  if (i == 0) return false;
  const auto at = m.groups.begin() + static_cast<std::ptrdiff_t>(i);
  switch (m.random.below(4)) {
    case 0: m.groups.erase(at); break;
    case 1: m.groups.insert(at, ProofGroup(*at)); break;
    case 2: std::swap(m.groups[i], m.groups[some_step(m)]); break;
    default: m.groups.resize(i);
  }
  return true;
}

/// Small numbers are bytes: nodes (0) and leaves are exchanged, changed, left out, repeated.
bool tree_numbers(Mutating& m) {
  ProofBlock* const block = some_block(m, {tree});
  if (block == nullptr || block->payload.empty()) return false;
  std::string& payload = block->payload;
  const std::size_t k = some_index(m.random, payload);
  switch (m.random.below(6)) {
    case 0:
    case 1: std::swap(payload[k], payload[some_index(m.random, payload)]); break;
    case 2: payload[k] = static_cast<char>(m.random.below(9)); break;
    case 3: payload.erase(k, 1); break;
    case 4: payload.insert(k, 1, payload[some_index(m.random, payload)]); break;
    default: {
      constexpr std::array<std::size_t, 4> depths = {1, 254, 255, 256};
      payload.insert(0, m.random.one_of(depths), '\0');
    }
  }
  return true;
}

/// A tree where there was none, or none where there was one.
bool tree_elsewhere(Mutating& m) {
  const ProofBlock* const some = some_block(m, {tree});
  const std::size_t i = some_step(m);
  if (some == nullptr || i == 0) return false;
  const ProofBlock copy = *some;
  ProofGroup& group = m.groups[i];
  if (m.random.one_in(2)) {
    group.insert(group.begin() + static_cast<std::ptrdiff_t>(m.random.below(group.size() + 1)), copy);
  } else {
    std::erase_if(group, [](const ProofBlock& block) { return block.kind == tree; });
  }
  return true;
}

bool claim_fields(Mutating& m) {
  ProofBlock* const block = claim_of(m);
  if (block == nullptr) return false;
  std::string& payload = block->payload;
  m.fits = !m.random.one_in(3);
  switch (m.random.below(6)) {
    case 0: payload[0] = static_cast<char>(m.random.below(4)); return true;
    case 1:
      payload[1] =
          static_cast<char>(m.random.one_in(4) ? m.random.below(256) : 5U - static_cast<unsigned char>(payload[1]));
      return true;
    case 2:
    case 3:
      payload[2] = static_cast<char>(payload[2] ^ (m.random.one_in(5) ? 128 : 1 + m.random.below(3)));
      return true;
    case 4: payload[3] = static_cast<char>(m.random.below(256)); return true;
    default: payload[16 + m.random.below(32)] ^= static_cast<char>(1 << m.random.below(8)); return true;
  }
}

/// A distance, a ring: what was proved without may not hold with it.
bool distance(Mutating& m) {
  ProofBlock* const block = claim_of(m);
  if (block == nullptr) return false;
  constexpr std::array<std::uint32_t, 6> rings = {1, 1, 1, 2, 3, 0xffffffffU};
  const auto exponent = static_cast<int>(m.random.between(-40, 4));
  const double eta = std::ldexp(static_cast<double>(m.random.between(0, 17)), exponent);
  change_field<double>(block->payload, 8,
                       [&](double old) { return m.random.one_in(6) ? other_double(m.random, old) : eta; });
  change_field<std::uint32_t>(block->payload, 4, [&](auto) { return m.random.one_of(rings); });
  if (m.random.one_in(2)) finer_units(m);
  return true;
}

/// Merged vertices, excluded pairs: one more, or a count that is not true.
bool pairs_of_claim(Mutating& m) {
  ProofBlock* const block = claim_of(m);
  if (block == nullptr) return false;
  std::string& payload = block->payload;
  m.fits = !m.random.one_in(4);
  const bool excluded = m.random.one_in(2);
  const std::size_t at = excluded ? payload.size() - 4 : counts_at;
  if (m.random.one_in(4)) {
    constexpr std::array<std::uint32_t, 4> counts = {1, ~0U, 1U << 31, 1U << 29};
    return change_field<std::uint32_t>(payload, at, [&](auto n) { return n + m.random.one_of(counts); });
  }
  if (get<std::uint32_t>(payload.data() + at) != 0) return false;  // only into an empty list, which needs no order
  std::string pair;
  const auto a = static_cast<std::uint32_t>(m.random.below(4)), b = static_cast<std::uint32_t>(m.random.below(4));
  put(pair, std::uint32_t{1});
  put(pair, excluded ? std::min(a, b) : std::max(a, b));
  put(pair, excluded ? std::max(a, b) : std::min(a, b));
  payload.replace(at, 4, pair);
  return true;
}

/// Labels where there are none, none where there are, others.
bool labels_of_cells(Mutating& m) {
  if (m.groups.empty() || m.groups[0].empty()) return false;
  m.fits = !m.random.one_in(4);
  ProofBlock* const block = some_block(m, {labels});
  if (block == nullptr) {
    std::string payload;
    for (std::uint64_t cells = 1 + m.random.below(6); cells > 0; --cells)
      put(payload, static_cast<std::uint32_t>(m.random.below(3)));
    m.groups[0].push_back({labels, payload});
    return true;
  }
  if (m.random.one_in(4)) {
    std::erase_if(m.groups[0], [](const ProofBlock& one) { return one.kind == labels; });
    return true;
  }
  return change_field<std::uint32_t>(block->payload, 4 * m.random.below(block->payload.size() / 4 + 1),
                                     [&](auto n) { return m.random.one_in(2) ? n ^ 1 : m.random.below(4); });
}

/// Blocks left out, doubled, exchanged, renamed, moved; groups that are empty or joined.
bool blocks_moved(Mutating& m) {
  const std::size_t g = m.random.below(m.groups.size());
  ProofGroup& group = m.groups[g];
  if (group.empty() || m.random.one_in(8)) {
    m.groups.insert(m.groups.begin() + static_cast<std::ptrdiff_t>(g), ProofGroup());
    return true;
  }
  const std::size_t k = some_index(m.random, group);
  const auto at = group.begin() + static_cast<std::ptrdiff_t>(k);
  constexpr std::array<FourLetters, 8> kinds = {
      claim, labels, step, tree, mutating::tokens, witness, four_letters("CMIT"), four_letters("XXXX")};
  switch (m.random.below(7)) {
    case 0: group.erase(at); break;
    case 1: group.insert(at, ProofBlock(*at)); break;
    case 2: std::swap(group[k], group[some_index(m.random, group)]); break;
    case 3: at->kind = m.random.one_of(kinds); break;
    case 4: at->payload += '\0'; break;
    case 5: {
      const ProofBlock moved = *at;
      group.erase(at);
      m.groups[m.random.below(m.groups.size())].push_back(moved);
      break;
    }
    default:
      if (g == 0) return false;
      m.groups[g - 1].insert(m.groups[g - 1].end(), group.begin(), group.end());
      m.groups.erase(m.groups.begin() + static_cast<std::ptrdiff_t>(g));
  }
  return true;
}

/// A block of another proof in the place of one of the same kind, or a whole group.
bool from_another(Mutating& m) {
  const ProofCase& other = m.others[some_index(m.random, m.others)];
  const ProofGroup& group = other.groups[some_index(m.random, other.groups)];
  m.fits = !m.random.one_in(3);
  if (group.empty() || m.random.one_in(2)) {
    m.groups[some_index(m.random, m.groups)] = group;
    return true;
  }
  const ProofBlock& block = group[some_index(m.random, group)];
  ProofBlock* const mine = some_block(m, {block.kind});
  if (mine == nullptr) return false;
  mine->payload = block.payload;
  return true;
}

bool payload_bytes(Mutating& m) {
  ProofGroup& group = m.groups[some_index(m.random, m.groups)];
  if (group.empty()) return false;
  change_bytes(m.random, group[some_index(m.random, group)].payload);
  return true;
}

}  // namespace

std::vector<ProofMutation> mutations_of_claims() {
  return {{"bytes of a payload", 4, payload_bytes},  {"fields of a step", 3, step_fields},
          {"finer units", 2, finer_units},           {"steps moved", 3, steps_moved},
          {"numbers of the tree", 6, tree_numbers},  {"tree elsewhere", 2, tree_elsewhere},
          {"fields of the claim", 4, claim_fields},  {"distance", 7, distance},
          {"pairs of the claim", 4, pairs_of_claim}, {"labels of cells", 2, labels_of_cells},
          {"blocks moved", 4, blocks_moved},         {"from another proof", 3, from_another}};
}

}  // namespace noli::audit
