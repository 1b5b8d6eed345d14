// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/windows/window_chords.h"

#include <cmath>
#include <limits>

#include "kernel/parallel.h"

namespace noli {

namespace {

/// A float not below x.
float rounded_up(double x) {
  return x == 0 ? 0 : std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
}

template <int Dim>
NearVertex near_vertex(const VertexChord<Dim>& chord, const Position& origin) {
  NearVertex near{};
  bool usable = true;
  for (std::size_t k = 0; k < Dim; ++k) {
    near.x_t0[k] = static_cast<float>(chord.x[k].at_t0() - origin[k]);
    near.x_t1[k] = static_cast<float>(chord.x[k].at_t1() - origin[k]);
    const float most = std::max(std::abs(near.x_t0[k]), std::abs(near.x_t1[k]));
    near.radius[k] = chord.radius[k] * (1 + 0x1p-20F) + (most * 0x1p-22F + 0x1p-120F);
    usable = usable && most < 0x1p60F && near.radius[k] < 0x1p60F;
  }
  return usable ? near : NearVertex{Lanes{}, Lanes{}, lanes(0x1p100F)};
}

struct Counts {
  std::size_t inside = 0, restless = 0;
};

Counts merged(const Counts& a, const Counts& b) { return {a.inside + b.inside, a.restless + b.restless}; }

/// The distance, enlarged by the rounding of the bounds to which it is added.
double farther(double distance, double x_t0, double x_t1) {
  return distance + 0x1p-50 * (std::abs(x_t0) + std::abs(x_t1) + distance);
}

}  // namespace

template <int Dim>
WindowChords<Dim> chords_over(Span span, const WorldLines& lines, const Forest& forest, int threads, double distance) {
  const std::size_t vertices = lines.vertex_count();
  WindowChords<Dim> chords{span, std::vector<VertexChord<Dim>>(vertices), std::vector<NearVertex>(vertices)};
  std::vector<Position> origins;  // by tree
  for (const Tree& tree : forest.trees()) origins.push_back(lines.positions(tree.vertices[0]).front());
  const auto fill = [&](std::size_t i) -> Counts {
    const auto v = static_cast<VertexId>(i);
    const Chord<Dim> chord = chord_of<Dim>(WorldLine(lines, v), span.begin, span.end);
    VertexChord<Dim>& stored = chords.of[v];
    float most = 0;
    for (std::size_t k = 0; k < Dim; ++k) {
      stored.x[k] = BothEnds(chord.x_t0[k], chord.x_t1[k]);
      stored.radius[k] = rounded_up(chord.radius[k]);
      most = std::max(most, stored.radius[k]);
      if (distance > 0) {
        stored.radius[k] = rounded_up(chord.radius[k] + farther(distance, chord.x_t0[k], chord.x_t1[k]));
      }
    }
    const std::uint32_t part = forest.part_of(v);
    if (part != Forest::no_part) chords.near[v] = near_vertex(stored, origins[part]);
    return {chord.inside, most * 12 > forest.size(v) ? 1U : 0U};
  };
  const Counts all = merged_over(vertices, threads, Counts{}, fill, 512);
  chords.inside = all.inside;
  chords.restless = all.restless;
  return chords;
}

template WindowChords<2> chords_over(Span, const WorldLines&, const Forest&, int, double);
template WindowChords<3> chords_over(Span, const WorldLines&, const Forest&, int, double);

}  // namespace noli
