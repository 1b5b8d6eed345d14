// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/start_layers.h"

#include <algorithm>
#include <functional>
#include <map>
#include <span>
#include <utility>

#include "certificates/features.h"
#include "certificates/hierarchy.h"
#include "certificates/stencil.h"
#include "integrator/contact_blow.h"
#include "integrator/layer_fire.h"
#include "trajectory/stop.h"

namespace noli::integrator {
namespace {

template <int Dim>
class StartLayers {
 public:
  explicit StartLayers(const BuiltScene<Dim>& scene)
      : model_(scene.model),
        settings_(*scene.model.contact),
        features_(scene.model.mesh, Dim),
        held_(held_vertices(scene.model)),
        near_(settings_.materials.size()) {}

  std::vector<StartPush> find() {
    find_near();
    for (std::size_t m = 0; m < near_.size(); ++m) add_layers(static_cast<std::uint16_t>(m));
    std::vector<StartPush> all;
    for (const auto& [bodies, push] : pushes_) all.push_back(push);
    std::ranges::stable_sort(all, std::greater(), &StartPush::energy);
    return all;
  }

 private:
  using Box = certificates::MovingBox<Dim>;
  using Stencil = certificates::Stencil;

  /// A pair of features on which at least the first layer acts.
  struct Near {
    Stencil pair;
    double distance;
  };

  auto positions() const {
    return [this](VertexId v) { return model_.x[v]; };
  }

  /// In a pair of features, each cell has at least half of the thickness around it.
  std::vector<Box> boxes() const {
    const std::vector<double> greatest = greatest_thicknesses(settings_);
    std::vector<Box> all;
    for (const auto& cell : features_.cells()) {
      end_if_stopped();
      double widest = 0;
      for (const VertexId v : cell.all()) {
        widest = std::max(widest, greatest[settings_.groups[v] * settings_.class_count + settings_.class_of(v)]);
      }
      const Vec<double, Dim> room = Vec<double, Dim>::Constant(0.5 * widest);
      Box box = Box::empty();
      for (const VertexId v : cell.all()) {
        const Vec<double, Dim> low = model_.x[v] - room, high = model_.x[v] + room;
        box.add({{low, low}, {high, high}});
      }
      all.push_back(box);
    }
    return all;
  }

  void find_near() {
    std::vector<Vec<double, Dim>> centres;
    std::vector<bool> fixed;
    for (const auto& cell : features_.cells()) {
      centres.push_back(model_.x[cell.vertices[0]]);
      fixed.push_back(are_held(cell.all()));
    }
    certificates::Hierarchy<Dim> hierarchy(centres, fixed);
    const std::vector<Box> boxes_of_cells = boxes();
    hierarchy.refit([&](std::uint32_t cell) { return boxes_of_cells[cell]; });
    hierarchy.for_each_pair([&](std::uint32_t a, std::uint32_t b) {
      features_.for_each_pair(a, b, [&](const Stencil& pair) { look(pair); });
    });
  }

  bool are_held(std::span<const VertexId> vertices) const {
    return std::ranges::all_of(vertices, [this](VertexId v) { return held_[v] != 0; });
  }

  /// Stores a pair on which a layer acts.
  void look(const Stencil& pair) {
    const std::span<const VertexId> vertices(pair.vertices.data(), pair.size());
    if (are_held(vertices)) return;
    const std::uint16_t m = settings_.material(vertices.first(pair.first()), vertices.subspan(pair.first()));
    if (m == ContactSettings::excluded) return;
    const double distance = closest_of<double, Dim>(pair, positions()).distance();
    const double thickness = settings_.materials[m].thickness;
    if (!(distance < thickness)) return;
    near_[m].push_back({pair, distance});
    StartPush& push = push_of(pair);
    if (push.thickness > 0 && !(distance < push.gap)) return;
    push.gap = distance;
    push.thickness = thickness;
  }

  StartPush& push_of(const Stencil& pair) {
    const std::size_t a = settings_.groups[pair.vertices[0]], b = settings_.groups[pair.vertices[pair.first()]];
    const std::array<std::size_t, 2> bodies{std::min(a, b), std::max(a, b)};
    StartPush& push = pushes_[bodies];
    push.bodies = bodies;
    return push;
  }

  /// Adds the layers of a material that act.
  void add_layers(std::uint16_t m) {
    std::vector<Near>& near = near_[m];
    std::ranges::sort(near, {}, [](const Near& n) { return n.pair.key; });
    const LayerFire<double, Dim> layers(settings_.inclusion_exclusion);
    std::vector<Stencil> acting;
    for (std::uint32_t l = 1; l <= settings_.most_layers; ++l) {
      end_if_stopped();
      LayerTerms terms;
      terms.thickness = layer_thickness(settings_.materials[m], settings_.schedule, l);
      terms.stiffness = layer_stiffness(settings_.materials[m], settings_.schedule, l);
      std::erase_if(near, [&](const Near& n) { return !(n.distance < terms.thickness); });
      if (near.empty()) return;
      const bool counted = l == 1 || near.size() <= left_;
      left_ -= std::min(left_, near.size());
      acting.clear();
      for (const Near& n : near) {
        acting.push_back(n.pair);
        StartPush& push = push_of(n.pair);
        push.layer = std::max(push.layer, l);
        push.at_least |= !counted;
      }
      if (!counted) return;
      layers.for_each_acting(acting, terms, positions(),
                             [&](const Stencil& pair, const auto&, double g, double weight) {
                               push_of(pair).energy += 0.5 * weight * terms.stiffness * g * g;
                             });
    }
  }

  const Model<double, Dim>& model_;
  const ContactSettings& settings_;
  certificates::Features features_;
  std::vector<std::uint8_t> held_;
  std::vector<std::vector<Near>> near_;  ///< by material
  std::map<std::array<std::size_t, 2>, StartPush> pushes_;
  std::size_t left_ = 1'000'000;  ///< pairs that deeper layers may still count, once each: a fraction of a second
};

}  // namespace

template <int Dim>
std::vector<StartPush> find_start_pushes(const BuiltScene<Dim>& scene) {
  if (scene.model.contact->materials.empty()) return {};
  return StartLayers<Dim>(scene).find();
}

template std::vector<StartPush> find_start_pushes(const BuiltScene<2>&);
template std::vector<StartPush> find_start_pushes(const BuiltScene<3>&);

}  // namespace noli::integrator
