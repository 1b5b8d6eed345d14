// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/largest_distance.h"

#include <algorithm>
#include <limits>

#include <noli/findings.h>
#include "certify/simulate/exact_gap.h"
#include "proofs/prover/tokens/no_proof.h"
#include "proofs/prover/witness/feature_sides.h"

namespace noli {
namespace {

class Cells {
 public:
  Cells(const Mesh& mesh, const WorldLines& rest, int dimension, const MeshPaths& paths)
      : mesh_(mesh), rest_(rest), dimension_(dimension), paths_(paths) {}

  /// The least double >= the distance of those features of two cells that no short path joins.
  double above_distance(std::uint32_t i, std::uint32_t j) const {
    double least = std::numeric_limits<double>::infinity();
    const auto a = vertices_of(mesh_, i), b = vertices_of(mesh_, j);
    for (unsigned m = 1; m < 1U << a.size(); ++m) {
      for (unsigned n = 1; n < 1U << b.size(); ++n) {
        FeatureSides s{chosen(a, m), chosen(b, n)};
        if (s.p.size() > s.q.size()) std::swap(s.p, s.q);
        const auto pair = pair_of(s);
        const bool in_space = pair == FeaturePair::vertex_face || pair == FeaturePair::edge_edge;
        if (!pair || (in_space && dimension_ == 2) || joined(s, paths_)) continue;
        std::array<VertexId, 4> vertices{};
        std::ranges::copy(s.both(), vertices.begin());
        least = std::min(least, exact_gap(rest_, dimension_, *pair, vertices).up_to);
      }
    }
    return least;
  }

 private:
  const Mesh& mesh_;
  const WorldLines& rest_;
  int dimension_;
  const MeshPaths& paths_;
};

}  // namespace

std::optional<LargestDistance> largest_distance(const WindowVerifier& verifier, const Mesh& mesh,
                                                std::span<const Position> x, const LeastDistance& distance,
                                                const VerifyOptions& options) {
  const WorldLines rest = WorldLines::from_frames(x, x);
  const Cells cells(mesh, rest, options.dimension, *distance.paths);
  for (LargestDistance found{distance.eta, distance.eta};;) {
    try {
      const bool whole = verifier.prove(rest, options, {found.allowed, distance.paths}, [](std::string_view) {});
      return whole && found.allowed < distance.eta ? std::optional(found) : std::nullopt;
    } catch (const TooNear& near) {
      const double limit = cells.above_distance(near.first_cell, near.second_cell);
      if (!(limit * (1 - 0x1p-20) < found.allowed) || limit == 0) return std::nullopt;
      found = {limit * (1 - 0x1p-20), limit};
    } catch (const NoProof&) {
      return std::nullopt;
    }
  }
}

}  // namespace noli
