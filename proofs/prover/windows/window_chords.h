// SPDX-License-Identifier: Apache-2.0
//
// The chords of all vertices over a part of a window.
//
// Notation
//   span    the part [begin, end] of the window
//   near    a vertex for proofs/prover/windows/monotone.h: in float, relative to the first position of the first vertex
//           of its part. For this rounding, 2^-22 of the greatest coordinate is added to its radius. A vertex that is
//           too far away gets position 0 and a radius of 2^100, with which nothing is monotone: with m the greatest
//           entry of M, its rows add up to 2^-30 m at least (as |R| |M| <= 2^30), so the tangents may be off by 2^70 m,
//           and are below 2^62 m
//   restless  a vertex that strays by more than a twelfth of its shortest edge
#pragma once

#include <vector>

#include "kernel/both_ends.h"
#include "proofs/prover/windows/chord.h"
#include "proofs/prover/windows/forest.h"

namespace noli {

struct Span {
  double begin, end;
};

/// A chord in one cache line; radii are rounded upwards.
template <int Dim>
struct alignas(64) VertexChord {
  std::array<BothEnds, Dim> x;
  std::array<float, Dim> radius;
};

template <int Dim>
struct WindowChords {
  Span span;
  std::vector<VertexChord<Dim>> of;  ///< by vertex
  std::vector<NearVertex> near;      ///< by vertex; meaningless for vertices outside parts
  std::size_t inside = 0;            ///< number of breakpoints inside the span
  std::size_t restless = 0;          ///< number of restless vertices

  /// Whether to halve the span: a vertex has on average more than 8 breakpoints inside, and more than a sixteenth of
  /// the vertices are restless.
  bool worth_cutting() const { return inside > 8 * of.size() && restless * 16 > of.size(); }
};

/// Linear in the number of breakpoints. `distance` is added to the radii, so features separated with them are more than
/// twice that apart.
template <int Dim>
WindowChords<Dim> chords_over(Span span, const WorldLines& lines, const Forest& forest, int threads,
                              double distance = 0);

}  // namespace noli
