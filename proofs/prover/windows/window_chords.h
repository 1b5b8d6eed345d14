// SPDX-License-Identifier: Apache-2.0
//
// The chords of all vertices over a part of a window.
//
// Notation
//   span    the part [begin, end] of the window
//   near    a vertex for proofs/prover/windows/monotone.h: in float, relative to where the first vertex of its part
//           begins. Its radius has 2^-22 of the greatest coordinate added for that; what is too far away has the place
//           0 and a radius of 2^100, at which nothing is monotone: with m the greatest entry of M, its rows add up to
//           2^-30 m at least (as |R| |M| <= 2^30), so the tangents may be off by 2^70 m, and are below 2^62 m
//   restless  a vertex that strays by more than a twelfth of its shortest edge
//
// What this does not do: it keeps nothing of the breakpoints.
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
  std::vector<NearVertex> near;      ///< by vertex; meaningless for one that is in no part
  std::size_t inside = 0;            ///< number of breakpoints inside the span
  std::size_t restless = 0;          ///< number of restless vertices

  /// Whether the span is to be cut into halves: a vertex has on average more than 8 breakpoints inside, and more than
  /// a sixteenth of the vertices are restless.
  bool worth_cutting() const { return inside > 8 * of.size() && restless * 16 > of.size(); }
};

/// Linear in the number of breakpoints. What is separated with radii that have `distance` added to them is farther
/// apart than twice that.
template <int Dim>
WindowChords<Dim> chords_over(Span span, const WorldLines& lines, const Forest& forest, int threads,
                              double distance = 0);

}  // namespace noli
