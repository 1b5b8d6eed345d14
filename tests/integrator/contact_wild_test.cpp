// SPDX-License-Identifier: Apache-2.0
//
// Random small scenes over wild parameters: whatever happens, nothing is recorded that touches, unless the steps of
// contact are at fault; certificates never are.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include "contact_models.h"
#include "noli/integrator/contact_limit.h"
#include "noli/proofs/prover/window_verifier.h"

namespace noli::integrator {
namespace {

/// A stream of numbers that depends on the seed alone.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : state_(seed * 1000003) {}
  double unit() { return 0.5 + 0.5 * test::noise(state_++); }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// Log-uniform.
  double decades(double low, double high) { return low * std::pow(high / low, unit()); }
  int whole(int low, int high) { return low + static_cast<int>((high - low + 1) * unit() * (1 - 1e-12)); }

 private:
  std::uint64_t state_;
};

struct Wild {
  Model<double, 3> model;
  double c = 0;
};

/// Sheets and spikes that fly into each other.
Wild wild_scene(std::uint64_t seed) {
  Numbers random(seed);
  test::SheetOptions o;
  o.cells = random.whole(2, 4);
  o.speed = random.decades(1e-3, 1);
  o.membrane = random.unit() < 0.5;
  Model<double, 3> model = test::sheet(o);
  const int sheets = random.whole(1, 3);
  const double speed = random.decades(0.1, 1000), gap = random.decades(0.03, 0.3);
  for (int k = 1; k <= sheets; ++k) {
    test::SheetOptions other = o;
    other.cells = random.whole(1, 4);
    Model<double, 3> next = test::sheet(other);
    const double spike = random.unit() < 0.3 ? random.between(0.05, 0.3) : 1;  // narrow: sharp tips
    const double tilt = random.between(-0.2, 0.2);
    for (std::size_t i = 0; i < next.x.size(); ++i) {
      const Vec<double, 3> x = next.x[i];
      next.x[i] = {spike * x[0] + 0.1, x[1] + 0.05, k * gap + 0.45 * k + x[2] + tilt * (x[0] + x[1] - 1)};
      next.v[i][2] -= speed;
    }
    model = test::both(std::move(model), next);
  }
  test::choose_steps(model, 0.5);
  test::ContactOptions contact;
  contact.thickness = random.decades(2e-5, 2e-2);
  contact.stiffness = random.decades(1, 1e6);
  contact.c = random.decades(0.01, 0.5);
  contact.restitution = random.unit() < 0.5 ? 1 : random.unit();
  contact.friction = random.unit() < 0.5 ? 0 : random.unit();
  model = with_contact(std::move(model), contact);
  model.window_length = 0.2 / speed;
  test::choose_steps(model, 0.5);
  return {std::move(model), contact.c};
}

struct Ending {
  bool touched = false, limited = false, long_winded = false;
  int windows = 0;
  std::uint64_t acted = 0;
};

/// Up to so many windows, or the first that is not to be committed.
Ending run_verified(const Model<double, 3>& model, int windows) {
  WindowOptions options;
  options.threads = 1;
  const WindowVerifier verifier(model.mesh, test::positions(model), options);
  Simulation<double, 3> simulation(model);
  Recording<double, 3> recording;
  Ending ending;
  constexpr std::uint64_t most_events = 3'000'000;
  for (; ending.windows < windows; ++ending.windows) {
    recording.clear();
    Books<double, 3> books;
    try {
      if (!simulation.run_window(recording, books, [&] { return simulation.events() > most_events; })) {
        ending.long_winded = true;
        return ending;
      }
    } catch (const ContactLimit&) {
      ending.limited = true;
      return ending;
    }
    ending.acted += books.of(ForceKind::contact).events;
    if (!simulation.finite()) {
      ending.limited = true;
      return ending;
    }
    const WindowResult result = verifier.verify(world_lines<3>(recording, model.x.size()), options);
    if (result.contact_count() + result.initial_intersections > 0) {
      ending.touched = true;
      return ending;
    }
  }
  return ending;
}

void try_scenes(std::uint64_t first, std::uint64_t count) {
  constexpr int windows = 8;
  int calm = 0, calm_done = 0, acting = 0, touched = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    Wild wild = wild_scene(seed);
    const Ending ending = run_verified(wild.model, windows);
    acting += ending.acted >= 100 ? 1 : 0;
    if (wild.c <= 0.1) {
      ++calm;
      calm_done += ending.windows == windows || ending.long_winded ? 1 : 0;
    }
    if (ending.limited || ending.touched) {
      std::printf("seed %d c %.3g %s in window %d\n", static_cast<int>(seed), wild.c,
                  ending.touched ? "touched" : "limit", ending.windows);
    }
    if (!ending.touched) continue;
    ++touched;
    // Not for want of layers: with more of them from the start it is the same.
    wild.model.contact->least_layers = 40;
    const Ending again = run_verified(wild.model, windows);
    EXPECT_TRUE(again.touched) << "seed " << seed << ": certificates missed a layer";
    EXPECT_EQ(again.windows, ending.windows) << "seed " << seed;
  }
  std::printf("%d of %d scenes with at least 100 impulses, %d touched, %d of %d with c <= 0.1 to the end\n", acting,
              static_cast<int>(count), touched, calm_done, calm);
  EXPECT_GE(acting * 2, static_cast<int>(count));
  EXPECT_GE(calm_done * 100, calm * 95);
}

TEST(WildContact, NothingTouches) { try_scenes(0, 20); }
TEST(WildContact, SlowNothingTouchesInTwoHundredScenes) { try_scenes(1000, 200); }

}  // namespace
}  // namespace noli::integrator
