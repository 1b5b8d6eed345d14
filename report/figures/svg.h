// SPDX-License-Identifier: Apache-2.0
//
// Pictures as text: just those parts of SVG 1.1 that a figure is made of. Lengths are pixels, y points down.
#pragma once

#include <array>
#include <span>
#include <string>

namespace noli::report {

enum class Anchor { start, middle, end };

class Svg {
 public:
  using Point = std::array<double, 2>;

  /// On a white ground.
  Svg(double width, double height, const std::string& title);

  void rectangle(Point corner, Point size, const std::string& fill);
  void frame(Point corner, Point size, const std::string& stroke);
  void line(Point from, Point to, const std::string& stroke, const std::string& dashes = "");
  void polyline(std::span<const Point> points, const std::string& stroke, double width);
  void polygon(std::span<const Point> points, const std::string& fill);
  /// `y` is the line that letters stand on. `turned`: read from below, about (x, y).
  void text(Point at, const std::string& words, Anchor anchor = Anchor::start, bool turned = false);

  /// The document. Nothing may follow.
  std::string finish();

 private:
  std::string out_;
};

/// "#rrggbb".
std::string colour(std::array<double, 3> red_green_blue);

/// A dark colour for 0, by way of red to a pale one for 1; each is lighter than the one before.
std::string graded_colour(double share);

}  // namespace noli::report
