// SPDX-License-Identifier: Apache-2.0
//
// Defines ten small scenes that together cover all features of contact: both dimensions, faces, loose edges and points,
// tips, scripted, pinned and free bodies, several materials, excluded groups, gravity, restitution, friction, grouped
// and own clocks.
#pragma once

#include <vector>

#include "contact_models.h"

namespace noli::integrator::test {

template <int Dim>
struct SmallScene {
  const char* name;
  Model<double, Dim> (*make)();
  std::uint64_t windows, with_all_layers;  ///< windows to run, and windows with all layers always active
};

template <int Dim>
void PrintTo(const SmallScene<Dim>& scene, std::ostream* out) {
  *out << scene.name;
}

using V2 = Vec<double, 2>;
using V3 = Vec<double, 3>;

/// Splits vertices into successive groups of these sizes. The first two groups exclude each other; pairs within a group
/// have another material than pairs between groups.
template <int Dim>
Model<double, Dim> with_groups(Model<double, Dim> model, const ContactOptions& o,
                               const std::vector<std::size_t>& sizes) {
  model = with_contact(std::move(model), o);
  ContactSettings& contact = *model.contact;
  contact.groups.clear();
  for (std::size_t g = 0; g < sizes.size(); ++g) {
    contact.groups.insert(contact.groups.end(), sizes[g], static_cast<std::uint16_t>(g));
  }
  ContactMaterial within = contact.materials[0];
  within.thickness *= 0.6;
  within.stiffness *= 2;
  within.step *= 0.7;
  contact.materials.push_back(within);
  contact.group_count = static_cast<std::uint16_t>(sizes.size());
  contact.material_of.assign(sizes.size() * sizes.size(), 0);
  for (std::size_t g = 0; g < sizes.size(); ++g) contact.material_of[g * sizes.size() + g] = 1;
  contact.material_of[1] = contact.material_of[sizes.size()] = ContactSettings::excluded;
  return model;
}

template <int Dim>
Model<double, Dim> with_gravity(Model<double, Dim> model, double acceleration) {
  Vec<double, Dim> g = Vec<double, Dim>::Zero();
  g[Dim - 1] = -acceleration;
  model.gravity = Gravity<double, Dim>{g, model.window_length / 16};
  return model;
}

// --- In the plane ----------------------------------------------------------------------------------------------------

inline Model<double, 2> straight_chain(int segments, double length, double noise_height, std::uint64_t seed) {
  std::vector<V2> x;
  for (int i = 0; i <= segments; ++i) {
    x.emplace_back(length * i / segments - 0.5 * length, noise_height * noise(seed + static_cast<std::uint64_t>(i)));
  }
  return chain<2>(std::move(x), false, 200, 0.05);
}

inline Model<double, 2> hexagon(double radius) {
  const double h = 0.8660254037844386;
  std::vector<V2> x;
  for (const auto& [a, b] : {std::pair(1.0, 0.0), std::pair(0.5, h), std::pair(-0.5, h), std::pair(-1.0, 0.0),
                             std::pair(-0.5, -h), std::pair(0.5, -h)}) {
    x.emplace_back(radius * a, radius * b);
  }
  return chain<2>(std::move(x), true, 300, 0.05);
}

/// Two edges with a sharp tip below.
inline Model<double, 2> spike(double width, double height) {
  return chain<2>({V2(-width, height), V2(0, 0), V2(width, height)}, false, 500, 0.1);
}

inline Model<double, 2> chains_that_meet() {
  auto m = both(straight_chain(8, 1, 0.02, 1), moved<2>(straight_chain(7, 0.9, 0.02, 50), {0.03, 0.08}, {0.4, -2}));
  choose_steps(m, 0.5);
  return with_contact(std::move(m), {0.02, 400, 0.05, 1, 0});
}

inline Model<double, 2> loop_in_a_box() {
  const auto wall = held(chain<2>({V2(-0.6, -0.5), V2(0.6, -0.5), V2(0.6, 0.5), V2(-0.6, 0.5)}, true, 1, 1));
  const auto lid = scripted(chain<2>({V2(-0.55, 0.42), V2(0.55, 0.43)}, false, 1, 1), {0, 0.05, 0.1},
                            {V2(0, 0), V2(0, -0.12), V2(0.02, 0)});
  auto m = both(both(moved<2>(hexagon(0.25), {0.02, -0.1}, {0.7, -2.5}), wall), lid);
  choose_steps(m, 0.4);
  m.clocks = Clocks::own;
  return with_contact(std::move(m), {0.03, 500, 0.05, 0.6, 0.3});
}

inline Model<double, 2> points_and_spikes() {
  std::vector<V2> loose;
  for (int i = 0; i < 6; ++i) {
    const auto k = static_cast<std::uint64_t>(i);
    loose.emplace_back(-0.45 + 0.17 * i + 0.02 * noise(k), 0.12 + 0.03 * noise(k + 9));
  }
  auto m = both(held(chain<2>({V2(-1, 0), V2(0.1, 0), V2(1, 0.05)}, false, 1, 1)),
                moved<2>(points<2>(std::move(loose), 0.05), {0, 0}, {0.1, -1}));
  m = both(std::move(m), moved<2>(spike(0.02, 0.3), {0.2, 0.2}, {0, -3}));
  m = both(std::move(m), moved<2>(spike(0.05, 0.2), {-0.3, 0.3}, {0.2, -4}));
  choose_steps(m, 0.5);
  return with_contact(with_gravity(std::move(m), 9.81), {0.03, 300, 0.1, 0.4, 0.5});
}

inline Model<double, 2> stack_of_chains() {
  Model<double, 2> m = held(straight_chain(3, 2, 0, 1));
  std::vector<std::size_t> sizes{m.x.size()};
  for (int k = 1; k <= 4; ++k) {
    const auto next = straight_chain(4 + k, 1.2, 0.01, 100 * static_cast<std::uint64_t>(k));
    m = both(std::move(m), moved<2>(next, {0.02 * k, 0.05 * k}, {0, -1.0 - k}));
    sizes.push_back(next.x.size());
  }
  choose_steps(m, 0.5);
  return with_groups(std::move(m), {0.02, 500, 0.05, 1, 0.2}, sizes);
}

inline Model<double, 2> fast_points() {
  auto m =
      both(straight_chain(6, 1, 0.02, 3), moved<2>(points<2>({V2(-0.2, 0.1), V2(0.21, 0.12)}, 0.02), {0, 0}, {0, -60}));
  m = both(std::move(m), moved<2>(points<2>({V2(-0.2, -0.1)}, 0.02), {0, 0}, {0.5, 70}));
  m.window_length = 0.0005;
  choose_steps(m, 0.5);
  return with_contact(std::move(m), {0.02, 2000, 0.2, 0.8, 0.1});
}

// --- In space --------------------------------------------------------------------------------------------------------

inline Model<double, 3> small_sheet(int cells) {
  SheetOptions o;
  o.cells = cells;
  o.speed = 0.05;
  return sheet(o);
}

inline Model<double, 3> chains_and_points_on_a_sheet() {
  std::vector<V3> a, b;
  for (int i = 0; i < 4; ++i) {
    a.emplace_back(0.1 + 0.25 * i, 0.45, 0.08);
    b.emplace_back(0.52, 0.12 + 0.25 * i, 0.12);
  }
  auto m = both(small_sheet(2), moved<3>(chain<3>(std::move(a), false, 100, 0.02), {0, 0, 0}, {0, 0, -2}));
  m = both(std::move(m), moved<3>(chain<3>(std::move(b), false, 100, 0.02), {0, 0, 0}, {0.1, 0, -3}));
  m = both(std::move(m), moved<3>(points<3>({V3(0.3, 0.3, 0.05), V3(0.305, 0.31, 0.09), V3(0.53, 0.5, 0.2)}, 0.02),
                                  {0, 0, 0}, {0, 0, -3}));
  choose_steps(m, 0.5);
  return with_contact(std::move(m), {0.02, 200, 0.05, 1, 0.2});
}

inline Model<double, 3> scripted_plate() {
  SheetOptions flat;
  flat.cells = 1;
  flat.wave = flat.speed = 0;
  const auto plate = scripted(moved<3>(sheet(flat), {0.05, 0.02, 0.06}, {0, 0, 0}), {0, 0.04, 0.08},
                              {V3(0, 0, 0), V3(0, 0, -0.06), V3(0.05, 0, 0.05)});
  auto m = both(small_sheet(3), plate);
  m.pinned = {0, 3};
  choose_steps(m, 0.5);
  return with_contact(std::move(m), {0.02, 1000, 0.05, 0.5, 0.3});
}

inline Model<double, 3> three_sheets_two_materials() {
  Model<double, 3> m = small_sheet(2);
  std::vector<std::size_t> sizes{m.x.size()};
  for (int k = 1; k <= 2; ++k) {
    const auto next = small_sheet(1 + k % 2);
    m = both(std::move(m), moved<3>(next, {0.04 * k, 0.03 * k, 0.25 * k}, {0.1, 0, -4.0 * k}));
    sizes.push_back(next.x.size());
  }
  choose_steps(m, 0.5);
  m.clocks = Clocks::own;
  return with_groups(std::move(m), {0.02, 500, 0.05, 0.7, 0.1}, sizes);
}

/// A narrow sheet that flies tip first, under gravity.
inline Model<double, 3> tip_on_a_sheet() {
  SheetOptions o;
  o.cells = 1;
  o.wave = o.speed = 0;
  Model<double, 3> tip = sheet(o);
  for (V3& x : tip.x) x = V3(0.4 + 0.06 * (x[0] - x[1]), 0.45 + 0.03 * x[0], 0.08 + 0.5 * (x[0] + x[1]));
  for (V3& v : tip.v) v = V3(0.2, 0, -5);
  auto m = both(small_sheet(3), tip);
  choose_steps(m, 0.5);
  return with_contact(with_gravity(std::move(m), 9.81), {0.02, 400, 0.1, 0.6, 0.4});
}

/// Two points and two loose edges in space, no sheet.
inline Model<double, 3> loose_things() {
  auto m = both(points<3>({V3(0, 0, 0), V3(0.3, 0, 0)}, 0.1),
                moved<3>(points<3>({V3(0.004, 0.003, 0.1)}, 0.1), {0, 0, 0}, {0, 0, -4}));
  m = both(std::move(m),
           moved<3>(chain<3>({V3(0.2, 0, 0.08), V3(0.4, 0.01, 0.08)}, false, 200, 0.1), {0, 0, 0}, {0, 0, -3}));
  m = both(std::move(m),
           moved<3>(chain<3>({V3(0.29, -0.2, 0.14), V3(0.3, 0.2, 0.15), V3(0.5, 0.2, 0.2)}, false, 200, 0.1), {0, 0, 0},
                    {0, 0, -6}));
  choose_steps(m, 0.5);
  return with_contact(std::move(m), {0.02, 500, 0.1, 1, 0});
}

inline const std::vector<SmallScene<2>> small_scenes_2d = {{"ChainsThatMeet", chains_that_meet, 12, 6},
                                                           {"LoopInABox", loop_in_a_box, 12, 12},
                                                           {"PointsAndSpikes", points_and_spikes, 15, 8},
                                                           {"StackOfChains", stack_of_chains, 10, 3},
                                                           {"FastPoints", fast_points, 12, 6}};

inline const std::vector<SmallScene<3>> small_scenes_3d = {
    {"ChainsAndPointsOnASheet", chains_and_points_on_a_sheet, 8, 4},
    {"ScriptedPlate", scripted_plate, 8, 3},
    {"ThreeSheetsTwoMaterials", three_sheets_two_materials, 8, 4},
    {"TipOnASheet", tip_on_a_sheet, 8, 4},
    {"LooseThings", loose_things, 12, 6}};

}  // namespace noli::integrator::test
