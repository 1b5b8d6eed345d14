// SPDX-License-Identifier: Apache-2.0
//
// A picture of a mesh at one moment, for pages about scenes.
//
// Notation
//   view     parallel projection along a direction; z is up, or y in the plane
//   sample   a pixel is the mean of 3 x 3 samples, each the nearest thing there
// Parts of the mesh that hang together have a colour each; parts of which nothing is free are grey. Faces are lit from
// the eye's upper left, alike on both sides, and their edges are darker where there is room for them.
// Fixed parts of four vertices or fewer are floors and walls: only their borders are drawn, and they need not be seen.
// With `count` the picture is as large as what is shown, and the rest is drawn as far as it reaches into it.
//
// What this does not do: no perspective, no shadows, and nothing is decided by it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <noli/mesh.h>

namespace noli::report {

/// Of a parallel projection, right and down [m].
struct Extent {
  double left = 0, top = 0, right = 0, bottom = 0;
};

/// A point and what is around it.
struct Focus {
  Position centre{};
  double radius = 0;  ///< [m]
};

/// A cell in the colour of one of two sides, 0 or 1.
struct Mark {
  std::uint32_t cell = 0;  ///< as the mesh numbers them
  int side = 0;
};

struct View {
  Position from{0.8, -1.4, 0.7};  ///< the direction in which the eye is; of any length but zero
  Position up{0, 0, 1};           ///< not along `from`
  std::size_t width = 640;        ///< [pixels]
  std::size_t height = 0;         ///< [pixels]; 0: it follows from what is seen
  /// What the picture shows: of the vertices [first, first + count); count 0: all but floors and walls.
  std::size_t first = 0, count = 0;
  std::optional<Extent> extent = std::nullopt;  ///< fills the picture instead, as in a film
  std::optional<Focus> focus = std::nullopt;    ///< fills the picture instead
  std::vector<Mark> marks = {};                 ///< cells that stand out, before all others
};

/// Rows from top to bottom; red, green, blue.
struct Picture {
  std::size_t width = 0, height = 0;
  std::vector<std::uint8_t> bytes;
};

/// How much of the view what it shows takes. Arguments, errors: those of draw().
Extent extent_of(const Frame& frame, const std::vector<bool>& fixed, const View& view);

/// `fixed`: one for each vertex. Throws std::invalid_argument when the view is none.
Picture draw(const Frame& frame, const std::vector<bool>& fixed, const View& view);

}  // namespace noli::report
