// SPDX-License-Identifier: Apache-2.0
//
// Tests that time advances: the number of contact events at one instant is bounded (theory.md, T5).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>

#include "contact_models.h"
#include "integrator/contact.h"

namespace noli::integrator {
namespace {

/// Repairs, plans and tubes.
std::uint64_t work_of(const CertificateCounts& c) { return c.repairs + c.plans + c.tubes; }

/// Counts events by time and keeps the most at one time.
class InstantSet {
 public:
  void add(double t, std::uint64_t events) {
    sum_ = t == time_ ? sum_ + events : events;
    EXPECT_GE(t, time_) << "time goes back";
    time_ = t;
    most_ = std::max(most_, sum_);
  }
  std::uint64_t most() const { return most_; }

 private:
  double time_ = 0;
  std::uint64_t sum_ = 0, most_ = 0;
};

/// Triangles without internal forces that fly at each other from all sides.
Model<double, 3> swarm(int count) {
  Model<double, 3> model;
  std::uint64_t draw = 0;
  const auto some = [&draw](double size) {
    const double a = test::noise(draw), b = test::noise(draw + 1), c = test::noise(draw + 2);
    draw += 3;
    return Vec<double, 3>(size * a, size * b, size * c);
  };
  for (int k = 0; k < count; ++k) {
    const Vec<double, 3> from = some(1).normalized() * (1 + 0.1 * k);
    const auto first = static_cast<VertexId>(model.x.size());
    for (int i = 0; i < 3; ++i) {
      model.x.emplace_back(from + some(0.3));
      model.v.emplace_back(-4 * from.normalized() + some(0.1));
      model.mass.push_back(1);
    }
    model.mesh.faces.push_back({first, first + 1, first + 2});
  }
  model.mesh.vertex_count = model.x.size();
  model.window_length = 0.05;
  return test::with_contact(std::move(model), {0.02, 1000, 0.05, 1, 0});
}

TEST(Progress, NoInstantHasMoreThanABoundedNumberOfEvents) {
  const Model<double, 3> model = swarm(40);
  std::vector<Particle<double, 3>> particles;
  for (std::size_t i = 0; i < model.x.size(); ++i) particles.push_back({model.x[i], 0, model.v[i], 1 / model.mass[i]});
  const std::vector<double> look_steps(particles.size(), std::numeric_limits<double>::infinity());
  Contact<3> contact(*model.contact, model.mesh, particles, look_steps, model.window_length);
  Activity activity;
  contact.show(activity);
  NoRecording nothing;
  Books<double, 3> books;
  books.make_room(model.contact->materials.size(), 0);
  ScriptBook<double, 3> scripts;
  Falling<double, 3> falling;
  contact.start(0);
  InstantSet failures, plans, fired;
  for (;;) {
    const double certificate = contact.next_certificate(), layer = contact.next_layer();
    const double t = std::min(certificate, layer);
    if (t > 1) break;
    const std::uint64_t before = work_of(contact.counts());
    if (certificate <= layer) {
      contact.run_certificate();
      failures.add(t, 1);
    } else {
      contact.fire_next(nothing, books, scripts, falling);
      fired.add(t, 1);
    }
    plans.add(t, work_of(contact.counts()) - before);
  }
  books.sum_contact();
  std::printf(
      "%d impulses, %d activations; in one instant at most %d failures, %d repairs, plans and tubes, %d layers\n",
      static_cast<int>(books.of(ForceKind::contact).events), static_cast<int>(contact.counts().activations),
      static_cast<int>(failures.most()), static_cast<int>(plans.most()), static_cast<int>(fired.most()));
  EXPECT_GT(books.of(ForceKind::contact).events, 10000U);
  // At the start of a slice, each vertex is planned and each near pair gets its slab.
  EXPECT_LE(plans.most(), 20 * particles.size());
  // Each vertex has one event, which happens once, and the next slice is one more.
  EXPECT_LE(failures.most(), particles.size() + 1);
  EXPECT_LE(fired.most(), contact.counts().deepest) << "each layer once";
}

}  // namespace
}  // namespace noli::integrator
