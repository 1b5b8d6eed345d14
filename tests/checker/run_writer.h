// SPDX-License-Identifier: Apache-2.0
//
// Writes valid and invalid runs (trajectory/FORMAT.md) and proofs about them.
#pragma once

#include <functional>

#include "proof_writer.h"

namespace noli::checker::test {

struct Line {
  std::vector<double> times;
  Points x;
};

/// A run in 3D of edges; labels and groups by vertex.
struct RunFile {
  std::uint32_t dimension = 3, mode = 0;
  double length = 1;
  Lists cells{{0, 1}, {2, 3}};
  std::string labels = std::string(4, '\0');
  std::vector<std::array<std::uint16_t, 2>> pairs;
  std::vector<std::uint16_t> groups;
  std::vector<std::vector<Line>> windows;
  std::vector<double> times;  ///< of the windows' ends

  std::string mesh() const {
    std::array<std::uint64_t, 4> counts = {labels.size(), 0, 0, 0};
    std::string rest;
    for (const auto& cell : cells) {
      ++counts[4 - cell.size()];
      for (const auto v : cell) rest += raw(v);
    }
    return raw(counts) + rest;
  }
  Blocks window(std::size_t k) const {
    std::string counts, all_times, x;
    for (const Line& line : windows[k]) {
      counts += raw(static_cast<std::uint32_t>(line.times.size()));
      for (const double t : line.times) all_times += raw(t);
      for (const auto& p : line.x) x += raw(p).substr(0, 8 * dimension);
    }
    return {{"WIND", raw(std::uint64_t{k}) + raw(times[k]) + raw(times[k + 1])},
            {"LINE", counts + all_times + x},
            {"VELO", ""},
            {"STAT", "any"}};
  }
  std::vector<Blocks> blocks() const {
    Blocks first = {{"HEAD", raw(dimension) + raw(mode) + raw(length)}, {"MESH", mesh()}, {"LABL", labels}};
    if (!pairs.empty()) {
      std::string payload = raw(static_cast<std::uint32_t>(pairs.size()));
      for (const auto& pair : pairs) payload += raw(pair);
      for (const auto g : groups) payload += raw(g);
      first.emplace_back("EXCL", payload);
    }
    std::vector<Blocks> result = {first};
    for (std::size_t k = 0; k < windows.size(); ++k) result.push_back(window(k));
    return result;
  }
};

inline std::string group_hash(const Blocks& blocks) {
  std::string all;
  for (const auto& [kind, payload] : blocks) all += block(kind, payload);
  return sha256(all);
}

/// Edge 0-1 rests along y; edge 2-3 moves along x to 2 and back.
inline RunFile there_and_back() {
  RunFile run;
  const Line zero{{0, 2}, {{0, -1, 0}, {0, -1, 0}}}, one{{0, 2}, {{0, 1, 0}, {0, 1, 0}}},
      two{{0, 1, 2}, {{8, 0, -1}, {2, 0, -1}, {8, 0, -1}}}, three{{0, 1, 2}, {{8, 0, 1}, {2, 0, 1}, {8, 0, 1}}};
  run.windows = {{zero, one, two, three}};
  run.times = {0, 2};
  return run;
}

struct RunProof {
  RunFile run = there_and_back();
  ClaimFields claim{};
  std::vector<std::string> tokens{token::N + token::F + token::mx + token::F};
  std::vector<std::uint32_t> labels{};
  std::string witness{};
  std::size_t steps = 99;          ///< most steps of the proof
  std::optional<Fields> fields{};  ///< required fields; unset: its own claim

  Verdict check() const { return check(run.blocks()); }
  Verdict check(const std::vector<Blocks>& trajectory, const Blocks& behind_claim = {}) const {
    ClaimFields c = claim;
    c.source = 2;
    c.dimension = static_cast<int>(run.dimension);
    if (c.hash.empty()) c.hash = hash_of_cells(run.labels.size(), run.cells, labels);
    std::vector<Blocks> groups = {{{"CLAM", c.encode()}}};
    groups[0].insert(groups[0].end(), behind_claim.begin(), behind_claim.end());
    for (std::size_t k = 0; k < std::min(steps, run.windows.size()); ++k) {
      StepFields s{
          k, run.times[k], run.times[k + 1], -4, -4, witness.empty() ? 0 : 1, group_hash(trajectory.at(k + 1))};
      groups.push_back({{"STEP", s.encode()}});
      if (!witness.empty()) {
        groups[k + 1].emplace_back("WITN", witness);
        continue;
      }
      if (k == 0) groups[1].emplace_back("TREE", uint(0) + uint(1) + uint(2));
      groups[k + 1].emplace_back("TOKS", tokens[k]);
    }
    const Folder folder;
    return verdict(folder.write("proof", block_file("PROF", groups)),
                   {folder.write("trajectory", block_file("TRAJ", trajectory))}, fields);
  }
  Verdict with(const std::function<void(std::vector<Blocks>&)>& change) const {
    auto blocks = run.blocks();
    change(blocks);
    return check(blocks);
  }
  Verdict with_run(const std::function<void(RunFile&)>& change) const {
    RunProof other = *this;
    change(other.run);
    return other.check();
  }
};

}  // namespace noli::checker::test
