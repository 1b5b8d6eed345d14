// SPDX-License-Identifier: Apache-2.0
#include "certify/repair/step_contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <noli/errors.h>
#include "integrator/scene/scene.h"
#include "integrator/scene/shapes/curve.h"

namespace noli {
namespace {

using integrator::to_vec;
using integrator::Vec3;

constexpr std::size_t most_classes = 16, most_groups = 128;
constexpr double infinite = std::numeric_limits<double>::infinity();

double length_of(std::span<const Position> x, VertexId a, VertexId b) { return (to_vec(x[b]) - to_vec(x[a])).norm(); }

/// Twice the area.
double parallelogram(std::span<const Position> x, const std::array<VertexId, 3>& face) {
  const Vec3 a = to_vec(x[face[1]]) - to_vec(x[face[0]]);
  const Vec3 b = to_vec(x[face[2]]) - to_vec(x[face[0]]);
  return a.cross(b).norm();
}

double least_height(std::span<const Position> x, const std::array<VertexId, 3>& face) {
  const double longest =
      std::max({length_of(x, face[0], face[1]), length_of(x, face[1], face[2]), length_of(x, face[2], face[0])});
  return longest > 0 ? parallelogram(x, face) / longest : 0;
}

/// The least height of each vertex's cells; infinite for a vertex without any.
std::vector<double> heights_of(const Mesh& mesh, std::span<const Position> x) {
  std::vector<double> heights(mesh.vertex_count, infinite);
  const auto lower = [&](VertexId v, double height) { heights[v] = std::min(heights[v], height); };
  for (const auto& face : mesh.faces) {
    const double height = least_height(x, face);
    for (const VertexId v : face) lower(v, height);
  }
  for (const auto& [a, b] : mesh.edges) {
    const double length = length_of(x, a, b);
    lower(a, length);
    lower(b, length);
  }
  return heights;
}

/// The diagonal of the box around all vertices; 1 where they are all at one place.
double size_of(std::span<const Position> x) {
  if (x.empty()) return 1;
  Vec3 low = to_vec(x[0]), high = low;
  for (const Position& p : x) {
    low = low.cwiseMin(to_vec(p));
    high = high.cwiseMax(to_vec(p));
  }
  const double size = (high - low).norm();
  return size > 0 ? size : 1;
}

double root_mean_square(std::span<const double> numbers) {
  double sum = 0;
  for (const double number : numbers) sum += number * number;
  return numbers.empty() ? 0 : std::sqrt(sum / static_cast<double>(numbers.size()));
}

}  // namespace

std::vector<double> masses_by_size(const Mesh& mesh, std::span<const Position> x) {
  std::vector<double> mass(mesh.vertex_count, 0);
  // Areas and lengths do not add up: each has a mean of its own.
  const auto add_shares = [&](const auto& cells, const auto& size) {
    std::vector<double> part(mesh.vertex_count, 0);
    double sum = 0;
    std::size_t count = 0;
    for (const auto& cell : cells) {
      for (const VertexId v : cell) part[v] += size(cell) / static_cast<double>(cell.size());
    }
    for (const double p : part) {
      sum += p;
      count += p > 0 ? 1 : 0;
    }
    if (!(sum > 0)) return;
    for (std::size_t v = 0; v < part.size(); ++v) mass[v] += part[v] * static_cast<double>(count) / sum;
  };
  add_shares(mesh.faces, [&](const auto& face) { return parallelogram(x, face) / 2; });
  add_shares(mesh.edges, [&](const auto& edge) { return length_of(x, edge[0], edge[1]); });
  for (double& m : mass) m = m > 0 ? std::max(m, 0x1p-6) : 1;
  return mass;
}

double mean_edge(const Mesh& mesh, std::span<const Position> x) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.faces) sum += length_of(x, a, b) + length_of(x, b, c) + length_of(x, c, a);
  for (const auto& [a, b] : mesh.edges) sum += length_of(x, a, b);
  const std::size_t count = 3 * mesh.faces.size() + mesh.edges.size();
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

StepContact::StepContact(const Mesh& mesh, std::span<const Position> x, std::span<const double> mass,
                         std::span<const std::uint8_t> fixed, const Exclusions* exclusions, const Wanted& wanted)
    : wanted_(wanted), mass_(mass), fixed_(fixed), exclusions_(exclusions), bounds_(heights_of(mesh, x)) {
  double highest = 0;
  for (const double height : bounds_) {
    if (std::isfinite(height)) highest = std::max(highest, height);
  }
  if (!(highest > 0)) highest = size_of(x) / 64;  // points alone
  // A cell without height would leave no room for any layer.
  const double lowest = highest * 0x1p-20;
  for (double& bound : bounds_) {
    const double height = std::clamp(bound, lowest, highest);
    bound = wanted.thickness ? std::min(*wanted.thickness, height / 2) : height / 4;
  }
  double lightest = infinite;
  for (std::size_t v = 0; v < mass.size(); ++v) {
    if (fixed[v] == 0) lightest = std::min(lightest, mass[v]);
  }
  if (std::isfinite(lightest)) least_mass_ = lightest;
  if (exclusions != nullptr && !exclusions->empty()) number_groups();
}

