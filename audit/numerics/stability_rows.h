// SPDX-License-Identifier: Apache-2.0
//
// Builds the sweeps of `noli audit stability`. Each row takes one quantity from the ordinary to the extreme (design,
// "Audit", stiff and extreme), in a small scene, or in two frames for which it is known whether anything touches.
//
// Notation
//   sheet    3 x 3 cells of 10 cm, thin and elastic, free, that flies and spins
//   chain    in the plane, four springs of 25 cm between free masses, that flies and spins
//   other    with contact: a sheet, or a chain, at rest in front of the first, and free too
// No scene has gravity, damping, friction or loss, and each begins in its rest shape with only kinetic energy. So its
// energy must stay constant, and if nothing is pinned, its momenta too. Where an extreme makes steps shorter, the run
// is shorter in proportion, and bodies that are to meet begin nearer to each other.
//
// Only one quantity at a time is extreme.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace noli::audit {

/// A scene to run: the text of a scene file.
struct SceneCase {
  std::string scene;
  bool free = true;  ///< nothing is pinned: momentum is kept
};

/// Two frames to verify, as texts of PLY files, and whether anything touches between them.
struct FramesCase {
  std::array<std::string, 2> frames;
  bool touch = false;
};

using StabilityCase = std::variant<SceneCase, FramesCase>;

struct StabilityRow {
  std::string name;
  std::string varied;          ///< the quantity that varies, with its unit
  bool contact = false;        ///< whether the scene has contact, or the frames do
  std::vector<double> values;  ///< from the ordinary to the extreme
  std::function<StabilityCase(double)> make;
};

/// All rows, in the order of the table. Names are unique.
std::vector<StabilityRow> stability_rows();

}  // namespace noli::audit
