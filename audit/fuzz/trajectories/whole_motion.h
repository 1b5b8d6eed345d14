// SPDX-License-Identifier: Apache-2.0
//
// Motions of meshes with whole numbers as coordinates, and how they become frames: sheared, turned, moved, renumbered
// and scaled, all of which is exact and keeps the truth about contact.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "audit/fuzz/queries/whole_query.h"
#include "audit/fuzz/trajectories/frame_motion.h"
#include "audit/fuzz/trajectories/motion_oracle.h"

namespace noli::audit {

/// In 2D the third coordinates are 0.
struct WholeMotion {
  int dimension = 3;
  std::vector<Feature> cells;              ///< of one to three vertices, which need not ascend or differ
  std::vector<std::vector<Whole>> frames;  ///< one for a motion at rest

  std::size_t vertices() const { return frames[0].size(); }
};

/// What is known of a motion by how it was made. Where `contact` is nothing, nothing is.
struct PlantedTruth {
  std::optional<bool> contact;
  std::size_t step = 0;                ///< of the first contact
  std::optional<bool> initial;         ///< whether cells meet at the first time
  std::optional<double> time;          ///< of the first contact of features, exactly; nothing if none meet
  std::optional<FeatureTwo> features;  ///< that meet then, perhaps among others
};

struct GeneratedMotion {
  FrameMotion motion;
  PlantedTruth planted;
};

/// What the numbers of a motion are like.
enum class Numbers : std::uint8_t {
  small,   ///< as they are, times 2^-40 to 1
  scaled,  ///< subnormal, near the greatest double, or different on each axis
  offset,  ///< from 2^52 on: a unit is the last bit
};

/// 0, ..., size - 1 in random order, all orders equally likely.
std::vector<VertexId> random_order(std::size_t size, Random& random);

/// Adds triangles (edges, in 2D) that rest above all there is, each at a height of its own, so that they meet nothing.
void add_crowd(WholeMotion& motion, Random& random, std::size_t count);

/// The motion in disguise. Precondition: coordinates below 2^47 in size.
GeneratedMotion finish(WholeMotion motion, PlantedTruth planted, Numbers numbers, Random& random);

}  // namespace noli::audit
