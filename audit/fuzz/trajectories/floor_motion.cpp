// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/trajectories/floor_motion.h"

#include <algorithm>
#include <cstdlib>

namespace noli::audit {

namespace {

std::int64_t determinant(const Whole& a, const Whole& b, const Whole& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// One of the two: its vertices at t*, what they move by in an n-th of the step, and its cells.
struct Body {
  std::vector<Whole> x, v;
  std::vector<Feature> cells;
};

class Builder {
 public:
  Builder(const FloorPlan& plan, Random& random)
      : plan_(plan),
        random_(random),
        height_(static_cast<std::size_t>(plan.type.dimension - 1)),
        joined_(plan.joined) {}

  FloorMotion make() {
    const int axes = plan_.type.dimension - 1;
    const Directions directions = {random_direction(random_, axes, plan_.size),
                                   random_direction(random_, axes, plan_.size)};
    const Meeting met = meeting(plan_.type, plan_.place, random_ratios(random_), directions);
    const std::size_t first = first_size(plan_.type.pair), all = point_count(plan_.type.pair);
    const bool swapped = random_.one_in(2);
    upper_.x = {met.x.begin() + (swapped ? first : 0), met.x.begin() + (swapped ? all : first)};
    lower_.x = {met.x.begin() + (swapped ? 0 : first), met.x.begin() + (swapped ? first : all)};
    const std::array<std::size_t, 2> sizes = {upper_.x.size(), lower_.x.size()};
    dress(upper_, 1);
    dress(lower_, -1);
    return assemble(sizes);
  }

 private:
  bool meets() const { return std::ranges::find(meeting_places, plan_.place) != meeting_places.end(); }

  /// A vertex off the floor, on that side.
  Whole off_floor(int side) {
    Whole x = random_whole(random_, plan_.type.dimension - 1, plan_.size);
    x[height_] = side * random_.between(1, plan_.size);
    return x;
  }

  /// A displacement that keeps the side.
  Whole displacement(int side) {
    Whole v = plan_.joined ? Whole{} : random_whole(random_, plan_.type.dimension - 1, plan_.speed);
    v[height_] = side > 0 ? -random_.between(1, plan_.fall) : random_.between(0, plan_.fall);
    if (plan_.away) v[height_] = side > 0 ? random_.between(1, plan_.fall) : -random_.between(0, plan_.fall);
    return v;
  }

  /// Gives the feature in the floor the rest of its body.
  void dress(Body& body, int side) {
    if (plan_.rigid) return dress_rigidly(body, side);
    const std::size_t feature = body.x.size(), corners = feature + random_.below(4 - feature);
    while (body.x.size() < corners) body.x.push_back(off_floor(side));
    while (body.v.size() < corners) body.v.push_back(displacement(side));
    body.cells = {all_of(body)};
  }

  static Feature all_of(const Body& body) {
    Feature cell;
    for (VertexId v = 0; v < body.x.size(); ++v) cell.push_back(v);
    return cell;
  }

  /// A simplex that is not flat: its feature is all that it has in the floor.
  void dress_rigidly(Body& body, int side) {
    const std::vector<Whole> feature = body.x;
    const std::size_t corners = height_ + 2;
    for (int attempt = 0; attempt < 50; ++attempt) {
      body.x = feature;
      while (body.x.size() < corners) body.x.push_back(off_floor(side));
      if (plan_.joined) body.x.back()[0] = -link();
      if (!flat(body)) break;
    }
    body.v.assign(corners, displacement(side));
    if (flat(body)) {  // a feature that is less than its name: let it be the only cell
      body.x = feature;
      body.v.resize(feature.size());
      body.cells = {all_of(body)};
      joined_ = false;
      return;
    }
    if (height_ == 2) body.cells = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
    if (height_ == 1 && random_.one_in(2)) body.cells = {{0, 1}, {1, 2}, {2, 0}};
    if (body.cells.empty()) body.cells = {{0, 1, 2}};
  }

  bool flat(const Body& body) const {
    const auto& x = body.x;
    if (height_ == 1) return (x[1] - x[0])[0] * (x[2] - x[0])[1] == (x[1] - x[0])[1] * (x[2] - x[0])[0];
    return determinant(x[1] - x[0], x[2] - x[0], x[3] - x[0]) == 0;
  }

  /// How far aside the two are joined: nothing else is as far.
  std::int64_t link() const { return 64 * plan_.size; }

  FloorMotion assemble(const std::array<std::size_t, 2>& sizes) {
    const auto [k, n] = plan_.when;
    FloorMotion made;
    WholeMotion& motion = made.motion;
    motion.dimension = plan_.type.dimension;
    const auto shift = static_cast<VertexId>(upper_.x.size());
    motion.cells = upper_.cells;
    for (Feature cell : lower_.cells) {
      for (VertexId& v : cell) v += shift;
      motion.cells.push_back(cell);
    }
    std::vector<Whole> x = upper_.x, v = upper_.v;
    x.insert(x.end(), lower_.x.begin(), lower_.x.end());
    v.insert(v.end(), lower_.v.begin(), lower_.v.end());
    if (joined_) {
      motion.cells.push_back({shift - 1, static_cast<VertexId>(x.size() - 1), static_cast<VertexId>(x.size())});
      Whole far = off_floor(1);
      far[0] = -2 * link();
      x.push_back(far);
      v.push_back(displacement(1));
    }
    plant(sizes, shift, made.planted);
    if (plan_.at_rest) {
      motion.frames = {x};
      return made;
    }
    const auto at = [&](std::int64_t steps) {
      std::vector<Whole> frame = x;
      for (std::size_t i = 0; i < x.size(); ++i) frame[i] = x[i] + steps * v[i];
      return frame;
    };
    motion.frames = {at(-k), at(n - k)};
    for (std::size_t i = 0; i < plan_.before; ++i) motion.frames.insert(motion.frames.begin(), apart_from(motion, 0));
    for (std::size_t i = 0; i < plan_.after; ++i) {
      const bool risen = !made.planted.contact.value() || k == n;
      motion.frames.push_back(risen ? apart_from(motion, motion.frames.size() - 1) : anything(x.size()));
    }
    return made;
  }

  void plant(const std::array<std::size_t, 2>& sizes, VertexId shift, PlantedTruth& planted) const {
    const auto [k, n] = plan_.when;
    planted.contact = meets() && k <= n;
    planted.step = planted.contact.value() && !plan_.at_rest ? plan_.before : 0;
    planted.initial = planted.contact.value() && (plan_.at_rest || (k == 0 && plan_.before == 0));
    if (!planted.contact.value()) return;
    planted.time = plan_.at_rest ? 0 : static_cast<double>(k) / static_cast<double>(n);
    planted.features.emplace();
    for (VertexId i = 0; i < sizes[0]; ++i) (*planted.features)[0].push_back(i);
    for (VertexId i = 0; i < sizes[1]; ++i) (*planted.features)[1].push_back(shift + i);
  }

  /// A frame from which, or to which, both bodies move in their own half, the upper one above the floor.
  std::vector<Whole> apart_from(const WholeMotion& motion, std::size_t frame) {
    std::vector<Whole> x = motion.frames[frame];
    Whole up = plan_.joined ? Whole{} : random_whole(random_, plan_.type.dimension - 1, plan_.speed), down = up;
    up[height_] = random_.between(1, plan_.fall);
    down[height_] = -random_.between(0, plan_.fall);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = x[i] + (i < upper_.x.size() ? up : down);
    return x;
  }

  std::vector<Whole> anything(std::size_t vertices) {
    std::vector<Whole> x(vertices);
    for (Whole& place : x) place = random_whole(random_, plan_.type.dimension, plan_.size);
    return x;
  }

  const FloorPlan& plan_;
  Random& random_;
  std::size_t height_;
  bool joined_;  ///< unless a body is flat
  Body upper_, lower_;
};

}  // namespace

FloorMotion floor_motion(const FloorPlan& plan, Random& random) { return Builder(plan, random).make(); }

}  // namespace noli::audit
