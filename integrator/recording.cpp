// SPDX-License-Identifier: Apache-2.0
#include "integrator/recording.h"

namespace noli::integrator {

template <int Dim>
WorldLines world_lines(const Recording<double, Dim>& recording, std::size_t vertex_count) {
  const auto stream = recording.stream();
  std::vector<std::size_t> offsets(vertex_count + 1, 0);
  for (const auto& b : stream) ++offsets[b.vertex + 1];
  for (std::size_t i = 0; i < vertex_count; ++i) offsets[i + 1] += offsets[i];
  std::vector<double> times(stream.size());
  std::vector<Position> positions(stream.size());
  std::vector<std::size_t> next(offsets.begin(), offsets.end() - 1);
  for (const auto& b : stream) {
    const std::size_t i = next[b.vertex]++;
    times[i] = b.t;
    positions[i] = {b.x[0], b.x[1], Dim == 3 ? b.x[Dim - 1] : 0.0};
  }
  return WorldLines::from_breakpoints(std::move(offsets), std::move(times), std::move(positions), "window");
}

template WorldLines world_lines(const Recording<double, 2>&, std::size_t);
template WorldLines world_lines(const Recording<double, 3>&, std::size_t);

}  // namespace noli::integrator
