// SPDX-License-Identifier: Apache-2.0
#include "trajectory/merge.h"

#include <bit>
#include <limits>

#include "trajectory/cells.h"
#include "trajectory/stop.h"

namespace noli {
namespace {

constexpr VertexId nobody = std::numeric_limits<VertexId>::max();

/// Mixes one word into a hash (the finaliser of splitmix64).
std::uint64_t mix(std::uint64_t hash, std::uint64_t word) {
  std::uint64_t z = (hash ^ word) + 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// Equal for positions that are equal as numbers: adding +0 turns -0 into +0 and changes nothing else.
std::uint64_t hash(VertexId old_class, const Position& x) {
  std::uint64_t result = mix(0, old_class);
  for (const double coordinate : x) result = mix(result, std::bit_cast<std::uint64_t>(coordinate + 0.0));
  return result;
}

/// An open-addressing table of vertices. Each represents all vertices with its old class and its position.
class Classes {
 public:
  Classes(const std::vector<VertexId>& old_class, std::span<const Position> positions)
      : old_class_(old_class), positions_(positions), slots_(std::bit_ceil(2 * positions.size() + 1), nobody) {}

  /// The first vertex asked for with this one's class and position: itself if there was none.
  VertexId find_or_insert(VertexId v) {
    std::size_t slot = hash(old_class_[v], positions_[v]) & (slots_.size() - 1);
    while (slots_[slot] != nobody && !same(slots_[slot], v)) slot = (slot + 1) & (slots_.size() - 1);
    if (slots_[slot] == nobody) slots_[slot] = v;
    return slots_[slot];
  }

 private:
  bool same(VertexId a, VertexId b) const { return old_class_[a] == old_class_[b] && positions_[a] == positions_[b]; }

  const std::vector<VertexId>& old_class_;
  std::span<const Position> positions_;
  std::vector<VertexId> slots_;
};

}  // namespace

void IdenticalVertices::refine(std::span<const Position> positions) {
  Classes classes(representative_, positions);
  std::vector<VertexId> refined(representative_.size());
  for (std::size_t v = 0; v < refined.size(); ++v) {
    end_if_stopped();
    refined[v] = classes.find_or_insert(static_cast<VertexId>(v));
  }
  representative_ = std::move(refined);
}

std::size_t IdenticalVertices::merged_count() const {
  std::size_t count = 0;
  for (std::size_t v = 0; v < representative_.size(); ++v) count += representative_[v] != v;
  return count;
}

Mesh with_merged_vertices(const Mesh& mesh, const IdenticalVertices& classes) {
  Mesh merged = mesh;
  const std::vector<VertexId>& representative = classes.representative();
  for (auto& face : merged.faces) {
    for (VertexId& v : face) v = representative[v];
  }
  for (auto& edge : merged.edges) {
    for (VertexId& v : edge) v = representative[v];
  }
  for (VertexId& v : merged.points) v = representative[v];
  drop_redundant_cells(merged);
  return merged;
}

}  // namespace noli
