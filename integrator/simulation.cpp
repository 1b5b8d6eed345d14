// SPDX-License-Identifier: Apache-2.0
#include "integrator/simulation.h"

#include <algorithm>

#include "integrator/energy.h"
#include "integrator/engine.h"

namespace noli::integrator {

template <class S, int Dim>
Simulation<S, Dim>::Simulation(Model<S, Dim> model) : engine_(std::make_unique<Engine<S, Dim>>(std::move(model))) {}

template <class S, int Dim>
Simulation<S, Dim>::Simulation(Model<S, Dim> model, const Snapshot<S, Dim>& snapshot) : Simulation(std::move(model)) {
  engine_->resume(snapshot);
}

template <class S, int Dim>
Simulation<S, Dim>::~Simulation() = default;
template <class S, int Dim>
Simulation<S, Dim>::Simulation(Simulation&&) noexcept = default;
template <class S, int Dim>
Simulation<S, Dim>& Simulation<S, Dim>::operator=(Simulation&&) noexcept = default;

template <class S, int Dim>
double Simulation<S, Dim>::time() const {
  return engine_->time();
}

template <class S, int Dim>
std::uint64_t Simulation<S, Dim>::windows() const {
  return engine_->windows();
}

template <class S, int Dim>
bool Simulation<S, Dim>::run_window(Recording<S, Dim>& recording, Books<S, Dim>& books, const Stop& stop) {
  return engine_->run_window(recording, books, stop);
}

template <class S, int Dim>
void Simulation<S, Dim>::run_window(Books<S, Dim>& books) {
  NoRecording nothing;
  engine_->run_window(nothing, books, never_stop);
}

template <class S, int Dim>
Snapshot<S, Dim> Simulation<S, Dim>::snapshot() const {
  return engine_->snapshot();
}

template <class S, int Dim>
State<S, Dim> Simulation<S, Dim>::state() const {
  return Ledger<S, Dim>(*engine_).state();
}

template <class S, int Dim>
S Simulation<S, Dim>::contact_at_start() const {
  return engine_->contact_at_start();
}

template <class S, int Dim>
std::vector<Vec<S, Dim>> Simulation<S, Dim>::mean_velocities() const {
  return Ledger<S, Dim>(*engine_).mean_velocities();
}

template <class S, int Dim>
std::uint64_t Simulation<S, Dim>::events() const {
  return engine_->events();
}

template <class S, int Dim>
CertificateCounts Simulation<S, Dim>::certificates() const {
  return engine_->contact() != nullptr ? engine_->contact()->counts() : CertificateCounts{};
}

template <class S, int Dim>
ContactExtremes Simulation<S, Dim>::extremes() const {
  return engine_->contact() != nullptr ? engine_->contact()->extremes() : ContactExtremes{};
}

template <class S, int Dim>
void Simulation<S, Dim>::show(Activity& activity) {
  engine_->show(activity);
}

template <class S, int Dim>
bool Simulation<S, Dim>::finite() const {
  return std::ranges::all_of(engine_->particles(), &Particle<S, Dim>::finite);
}

template <class S, int Dim>
std::optional<NotFinite> Simulation<S, Dim>::find_not_finite(const Stop& stop) {
  detail::Watch watch;
  Books<S, Dim> books;
  try {
    if (!engine_->run_window(watch, books, stop)) return std::nullopt;
  } catch (const NotFinite& found) {
    return found;
  }
  // No force caused it: a particle has left the range of doubles while nothing acted on it.
  for (std::size_t i = 0; i < engine_->particles().size(); ++i) {
    if (!engine_->particles()[i].finite()) {
      return NotFinite{engine_->time(), std::nullopt, {}, static_cast<VertexId>(i)};
    }
  }
  throw std::logic_error("find_not_finite: all numbers of the window are finite");
}

template class Simulation<double, 2>;
template class Simulation<double, 3>;

}  // namespace noli::integrator
