// SPDX-License-Identifier: Apache-2.0
#include "report/figures/svg.h"
#include "trajectory/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace noli::report {
namespace {

/// To a hundredth of a pixel.
std::string number(double x) { return fmt::format("{:g}", std::round(100 * x) / 100); }

std::string points_text(std::span<const Svg::Point> points) {
  std::string text;
  for (const auto& p : points) text += number(p[0]) + "," + number(p[1]) + " ";
  if (!text.empty()) text.pop_back();
  return text;
}

std::string box(Svg::Point corner, Svg::Point size) {
  return fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}")", number(corner[0]), number(corner[1]),
                     number(size[0]), number(size[1]));
}

}  // namespace

Svg::Svg(double width, double height, const std::string& title) {
  out_ = fmt::format(
      R"(<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" version="1.1" width="{0}" height="{1}" viewBox="0 0 {0} {1}"
 font-family="Helvetica, Arial, sans-serif" font-size="13" fill="#222222">
<title>{2}</title>
)",
      number(width), number(height), escaped_markup(title));
  rectangle({0, 0}, {width, height}, "#ffffff");
}

void Svg::rectangle(Point corner, Point size, const std::string& fill) {
  out_ += fmt::format("{} fill=\"{}\"/>\n", box(corner, size), fill);
}

void Svg::frame(Point corner, Point size, const std::string& stroke) {
  out_ += fmt::format("{} fill=\"none\" stroke=\"{}\"/>\n", box(corner, size), stroke);
}

void Svg::line(Point from, Point to, const std::string& stroke, const std::string& dashes) {
  out_ += fmt::format(R"(<line x1="{}" y1="{}" x2="{}" y2="{}" stroke="{}")", number(from[0]), number(from[1]),
                      number(to[0]), number(to[1]), stroke);
  if (!dashes.empty()) out_ += fmt::format(R"( stroke-dasharray="{}")", dashes);
  out_ += "/>\n";
}

void Svg::polyline(std::span<const Point> points, const std::string& stroke, double width) {
  out_ += fmt::format(R"(<polyline points="{}" fill="none" stroke="{}" stroke-width="{}" stroke-linejoin="round"/>)"
                      "\n",
                      points_text(points), stroke, number(width));
}

void Svg::polygon(std::span<const Point> points, const std::string& fill) {
  out_ += fmt::format(R"(<polygon points="{}" fill="{}"/>)"
                      "\n",
                      points_text(points), fill);
}

void Svg::text(Point at, const std::string& words, Anchor anchor, bool turned) {
  static constexpr const char* names[] = {"start", "middle", "end"};
  const std::string x = number(at[0]), y = number(at[1]);
  out_ += fmt::format(R"(<text x="{}" y="{}" text-anchor="{}")", x, y, names[static_cast<int>(anchor)]);
  if (turned) out_ += fmt::format(" transform=\"rotate(-90 {} {})\"", x, y);
  out_ += fmt::format(">{}</text>\n", escaped_markup(words));
}

std::string Svg::finish() { return std::move(out_) + "</svg>\n"; }

std::string colour(std::array<double, 3> red_green_blue) {
  std::string text = "#";
  for (const double c : red_green_blue) {
    text += fmt::format("{:02x}", static_cast<int>(std::lround(255 * std::clamp(c, 0.0, 1.0))));
  }
  return text;
}

std::string graded_colour(double share) {
  static constexpr std::array<std::array<double, 3>, 7> stops = {{{0.08, 0.05, 0.22},
                                                                  {0.33, 0.08, 0.45},
                                                                  {0.62, 0.15, 0.46},
                                                                  {0.87, 0.29, 0.36},
                                                                  {0.97, 0.53, 0.33},
                                                                  {0.99, 0.76, 0.50},
                                                                  {0.99, 0.95, 0.80}}};
  const double place = std::clamp(share, 0.0, 1.0) * (stops.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  std::array<double, 3> mixed{};
  for (std::size_t k = 0; k < 3; ++k) {
    mixed[k] = stops[i][k] + (place - static_cast<double>(i)) * (stops[i + 1][k] - stops[i][k]);
  }
  return colour(mixed);
}

}  // namespace noli::report
