// SPDX-License-Identifier: Apache-2.0
//
// Tests that a run is the same, bit for bit, for every implementation of certificates and any number of layers that are
// always active.
#include <gtest/gtest.h>

#include <cstdio>

#include "contact_small_scenes.h"
#include "running.h"
#include "tests/support/literal_simulation.h"

namespace noli::integrator {
namespace {

using noli::test::LiteralSimulation;
using test::expect_same;
using test::run;
using test::run_of;
using test::SmallScene;

template <int Dim>
void compare_with_the_literal_algorithm(const SmallScene<Dim>& scene) {
  Model<double, Dim> literal = scene.make();
  Simulation<double, Dim> cells(literal);
  LiteralSimulation<Dim> every_pair(literal);
  std::uint64_t impulses = 0;
  for (std::uint64_t w = 0; w < scene.windows; ++w) {
    const Books<double, Dim> of_cells = run(cells, 1), of_every_pair = run_of<Dim>(every_pair, 1);
    ASSERT_NO_FATAL_FAILURE(expect_same(cells.snapshot(), every_pair.snapshot())) << w;
    ASSERT_EQ(of_cells.of(ForceKind::contact).events, of_every_pair.of(ForceKind::contact).events) << w;
    ASSERT_EQ(of_cells.work(), of_every_pair.work()) << w;
    impulses += of_cells.of(ForceKind::contact).events;
  }
  std::printf("%s: %d vertices, %.0f impulses, layers to %u; slabs put up %.0f and %.0f times\n", scene.name,
              static_cast<int>(literal.x.size()), static_cast<double>(impulses), cells.certificates().deepest,
              static_cast<double>(cells.certificates().repairs),
              static_cast<double>(every_pair.certificates().repairs));
  EXPECT_GE(impulses, 50U);
  EXPECT_GE(cells.certificates().deepest, 2U);
}

template <int Dim>
void compare_with_layers_that_always_are(const SmallScene<Dim>& scene) {
  Model<double, Dim> eager = scene.make();
  Simulation<double, Dim> lazy(eager);
  const std::uint64_t windows = scene.with_all_layers;
  const Books<double, Dim> of_lazy = run(lazy, windows);
  eager.contact->least_layers = lazy.certificates().deepest;
  LiteralSimulation<Dim> always(eager);
  const Books<double, Dim> of_always = run_of<Dim>(always, windows);
  EXPECT_EQ(always.certificates().deepest, lazy.certificates().deepest);
  expect_same(lazy.snapshot(), always.snapshot());
  EXPECT_EQ(of_lazy.of(ForceKind::contact).events, of_always.of(ForceKind::contact).events);
  EXPECT_GE(of_lazy.of(ForceKind::contact).events, 20U);
  EXPECT_GE(lazy.certificates().deepest, 1U);
}

class SmallScenes2 : public testing::TestWithParam<SmallScene<2>> {};
class SmallScenes3 : public testing::TestWithParam<SmallScene<3>> {};

const auto name_of = [](const auto& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(Contact, SmallScenes2, testing::ValuesIn(test::small_scenes_2d), name_of);
INSTANTIATE_TEST_SUITE_P(Contact, SmallScenes3, testing::ValuesIn(test::small_scenes_3d), name_of);

TEST_P(SmallScenes2, CellsEqualTheLiteralAlgorithm) { compare_with_the_literal_algorithm(GetParam()); }
TEST_P(SmallScenes3, CellsEqualTheLiteralAlgorithm) { compare_with_the_literal_algorithm(GetParam()); }
TEST_P(SmallScenes2, LayersActivatedInTimeEqualLayersThatAlwaysAre) { compare_with_layers_that_always_are(GetParam()); }
TEST_P(SmallScenes3, LayersActivatedInTimeEqualLayersThatAlwaysAre) { compare_with_layers_that_always_are(GetParam()); }

/// Shows that the comparison can fail: with other layers than the first, the run differs.
TEST(SmallScenes, WithoutItsDeepestLayersARunIsAnother) {
  Model<double, 2> model = test::chains_that_meet();
  Simulation<double, 2> whole(model);
  run(whole, 12);
  ASSERT_GE(whole.certificates().deepest, 2U);
  model.contact->schedule.stiffness_quarters = 13;  // the first layer is the same, others are not
  Simulation<double, 2> other(model);
  run(other, 12);
  const auto a = whole.snapshot(), b = other.snapshot();
  bool same = true;
  for (std::size_t i = 0; i < a.x.size(); ++i) same = same && a.x[i] == b.x[i];
  EXPECT_FALSE(same);
}

}  // namespace
}  // namespace noli::integrator
