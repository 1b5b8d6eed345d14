// SPDX-License-Identifier: Apache-2.0
//
// Writes valid and invalid proofs (proofs/FORMAT.md) and runs (trajectory/FORMAT.md), and calls the checker.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>

#include "proofs/checker/check.h"
#include "tests/support/temporary_folder.h"

namespace noli::checker::test {

namespace fs = std::filesystem;

template <class T>
std::string raw(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}
inline std::string bytes(std::initializer_list<int> values) {
  std::string result;
  for (const int v : values) result += static_cast<char>(v);
  return result;
}
inline std::string uint(mpz_class n) {
  std::string result;
  do {
    const mpz_class low = n % 128;
    n /= 128;
    result += static_cast<char>(low.get_ui() + (n > 0 ? 128 : 0));
  } while (n > 0);
  return result;
}
inline std::string sint(const mpz_class& n) { return uint(n >= 0 ? mpz_class(2 * n) : mpz_class(-2 * n - 1)); }
inline std::string scaled(const mpz_class& m, unsigned s = 0) { return uint(s) + sint(m); }
inline std::string poly(const std::vector<mpz_class>& f) {
  std::string result = bytes({static_cast<int>(f.size())});
  for (const auto& k : f) result += sint(k);
  return result;
}
inline std::string sha256(std::string_view text) {
  Sha256 hash;
  hash.add(text);
  return raw(hash.digest());
}

/// The first byte of a token; `k` counts the codes in a range.
inline std::string first_byte(TokenCode code, int k = 0) { return bytes({static_cast<int>(code) + k}); }

namespace token {
inline const std::string T = first_byte(TokenCode::halve), L = first_byte(TokenCode::left),
                         R = first_byte(TokenCode::right), N = first_byte(TokenCode::parts),
                         F = first_byte(TokenCode::one), B = first_byte(TokenCode::both),
                         X = first_byte(TokenCode::excluded), px = first_byte(TokenCode::axis),
                         mx = first_byte(TokenCode::axis, 1), py = first_byte(TokenCode::axis, 2),
                         my = first_byte(TokenCode::axis, 3), pz = first_byte(TokenCode::axis, 4),
                         mz = first_byte(TokenCode::last_axis), none = first_byte(TokenCode::empty);
inline std::string packed(int x, int y, int z) {
  return first_byte(TokenCode::short_direction) +
         raw(static_cast<std::uint32_t>((x & 1023) | (y & 1023) << 10 | (z & 1023) << 20));
}
inline std::string S(const mpz_class& x, const mpz_class& y, const mpz_class& z) {
  return first_byte(TokenCode::direction) + sint(x) + sint(y) + sint(z);
}
inline std::string P(unsigned s, const std::array<int, 3>& n, const mpz_class& nt, const mpz_class& nd,
                     const mpz_class& w) {
  return first_byte(TokenCode::half_space) + uint(s) + sint(n[0]) + sint(n[1]) + sint(n[2]) + scaled(nt) + scaled(nd) +
         scaled(w);
}
inline std::string D(int k) { return first_byte(TokenCode::drop, k); }
/// v0 c1 v1 ... cm vm.
inline std::string W(const std::vector<unsigned>& way) {
  std::string result = first_byte(TokenCode::ring) + uint(way.size() / 2);
  for (const unsigned i : way) result += uint(i);
  return result;
}
}  // namespace token

using Blocks = std::vector<std::pair<std::string, std::string>>;

inline std::string block(const std::string& kind, const std::string& payload) {
  const std::string all = kind + raw(std::uint64_t{payload.size()}) + payload;
  return all + raw(crc32c(all));
}
/// A file of groups of blocks, each followed by its commit.
inline std::string block_file(const std::string& content, const std::vector<Blocks>& groups) {
  std::string file = std::string("\x89NOLI\r\n\x1a\1\0\0\0", 12) + content, running(32, '\0');
  std::size_t begin = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (const auto& [kind, payload] : groups[i]) file += block(kind, payload);
    const std::string hash = sha256(file.substr(begin));
    running = sha256(running + hash);
    file += block("CMIT", raw(std::uint64_t{i}) + hash + running);
    begin = file.size();
  }
  return file;
}

struct Verdict {
  int code;
  std::string words;
};

/// Fields as written after --require.
using Fields = std::vector<std::string>;

