// SPDX-License-Identifier: Apache-2.0
#include <noli/explain.h>

#include <fmt/format.h>

#include "certify/simulate/start_check.h"
#include "integrator/scene/explain.h"
#include "integrator/scene/read_scene.h"
#include "trajectory/stop.h"

namespace noli {

ScenePrediction prediction_of_scene(const std::filesystem::path& scene, bool brief, const std::atomic<bool>* stop) {
  const StopOfThread hears(stop);
  const auto form = brief ? integrator::Form::brief : integrator::Form::full;
  const integrator::Scene read = integrator::read_scene(scene, form);
  const integrator::Explanation explanation = integrator::explain(read);
  ScenePrediction prediction;
  prediction.title = explanation.title;
  prediction.dimension = explanation.dimension;
  prediction.active = explanation.active;
  prediction.warnings = integrator::notes(explanation);
  prediction.hints = explanation.hints;
  prediction.contact_at_start = contact_at_start(read, stop_of_thread(), {});
  prediction.windows = explanation.windows;
  prediction.events_per_second = explanation.events;
  prediction.breakpoints_per_second = explanation.breakpoints;
  prediction.bytes = explanation.bytes_in_all;
  for (const integrator::BuiltBody& b : explanation.bodies) {
    prediction.bodies.push_back({b.name, b.vertices, b.faces, b.edges, b.mass, b.pinned, b.scripted});
  }
  for (const integrator::PredictedGroup& g : explanation.groups) {
    prediction.forces.push_back({g.kind, g.forces, g.shortest, g.longest, g.events});
  }
  for (const integrator::PredictedContact& c : explanation.contact) {
    const integrator::ContactMaterial& m = c.material;
    prediction.contact.push_back({c.pairs, m.thickness, c.bound, m.stiffness, m.step, m.restitution, m.friction});
  }
  for (const integrator::LeftOut& l : explanation.left_out) prediction.left_out.push_back(l.what + ": " + l.why);
  for (const integrator::DefaultTaken& d : explanation.defaults) {
    prediction.defaults.push_back(fmt::format("{} = {}", d.path, d.value.dump()));
  }
  return prediction;
}

}  // namespace noli
