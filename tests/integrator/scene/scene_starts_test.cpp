// SPDX-License-Identifier: Apache-2.0
//
// Tests that shipped scenes with contact begin with all features farther apart than the first layer, except scenes
// whose bodies begin at rest on each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"
#include "integrator/scene/shapes/connectivity.h"
#include "kernel/thickness.h"

namespace noli::integrator {
namespace {

/// The corners of a vertex, an edge or a face, and their box.
template <int Dim>
struct Feature {
  std::vector<VertexId> ids;
  Point<Dim> low{}, high{};
};

template <int Dim>
class Start {
 public:
  explicit Start(const Model<double, Dim>& model) : model_(model) {
    for (const ContactMaterial& m : model.contact->materials) reach_ = std::max(reach_, m.thickness);
    for (VertexId i = 0; i < model.mesh.vertex_count; ++i) add(vertices_, {i});
    for (const auto& edge : model.mesh.edges) add(edges_, {edge[0], edge[1]});
    for (const FaceEdge& edge : face_edges(model.mesh)) add(edges_, {edge.ends[0], edge.ends[1]});
    for (const auto& face : model.mesh.faces) add(faces_, {face[0], face[1], face[2]});
  }

  /// The number of pairs that share no vertex, are not excluded, and are within their first layer.
  std::size_t near_pairs() const {
    if constexpr (Dim == 2) {
      return count<FeaturePair::vertex_edge>(vertices_, edges_);
    } else {
      return count<FeaturePair::vertex_face>(vertices_, faces_) + count<FeaturePair::edge_edge>(edges_, edges_) / 2;
    }
  }

 private:
  using Features = std::vector<Feature<Dim>>;

  void add(Features& list, std::vector<VertexId> ids) {
    Feature<Dim> f{std::move(ids), {}, {}};
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      const auto at = [&](VertexId i) { return model_.x[i][static_cast<int>(axis)]; };
      const auto [low, high] =
          std::minmax_element(f.ids.begin(), f.ids.end(), [&](auto i, auto j) { return at(i) < at(j); });
      f.low[axis] = at(*low);
      f.high[axis] = at(*high);
    }
    list.push_back(std::move(f));
  }

  bool boxes_near(const Feature<Dim>& a, const Feature<Dim>& b) const {
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      if (a.low[axis] > b.high[axis] + reach_ || b.low[axis] > a.high[axis] + reach_) return false;
    }
    return true;
  }

  template <FeaturePair Pair>
  bool near(const Feature<Dim>& a, const Feature<Dim>& b) const {
    const std::uint16_t material = model_.contact->material(a.ids, b.ids);
    if (material == ContactSettings::excluded) return false;
    for (const VertexId i : a.ids) {
      if (std::find(b.ids.begin(), b.ids.end(), i) != b.ids.end()) return false;
    }
    Query<Pair, Dim> query;
    std::size_t k = 0;
    for (const auto* ids : {&a.ids, &b.ids}) {
      for (const VertexId i : *ids) {
        for (int axis = 0; axis < Dim; ++axis) query.x_t0[k][static_cast<std::size_t>(axis)] = model_.x[i][axis];
        ++k;
      }
    }
    query.x_t1 = query.x_t0;
    return within_distance(query, model_.contact->materials[material].thickness);
  }

  /// Sweeps along x over both lists.
  template <FeaturePair Pair>
  std::size_t count(const Features& as, Features bs) const {
    std::sort(bs.begin(), bs.end(), [](const auto& a, const auto& b) { return a.low[0] < b.low[0]; });
    double widest = 0;
    for (const auto& b : bs) widest = std::max(widest, b.high[0] - b.low[0]);
    std::size_t found = 0;
    for (const auto& a : as) {
      const double from = a.low[0] - reach_ - widest;
      auto b = std::lower_bound(bs.begin(), bs.end(), from, [](const auto& f, double x) { return f.low[0] < x; });
      for (; b != bs.end() && b->low[0] <= a.high[0] + reach_; ++b) {
        if (boxes_near(a, *b) && near<Pair>(a, *b)) ++found;
      }
    }
    return found;
  }

  const Model<double, Dim>& model_;
  double reach_ = 0;
  Features vertices_, edges_, faces_;
};

std::size_t near_pairs(const Scene& scene) {
  if (scene.dimension == 2) return Start<2>(build_model<2>(scene).model).near_pairs();
  return Start<3>(build_model<3>(scene).model).near_pairs();
}

class SceneStarts : public ::testing::TestWithParam<const char*> {};

void expect_apart(const std::string& name, Form form) {
  const Scene scene = read_scene(std::filesystem::path(NOLI_SOURCE_DIR) / "scenes" / (name + ".json"), form);
  ASSERT_TRUE(scene.contact);
  const std::size_t near = near_pairs(scene);
  EXPECT_EQ(near > 0, name == "stack" || name == "incline") << near;
}

TEST_P(SceneStarts, AreApartUnlessThingsLieOnEachOther) { expect_apart(GetParam(), Form::brief); }

TEST_P(SceneStarts, SlowAreApartInFullToo) { expect_apart(GetParam(), Form::full); }

INSTANTIATE_TEST_SUITE_P(Shipped, SceneStarts,
                         ::testing::Values("billiard", "bounce", "bowline", "compactor", "curtains", "drape_mesh",
                                           "drape_sphere", "incline", "nails", "plane_compactor",
                                           "plane_compactor_elastic", "plane_curtain", "plane_nails", "reef_knot",
                                           "restitution", "ring_in_box", "sphere_plate", "stack", "through_ring",
                                           "trefoil"));

}  // namespace
}  // namespace noli::integrator
