// SPDX-License-Identifier: Apache-2.0
//
// Generates random small scenes with extreme parameters: thickness over three decades, stiffness over six, c up to 0.5,
// speeds up to 1,000 m/s. Sheets, tips, stacks, chains, loops and loose points fly into each other.
#pragma once

#include <cmath>
#include <cstdint>

#include "contact_models.h"

namespace noli::integrator::test {

/// A stream of numbers that depends only on the seed. Draw at most one per list of arguments, except in braces:
/// compilers evaluate arguments in different orders.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : state_(seed * 1000003) {}
  double unit() { return 0.5 + 0.5 * noise(state_++); }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// Log-uniform.
  double decades(double low, double high) { return low * std::pow(high / low, unit()); }
  int whole(int low, int high) { return low + static_cast<int>((high - low + 1) * unit() * (1 - 1e-12)); }
  bool chance(double p) { return unit() < p; }

 private:
  std::uint64_t state_;
};

template <int Dim>
struct Wild {
  Model<double, Dim> model;
  double c = 0;
};

using V2 = Vec<double, 2>;
using V3 = Vec<double, 3>;

/// Sets the forces' steps, the window, and one extreme material.
template <int Dim>
Wild<Dim> wild(Model<double, Dim> model, double speed, Numbers& random) {
  ContactOptions contact;
  contact.thickness = random.decades(2e-5, 2e-2);
  contact.stiffness = random.decades(1, 1e6);
  contact.c = random.decades(0.01, 0.5);
  contact.restitution = random.chance(0.5) ? 1 : random.unit();
  contact.friction = random.chance(0.5) ? 0 : random.unit();
  model = with_contact(std::move(model), contact);
  model.window_length = 0.2 / speed;
  if (random.chance(0.3)) model.clocks = Clocks::own;
  choose_steps(model, 0.5);
  return {std::move(model), contact.c};
}

/// Sheets that fly into one that is nearly at rest. Some are narrow and have sharp tips.
inline Model<double, 3> flying_sheets(Numbers& random, double speed) {
  SheetOptions o;
  o.cells = random.whole(2, 4);
  o.speed = random.decades(1e-3, 1);
  o.membrane = random.chance(0.5);
  Model<double, 3> model = sheet(o);
  const int sheets = random.whole(1, 3);
  const double gap = random.decades(0.03, 0.3);
  for (int k = 1; k <= sheets; ++k) {
    SheetOptions other = o;
    other.cells = random.whole(1, 4);
    Model<double, 3> next = sheet(other);
    const double spike = random.chance(0.3) ? random.between(0.05, 0.3) : 1;
    const double tilt = random.between(-0.2, 0.2);
    for (std::size_t i = 0; i < next.x.size(); ++i) {
      const V3 x = next.x[i];
      next.x[i] = {spike * x[0] + 0.1, x[1] + 0.05, k * gap + 0.45 * k + x[2] + tilt * (x[0] + x[1] - 1)};
      next.v[i][2] -= speed;
    }
    model = both(std::move(model), next);
  }
  return model;
}

/// A sheet of one cell, standing on its corner. `direction` 1: the tip is below, at (0, 0, 0); -1: above.
inline Model<double, 3> tip(Numbers& random, double direction) {
  SheetOptions o;
  o.cells = 1;
  o.wave = o.speed = 0;
  Model<double, 3> model = sheet(o);
  const double width = random.between(0.03, 0.15), turn = random.between(-1, 1);
  for (V3& x : model.x) {
    const double across = width * (x[0] - x[1]);
    x = V3(across, across * turn, direction * 0.5 * (x[0] + x[1]));
  }
  return model;
}

/// Tips that fly at tips, or at a pinned or free sheet.
inline Model<double, 3> flying_tips(Numbers& random, double speed) {
  SheetOptions o;
  o.cells = random.whole(1, 3);
  o.speed = 0;
  Model<double, 3> below = sheet(o);
  if (random.chance(0.4)) below = held(std::move(below));
  const int tips = random.whole(1, 3);
  for (int k = 0; k < tips; ++k) {
    const V3 place{0.1 + 0.4 * k + random.between(-0.02, 0.02), 0.4 + random.between(-0.1, 0.1), 0.1};
    const bool opposed = random.chance(0.5);
    if (opposed) {
      below = both(std::move(below), moved<3>(tip(random, -1), place + V3(0, 0, 1.05), V3(0, 0, -0.2 * speed)));
    }
    const V3 aside{random.between(-0.01, 0.01), random.between(-0.01, 0.01), opposed ? 1.15 : 0.05};
    below = both(std::move(below), moved<3>(tip(random, 1), place + aside, V3(0, 0, -speed)));
  }
  return below;
}

