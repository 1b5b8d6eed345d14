// SPDX-License-Identifier: Apache-2.0
#include "noli/app/largest_distance.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "noli/app/exact_gap.h"
#include "noli/proofs/prover/features.h"
#include "noli/proofs/prover/mesh_paths.h"
#include "noli/proofs/prover/too_near.h"

namespace noli::app {
namespace {

/// Some of a cell's vertices.
std::vector<VertexId> chosen(const Mesh& mesh, std::uint32_t cell, unsigned mask) {
  std::vector<VertexId> vertices;
  for (std::size_t i = 0; i < static_cast<std::size_t>(corner_count(mesh, cell)); ++i) {
    if ((mask >> i & 1) != 0) vertices.push_back(corners(mesh, cell)[i]);
  }
  return vertices;
}

std::optional<FeaturePair> pair_of(std::size_t p, std::size_t q, int dimension) {
  if (p == 1 && q == 1) return FeaturePair::vertex_vertex;
  if (p == 1 && q == 2) return FeaturePair::vertex_edge;
  if (p == 1 && q == 3 && dimension == 3) return FeaturePair::vertex_face;
  if (p == 2 && q == 2 && dimension == 3) return FeaturePair::edge_edge;
  return std::nullopt;
}

class Cells {
 public:
  Cells(const Mesh& mesh, const WorldLines& rest, int dimension, const MeshPaths& paths)
      : mesh_(mesh), rest_(rest), dimension_(dimension), paths_(paths) {}

  /// The least double that is not less than the distance of those features of two cells that no short path joins.
  double above_distance(std::uint32_t i, std::uint32_t j) const {
    double least = std::numeric_limits<double>::infinity();
    for (unsigned m = 1; m < 1U << corner_count(mesh_, i); ++m) {
      for (unsigned n = 1; n < 1U << corner_count(mesh_, j); ++n) {
        auto p = chosen(mesh_, i, m), q = chosen(mesh_, j, n);
        if (p.size() > q.size()) std::swap(p, q);
        const auto pair = pair_of(p.size(), q.size(), dimension_);
        if (!pair || joined(p, q)) continue;
        std::array<VertexId, 4> vertices{};
        std::ranges::copy(q, std::ranges::copy(p, vertices.begin()).out);
        least = std::min(least, exact_gap(rest_, dimension_, *pair, vertices).up_to);
      }
    }
    return least;
  }

 private:
  bool joined(const std::vector<VertexId>& p, const std::vector<VertexId>& q) const {
    return std::ranges::any_of(p, [&](VertexId v) {
      return std::ranges::any_of(q, [&](VertexId w) { return paths_.find(v, w).has_value(); });
    });
  }

  const Mesh& mesh_;
  const WorldLines& rest_;
  int dimension_;
  const MeshPaths& paths_;
};

}  // namespace

std::optional<LargestDistance> largest_distance(const StepProver& prover, const Mesh& mesh, std::span<const Position> x,
                                                double eta, const VerifyOptions& options) {
  const WorldLines rest = WorldLines::from_frames(x, x);
  const MeshPaths paths(prover.tree(), mesh.vertex_count, prover.claim().ring);
  const Cells cells(mesh, rest, prover.claim().dimension, paths);
  for (LargestDistance found{eta, eta};;) {
    try {
      const bool whole = prover.with_distance(found.allowed).prove(rest, options, [](std::string_view) {});
      return whole && found.allowed < eta ? std::optional(found) : std::nullopt;
    } catch (const TooNear& near) {
      const double limit = cells.above_distance(near.first_cell, near.second_cell);
      if (!(limit * (1 - 0x1p-20) < found.allowed) || limit == 0) return std::nullopt;
      found = {limit * (1 - 0x1p-20), limit};
    } catch (const NoProof&) {
      return std::nullopt;
    }
  }
}

}  // namespace noli::app
