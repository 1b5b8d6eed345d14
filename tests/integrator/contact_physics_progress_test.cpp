// SPDX-License-Identifier: Apache-2.0
//
// Bounds the cost of certificates per activated layer (theory.md, T5).
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include "contact_models.h"
#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"
#include "running.h"

namespace noli::integrator {
namespace {

/// Repairs, plans and tubes per activation. In these scenes there are 73 to 209, whatever the number of vertices.
constexpr double most_per_activation = 600;

struct Contacts {
  const char* scene;
  int windows;
};

void PrintTo(const Contacts& contacts, std::ostream* out) { *out << contacts.scene; }

class ProgressOf : public testing::TestWithParam<Contacts> {};

INSTANTIATE_TEST_SUITE_P(Scenes, ProgressOf,
                         testing::Values(Contacts{"ring_in_box", 100}, Contacts{"plane_curtain", 30},
                                         Contacts{"plane_compactor", 30}, Contacts{"plane_nails", 30},
                                         Contacts{"billiard", 30}));

TEST_P(ProgressOf, CertificatesPerActivationAreBounded) {
  const auto path = std::filesystem::path(NOLI_SOURCE_DIR) / "scenes" / (std::string(GetParam().scene) + ".json");
  Simulation<double, 2> simulation(build_model<2>(read_scene(path, Form::brief)).model);
  const auto books = test::run(simulation, static_cast<std::uint64_t>(GetParam().windows));
  const CertificateCounts c = simulation.certificates();
  const auto per_activation = [&](std::uint64_t count) {
    return static_cast<double>(count) / static_cast<double>(c.activations);
  };
  std::printf("%s: %.1f repairs, %.1f plans, %.1f tubes, %.1f events for each of %d activations; %d impulses\n",
              GetParam().scene, per_activation(c.repairs), per_activation(c.plans), per_activation(c.tubes),
              per_activation(c.events), static_cast<int>(c.activations),
              static_cast<int>(books.of(ForceKind::contact).events));
  ASSERT_GT(c.activations, 20U);
  EXPECT_LT(per_activation(c.repairs + c.plans + c.tubes), most_per_activation);
  EXPECT_LT(per_activation(c.events), most_per_activation);
}

}  // namespace
}  // namespace noli::integrator
