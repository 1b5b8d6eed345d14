// SPDX-License-Identifier: Apache-2.0
#include "report/figures/picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>

#include "integrator/scene/shapes/curve.h"

namespace noli::report {
namespace {

using integrator::cross;
using integrator::to_vec;
using integrator::Vec3;
using Colour = std::array<double, 3>;

constexpr std::size_t samples = 3;  ///< across a pixel
constexpr double margin = 0.03;     ///< around what is seen, in parts of the width
constexpr double line_width = 1.2;  ///< of the edges of faces [samples]
constexpr double thick_width = 5;   ///< of loose edges [samples]
constexpr double wall_width = 4;    ///< of the borders of walls [samples]
constexpr double dot_width = 12;    ///< of loose points [samples]
constexpr double least_aspect = 0.3, greatest_aspect = 1.5;
constexpr Colour paper{1, 1, 1}, grey{0.72, 0.72, 0.70};
constexpr std::array<Colour, 2> mark_colours{{{0.85, 0.10, 0.12}, {0.98, 0.78, 0.10}}};
constexpr Colour ink{0.05, 0.05, 0.05};
constexpr double in_front = 1e9;  ///< depth of what nothing hides [samples]
constexpr std::array<Colour, 6> palette{{{0.36, 0.56, 0.80},
                                         {0.90, 0.62, 0.32},
                                         {0.45, 0.68, 0.42},
                                         {0.79, 0.44, 0.46},
                                         {0.60, 0.50, 0.74},
                                         {0.84, 0.75, 0.40}}};

Vec3 unit(const Vec3& a) {
  const double length = std::sqrt(a.squaredNorm());
  if (!(length > 0 && std::isfinite(length))) throw std::invalid_argument("picture: a view without direction");
  return a / length;
}

/// For each vertex the first vertex of what it hangs together with.
std::vector<VertexId> parts_of(const Mesh& mesh) {
  std::vector<VertexId> of(mesh.vertex_count);
  std::iota(of.begin(), of.end(), VertexId{0});
  const auto root = [&of](VertexId v) {
    while (of[v] != v) v = of[v] = of[of[v]];
    return v;
  };
  const auto join = [&](const auto& cell) {
    for (const VertexId v : cell) {
      const VertexId a = root(cell[0]), b = root(v);
      of[std::max(a, b)] = std::min(a, b);
    }
  };
  for (const auto& face : mesh.faces) join(face);
  for (const auto& edge : mesh.edges) join(edge);
  for (VertexId v = 0; v < of.size(); ++v) of[v] = root(v);
  return of;
}

/// How each vertex is drawn.
struct Looks {
  std::vector<Colour> colours;
  std::vector<bool> is_wall;  ///< part of something fixed of no more than four vertices, a floor or a wall
};

Looks looks_of(const Mesh& mesh, const std::vector<bool>& fixed) {
  const std::vector<VertexId> part = parts_of(mesh);
  std::vector<bool> moves(part.size(), false);
  std::vector<std::size_t> sizes(part.size(), 0);
  for (VertexId v = 0; v < part.size(); ++v) {
    ++sizes[part[v]];
    if (!fixed[v]) moves[part[v]] = true;
  }
  Looks looks{std::vector<Colour>(part.size(), grey), std::vector<bool>(part.size(), false)};
  std::size_t next = 0;
  for (VertexId v = 0; v < part.size(); ++v) {
    if (part[v] == v && moves[v]) looks.colours[v] = palette[next++ % palette.size()];
    looks.colours[v] = looks.colours[part[v]];
    looks.is_wall[v] = !moves[part[v]] && sizes[part[v]] <= 4;
  }
  return looks;
}

class Canvas {
 public:
  Canvas(const Frame& frame, const std::vector<bool>& fixed, const View& view)
      : frame_(frame), looks_(looks_of(frame.mesh, fixed)), marks_(view.marks), eye_(unit(to_vec(view.from))) {
    right_ = unit(cross(to_vec(view.up), eye_));
    up_ = cross(eye_, right_);
    project(view);
    depth_.assign(width_ * height_, -std::numeric_limits<double>::infinity());
    colour_.assign(width_ * height_, paper);
  }

  /// What fills the picture.
  const Extent& seen() const { return seen_; }

  Picture paint() {
    for (const auto& face : frame_.mesh.faces) {
      if (!looks_.is_wall[face[0]]) paint_face(face);
    }
    paint_walls();
    for (const auto& [a, b] : frame_.mesh.edges) paint_line(at_[a], at_[b], thick_width, looks_.colours[a]);
    for (const VertexId v : frame_.mesh.points) paint_line(at_[v], at_[v], dot_width, looks_.colours[v]);
    for (const Mark& mark : marks_) paint_mark(mark);
    if (focus_) paint_line(*focus_, *focus_, dot_width, ink);
    return picture();
  }

