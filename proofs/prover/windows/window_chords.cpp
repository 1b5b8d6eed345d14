// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/windows/window_chords.h"

#include <cmath>
#include <limits>

#include "kernel/parallel.h"

namespace noli {

namespace {

/// Not below x.
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

/// Counters of one piece of the vertices.
struct Counts {
  std::size_t inside = 0, restless = 0;
};

/// Fills in the vertices one by one.
template <int Dim>
class Filler {
 public:
  Filler(WindowChords<Dim>& chords, const WorldLines& lines, const Forest& forest, double distance)
      : chords_(chords), lines_(lines), forest_(forest), distance_(distance) {
    for (const Tree& tree : forest.trees()) origins_.push_back(lines.positions(tree.vertices[0]).front());
  }

  void fill(VertexId v, Counts& counts) {
    const WorldLine line(lines_, v);
    const Chord<Dim> chord = chord_of<Dim>(line, chords_.span.begin, chords_.span.end);
    VertexChord<Dim>& stored = chords_.of[v];
    float most = 0;
    for (std::size_t k = 0; k < Dim; ++k) {
      stored.x[k] = BothEnds(chord.x_t0[k], chord.x_t1[k]);
      stored.radius[k] = rounded_up(chord.radius[k]);
      most = std::max(most, stored.radius[k]);
      if (distance_ > 0) stored.radius[k] = rounded_up(chord.radius[k] + farther(chord.x_t0[k], chord.x_t1[k]));
    }
    const std::uint32_t part = forest_.part_of(v);
    if (part != Forest::no_part) chords_.near[v] = near_vertex(stored, origins_[part]);
    counts.inside += chord.inside;
    counts.restless += most * 12 > forest_.size(v) ? 1 : 0;
  }

 private:
  /// The distance, with room for the rounding of the bounds that have it added.
  double farther(double x_t0, double x_t1) const {
    return distance_ + 0x1p-50 * (std::abs(x_t0) + std::abs(x_t1) + distance_);
  }

  WindowChords<Dim>& chords_;
  const WorldLines& lines_;
  const Forest& forest_;
  double distance_;
  std::vector<Position> origins_;
};

}  // namespace

template <int Dim>
WindowChords<Dim> chords_over(Span span, const WorldLines& lines, const Forest& forest, int threads, double distance) {
  constexpr std::size_t piece = 512;
  const std::size_t vertices = lines.vertex_count(), pieces = (vertices + piece - 1) / piece;
  WindowChords<Dim> chords{span, std::vector<VertexChord<Dim>>(vertices), std::vector<NearVertex>(vertices)};
  Filler<Dim> filler(chords, lines, forest, distance);
  std::vector<Counts> counts(pieces);
  parallel_for(pieces, threads, [&](std::size_t i) {
    Counts sum;
    for (std::size_t v = i * piece; v < std::min(vertices, (i + 1) * piece); ++v) {
      filler.fill(static_cast<VertexId>(v), sum);
    }
    counts[i] = sum;
  });
  for (const Counts& c : counts) {
    chords.inside += c.inside;
    chords.restless += c.restless;
  }
  return chords;
}

template WindowChords<2> chords_over(Span, const WorldLines&, const Forest&, int, double);
template WindowChords<3> chords_over(Span, const WorldLines&, const Forest&, int, double);

}  // namespace noli
