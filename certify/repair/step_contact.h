// SPDX-License-Identifier: Apache-2.0
//
// Chooses the layers of contact for frames that are repaired: masses, thickness, stiffness, steps.
//
// Notation
//   bound    of a vertex: what is aimed at, at most half of the least height of its cells in the first frame; a quarter
//            of it where nothing is aimed at. So cells do not push their neighbours
//   size     of a vertex at one moment: the lesser of its bound and its gap (near_gaps.h). So nothing begins within a
//            layer, however near it is
//   class    of a vertex: sizes that differ by less than a factor of 8, the greatest first
//   eta_c    the least size among the classes up to c. The first layer of two features has that of the greater class of
//            their vertices
//   v        of a class: the greatest speed of its vertices, seen from the mean velocity; of the first class, in which
//            few are near anything, the root mean square. At least eta per step
//   m, M     least mass of free vertices; greatest of the class
//   r(1)     M (v / eta)^2: a vertex of speed v is stopped within a thickness. Faster ones go deeper, where layers are
//            stiffer
//   h(1)     c sqrt(m / (2 r(1))) with the stability c of scenes
//
// As in scenes (integrator/scene/build_contact.h), but without materials and bodies, and for one moment.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <noli/mesh.h>
#include "integrator/contact_settings.h"

namespace noli {

/// A third of the area around each vertex, half of the length of its loose edges: relative to their mean, at least
/// 1/64. Vertices without either have 1.
std::vector<double> masses_by_size(const Mesh& mesh, std::span<const Position> x);

/// The mean length of all edges of cells; 0 without edges.
double mean_edge(const Mesh& mesh, std::span<const Position> x);

class StepContact {
 public:
  struct Wanted {
    std::optional<double> thickness;
    double restitution = 0.1, friction = 0;
  };

  /// x: the first frame. `mass`, `fixed`: by vertex. `exclusions`: nothing, or pairs of groups that may pass through
  /// each other. The arguments but x have to outlive this. Throws UsageError for more than 128 groups.
  StepContact(const Mesh& mesh, std::span<const Position> x, std::span<const double> mass,
              std::span<const std::uint8_t> fixed, const Exclusions* exclusions, const Wanted& wanted);

  /// By vertex.
  const std::vector<double>& bounds() const { return bounds_; }
  double greatest_bound() const;

  struct Settings {
    integrator::ContactSettings contact;
    double least_step = 1;  ///< the least h(1)
  };
  /// At a moment with these sizes and speeds, by vertex.
  Settings settings(std::span<const double> sizes, std::span<const double> speeds) const;

 private:
  void number_groups();
  integrator::ContactMaterial material(double thickness, double greatest_mass, double speed) const;

  Wanted wanted_;
  std::span<const double> mass_;
  std::span<const std::uint8_t> fixed_;
  const Exclusions* exclusions_;
  std::vector<double> bounds_;
  double least_mass_ = 1;
  std::vector<std::uint16_t> named_groups_;  ///< those of excluded pairs, ascending
  std::vector<std::uint16_t> groups_;        ///< by vertex: 1 + its place among them, or 0; empty without exclusions
};

}  // namespace noli
