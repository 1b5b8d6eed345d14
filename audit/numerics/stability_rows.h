// SPDX-License-Identifier: Apache-2.0
//
// What `noli audit stability` varies: each row takes one quantity from the ordinary to the extreme (design, "Audit",
// stiff and extreme), in a small scene, or in two frames of which it is known whether anything touches between them.
//
// Notation
//   sheet    3 x 3 cells of 10 cm, thin and elastic, free, that flies and spins
//   chain    in the plane, four springs of 25 cm between free masses, that flies and spins
//   other    with contact: a sheet, or a chain, at rest before the first, and free too
// Every scene is without gravity, damping, friction and loss, and begins in its shape at rest: its energy has to stay
// what it is, with nothing but kinetic energy at the start, and where nothing is pinned so have its momenta. Where an
// extreme makes steps shorter the run is as much shorter, and what is to meet begins as much nearer.
//
// What this does not do: one quantity at a time is extreme, not two.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace noli::audit {

/// To be run: the text of a scene file.
struct SceneCase {
  std::string scene;
  bool free = true;  ///< nothing is pinned: momentum is kept
};

/// To be verified: two frames as PLY files, and whether anything touches between them.
struct FramesCase {
  std::array<std::string, 2> frames;
  bool touch = false;
};

using StabilityCase = std::variant<SceneCase, FramesCase>;

struct StabilityRow {
  std::string name;
  std::string varied;          ///< what the values are, with their unit
  bool contact = false;        ///< whether the scene has contact, or the frames do
  std::vector<double> values;  ///< from the ordinary to the extreme
  std::function<StabilityCase(double)> make;
};

/// All rows, in the order of the table. Names are different.
std::vector<StabilityRow> stability_rows();

}  // namespace noli::audit
