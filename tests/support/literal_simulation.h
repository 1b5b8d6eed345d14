// SPDX-License-Identifier: Apache-2.0
//
// Defines a simulation with the certificates of Algorithm 1 taken literally (every_pair.h). Every run must equal it,
// bit for bit.
#pragma once

#include <utility>

#include "integrator/engine.h"
#include "tests/support/every_pair.h"

namespace noli::test {

template <int Dim>
class LiteralSimulation {
 public:
  explicit LiteralSimulation(integrator::Model<double, Dim> model) : engine_(std::move(model)) {}

  template <class Recorder>
  void run_window(Recorder& recorder, integrator::Books<double, Dim>& books) {
    engine_.run_window(recorder, books, [] { return false; });
  }
  void run_window(integrator::Books<double, Dim>& books) {
    integrator::NoRecording nothing;
    run_window(nothing, books);
  }

  integrator::Snapshot<double, Dim> snapshot() const { return engine_.snapshot(); }
  const CertificateCounts& certificates() const { return engine_.contact()->counts(); }

 private:
  integrator::Engine<double, Dim, integrator::Contact<Dim, certificates::EveryPair>> engine_;
};

}  // namespace noli::test
