// SPDX-License-Identifier: Apache-2.0
//
// The steps by which a verification was carried out, in prefix order, so that others can count, replay or write them
// down.
//
// Notation
//   group       a node of one binary tree over the cells; a leaf holds one cell. A node over m > 1 successive entries
//               of `leaf_cells` has the first m/2 of them (rounded down) in its left child and the others in its right
//   part        some of the vertices of a group; at first all of them
//   obligation  to show that over an interval of the step no simplex of one part meets a vertex-disjoint simplex of
//               another (a pair: first, second), or that this holds for any two different cells of one group (a self)
//
// The steps rewrite a stack of obligations, which begins with the self of the whole tree over [0, 1]. Each step is
// about the obligation on top; what replaces it is listed top first:
//   split_self     self(x)           -> self(left), pair(left, right), self(right)  x is no leaf
//   split_first    pair(x, y)        -> pair(left of x, y), pair(right of x, y)     x is no leaf
//   split_second   pair(x, y)        -> pair(x, left of y), pair(x, right of y)     y is no leaf
//   drop_vertex v  pair(x, y)        -> pair(x without v, y), pair(x, y without v)  x and y are leaves that share v
//   halve          pair over [a, b]  -> the same over [a, m], the same over [m, b]  m = (a + b) / 2
//   direction n    pair(x, y)        -> nothing: n.(a - b) > 0 for all a in x, b in y, at both ends of the interval
//   empty          pair(x, y)        -> nothing: x or y has no vertex
//   features       pair(x, y)        -> nothing: see below
//   cell           self(x)           -> nothing: x is a leaf
// What no direction settled is taken apart into pairs of features, and each of these belongs to one pair of cells: that
// of the least cells that have the two features, or the one in proofs/prover/leftover.h. `features` says that each pair
// of features of the two parts is apart from what `direction` settled (here for other parts, or in the obligation of
// the cells it belongs to), or was told by `decided`, here or in the obligation it belongs to; never twice. `at_begin`
// says whether the two parts on top meet at the beginning of the step; it comes before `features`, but not again for a
// pair of cells of which some parts are known to meet.
//
// What this does not do: it writes no file and checks nothing.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "kernel/query.h"
#include "trajectory/mesh.h"

namespace noli {

/// Receives the steps of one verification, all from one thread at a time. Exceptions end the verification and reach its
/// caller.
class StepSink {
 public:
  virtual ~StepSink() = default;

  /// Before all else. `leaf_cells`: the cells in the order of the tree's leaves; valid until end_step.
  virtual void begin_step(std::span<const std::uint32_t> leaf_cells) = 0;
  virtual void split_self() = 0;
  virtual void split_first() = 0;
  virtual void split_second() = 0;
  virtual void drop_vertex(VertexId v) = 0;
  virtual void halve() = 0;
  virtual void direction(const std::array<double, 3>& n) = 0;
  virtual void empty() = 0;
  virtual void cell() = 0;
  /// Whether the pair of features meets during the whole step; vertices as in FeatureContact, not put into canonical
  /// order.
  virtual void decided(FeaturePair pair, const std::array<VertexId, 4>& vertices, bool contact) = 0;
  virtual void at_begin(bool meet) = 0;
  virtual void features() = 0;
  /// After all else. `complete`: false if the verification was stopped; then obligations are left.
  virtual void end_step(bool complete) = 0;
};

}  // namespace noli
