// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/trajectories/whole_motion.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "trajectory/cells.h"

namespace noli::audit {

namespace {

template <class Function>
void for_each_place(WholeMotion& motion, const Function& function) {
  for (auto& frame : motion.frames) std::ranges::for_each(frame, function);
}

void rename(WholeMotion& motion, PlantedTruth& planted, Random& random) {
  const std::vector<VertexId> name = random_order(motion.vertices(), random);
  for (auto& frame : motion.frames) {
    auto renamed = frame;
    for (std::size_t v = 0; v < frame.size(); ++v) renamed[name[v]] = frame[v];
    frame = std::move(renamed);
  }
  for (Feature& cell : motion.cells) {
    for (VertexId& v : cell) v = name[v];
    std::rotate(cell.begin(), cell.begin() + static_cast<std::ptrdiff_t>(random.below(cell.size())), cell.end());
  }
  const std::vector<VertexId> order = random_order(motion.cells.size(), random);
  std::vector<Feature> cells;
  cells.reserve(order.size());
  for (const VertexId c : order) cells.push_back(motion.cells[c]);
  motion.cells = std::move(cells);
  if (!planted.features) return;
  for (Feature& feature : *planted.features) {
    for (VertexId& v : feature) v = name[v];
    std::ranges::sort(feature);
  }
}

/// What is added to and multiplied with each axis.
struct Scale {
  Whole offset{};
  std::array<int, 3> exponent{};
};

Scale random_scale(Numbers numbers, int dimension, Random& random) {
  Scale scale;
  const auto axes = static_cast<std::size_t>(dimension);
  if (numbers == Numbers::small) scale.exponent.fill(-static_cast<int>(random.below(41)));
  constexpr std::array<int, 6> exponents = {-1074, -1040, -500, 0, 500, 960};
  if (numbers == Numbers::scaled) scale.exponent.fill(random.one_of(exponents));
  const bool own = numbers == Numbers::scaled && random.one_in(2);
  for (std::size_t axis = 0; axis < axes; ++axis) {
    if (own) scale.exponent[axis] = random.one_of(exponents);
    if (numbers != Numbers::offset) continue;
    const std::int64_t size = (std::int64_t{1} << 52) + (std::int64_t{1} << 51);
    scale.offset[axis] = random.one_in(2) ? size : -size;
  }
  return scale;
}

Mesh mesh_of(const WholeMotion& motion) {
  Mesh mesh;
  mesh.vertex_count = motion.vertices();
  for (const Feature& cell : motion.cells) add_polygon(mesh, cell);
  drop_redundant_cells(mesh);
  return mesh;
}

}  // namespace

std::vector<VertexId> random_order(std::size_t size, Random& random) {
  std::vector<VertexId> order(size);
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = 0; i < size; ++i) std::swap(order[i], order[i + random.below(size - i)]);
  return order;
}

void add_crowd(WholeMotion& motion, Random& random, std::size_t count) {
  const auto height = static_cast<std::size_t>(motion.dimension - 1), corners = height + 1;
  std::int64_t level = 0;
  for_each_place(motion, [&](const Whole& x) { level = std::max(level, x[height]); });
  for (std::size_t i = 0; i < count; ++i) {
    level += random.between(1, 4);
    Feature cell;
    for (std::size_t k = 0; k < corners; ++k) {
      Whole x = random_whole(random, motion.dimension - 1, 1 << 12);
      x[height] = level;
      cell.push_back(static_cast<VertexId>(motion.vertices()));
      for (auto& frame : motion.frames) frame.push_back(x);
    }
    motion.cells.push_back(cell);
  }
}

GeneratedMotion finish(WholeMotion motion, PlantedTruth planted, Numbers numbers, Random& random) {
  std::vector<Whole*> places;
  for_each_place(motion, [&](Whole& x) { places.push_back(&x); });
  shear_and_turn(places, motion.dimension, random);
  rename(motion, planted, random);
  const Scale scale = random_scale(numbers, motion.dimension, random);
  GeneratedMotion made;
  made.motion.mesh = mesh_of(motion);
  made.motion.format = static_cast<FrameFormat>(random.below(3));
  for (const auto& frame : motion.frames) {
    auto& positions = made.motion.frames.emplace_back();
    for (const Whole& x : frame) {
      Position& place = positions.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        place[axis] = as_double(x[axis] + scale.offset[axis], scale.exponent[axis]);
      }
    }
  }
  made.planted = std::move(planted);
  if (made.motion.dimension() != motion.dimension) {  // flat by chance: in the plane other features count
    made.planted.features.reset();
    made.planted.time.reset();
  }
  return made;
}

}  // namespace noli::audit