/// Sheets close above each other. The lowest is pinned, the highest is thrown down.
inline Model<double, 3> thrown_stack(Numbers& random, double speed) {
  SheetOptions o;
  o.cells = random.whole(1, 3);
  o.speed = 0;
  o.wave = 0.02;
  Model<double, 3> model = held(sheet(o));
  const int sheets = random.whole(2, 4);
  const double gap = random.between(0.03, 0.08);
  for (int k = 1; k <= sheets; ++k) {
    o.cells = random.whole(1, 3);
    const V3 by(0.03 * k, 0.02 * k, gap * k);
    model = both(std::move(model), moved<3>(sheet(o), by, V3(0, 0, k == sheets ? -speed : 0)));
  }
  return model;
}

/// Adds a chain and some points, faster and high above everything else.
inline Model<double, 3> with_loose_things(Model<double, 3> model, Numbers& random, double speed) {
  std::vector<V3> line, loose;
  const double height = random.between(2.6, 2.8);
  for (int i = 0; i < 4; ++i) line.emplace_back(0.1 + 0.25 * i, 0.4 + random.between(0, 0.1), height);
  for (int i = 0; i < 3; ++i) loose.emplace_back(0.2 + 0.3 * i, 0.5 + random.between(-0.2, 0), height + 0.2);
  model =
      both(std::move(model), moved<3>(chain<3>(std::move(line), false, 100, 0.02), V3::Zero(), V3(0, 0, -3 * speed)));
  return both(std::move(model), moved<3>(points<3>(std::move(loose), 0.02), V3::Zero(), V3(0, 0, -4 * speed)));
}

inline Wild<3> wild_scene_3d(std::uint64_t seed) {
  Numbers random(seed);
  const double speed = random.decades(0.1, 1000);
  Model<double, 3> model;
  switch (random.whole(0, 2)) {
    case 0: model = flying_sheets(random, speed); break;
    case 1: model = flying_tips(random, speed); break;
    default: model = thrown_stack(random, speed); break;
  }
  if (random.chance(0.3)) model = with_loose_things(std::move(model), random, speed);
  return wild(std::move(model), speed, random);
}

// --- In the plane ----------------------------------------------------------------------------------------------------

/// A chain along the first axis, at about `height`.
inline Model<double, 2> rough_chain(Numbers& random, double height) {
  const int segments = random.whole(2, 8);
  std::vector<V2> x;
  for (int i = 0; i <= segments; ++i) {
    x.emplace_back(1.2 * i / segments - 0.6, height + random.between(-0.02, 0.02));
  }
  return chain<2>(std::move(x), false, random.decades(50, 5000), 0.05);
}

/// A spike whose tip is at `at`, pointing down, or up for negative heights.
inline Model<double, 2> rough_spike(Numbers& random, const V2& at, double height) {
  const double width = random.decades(0.002, 0.1);
  return chain<2>({at + V2(-width, height), at, at + V2(width, height)}, false, random.decades(50, 5000), 0.05);
}

inline Model<double, 2> rough_loop(Numbers& random, const V2& at, double radius) {
  constexpr double h = 0.8660254037844386;
  std::vector<V2> x{{1, 0}, {0.5, h}, {-0.5, h}, {-1, 0}, {-0.5, -h}, {0.5, -h}};
  for (V2& p : x) p = at + radius * random.between(0.8, 1) * p;
  return chain<2>(std::move(x), true, random.decades(50, 5000), 0.05);
}

inline Model<double, 2> rough_points(Numbers& random, double height) {
  const int count = random.whole(1, 5);
  std::vector<V2> x(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double place = -0.5 + 0.2 * i + random.between(0, 0.1);
    x[static_cast<std::size_t>(i)] = V2(place, height + random.between(0, 0.1));
  }
  return points<2>(std::move(x), random.decades(0.005, 0.5));
}

/// Bodies above each other at heights 0.3 apart; higher ones are faster.
inline Wild<2> wild_scene_2d(std::uint64_t seed) {
  Numbers random(seed);
  const double speed = random.decades(0.1, 1000);
  Model<double, 2> model = rough_chain(random, 0);
  if (random.chance(0.5)) model = held(std::move(model));
  const int things = random.whole(1, 4);
  for (int k = 1; k <= things; ++k) {
    const double height = 0.3 * k, place = random.between(-0.3, 0.3);
    const V2 v(0.2 * speed * random.between(-1, 1), -speed * (0.5 + 0.5 * k));
    Model<double, 2> next;
    switch (random.whole(0, 4)) {
      case 0: next = rough_chain(random, height); break;
      case 1: next = rough_spike(random, {place, height - 0.1}, 0.2); break;
      case 2: next = rough_loop(random, {place, height}, 0.12); break;
      case 3: next = rough_points(random, height - 0.05); break;
      default:  // two tips
        next = rough_spike(random, {place, height - 0.04}, -0.08);
        next = both(std::move(next), rough_spike(random, {place + random.between(-1e-3, 1e-3), height + 0.01}, 0.09));
        break;
    }
    model = both(std::move(model), moved<2>(std::move(next), V2::Zero(), v));
  }
  return wild(std::move(model), speed, random);
}

}  // namespace noli::integrator::test
