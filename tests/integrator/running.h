// SPDX-License-Identifier: Apache-2.0
//
// Runs simulations and compares them bit for bit.
#pragma once

#include <gtest/gtest.h>

#include "integrator/simulation.h"

namespace noli::integrator::test {

/// The energy accounts of `windows` windows, added up.
template <int Dim, class Run>
Books<double, Dim> run_of(Run& simulation, std::uint64_t windows) {
  Books<double, Dim> books;
  for (std::uint64_t i = 0; i < windows; ++i) simulation.run_window(books);
  return books;
}
template <int Dim>
Books<double, Dim> run(Simulation<double, Dim>& simulation, std::uint64_t windows) {
  return run_of<Dim>(simulation, windows);
}

template <int Dim>
void expect_same(const Snapshot<double, Dim>& a, const Snapshot<double, Dim>& b) {
  ASSERT_EQ(a.x.size(), b.x.size());
  for (std::size_t i = 0; i < a.x.size(); ++i) {
    ASSERT_EQ(a.x[i], b.x[i]) << i;
    ASSERT_EQ(a.v[i], b.v[i]) << i;
  }
}

}  // namespace noli::integrator::test
