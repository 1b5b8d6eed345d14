// SPDX-License-Identifier: Apache-2.0
//
// Generators of motions of meshes for `noli fuzz trajectories`. Each attacks one thing, and most know their answer by
// how they are made: contact or none, the step and the exact time, the features.
//
// A generator uses nothing but the random numbers that it is given.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "audit/fuzz/trajectories/whole_motion.h"

namespace noli::audit {

struct MotionGenerator {
  std::string_view name;
  std::string_view attacks;  ///< one line
  GeneratedMotion (*make)(Random& random);
};

/// A fuzzer's generators take turns over blocks of so many motions.
inline constexpr std::uint64_t motions_per_block = 16;

/// All generators; the order never depends on anything.
std::span<const MotionGenerator> motion_generators();

/// The generators with these names, in that order; without names, all of them. Throws std::invalid_argument for other
/// names.
std::vector<MotionGenerator> motion_generators(std::span<const std::string> names);

}  // namespace noli::audit
