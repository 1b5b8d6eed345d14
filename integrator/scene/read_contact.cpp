// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/read_contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "integrator/scene/read_body.h"

namespace noli::integrator {
namespace {

void require_one_of(const Field& f, std::string_view a, std::string_view b) {
  if (f.has(a) && f.has(b)) f.fail(fmt::format("expected at most one of the fields \"{}\", \"{}\"", a, b));
}

std::optional<double> read_restitution(const Field& f) {
  require_one_of(f, "restitution", "newton_restitution");
  const std::optional<double> newton = f.number_if("newton_restitution");
  return newton ? *newton * *newton : f.number_if("restitution");
}

std::optional<double> read_stability(const Field& f, bool allow_unstable) {
  require_one_of(f, "step", "stability");
  const std::optional<double> stability = f.number_if("stability");
  if (stability > greatest_stability && !allow_unstable) {
    f["stability"].fail(
        fmt::format("expected at most {}, above which a bounce gains energy without end, or "
                    "\"allow_unstable\": true, found {}",
                    greatest_stability, *stability));
  }
  return stability;
}

ContactValues read_values(const Field& f, bool allow_unstable) {
  return {f.number_if("thickness"),          f.number_if("stiffness"), read_step(f, "step"),
          read_stability(f, allow_unstable), read_restitution(f),      f.number_if("friction")};
}

int read_quarters(const Field& f) {
  const double quarters = 4 * f.number();
  if (quarters != std::trunc(quarters)) f.fail(fmt::format("expected a multiple of 1/4, found {}", f.number()));
  return static_cast<int>(quarters);
}

LayerSchedule read_layers(const Field& f) {
  const LayerSchedule s{read_quarters(f["thickness_exponent"]), read_quarters(f["stiffness_exponent"]),
                        read_quarters(f["step_exponent"])};
  if (!s.diverges()) {
    const int least = 2 * s.thickness_quarters - 4;
    f["stiffness_exponent"].fail(
        fmt::format("expected at least {}, twice the thickness_exponent less 1, found {}: the layers' energies, "
                    "stiffness * thickness^2, have a finite sum, so that a great speed gets through",
                    least / 4.0, s.stiffness_quarters / 4.0));
  }
  if (!s.outruns()) {
    f["step_exponent"].fail(
        fmt::format("expected more than {}, the thickness_exponent, found {}: deep layers could be passed between two "
                    "of their kicks",
                    s.thickness_quarters / 4.0, s.step_quarters / 4.0));
  }
  return s;
}

BodyPair read_pair(const Field& f, const std::vector<Body>& bodies) {
  const std::size_t a = find_body(f[0], bodies), b = find_body(f[1], bodies);
  return {std::min(a, b), std::max(a, b)};
}

bool excludes(const SceneContact& contact, const BodyPair& pair) {
  return std::find(contact.excluded.begin(), contact.excluded.end(), pair) != contact.excluded.end();
}

ContactPair read_contact_pair(const Field& f, const Scene& scene, const SceneContact& contact) {
  const Field bodies = f["bodies"];
  const ContactPair pair{read_pair(bodies, scene.bodies), read_values(f, scene.allow_unstable)};
  if (excludes(contact, pair.bodies)) bodies.fail("expected bodies that \"exclude\" does not name");
  for (const ContactPair& other : contact.pairs) {
    if (other.bodies == pair.bodies)
      bodies.fail("expected bodies that no other pair has, found " + brief(bodies.json()));
  }
  return pair;
}

}  // namespace

SceneContact read_contact(const Field& f, const Scene& scene) {
  SceneContact contact{
      read_values(f, scene.allow_unstable), read_layers(f["layers"]), f["most_layers"].count(), {}, {}};
  for (const Field& pair : f["exclude"].items()) contact.excluded.push_back(read_pair(pair, scene.bodies));
  for (const Field& pair : f["pairs"].items()) contact.pairs.push_back(read_contact_pair(pair, scene, contact));
  return contact;
}

}  // namespace noli::integrator