/// Groups that no pair names are one group, as the table of pairs grows with the square of their number.
void StepContact::number_groups() {
  for (const auto& pair : exclusions_->pairs) named_groups_.insert(named_groups_.end(), pair.begin(), pair.end());
  std::sort(named_groups_.begin(), named_groups_.end());
  named_groups_.erase(std::unique(named_groups_.begin(), named_groups_.end()), named_groups_.end());
  if (named_groups_.size() > most_groups) {
    throw UsageError(fmt::format("--ignore: expected at most {} groups, found {}", most_groups, named_groups_.size()));
  }
  for (const std::uint16_t group : exclusions_->groups) {
    const auto found = std::lower_bound(named_groups_.begin(), named_groups_.end(), group);
    const bool named = found != named_groups_.end() && *found == group;
    groups_.push_back(named ? static_cast<std::uint16_t>(found - named_groups_.begin() + 1) : std::uint16_t{0});
  }
}

double StepContact::greatest_bound() const {
  return bounds_.empty() ? 0 : *std::max_element(bounds_.begin(), bounds_.end());
}

integrator::ContactMaterial StepContact::material(double thickness, double greatest_mass, double speed) const {
  integrator::ContactMaterial m;
  m.thickness = thickness;
  const double rate = std::max(speed / thickness, 1.0);
  m.stiffness = std::max(greatest_mass, least_mass_) * rate * rate;
  m.step = std::min(1.0, integrator::default_stability * std::sqrt(least_mass_ / (2 * m.stiffness)));
  m.restitution = wanted_.restitution;
  m.friction = wanted_.friction;
  return m;
}

StepContact::Settings StepContact::settings(std::span<const double> sizes, std::span<const double> speeds) const {
  Settings result;
  integrator::ContactSettings& contact = result.contact;
  const double greatest = sizes.empty() ? 1 : *std::max_element(sizes.begin(), sizes.end());
  std::vector<double> thickness, heaviest, fastest;
  for (std::size_t v = 0; v < sizes.size(); ++v) {
    std::uint8_t c = 0;
    while (c + 1U < most_classes && sizes[v] < std::ldexp(greatest, -3 * (c + 1))) ++c;
    contact.classes.push_back(c);
    thickness.resize(std::max<std::size_t>(thickness.size(), c + 1U), infinite);
    heaviest.resize(thickness.size(), 0);
    fastest.resize(thickness.size(), 0);
    fastest[c] = std::max(fastest[c], speeds[v]);
    thickness[c] = std::min(thickness[c], sizes[v]);
    if (fixed_[v] == 0) heaviest[c] = std::max(heaviest[c], mass_[v]);
  }
  contact.class_count = static_cast<std::uint16_t>(thickness.size());
  if (!fastest.empty()) fastest[0] = std::min(fastest[0], root_mean_square(speeds));
  for (std::size_t c = 0; c < thickness.size(); ++c) {
    if (c > 0) thickness[c] = std::min(thickness[c], thickness[c - 1]);  // also of a class without vertices
    if (c > 0 && heaviest[c] == 0) heaviest[c] = heaviest[c - 1];
    contact.materials.push_back(material(thickness[c], heaviest[c], fastest[c]));
    result.least_step = std::min(result.least_step, contact.materials.back().step);
  }
  contact.groups = groups_.empty() ? std::vector<std::uint16_t>(sizes.size(), 0) : groups_;
  contact.group_count = static_cast<std::uint16_t>(named_groups_.size() + 1);
  const std::size_t groups = contact.group_count, classes = contact.class_count;
  contact.material_of.resize(groups * groups * classes * classes);
  for (std::size_t g = 0; g < groups; ++g) {
    for (std::size_t h = 0; h < groups; ++h) {
      const bool excluded = g > 0 && h > 0 && exclusions_->excluded(named_groups_[g - 1], named_groups_[h - 1]);
      for (std::size_t a = 0; a < classes; ++a) {
        for (std::size_t b = 0; b < classes; ++b) {
          contact.material_of[contact.place(g, h, a, b)] =
              excluded ? integrator::ContactSettings::excluded : static_cast<std::uint16_t>(std::max(a, b));
        }
      }
    }
  }
  return result;
}

}  // namespace noli
