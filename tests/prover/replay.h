// SPDX-License-Identifier: Apache-2.0
//
// Replays the steps of a verification with a stack machine of its own (the rules are in proofs/prover/events.h) and
// checks each of them in rational arithmetic.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "brute_force.h"
#include "hulls.h"
#include "proofs/prover/events.h"

namespace noli::testing {

class Replay : public StepSink {
 public:
  /// `step` must outlive this.
  Replay(const Step& step, int dimension) : step_(step), dimension_(dimension) {}

  void begin_step(std::span<const std::uint32_t> leaf_cells) override;
  void split_self() override;
  void split_first() override;
  void split_second() override;
  void drop_vertex(VertexId v) override;
  void halve() override;
  void direction(const std::array<double, 3>& n) override;
  void empty() override;
  void cell() override;
  void decided(FeaturePair pair, const std::array<VertexId, 4>& vertices, bool contact) override;
  void at_begin(bool meet) override;
  void features() override;
  void end_step(bool complete) override;

  /// What was wrong, if anything.
  const std::vector<std::string>& faults() const { return faults_; }
  bool ended() const { return ended_; }
  bool complete() const { return complete_; }
  std::size_t obligations_left() const { return stack_.size(); }
  std::size_t count(const std::string& step) const { return counts_.contains(step) ? counts_.at(step) : 0; }

  /// For each pair of features: how often it was decided, and the last answer.
  struct Decision {
    int times = 0;
    bool contact = false;
  };
  const std::map<PairKey, Decision>& decisions() const { return decisions_; }
  /// Pairs of features that directions cover over the whole step.
  const std::set<PairKey>& covered() const { return covered_; }
  /// Pairs of features that were left to `decided`, here or elsewhere.
  const std::set<PairKey>& left_to_kernel() const { return left_to_kernel_; }
  /// Pairs of cells for which a direction was not found for every pair of parts.
  const std::set<std::pair<std::uint32_t, std::uint32_t>>& open() const { return open_; }
  /// Those of them with a pair of parts that meets at the beginning.
  const std::set<std::pair<std::uint32_t, std::uint32_t>>& meeting() const { return meeting_; }

 private:
  /// A run of leaves, and the vertices that were dropped from it (of a single leaf).
  struct Part {
    std::size_t begin, count;
    std::set<VertexId> dropped;
  };
  struct Obligation {
    bool self;
    Part first, second;
    double begin = 0, end = 1;
  };

  Obligation pop(const std::string& step, bool self);
  void expect(bool condition, const std::string& fault);
  std::vector<VertexId> vertices_of(const Part& part) const;
  std::set<PairKey> features_of(const Obligation& pair) const;
  std::pair<std::uint32_t, std::uint32_t> cells_of(const Obligation& pair) const;
  bool separates(const std::array<double, 3>& n, VertexId a, VertexId b, double t) const;
  void cover(const Obligation& pair);
  Part left(const Part& part) const { return {part.begin, part.count / 2, {}}; }
  Part right(const Part& part) const { return {part.begin + part.count / 2, part.count - part.count / 2, {}}; }

  const Step& step_;
  int dimension_;
  std::vector<std::uint32_t> leaves_;
  std::vector<Obligation> stack_;
  std::vector<std::string> faults_;
  std::map<std::string, std::size_t> counts_;
  std::map<PairKey, Decision> decisions_;
  std::map<PairKey, double> covered_length_;
  std::set<PairKey> covered_, left_to_kernel_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> open_, meeting_;
  bool said_at_begin_ = false;
  bool ended_ = false, complete_ = false;
};

}  // namespace noli::testing