 private:
  /// Whether a vertex has to be in the picture.
  bool is_shown(std::size_t v, const View& view, bool only_walls) const {
    if (view.count > 0) return view.first <= v && v - view.first < view.count;
    return !looks_.is_wall[v] || only_walls || frame_.mesh.faces.empty();
  }

  /// Of what the view shows, in metres: before at_ is in samples.
  Extent extent(const View& view) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Extent all{infinity, infinity, -infinity, -infinity};
    const bool only_walls = std::find(looks_.is_wall.begin(), looks_.is_wall.end(), false) == looks_.is_wall.end();
    for (std::size_t v = 0; v < at_.size(); ++v) {
      if (!is_shown(v, view, only_walls)) continue;
      all = {std::min(all.left, at_[v][0]), std::min(all.top, at_[v][1]), std::max(all.right, at_[v][0]),
             std::max(all.bottom, at_[v][1])};
    }
    return at_.empty() ? Extent() : all;
  }

  /// Right, down, towards the eye, in samples.
  void project(const View& view) {
    for (const Position& position : frame_.positions) {
      const Vec3 x = to_vec(position);
      at_.emplace_back(x.dot(right_), -x.dot(up_), x.dot(eye_));
    }
    seen_ = view.extent ? *view.extent : extent(view);
    if (view.focus) seen_ = around(*view.focus);
    const Extent& seen = seen_;
    const double wide = seen.right - seen.left, tall = seen.bottom - seen.top, pixels = static_cast<double>(view.width);
    const double shape = std::clamp(wide > 0 ? tall / wide : greatest_aspect, least_aspect, greatest_aspect);
    const double aspect = view.height > 0 ? static_cast<double>(view.height) / pixels : shape;
    width_ = view.width * samples;
    height_ = static_cast<std::size_t>(std::lround(pixels * aspect)) * samples;
    const double longest = std::max({wide, tall / aspect, std::numeric_limits<double>::min()});
    const double scale = static_cast<double>(width_) * (1 - 2 * margin) / longest;
    for (Vec3& p : at_) {
      p[0] = scale * (p[0] - 0.5 * (seen.left + seen.right)) + 0.5 * static_cast<double>(width_);
      p[1] = scale * (p[1] - 0.5 * (seen.top + seen.bottom)) + 0.5 * static_cast<double>(height_);
      p[2] *= scale;
    }
    if (view.focus) {
      focus_ = Vec3(0.5 * static_cast<double>(width_), 0.5 * static_cast<double>(height_), 3 * in_front);
    }
  }

  Extent around(const Focus& focus) const {
    const Vec3 x = to_vec(focus.centre);
    const double right = x.dot(right_), down = -x.dot(up_);
    return {right - focus.radius, down - focus.radius, right + focus.radius, down + focus.radius};
  }

  /// Calls each(column, row) for the samples in a box that are on the canvas.
  template <class Each>
  void for_each_sample(double left, double top, double right, double bottom, const Each& each) {
    const auto first = [](double x) { return static_cast<std::size_t>(std::clamp(std::floor(x), 0.0, 1e9)); };
    const auto end = [](double x, std::size_t n) {
      return static_cast<std::size_t>(std::clamp(std::ceil(x) + 1, 0.0, static_cast<double>(n)));
    };
    for (std::size_t j = first(top); j < end(bottom, height_); ++j) {
      for (std::size_t i = first(left); i < end(right, width_); ++i) each(i, j);
    }
  }

  void put(std::size_t i, std::size_t j, double depth, const Colour& colour, double light) {
    const std::size_t k = j * width_ + i;
    if (!(depth > depth_[k])) return;
    depth_[k] = depth;
    for (std::size_t c = 0; c < 3; ++c) colour_[k][c] = colour[c] * light;
  }

  void paint_mark(const Mark& mark) {
    const Mesh& mesh = frame_.mesh;
    const Colour& colour = mark_colours[static_cast<std::size_t>(mark.side)];
    const auto near = [&](VertexId v) -> Vec3 { return at_[v] + Vec3(0, 0, in_front); };
    if (mark.cell < mesh.faces.size()) return paint_face(mesh.faces[mark.cell], colour, in_front);
    const std::size_t edge = mark.cell - mesh.faces.size();
    if (edge < mesh.edges.size()) {
      return paint_line(near(mesh.edges[edge][0]), near(mesh.edges[edge][1]), thick_width, colour);
    }
    const VertexId point = mesh.points[edge - mesh.edges.size()];
    paint_line(near(point), near(point), dot_width, colour);
  }

  void paint_face(const std::array<VertexId, 3>& face) { paint_face(face, looks_.colours[face[0]], 0); }

