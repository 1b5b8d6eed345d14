// SPDX-License-Identifier: Apache-2.0
//
// Runs a small scene and verifies each window before it counts, as `noli simulate` does.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "contact_models.h"
#include "integrator/contact_extremes.h"
#include "proofs/prover/windows/window_verifier.h"

namespace noli::integrator::test {

struct Ending {
  int windows = 0;             ///< verified windows; nothing touches in them
  std::uint64_t impulses = 0;  ///< contact impulses in them and in the aborted one
  std::uint32_t deepest = 0;   ///< deepest layer
  double energy = 0;           ///< at time 0 [J]
  double friction_gave = 0;    ///< the most that friction's work rose above its least so far, at ends of windows [J]
  // Why the next window was not committed:
  bool touched = false;  ///< exact arithmetic found a contact
  bool not_finite = false;
  bool long_winded = false;           ///< more turns than allowed
  std::optional<ContactLimit> limit;  ///< a pair needed too many layers

  bool stopped() const { return touched || not_finite || long_winded || limit.has_value(); }
};

/// Runs up to `windows` windows, or until one may not be committed. `most_turns` limits the turns of the event loop,
/// including layers that fire for no pair; it is checked every 2^14 turns.
template <int Dim>
Ending run_verified(const Model<double, Dim>& model, int windows, std::uint64_t most_turns) {
  WindowOptions options;
  options.threads = 1;
  options.dimension = Dim;
  const WindowVerifier verifier(model.mesh, positions(model), options);
  Simulation<double, Dim> simulation(model);
  Recording<double, Dim> recording;
  Ending ending;
  std::uint64_t turns = 0;
  double friction = 0, least_friction = 0;
  ending.energy = simulation.state().energy();
  while (ending.windows < windows && !ending.stopped()) {
    recording.clear();
    Books<double, Dim> books;
    try {
      ending.long_winded = !simulation.run_window(recording, books, [&] { return (turns += 1 << 14) > most_turns; });
    } catch (const ContactLimit& limit) {
      ending.limit = limit;
    }
    ending.impulses += books.of(ForceKind::contact).events;
    friction += books.of(ForceKind::contact).damping_work;
    least_friction = std::min(least_friction, friction);
    ending.friction_gave = std::max(ending.friction_gave, friction - least_friction);
    ending.deepest = simulation.certificates().deepest;
    ending.not_finite = !simulation.finite();
    if (ending.stopped()) return ending;
    const WindowResult result = verifier.verify(world_lines<Dim>(recording, model.x.size()), options);
    ending.touched = !result.complete || result.contact_count() + result.initial_intersections > 0;
    if (ending.touched) return ending;
    ++ending.windows;
  }
  return ending;
}

}  // namespace noli::integrator::test