/// The fields that require exactly the claim of a proof; empty if it has none.
inline Fields own_claim(const std::string& proof) {
  try {
    BlockFile file(proof, "PROF");
    Reader c = file.expect("CLAM");
    const int source = c.u8(), dimension = c.u8(), flags = c.u8();
    c.u8();
    const std::uint32_t ring = c.u32();
    const double eta = c.f64();
    const auto cells = c.raw<Sha256::Digest>();
    const std::uint32_t merged = c.u32();
    for (std::uint32_t i = 0; i < merged; ++i) c.u64();
    const auto excluded = read_pairs<std::uint32_t>(c, c.u32(), "");
    if (eta == 0 && ring > 1) return {};
    Fields fields = {"empty",
                     "distance=" + text_of(eta),
                     "ring=" + std::to_string(ring),
                     "merged=" + std::to_string(merged),
                     "strict=" + std::to_string(flags & 1),
                     "points=" + std::to_string(flags >> 1 & 1)};
    if (source < 2) {
      fields.push_back(std::string("motion=") + motions[static_cast<std::size_t>(source)]);
      if (dimension == 2) fields.emplace_back("dimension=2");
      fields.push_back("excluded=" + text_of(excluded));
      fields.push_back("cells=" + text_of(cells));
    }
    const Asked valid{fields};
    return fields;
  } catch (const Rejected&) {
    return {};
  }
}

/// The verdict on a proof when these fields, or by default its own claim, are required.
inline Verdict verdict(const std::string& proof, const std::vector<std::string>& paths,
                       const std::optional<Fields>& fields = std::nullopt) {
  try {
    Check check(proof, paths, Asked(fields ? *fields : own_claim(proof)));
    const auto refuted = check.go();
    return {refuted ? 1 : 0, refuted ? *refuted : check.weaker()};
  } catch (const Rejected& r) {
    return {3, r.where + ": " + r.why};
  }
}

/// A folder that is removed after the test.
class Folder {
 public:
  std::string write(const std::string& name, const std::string& text) const {
    return folder_.write(name, text).string();
  }

 private:
  noli::test::TemporaryFolder folder_;
};

struct ClaimFields {
  int source = 0, dimension = 3, flags = 0, zero = 0;
  std::uint32_t ring = 1;
  double eta = 0;
  std::string hash;
  std::vector<std::array<std::uint32_t, 2>> merged, excluded;

  std::string encode() const {
    std::string result = bytes({source, dimension, flags, zero}) + raw(ring) + raw(eta) + hash;
    for (const auto* list : {&merged, &excluded}) {
      result += raw(static_cast<std::uint32_t>(list->size()));
      for (const auto& pair : *list) result += raw(pair);
    }
    return result;
  }
};

struct StepFields {
  std::uint64_t number = 0;
  double t0 = 0, t1 = 1;
  std::int32_t p = 0, q = 0;
  int kind = 0;
  std::string hash;

  std::string encode() const { return raw(number) + raw(t0) + raw(t1) + raw(p) + raw(q) + bytes({kind}) + hash; }
};

/// A witness of vertex 0 of cell i against vertex 1 of cell j, at the beginning of step k.
inline std::string at_begin(std::uint32_t i, std::uint32_t j, int k = 0, std::uint32_t q = 1) {
  return raw(i) + raw(j) + bytes({1}) + raw(0u) + poly({1}) + bytes({1}) + raw(q) + poly({1}) + poly({-k, 1}) +
         uint(0) + sint(k) + sint(k);
}

using Points = std::vector<std::array<double, 3>>;
using Lists = std::vector<std::vector<std::uint32_t>>;

inline std::string hash_of_cells(std::uint64_t vertices, const Lists& cells,
                                 const std::vector<std::uint32_t>& labels = {}) {
  std::string text = raw(vertices) + raw(std::uint64_t{cells.size()});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    text += bytes({static_cast<int>(cells[i].size())});
    for (const std::uint32_t v : cells[i]) text += raw(v);
    text += raw(labels.empty() ? std::uint32_t{0} : labels[i]);
  }
  return sha256(text);
}
inline std::string obj(const Points& x, const Lists& cells) {
  std::ostringstream text;
  text.precision(17);
  for (const auto& p : x) text << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  for (const auto& cell : cells) {
    text << (cell.size() == 3 ? "f" : cell.size() == 2 ? "l" : "p");
    for (const auto v : cell) text << ' ' << v + 1;
    text << '\n';
  }
  return text.str();
}

