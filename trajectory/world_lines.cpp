// SPDX-License-Identifier: Apache-2.0
#include "trajectory/world_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <noli/errors.h>

namespace noli {
namespace {

/// The arrays of a WorldLines, not checked yet.
struct Candidate {
  const std::vector<std::size_t>& offsets;
  const std::vector<double>& times;
  const std::vector<Position>& positions;
  const std::string& source;

  [[noreturn]] void fail(std::size_t v, const std::string& problem) const {
    throw InputError(source, fmt::format("vertex {}", v), problem);
  }
  [[noreturn]] void fail(std::size_t v, std::size_t breakpoint, const std::string& problem) const {
    throw InputError(source, fmt::format("vertex {}, breakpoint {}", v, breakpoint - offsets[v]), problem);
  }
};

void check_offsets(const Candidate& c) {
  if (c.offsets.size() < 2) throw InputError(c.source, "", "there are no vertices");
  if (c.times.size() != c.positions.size() || c.offsets.front() != 0 || c.offsets.back() != c.times.size()) {
    throw InputError(c.source, "",
                     fmt::format("offsets from {} to {} do not fit {} times and {} positions", c.offsets.front(),
                                 c.offsets.back(), c.times.size(), c.positions.size()));
  }
  for (std::size_t v = 0; v + 1 < c.offsets.size(); ++v) {
    if (c.offsets[v + 1] < c.offsets[v] || c.offsets[v + 1] - c.offsets[v] < 2) {
      c.fail(v, "expected at least two breakpoints");
    }
    if (c.offsets[v + 1] > c.times.size()) c.fail(v, "its breakpoints reach beyond the last");
  }
}

void check_breakpoint(const Candidate& c, std::size_t v, std::size_t k) {
  if (!std::isfinite(c.times[k])) c.fail(v, k, fmt::format("expected a finite time, found {}", c.times[k]));
  if (k > c.offsets[v] && !(c.times[k - 1] < c.times[k])) {
    c.fail(v, k, fmt::format("time {} does not come after {}", c.times[k], c.times[k - 1]));
  }
  for (const double x : c.positions[k]) {
    if (!std::isfinite(x)) c.fail(v, k, fmt::format("expected a finite coordinate, found {}", x));
  }
}

void check_vertex(const Candidate& c, std::size_t v) {
  for (std::size_t k = c.offsets[v]; k < c.offsets[v + 1]; ++k) check_breakpoint(c, v, k);
  const double begin = c.times[c.offsets[v]], end = c.times[c.offsets[v + 1] - 1];
  if (begin != c.times.front()) c.fail(v, fmt::format("begins at {}, but vertex 0 at {}", begin, c.times.front()));
  const double common_end = c.times[c.offsets[1] - 1];
  if (end != common_end) c.fail(v, fmt::format("ends at {}, but vertex 0 at {}", end, common_end));
}

}  // namespace

WorldLines WorldLines::from_frames(std::span<const Position> x_t0, std::span<const Position> x_t1) {
  std::vector<std::size_t> offsets{0};
  std::vector<double> times;
  std::vector<Position> positions;
  for (std::size_t v = 0; v < x_t0.size(); ++v) {
    times.insert(times.end(), {0.0, 1.0});
    positions.insert(positions.end(), {x_t0[v], x_t1[v]});
    offsets.push_back(times.size());
  }
  return {std::move(offsets), std::move(times), std::move(positions)};
}

WorldLines WorldLines::from_breakpoints(std::vector<std::size_t> offsets, std::vector<double> times,
                                        std::vector<Position> positions, const std::string& source) {
  const Candidate candidate{offsets, times, positions, source};
  check_offsets(candidate);
  for (std::size_t v = 0; v + 1 < offsets.size(); ++v) check_vertex(candidate, v);
  return {std::move(offsets), std::move(times), std::move(positions)};
}

std::size_t WorldLines::segment_at(VertexId v, double t) const {
  const std::span<const double> all = times(v);
  const std::span<const double> begins = all.first(all.size() - 1);
  return static_cast<std::size_t>(std::upper_bound(begins.begin() + 1, begins.end(), t) - begins.begin()) - 1;
}

}  // namespace noli
