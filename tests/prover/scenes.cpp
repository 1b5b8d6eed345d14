// SPDX-License-Identifier: Apache-2.0
#include "scenes.h"

namespace noli::testing {

VertexId Step::vertex(const Position& at_t0, const Position& at_t1) {
  x_t0.push_back(at_t0);
  x_t1.push_back(at_t1);
  return static_cast<VertexId>(mesh.vertex_count++);
}

void Step::face(const Position& a, const Position& b, const Position& c, const Position& motion) {
  const auto moved = [&](const Position& x) { return Position{x[0] + motion[0], x[1] + motion[1], x[2] + motion[2]}; };
  const VertexId i = vertex(a, moved(a)), j = vertex(b, moved(b)), k = vertex(c, moved(c));
  mesh.faces.push_back({i, j, k});
}

std::uint64_t Random::next() {
  std::uint64_t z = (state_ += 0x9E3779B97F4A7C15U);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31);
}

Step random_soup(std::uint64_t seed, const SoupSize& size, int dimension) {
  Random random(seed);
  const auto coordinate = [&] { return static_cast<double>(random.below(2 * size.span + 1)) - size.span; };
  const auto position = [&] {
    return Position{coordinate(), coordinate(), dimension == 3 ? coordinate() : random.unit()};
  };
  const auto corner = [&] { return random.below(size.vertices); };
  Step step;
  for (std::uint32_t i = 0; i < size.vertices; ++i) {
    const Position from = position();
    step.vertex(from, random.below(3) == 0 ? from : position());
  }
  for (std::uint32_t i = 0; i < size.faces; ++i) step.mesh.faces.push_back({corner(), corner(), corner()});
  for (std::uint32_t i = 0; i < size.edges; ++i) step.mesh.edges.push_back({corner(), corner()});
  for (std::uint32_t i = 0; i < size.points; ++i) step.mesh.points.push_back(corner());
  return step;
}

namespace {

void add_sheet(Step& step, Random& random, std::uint32_t n, double height, double fall) {
  const auto first = static_cast<VertexId>(step.mesh.vertex_count);
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) {
      const Position x = {i + 0.3 * random.unit(), j + 0.3 * random.unit(), height + 0.4 * random.unit()};
      step.vertex(x, {x[0] + 0.1 * random.unit(), x[1] + 0.1 * random.unit(), x[2] - fall});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const VertexId a = first + i * (n + 1) + j, b = a + n + 1;
      step.mesh.faces.push_back({a, b, b + 1});
      step.mesh.faces.push_back({a, b + 1, a + 1});
    }
  }
}

}  // namespace

Step two_sheets(std::uint64_t seed, std::uint32_t n, double fall) {
  Random random(seed);
  Step step;
  add_sheet(step, random, n, 0, 0);
  add_sheet(step, random, n, 1, fall);
  return step;
}

}  // namespace noli::testing
