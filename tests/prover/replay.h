// SPDX-License-Identifier: Apache-2.0
//
// Judges the proof of a step between two frames. An independent stack machine reads its tokens by the rules of
// proofs/FORMAT.md, section 3, and checks each in rational arithmetic.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "proofs/prover/verifier.h"
#include "scenes.h"

namespace noli::testing {

class Replay {
 public:
  /// Judges the whole proof. `step` and `proof` need not outlive this object.
  Replay(const Step& step, int dimension, bool strict, const StepProof& proof);

  /// The faults found; empty if the proof holds.
  const std::vector<std::string>& faults() const { return faults_; }
  std::size_t obligations_left() const { return stack_.size(); }
  /// The number of tokens of a kind: "halve", "left", "right", "parts", "one", "both", "drop", "empty", "axis", "short"
  /// or "long".
  std::size_t count(const std::string& token) const { return counts_.contains(token) ? counts_.at(token) : 0; }

 private:
  /// A range of leaves, and the vertices dropped from it (only for a single leaf).
  struct Part {
    std::size_t begin, count;
    std::set<VertexId> dropped;
  };
  struct Obligation {
    bool self;
    Part first, second;
    double begin = 0, end = 1;
  };

  void read(std::string_view bytes);
  void read_direction(std::string_view& bytes, bool is_short);
  Obligation pop(const std::string& token, bool self);
  void expect(bool condition, const std::string& fault);
  void split(const std::string& token, Part Obligation::*which);
  void parts();
  void both();
  void drop(std::size_t k);
  void halve();
  void direction(const std::array<double, 3>& n, const std::string& token);
  std::vector<VertexId> vertices_of(const Part& part) const;
  bool separates(const std::array<double, 3>& n, VertexId a, VertexId b, double t) const;
  static Part left(const Part& part) { return {part.begin, part.count / 2, {}}; }
  static Part right(const Part& part) { return {part.begin + part.count / 2, part.count - part.count / 2, {}}; }

  const Step& step_;
  int dimension_;
  bool strict_;
  std::vector<std::uint32_t> leaves_;
  std::vector<Obligation> stack_;
  std::vector<std::string> faults_;
  std::map<std::string, std::size_t> counts_;
};

}  // namespace noli::testing
