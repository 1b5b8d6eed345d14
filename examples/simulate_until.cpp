// SPDX-License-Identifier: Apache-2.0
// Runs a scene, certified window by window, until a condition holds: the kinetic energy has passed its first maximum.
//   simulate_until SCENE.json RUN
#include <cstdio>
#include <exception>

#include <noli/simulate.h>

int main(int argc, char** argv) try {
  if (argc != 3) return 3;
  noli::SimulateRequest request;
  request.scene = argv[1];
  request.run = argv[2];
  double most = 0, time = 0;
  request.keep_going = [&](const noli::SeriesRow& row) {
    if (row.kinetic < most) return false;
    most = row.kinetic;
    time = row.time;
    return true;
  };
  const noli::SimulateOutcome outcome = noli::run_simulate(request);
  std::printf("%llu windows are certified; the kinetic energy is largest, %.3g J, at %g s\n",
              static_cast<unsigned long long>(outcome.windows), most, time);
  return outcome.end == noli::RunEnd::interrupted ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 3;
}