/// A proof about frames. Members that are not set get correct values.
struct Proof {
  std::vector<Points> frames;
  Lists cells{}, cells_after{};  ///< in the file; after merging, if they differ
  std::string tree{};            ///< empty: each cell beside the node of all later ones
  std::vector<std::string> tokens{""};
  std::vector<std::string> witness{};  ///< by step; empty for steps without one
  ClaimFields claim{};
  std::vector<std::uint32_t> labels{};  ///< block LABL; empty: no block
  std::optional<Fields> fields{};       ///< required fields; unset: its own claim
  StepFields step{};  ///< of all steps; number, times and kind are filled in unless `keep`, an empty hash always
  bool keep = false;

  const Lists& listed() const { return cells_after.empty() ? cells : cells_after; }
  std::vector<Blocks> groups() const {
    ClaimFields c = claim;
    if (c.hash.empty()) c.hash = hash_of_cells(frames[0].size(), listed(), labels);
    std::string default_tree;
    for (std::size_t i = 0; i < listed().size(); ++i)
      default_tree += (i + 1 < listed().size() ? uint(0) : "") + uint(i + 1);
    std::vector<Blocks> result = {{{"CLAM", c.encode()}}};
    std::string of_cells;
    for (const std::uint32_t label : labels) of_cells += raw(label);
    if (!labels.empty()) result[0].emplace_back("LABL", of_cells);
    bool has_tree = false;
    for (std::size_t k = 0; k < std::max(tokens.size(), witness.size()); ++k) {
      StepFields s = step;
      const bool touches = k < witness.size() && !witness[k].empty();
      if (!keep) {
        s.number = k;
        s.t0 = claim.source == 1 ? 0 : static_cast<double>(k);
        s.t1 = s.t0 + 1;
        s.kind = touches ? 1 : 0;
      }
      if (s.hash.empty()) s.hash = sha256(motion(k));
      Blocks blocks = {{"STEP", s.encode()}};
      if (touches) {
        blocks.emplace_back("WITN", witness[k]);
      } else {
        if (!has_tree) blocks.emplace_back("TREE", tree.empty() ? default_tree : tree);
        has_tree = true;
        blocks.emplace_back("TOKS", tokens[k]);
      }
      result.push_back(blocks);
    }
    return result;
  }
  std::string motion(std::size_t k) const {
    std::string text;
    const std::size_t rest = claim.source == 1 ? 0 : 1;
    for (std::size_t v = 0; v < frames[0].size(); ++v) {
      text += raw(std::uint64_t{2});
      for (std::size_t i = 0; i < 2; ++i) {
        const auto& x = frames[std::min(k + rest * i, frames.size() - 1)][v];
        text += raw(static_cast<double>(rest * k + i)) + raw(x[0] + 0.0) + raw(x[1] + 0.0) +
                raw(claim.dimension == 2 ? 0.0 : x[2] + 0.0);
      }
    }
    return text;
  }
  Verdict check() const { return check(block_file("PROF", groups())); }
  Verdict check(const std::string& file) const {
    const Folder folder;
    return verdict(folder.write("proof", file), write_frames(folder), fields);
  }
  /// Returns the names of their files.
  std::vector<std::string> write_frames(const Folder& folder) const {
    std::vector<std::string> paths;
    for (std::size_t i = 0; i < frames.size(); ++i)
      paths.push_back(folder.write("f" + std::to_string(i) + ".obj", obj(frames[i], cells)));
    return paths;
  }
  /// The verdict if these fields are required.
  Verdict asked(const Fields& of_it) const {
    Proof other = *this;
    other.fields = of_it;
    return other.check();
  }
  /// The verdict on the same proof with other tokens.
  Verdict with(const std::string& all) const {
    Proof other = *this;
    other.tokens = {all};
    return other.check();
  }
};

/// Edge 0-1 rests along y at x = 0. Edge 2-3 along z moves from x = 4 to x = 2.
inline Proof two_edges() {
  return {{{{0, -1, 0}, {0, 1, 0}, {4, 0, -1}, {4, 0, 1}}, {{0, -1, 0}, {0, 1, 0}, {2, 0, -1}, {2, 0, 1}}},
          {{0, 1}, {2, 3}},
          {},
          "",
          {token::N + token::F + token::mx + token::F}};
}

}  // namespace noli::checker::test
