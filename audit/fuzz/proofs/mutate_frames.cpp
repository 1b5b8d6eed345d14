// SPDX-License-Identifier: Apache-2.0
//
// Mutations of the frames that a proof is about; the proof's hashes become those of the changed frames, mostly.
#include <array>

#include "audit/fuzz/proofs/mutating.h"
#include "trajectory/cells.h"

namespace noli::audit {

namespace {

using namespace mutating;

/// The frames, taken apart at the first change; nullptr for a run.
FrameMotion* frames_to_change(Mutating& m) {
  m.fits = m.fits || !m.random.one_in(20);
  if (m.frames) return &*m.frames;
  if (m.from.extension == "blocks") return nullptr;
  return &m.frames.emplace(frames_of(m.from));
}

/// The last bit that all positions have, by what the first step says.
double unit_of(Mutating& m) {
  const std::vector<ProofBlock*> steps = whole_steps(m);
  if (steps.empty()) return 0x1p-4;
  const auto p = static_cast<std::int32_t>(get<std::uint32_t>(steps[0]->payload.data() + 24));
  return std::ldexp(1.0, std::clamp(p, -1000, 900));
}

/// A position moves by units, to the place or a coordinate of another.
bool positions(Mutating& m) {
  FrameMotion* const motion = frames_to_change(m);
  if (motion == nullptr || motion->frames[0].empty()) return false;
  for (std::uint64_t i = 1 + m.random.below(2); i > 0; --i) {
    auto& frame = motion->frames[some_index(m.random, motion->frames)];
    Position &x = frame[some_index(m.random, frame)], other = frame[some_index(m.random, frame)];
    double& coordinate = x[m.random.below(3)];
    constexpr std::array<double, 8> steps = {1, -1, 2, -2, 4, 16, -8, 100};
    switch (m.random.below(7)) {
      case 0:
      case 1:
      case 2: coordinate += unit_of(m) * m.random.one_of(steps); break;
      case 3: coordinate = other[m.random.below(3)]; break;
      case 4: x = other; break;
      case 5: coordinate = -coordinate; break;
      default: coordinate = m.random.one_in(2) ? coordinate / 2 : 1e300;
    }
    if (!std::isfinite(coordinate)) coordinate = 0;
  }
  return true;
}

/// All frames are scaled by a power of two; where the unit follows the proof holds as before.
bool scaled(Mutating& m) {
  FrameMotion* const motion = frames_to_change(m);
  if (motion == nullptr) return false;
  constexpr std::array<int, 5> powers = {1, -1, 3, 10, -20};
  const int power = m.random.one_of(powers);
  for (auto& frame : motion->frames) {
    for (Position& x : frame) {
      for (double& coordinate : x) {
        const double times = std::ldexp(coordinate, power);
        coordinate = std::isfinite(times) ? times : 0;
      }
    }
  }
  for (ProofBlock* const block : blocks_of(m, {step})) {
    if (m.random.one_in(20)) continue;
    change_field<std::uint32_t>(block->payload, 24, [&](auto n) { return n + static_cast<std::uint32_t>(power); });
  }
  return true;
}

bool order_of_frames(Mutating& m) {
  FrameMotion* const motion = frames_to_change(m);
  if (motion == nullptr) return false;
  auto& frames = motion->frames;
  const std::size_t k = some_index(m.random, frames);
  const std::vector<Position> copy = frames[k];
  switch (m.random.below(3)) {
    case 0: frames.insert(frames.begin() + static_cast<std::ptrdiff_t>(k), copy); break;
    case 1: std::swap(frames[k], frames[some_index(m.random, frames)]); break;
    default:
      if (frames.size() > 1) frames.erase(frames.begin() + static_cast<std::ptrdiff_t>(k));
  }
  return true;
}

/// Another mesh: a vertex of a cell, a cell less, a cell more.
bool cells(Mutating& m) {
  FrameMotion* const motion = frames_to_change(m);
  if (motion == nullptr) return false;
  Mesh& mesh = motion->mesh;
  const auto vertex = [&] { return static_cast<VertexId>(m.random.below(mesh.vertex_count)); };
  switch (m.random.below(4)) {
    case 0:
      if (mesh.faces.empty()) return false;
      mesh.faces[some_index(m.random, mesh.faces)][m.random.below(3)] = vertex();
      break;
    case 1:
      if (mesh.cell_count() < 2) return false;
      if (!mesh.faces.empty()) {
        mesh.faces.pop_back();
      } else if (!mesh.edges.empty()) {
        mesh.edges.pop_back();
      } else {
        mesh.points.pop_back();
      }
      break;
    case 2: mesh.faces.push_back({vertex(), vertex(), vertex()}); break;
    default: mesh.edges.push_back({vertex(), vertex()});
  }
  drop_redundant_cells(mesh);
  return mesh.cell_count() > 0;
}

}  // namespace

std::vector<ProofMutation> mutations_of_frames() {
  return {{"positions", 14, positions},
          {"scaled", 3, scaled},
          {"order of frames", 2, order_of_frames},
          {"cells", 5, cells}};
}

}  // namespace noli::audit
