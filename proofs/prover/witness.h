// SPDX-License-Identifier: Apache-2.0
//
// Witnesses of contact: the payload of block WITN (proofs/FORMAT.md, section 5), for steps between frames and for windows.
//
// Notation
//   integer time   time in units of 2^q, the step's
//   g          the polynomial one of whose roots is the time, in integer time
//   weights    of the vertices of two features, as polynomials in the time, such that g divides the difference of the
//              two points that they give
//
// Each vertex is looked at on one segment between two of its breakpoints; the time at which the features meet is cut where
// one of them has a breakpoint.
//
// Where the features span just a plane (in 2D a line) at the time of contact, g is the factor of their determinant that
// vanishes then, and the weights are those of the nearest points of the plane (the line). Elsewhere (motion within a
// plane, degenerate features, contact from the beginning) cells are looked at, at rest, at some times that are
// fractions with a power of two below.
//
// What this does not do: it does not find contacts, and for degenerate ones that last for a moment it finds no witness.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "noli/proofs/prover/mesh_paths.h"
#include "noli/proofs/prover/too_near.h"
#include "noli/proofs/prover/verifier.h"
#include "noli/trajectory/world_lines.h"

namespace noli {

/// A step in which something meets. In two dimensions third coordinates count as 0.
struct WitnessStep {
  const Mesh& mesh;  ///< after merging
  const WorldLines& lines;
  double shift;  ///< its times are those of the lines and this more, exactly
  int dimension;
  bool strict;
  double eta = 0;          ///< the least distance
  std::uint32_t ring = 1;  ///< features that a path of fewer edges joins may be nearer
};

/// The payload for a pair of features that meets; nothing if none was found.
std::optional<std::string> witness_of(const WitnessStep& step, const FeatureContact& contact);

/// The same for two cells that meet at the beginning.
std::optional<std::string> witness_of(const WitnessStep& step, const InitialIntersection& pair);

/// The same for two cells that are nearer to each other than the least distance at a time of the lines.
std::optional<std::string> witness_of(const WitnessStep& step, const TooNear& near, const MeshPaths& paths);

/// Of the first contact; where that has none, of any of those that were found.
std::optional<std::string> witness_of(const WitnessStep& step, const std::optional<FeatureContact>& first,
                                      std::span<const InitialIntersection> initial,
                                      std::span<const FeatureContact> contacts);

}  // namespace noli
