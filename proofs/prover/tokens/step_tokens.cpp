// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/tokens/step_tokens.h"

#include "proofs/prover/tokens/proof_parts.h"

namespace noli {

template <int Dim>
std::optional<Tokens> prove_apart(const OpenParts<Dim>& parts, const StopSignal& stop) {
  std::vector<Position> x_t0, x_t1;  // of the vertices of both parts, numbered anew
  const auto add = [&](const StepCell<Dim>& cell, CornerMask part) {
    ProofCell result;
    for (std::size_t i = 0; i < cell.corners; ++i) {
      if ((part >> i & 1) == 0) continue;
      result.add(static_cast<VertexId>(x_t0.size()));
      Position &at_t0 = x_t0.emplace_back(), &at_t1 = x_t1.emplace_back();
      for (std::size_t k = 0; k < Dim; ++k) {
        at_t0[k] = cell.x(i)[k].at_t0();
        at_t1[k] = cell.x(i)[k].at_t1();
      }
    }
    return result;
  };
  const ProofCell a = add(*parts.a, parts.a_part), b = add(*parts.b, parts.b_part);
  const WorldLines lines = WorldLines::from_frames(x_t0, x_t1);
  Tokens tokens;
  try {
    const bool whole = ProofParts<Dim>(lines, {Integer(0), 0}, 0, nullptr, stop, tokens).settle(0, a, 1, b);
    return whole ? std::optional(std::move(tokens)) : std::nullopt;
  } catch (const NoProof&) {
    return std::nullopt;
  }
}

template std::optional<Tokens> prove_apart(const OpenParts<2>&, const StopSignal&);
template std::optional<Tokens> prove_apart(const OpenParts<3>&, const StopSignal&);

}  // namespace noli
