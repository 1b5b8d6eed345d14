// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/build_scripts.h"

#include <fmt/format.h>

#include <algorithm>

#include "integrator/scene/shapes/curve.h"
#include "integrator/scene/shapes/select.h"
#include "trajectory/error.h"
#include "trajectory/formats/frames.h"

namespace noli::integrator {
namespace {

/// Positions of all vertices of a body, frame by frame.
std::vector<std::vector<Position>> load_frames(const Scene& scene, const ScriptFrames& frames, std::size_t vertices,
                                               const Field& files) {
  std::vector<std::vector<Position>> loaded;
  for (std::size_t k = 0; k < frames.files.size(); ++k) {
    try {
      loaded.push_back(read_frame(scene.path.parent_path() / frames.files[k]).positions);
    } catch (const InputError& error) {
      files[k].fail(fmt::format("expected a mesh that loads: {}", error.what()));
    }
    if (loaded.back().size() != vertices) {
      files[k].fail(
          fmt::format("expected as many vertices as the body has, {}, found {}", vertices, loaded.back().size()));
    }
    const bool flat =
        std::all_of(loaded.back().begin(), loaded.back().end(), [](const Position& x) { return x[2] == 0; });
    if (scene.dimension == 2 && !flat) files[k].fail("expected z = 0 at every vertex, as the scene has dimension 2");
  }
  return loaded;
}

/// Times of the frames; k / rate is rounded, so at a great rate two may coincide.
std::vector<double> frame_times(const ScriptFrames& frames, const Field& at) {
  std::vector<double> times;
  for (std::size_t k = 0; k < frames.files.size(); ++k) {
    times.push_back(frames.from + static_cast<double>(k) / frames.rate);
    if (k > 0 && !(times[k] > times[k - 1]))
      at["rate"].fail("expected times of frames that increase in double precision");
  }
  return times;
}

template <int Dim>
Vec<double, Dim> cut(const Position& x) {
  return to_vec(x).template head<Dim>();
}

/// Gives the chosen vertices of one body the paths of one script.
template <int Dim>
struct Follow {
  const Scene& scene;
  const Field& at;
  const BodyMesh& body;
  VertexId first;  ///< of the body, in the scene
  const std::vector<VertexId>& chosen;
  Model<double, Dim>& model;

  void operator()(const ScriptPath& path) const {
    for (const VertexId i : chosen) {
      Script<double, Dim> script{first + i, path.times, {}};
      for (const Position& move : path.moves) script.positions.push_back(model.x[first + i] + cut<Dim>(move));
      model.scripts.push_back(std::move(script));
    }
  }

  void operator()(const ScriptFrames& frames) const {
    const auto loaded = load_frames(scene, frames, body.shape.mesh.vertex_count, at["frames"]["files"]);
    const std::vector<double> times = frame_times(frames, at["frames"]);
    for (const VertexId i : chosen) {
      Script<double, Dim> script{first + i, times, {}};
      for (const auto& positions : loaded) script.positions.push_back(cut<Dim>(positions[i]));
      model.scripts.push_back(std::move(script));
    }
  }
};

}  // namespace

template <int Dim>
void add_scripts(const Scene& scene, const std::vector<BodyMesh>& bodies, std::vector<BuiltBody>& built,
                 Model<double, Dim>& model) {
  const Field scripts = Field(scene.document, scene.path.string())["scripts"];
  std::vector<bool> taken(model.x.size());
  for (std::size_t k = 0; k < scene.scripts.size(); ++k) {
    const ScriptedVertices& script = scene.scripts[k];
    const BodyMesh& body = bodies[script.body];
    const VertexId first = built[script.body].first;
    const Field at = scripts[k], vertices = at["vertices"];
    const std::vector<VertexId> chosen = select(script.vertices, body.shape, body.start, vertices);
    if (chosen.empty()) vertices.fail("expected at least one vertex");
    for (const VertexId i : chosen) {
      if (std::binary_search(body.pinned.begin(), body.pinned.end(), i)) {
        vertices.fail(fmt::format("expected vertices that are not pinned; {} is", i));
      }
      if (taken[first + i]) vertices.fail(fmt::format("expected vertices that no other script moves; {} has one", i));
      taken[first + i] = true;
    }
    built[script.body].scripted += chosen.size();
    std::visit(Follow<Dim>{scene, at, body, first, chosen, model}, script.motion);
  }
  for (const Script<double, Dim>& script : model.scripts) {
    model.x[script.vertex] = script.positions.front();
    model.v[script.vertex].setZero();
  }
}

template void add_scripts(const Scene&, const std::vector<BodyMesh>&, std::vector<BuiltBody>&, Model<double, 2>&);
template void add_scripts(const Scene&, const std::vector<BodyMesh>&, std::vector<BuiltBody>&, Model<double, 3>&);

}  // namespace noli::integrator
