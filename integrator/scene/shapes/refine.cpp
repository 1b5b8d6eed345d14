// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/shapes/refine.h"

#include <algorithm>
#include <map>

#include "integrator/scene/shapes/curve.h"
#include "trajectory/stop.h"

namespace noli::integrator {
namespace {

using Edge = std::array<VertexId, 2>;

Edge sorted(VertexId a, VertexId b) { return {std::min(a, b), std::max(a, b)}; }

/// Faces are kept with their peaks first.
class Bisection {
 public:
  explicit Bisection(Shape& shape) : shape_(shape), faces_(shape.mesh.faces) {
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      put_peak_first(faces_[f]);
      for (const Edge& edge : edges(faces_[f])) on_[edge].push_back(f);
    }
  }

  /// Halves face f, and what has to be halved for that.
  void halve(std::size_t f) {
    const Edge base = base_of(f);
    std::size_t other = across(base, f);
    while (other != none && base_of(other) != base) {
      halve(other);
      other = across(base, f);
    }
    const VertexId middle = add_middle(base);
    split(f, middle);
    if (other != none) split(other, middle);
  }

  double longest_edge_squared(std::size_t f) const {
    double longest = 0;
    for (const auto& [a, b] : edges(faces_[f])) longest = std::max(longest, (at(b) - at(a)).squaredNorm());
    return longest;
  }

  bool contains(std::size_t f, const Vec3& p) const {
    const auto [a, b, c] = faces_[f];
    return side(a, b, p) >= 0 && side(b, c, p) >= 0 && side(c, a, p) >= 0;
  }

  bool has_vertex_within(std::size_t f, const Vec3& p, double radius) const {
    return std::any_of(faces_[f].begin(), faces_[f].end(),
                       [&](VertexId v) { return (at(v) - p).squaredNorm() <= radius * radius; });
  }

  std::size_t size() const { return faces_.size(); }

 private:
  using Face = std::array<VertexId, 3>;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  static std::array<Edge, 3> edges(const Face& face) {
    return {sorted(face[1], face[2]), sorted(face[2], face[0]), sorted(face[0], face[1])};
  }

  Vec3 at(VertexId v) const { return to_vec(shape_.positions[v]); }
  Edge base_of(std::size_t f) const { return sorted(faces_[f][1], faces_[f][2]); }
  double side(VertexId a, VertexId b, const Vec3& p) const { return cross(at(b) - at(a), p - at(a))[2]; }

  void put_peak_first(Face& face) const {
    std::array<double, 3> opposite{};
    for (std::size_t k = 0; k < 3; ++k) opposite[k] = (at(face[(k + 1) % 3]) - at(face[(k + 2) % 3])).squaredNorm();
    std::rotate(face.begin(), face.begin() + (std::max_element(opposite.begin(), opposite.end()) - opposite.begin()),
                face.end());
  }

  std::size_t across(const Edge& edge, std::size_t f) const {
    for (const std::size_t other : on_.at(edge)) {
      if (other != f) return other;
    }
    return none;
  }

  VertexId add_middle(const Edge& edge) {
    const Vec3 middle = 0.5 * (at(edge[0]) + at(edge[1]));
    return shape_.add(to_position(middle));
  }

  /// The first half stays in the face's place.
  void split(std::size_t f, VertexId middle) {
    const auto [peak, left, right] = faces_[f];
    for (const Edge& edge : edges(faces_[f])) std::erase(on_[edge], f);
    put(f, {middle, peak, left});
    faces_.emplace_back();
    put(faces_.size() - 1, {middle, right, peak});
  }

  void put(std::size_t f, const Face& face) {
    faces_[f] = face;
    for (const Edge& edge : edges(face)) on_[edge].push_back(f);
  }

  Shape& shape_;
  std::vector<Face>& faces_;
  std::map<Edge, std::vector<std::size_t>> on_;  ///< faces on each edge
};

}  // namespace

void refine(Shape& shape, const std::array<double, 2>& at, double radius, double longest) {
  Bisection bisection(shape);
  const Vec3 p(at[0], at[1], 0);
  const auto too_large = [&](std::size_t f) {
    return bisection.longest_edge_squared(f) > longest * longest &&
           (bisection.contains(f, p) || bisection.has_vertex_within(f, p, radius));
  };
  for (bool halved = true; halved;) {
    halved = false;
    for (std::size_t f = 0; f < bisection.size(); ++f) {
      end_if_stopped();
      if (!too_large(f)) continue;
      bisection.halve(f);
      halved = true;
    }
  }
}

}  // namespace noli::integrator
