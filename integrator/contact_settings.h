// SPDX-License-Identifier: Apache-2.0
//
// Settings of contact: an infinite sequence of nested penalty layers (Harmon et al. 2009, section 3).
//
// Notation
//   l         number of a layer, 1, 2, ...
//   eta(l)    thickness: the layer acts on a pair of features that is nearer than this [m]; eta(1) l^-a
//   r(l)      stiffness of the layer [N/m]; r(1) l^b
//   h(l)      step of the layer [s]; h(1) l^-c; it fires at the times k h(l)
//   e         the share of the energy of an approach that comes back, 0 to 1
//   mu        Coulomb's coefficient of friction
//
// The layers stop any speed if sum r(l) eta(l)^2 = infinity, that is b - 2 a >= -1. No layer is passed between two of
// its own kicks if h(l) / eta(l) -> 0, that is c > a.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <noli/mesh.h>

namespace noli::integrator {

/// Exponents a, b, c in quarters, so that powers take two square roots, with the same bits on all machines.
struct LayerSchedule {
  int thickness_quarters = 1;  ///< 4 a; the papers' schedule is l^(-1/4), l^3, l^(-3/2)
  int stiffness_quarters = 12;
  int step_quarters = 6;

  bool diverges() const { return stiffness_quarters - 2 * thickness_quarters >= -4; }
  bool outruns() const { return step_quarters > thickness_quarters; }
  friend bool operator==(const LayerSchedule&, const LayerSchedule&) = default;
};

/// l^(quarters / 4). Precondition: l >= 1, quarters >= 0.
inline double quarter_power(std::uint32_t l, int quarters) {
  const double base = l, root = std::sqrt(base), fourth = std::sqrt(root);
  double power = 1;
  for (int i = 0; i < quarters / 4; ++i) power *= base;
  if (quarters % 4 >= 2) power *= root;
  if (quarters % 2 == 1) power *= fourth;
  return power;
}

/// How two groups of bodies meet.
struct ContactMaterial {
  double thickness = 0;    ///< eta(1) [m], positive
  double stiffness = 0;    ///< r(1) [N/m], positive
  double step = 0;         ///< h(1) [s], positive
  double restitution = 1;  ///< e
  double friction = 0;     ///< mu

  friend bool operator==(const ContactMaterial&, const ContactMaterial&) = default;
};

/// Contact in a scene: the material of two features, if they are not excluded from contact. It depends on their groups,
/// which are bodies, and on their classes: within a body, light and small parts that need short steps have a class of
/// their own.
struct ContactSettings {
  static constexpr std::uint16_t excluded = 0xffff;

  LayerSchedule schedule;
  std::uint32_t most_layers = 1000;  ///< a pair that needs more ends the run
  std::uint32_t least_layers = 0;    ///< of each near pair; they change only the run time
  bool inclusion_exclusion = false;  ///< adjacent cells count once (integrator/inclusion_exclusion.h)
  std::vector<ContactMaterial> materials;
  std::vector<std::uint16_t> groups;  ///< of each vertex: its group, 0, 1, ..., group_count - 1
  std::uint16_t group_count = 1;
  std::vector<std::uint8_t> classes;  ///< of each vertex: its class, 0, 1, ..., class_count - 1; empty: all are 0
  std::uint16_t class_count = 1;
  /// [((g * group_count + h) * class_count + a) * class_count + b]: for groups g and h, classes a and b, symmetric; or
  /// `excluded`, then for all classes of the groups.
  std::vector<std::uint16_t> material_of;
  /// Keys of pairs of features (certificates/stencil.h), ascending: these may pass through each other too.
  std::vector<std::uint64_t> excluded_pairs = {};

  std::uint8_t class_of(VertexId v) const { return classes.empty() ? 0 : classes[v]; }
  std::size_t place(std::size_t g, std::size_t h, std::size_t a, std::size_t b) const {
    return ((g * group_count + h) * class_count + a) * class_count + b;
  }
  /// The material of two features. All vertices of a feature have one group; its class is the greatest of theirs.
  std::uint16_t material(std::span<const VertexId> first, std::span<const VertexId> second) const {
    return material_of[place(groups[first.front()], groups[second.front()], feature_class(first),
                             feature_class(second))];
  }

 private:
  std::uint8_t feature_class(std::span<const VertexId> vertices) const {
    std::uint8_t greatest = 0;
    for (const VertexId v : vertices) greatest = std::max(greatest, class_of(v));
    return greatest;
  }
};

/// [g * class_count + a]: the largest eta(1) of pairs with a feature of group g and of class a or above: the features
/// of which a vertex of class a may be part.
inline std::vector<double> greatest_thicknesses(const ContactSettings& s) {
  const std::size_t classes = s.class_count, all = s.group_count * classes;
  std::vector<double> greatest(all, 0);
  for (std::size_t i = all; i-- > 0;) {
    if ((i + 1) % classes != 0) greatest[i] = greatest[i + 1];
    for (std::size_t j = 0; j < all; ++j) {
      const std::uint16_t m = s.material_of[s.place(i / classes, j / classes, i % classes, j % classes)];
      if (m != ContactSettings::excluded) greatest[i] = std::max(greatest[i], s.materials[m].thickness);
    }
  }
  return greatest;
}

inline double layer_thickness(const ContactMaterial& m, const LayerSchedule& s, std::uint32_t l) {
  return m.thickness / quarter_power(l, s.thickness_quarters);
}
inline double layer_stiffness(const ContactMaterial& m, const LayerSchedule& s, std::uint32_t l) {
  return m.stiffness * quarter_power(l, s.stiffness_quarters);
}
inline double layer_step(const ContactMaterial& m, const LayerSchedule& s, std::uint32_t l) {
  return m.step / quarter_power(l, s.step_quarters);
}

}  // namespace noli::integrator