  void paint_face(const std::array<VertexId, 3>& face, const Colour& colour, double nearer) {
    const Vec3 &a = at_[face[0]], &b = at_[face[1]], &c = at_[face[2]];
    const double twice_area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if (twice_area == 0) return;
    const double light = light_on(face);
    const std::array<double, 3> heights = heights_of(a, b, c, std::abs(twice_area));
    const bool lines = *std::min_element(heights.begin(), heights.end()) > 6 * line_width;
    for_each_sample(std::min({a[0], b[0], c[0]}), std::min({a[1], b[1], c[1]}), std::max({a[0], b[0], c[0]}),
                    std::max({a[1], b[1], c[1]}), [&](std::size_t i, std::size_t j) {
                      const double x = static_cast<double>(i) + 0.5, y = static_cast<double>(j) + 0.5;
                      const double v = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / twice_area;
                      const double w = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / twice_area;
                      const double u = 1 - v - w;
                      if (u < 0 || v < 0 || w < 0) return;
                      const bool on_line = std::min({u * heights[0], v * heights[1], w * heights[2]}) < line_width;
                      put(i, j, u * a[2] + v * b[2] + w * c[2] + nearer, colour,
                          lines && on_line ? 0.72 * light : light);
                    });
  }

  /// Their borders alone.
  void paint_walls() {
    std::map<std::array<VertexId, 2>, int> faces_on;
    for (const auto& face : frame_.mesh.faces) {
      if (!looks_.is_wall[face[0]]) continue;
      for (std::size_t k = 0; k < 3; ++k)
        ++faces_on[{std::min(face[k], face[(k + 1) % 3]), std::max(face[k], face[(k + 1) % 3])}];
    }
    for (const auto& [edge, faces] : faces_on) {
      if (faces == 1) paint_line(at_[edge[0]], at_[edge[1]], wall_width, grey);
    }
  }

  /// Of the corners over the opposite edges, as they are seen.
  static std::array<double, 3> heights_of(const Vec3& a, const Vec3& b, const Vec3& c, double twice_area) {
    const auto length = [](const Vec3& p, const Vec3& q) { return std::hypot(p[0] - q[0], p[1] - q[1]); };
    return {twice_area / length(b, c), twice_area / length(c, a), twice_area / length(a, b)};
  }

  double light_on(const std::array<VertexId, 3>& face) const {
    const auto x = [&](std::size_t k) { return to_vec(frame_.positions[face[k]]); };
    const Vec3 normal = cross(x(1) - x(0), x(2) - x(0));
    const double length = std::sqrt(normal.squaredNorm());
    if (!(length > 0)) return 1;
    const Vec3 lamp = eye_ + 0.6 * up_ - 0.5 * right_;
    return 0.45 + 0.6 * std::min(0.92, std::abs(normal.dot(lamp)) / (length * std::sqrt(lamp.squaredNorm())));
  }

  /// With round ends.
  void paint_line(const Vec3& a, const Vec3& b, double width, const Colour& colour) {
    const double r = width / 2, dx = b[0] - a[0], dy = b[1] - a[1], squared = dx * dx + dy * dy;
    for_each_sample(std::min(a[0], b[0]) - r, std::min(a[1], b[1]) - r, std::max(a[0], b[0]) + r,
                    std::max(a[1], b[1]) + r, [&](std::size_t i, std::size_t j) {
                      const double x = static_cast<double>(i) + 0.5 - a[0], y = static_cast<double>(j) + 0.5 - a[1];
                      const double s = squared > 0 ? std::clamp((x * dx + y * dy) / squared, 0.0, 1.0) : 0;
                      if (std::hypot(x - s * dx, y - s * dy) > r) return;
                      put(i, j, a[2] + s * (b[2] - a[2]), colour, 0.9);
                    });
  }

  Picture picture() const {
    Picture result{width_ / samples, height_ / samples, {}};
    for (std::size_t j = 0; j < result.height; ++j) {
      for (std::size_t i = 0; i < result.width; ++i) {
        for (std::size_t c = 0; c < 3; ++c) result.bytes.push_back(mean(i, j, c));
      }
    }
    return result;
  }

  std::uint8_t mean(std::size_t i, std::size_t j, std::size_t c) const {
    double sum = 0;
    for (std::size_t y = 0; y < samples; ++y) {
      for (std::size_t x = 0; x < samples; ++x) sum += colour_[(j * samples + y) * width_ + i * samples + x][c];
    }
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(sum / (samples * samples), 0.0, 1.0)));
  }

  const Frame& frame_;
  Looks looks_;
  const std::vector<Mark>& marks_;
  std::optional<Vec3> focus_;  ///< in samples
  Vec3 eye_, right_, up_;
  std::vector<Vec3> at_;
  Extent seen_;
  std::size_t width_ = 0, height_ = 0;  ///< in samples
  std::vector<double> depth_;
  std::vector<Colour> colour_;
};

}  // namespace

Extent extent_of(const Frame& frame, const std::vector<bool>& fixed, const View& view) {
  return Canvas(frame, fixed, view).seen();
}

Picture draw(const Frame& frame, const std::vector<bool>& fixed, const View& view) {
  return Canvas(frame, fixed, view).paint();
}

}  // namespace noli::report
