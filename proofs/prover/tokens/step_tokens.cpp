// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/tokens/step_tokens.h"

#include "proofs/prover/tokens/proof_parts.h"

namespace noli {

namespace {

/// The vertices of both parts, numbered anew.
class FewVertices {
 public:
  template <int Dim>
  ProofCell add(const StepCell<Dim>& cell, CornerMask part) {
    ProofCell result;
    for (std::size_t i = 0; i < cell.corners; ++i) {
      if ((part >> i & 1) == 0) continue;
      Position x_t0{}, x_t1{};
      for (std::size_t k = 0; k < Dim; ++k) {
        x_t0[k] = cell.x(i)[k].at_t0();
        x_t1[k] = cell.x(i)[k].at_t1();
      }
      result.vertices[result.corners++] = static_cast<VertexId>(x_t0_.size());
      x_t0_.push_back(x_t0);
      x_t1_.push_back(x_t1);
    }
    return result;
  }

  WorldLines lines() const { return WorldLines::from_frames(x_t0_, x_t1_); }

 private:
  std::vector<Position> x_t0_, x_t1_;
};

}  // namespace

template <int Dim>
std::optional<Tokens> prove_apart(const OpenParts<Dim>& parts, const StopSignal& stop) {
  FewVertices vertices;
  const ProofCell a = vertices.add(*parts.a, parts.a_part), b = vertices.add(*parts.b, parts.b_part);
  const WorldLines lines = vertices.lines();
  ProofParts<Dim> prover(lines, {Integer(0), 0}, 0, nullptr, stop);
  Tokens tokens;
  try {
    prover.settle(0, a, 1, b, tokens);
  } catch (const NoProof&) {
    return std::nullopt;
  }
  if (prover.stopped()) return std::nullopt;
  return tokens;
}

template std::optional<Tokens> prove_apart(const OpenParts<2>&, const StopSignal&);
template std::optional<Tokens> prove_apart(const OpenParts<3>&, const StopSignal&);

}  // namespace noli
