// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/build_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "integrator/groups.h"
#include "integrator/scene/body_forces.h"
#include "integrator/scene/build_contact.h"
#include "integrator/scene/shapes/body_mesh.h"
#include "integrator/scene/shapes/connectivity.h"
#include "integrator/scene/shapes/curve.h"
#include "integrator/scene/shapes/place.h"
#include "integrator/stable_step.h"
#include "trajectory/stop.h"

namespace noli::integrator {
namespace {

template <int Dim>
Vec<double, Dim> cut(const Vec3& x) {
  return x.head<Dim>();
}

Vec3 centre_of_mass(const std::vector<Position>& x, const std::vector<double>& mass) {
  Vec3 sum = Vec3::Zero();
  double total = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += mass[i] * to_vec(x[i]);
    total += mass[i];
  }
  return sum / total;
}

/// Cells, positions, velocities, masses and pins of one body.
template <int Dim>
void add_body(const Scene& scene, std::size_t index, const BodyMesh& made, BuiltBody& built,
              Model<double, Dim>& model) {
  const Body& body = scene.bodies[index];
  append(model.mesh, made.shape.mesh);
  std::vector<Position> x = made.start;
  perturb(x, body.perturb, scene.seed, index, scene.dimension);
  const Vec3 centre = centre_of_mass(x, made.mass), spin = to_vec(body.spin);
  for (std::size_t i = 0; i < x.size(); ++i) {
    end_if_stopped();
    model.x.push_back(cut<Dim>(to_vec(x[i])));
    model.v.push_back(cut<Dim>(to_vec(body.velocity) + cross(spin, to_vec(x[i]) - centre)));
    if (!model.v.back().allFinite()) field_of_body(scene, index).fail("expected velocities in the range of double");
    model.mass.push_back(made.mass[i]);
    built.mass += made.mass[i];
  }
  for (const VertexId i : made.pinned) {
    model.pinned.push_back(built.first + i);
    model.v[built.first + i].setZero();
  }
  built.pinned = made.pinned.size();
}

/// A step that the scene gives, and the place of its field.
struct GivenStep {
  std::optional<double> step;
  std::optional<std::size_t> patch;
};

/// The step from the last patch that has one and contains the force's centre, or from the body.
GivenStep given_step(const Body& body, const Position& centre, std::optional<double> GivenSteps::*which) {
  GivenStep given{body.steps.*which, {}};
  for (std::size_t p = 0; p < body.patches.size(); ++p) {
    const Patch& patch = body.patches[p];
    if (patch.steps.*which && contains(patch.box, centre)) given = {patch.steps.*which, p};
  }
  return given;
}

bool bends(ForceKind kind) { return kind == ForceKind::hinge || kind == ForceKind::turning; }

[[noreturn]] void refuse_step(const Scene& scene, std::size_t body, const GivenStep& given, ForceKind kind,
                              double limit) {
  const Field at = field_of_body(scene, body);
  const Field steps = given.patch ? at["patches"][*given.patch]["steps"] : at["steps"];
  steps[bends(kind) ? "bend" : "stretch"].fail(
      fmt::format("expected at most {} [s], the limit of stability of a {}, or \"allow_unstable\": true, found {}",
                  limit, name(kind), *given.step));
}

/// Refuses a stiffness for whose steps double precision cannot distinguish the multiples.
[[noreturn]] void refuse_stiffness(const Scene& scene, std::size_t body, ForceKind kind, double limit) {
  field_of_body(scene, body)["material"].fail(
      fmt::format("expected steps that can be counted over the duration; the limit of stability of a {} is {} [s]: too "
                  "stiff, or too light",
                  name(kind), limit));
}

/// The same for damping.
[[noreturn]] void refuse_damping(const Scene& scene, std::size_t body, ForceKind kind, double damping) {
  field_of_body(scene, body)["material"].fail(
      fmt::format("expected steps that can be counted over the duration; those of a {} with a damping of {} s cannot",
                  name(kind), damping));
}

/// Leaves out forces that move nothing, and gives the others their steps.
template <class F, int Dim>
ForceList<F> with_steps(const Scene& scene, const Sourced<F>& sourced, const std::vector<Vec<double, Dim>>& x,
                        const std::vector<double>& inverse_mass, std::vector<BuiltBody>& built) {
  ForceList<F> list;
  std::vector<Origin> origins;
  for (std::size_t i = 0; i < sourced.forces.size(); ++i) {
    end_if_stopped();
    const auto& ids = sourced.forces[i].vertices;
    const bool idle = std::all_of(ids.begin(), ids.end(), [&](VertexId v) { return inverse_mass[v] == 0; });
    if (idle) {
      ++built[sourced.origins[i].body].idle_forces;
    } else {
      list.forces.push_back(sourced.forces[i]);
      origins.push_back(sourced.origins[i]);
    }
  }
  const std::vector<double> limits = stable_steps(list, x, inverse_mass, 1);
  const auto which = bends(F::kind) ? &GivenSteps::bend : &GivenSteps::stretch;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    end_if_stopped();
    if (!(limits[i] * 0x1p50 > scene.duration)) refuse_stiffness(scene, origins[i].body, F::kind, limits[i]);
    const GivenStep given = given_step(scene.bodies[origins[i].body], origins[i].centre, which);
    if (given.step > limits[i] && !scene.allow_unstable) refuse_step(scene, origins[i].body, given, F::kind, limits[i]);
    const double damping = list.forces[i].damping;
    BuiltBody& body = built[origins[i].body];
    const double step = given.step ? *given.step : std::min(scene.step_factor * limits[i], scene.window);
    const double excess = std::max(1.0, damping_number(damping, step, limits[i]) / most_damping_number);
    double& greatest = given.step ? body.damping_excess : body.damped_steps;
    greatest = std::max(greatest, excess);
    list.steps.push_back(given.step ? step : step / excess);
    if (!(list.steps.back() * 0x1p50 > scene.duration)) refuse_damping(scene, origins[i].body, F::kind, damping);
  }
  return list;
}

template <int Dim>
void add_gravity(const Scene& scene, Model<double, Dim>& model) {
  if (scene.gravity == Position{}) return;
  model.gravity = Gravity<double, Dim>{cut<Dim>(to_vec(scene.gravity)), scene.gravity_step.value_or(scene.window / 16)};
}

/// Vertices with forces fall with the steps of these. Vertices without forces meet others in the middle of a step of
/// gravity each time, and would lose energy with long steps (integrator/falling.h).
template <int Dim>
void choose_gravity_steps(const Scene& scene, Model<double, Dim>& model) {
  if (!model.gravity) return;
  Gravity<double, Dim>& gravity = *model.gravity;
  gravity.step_without_forces = gravity.step;
  if (model.contact && !scene.gravity_step) {
    for (const ContactMaterial& m : model.contact->materials) {
      gravity.step_without_forces = std::min(gravity.step_without_forces, m.step);
    }
  }
  if (scene.steps == Clocks::own) return;
  for (double* const step : {&gravity.step, &gravity.step_without_forces}) {
    *step = std::ldexp(scene.window, -step_exponent(*step, scene.window));
  }
}

/// Bounds the memory for breakpoints. Large meshes get room for a few per vertex.
template <int Dim>
void limit_breakpoints(const Scene& scene, Model<double, Dim>& model) {
  constexpr std::size_t least = 4'000'000, of_a_vertex = 8;
  model.most_breakpoints = scene.most_breakpoints.value_or(std::max(least, of_a_vertex * model.x.size()));
}

// --- Scripts ---------------------------------------------------------------------------------------------------------

/// A mesh's cells in an order that does not depend on how they are listed, nor on how they are turned.
Mesh sorted(Mesh mesh) {
  for (auto& face : mesh.faces) std::ranges::sort(face);
  for (auto& edge : mesh.edges) std::ranges::sort(edge);
  std::ranges::sort(mesh.faces);
  std::ranges::sort(mesh.edges);
  std::ranges::sort(mesh.points);
  return mesh;
}

/// Positions of all vertices of a body, frame by frame. A frame may have no cells, or those of the body.
std::vector<std::vector<Position>> load_frames(const Scene& scene, const ScriptFrames& frames, const Mesh& body,
                                               const Field& files) {
  const Mesh expected = sorted(body);
  std::vector<std::vector<Position>> loaded;
  for (std::size_t k = 0; k < frames.files.size(); ++k) {
    Frame frame = load_frame(scene, frames.files[k], files[k]);
    if (frame.mesh.vertex_count != body.vertex_count) {
      files[k].fail(fmt::format("expected as many vertices as the body has, {}, found {}", body.vertex_count,
                                frame.mesh.vertex_count));
    }
    if (frame.mesh.cell_count() > 0 && sorted(std::move(frame.mesh)) != expected) {
      files[k].fail("expected the faces, edges and points of the body, or none, found others");
    }
    require_plane(scene, frame.positions, files[k]);
    loaded.push_back(std::move(frame.positions));
  }
  return loaded;
}

/// The times of the frames. k / rate is rounded, so at a high rate two may coincide.
std::vector<double> frame_times(const ScriptFrames& frames, const Field& at) {
  std::vector<double> times;
  for (std::size_t k = 0; k < frames.files.size(); ++k) {
    times.push_back(frames.from + static_cast<double>(k) / frames.rate);
    if (k > 0 && !(times[k] > times[k - 1]))
      at["rate"].fail("expected times of frames that increase in double precision");
  }
  return times;
}

/// Gives the chosen vertices of one body the paths of one script. `first`: the body's first vertex in the scene.
template <int Dim>
void follow(const Scene& scene, std::size_t index, const BodyMesh& body, VertexId first,
            const std::vector<VertexId>& chosen, Model<double, Dim>& model) {
  const auto add = [&](const std::vector<double>& times, const auto& position) {
    for (const VertexId i : chosen) {
      Script<double, Dim>& script =
          model.scripts.emplace_back(Script<double, Dim>{first + i, times, {}, static_cast<std::uint32_t>(index)});
      for (std::size_t k = 0; k < times.size(); ++k) script.positions.push_back(position(i, k));
    }
  };
  const auto& motion = scene.scripts[index].motion;
  if (const auto* path = std::get_if<ScriptPath>(&motion)) {
    add(path->times, [&](VertexId i, std::size_t k) -> Vec<double, Dim> {
      return model.x[first + i] + cut<Dim>(to_vec(path->moves[k]));
    });
  } else {
    const auto& frames = std::get<ScriptFrames>(motion);
    const Field at = field_of(scene)["scripts"][index]["frames"];
    const auto loaded = load_frames(scene, frames, body.shape.mesh, at["files"]);
    add(frame_times(frames, at), [&](VertexId i, std::size_t k) { return cut<Dim>(to_vec(loaded[k][i])); });
  }
}

/// Adds the scripts of a scene, and changes start positions and velocities: a scripted vertex begins where its path
/// does, and its start velocity is zero here, as its path determines it. Fills in built[i].scripted. Throws InputError:
/// vertices that do not exist, are pinned, or have another script; frames that do not load or have other vertices
/// or cells.
template <int Dim>
void add_scripts(const Scene& scene, const std::vector<BodyMesh>& bodies, std::vector<BuiltBody>& built,
                 Model<double, Dim>& model) {
  std::vector<bool> taken(model.x.size());
  for (std::size_t k = 0; k < scene.scripts.size(); ++k) {
    const ScriptedVertices& script = scene.scripts[k];
    const BodyMesh& body = bodies[script.body];
    const VertexId first = built[script.body].first;
    const Field vertices = field_of(scene)["scripts"][k]["vertices"];
    const std::vector<VertexId> chosen = select(script.vertices, body.shape, body.start, vertices);
    if (chosen.empty()) vertices.fail("expected at least one vertex");
    for (const VertexId i : chosen) {
      if (std::binary_search(body.pinned.begin(), body.pinned.end(), i)) {
        vertices.fail(fmt::format("expected vertices that are not pinned; vertex {} is pinned", i));
      }
      if (taken[first + i])
        vertices.fail(fmt::format("expected vertices that no other script moves; vertex {} has a script already", i));
      taken[first + i] = true;
    }
    built[script.body].scripted += chosen.size();
    follow(scene, k, body, first, chosen, model);
  }
  for (const Script<double, Dim>& script : model.scripts) {
    model.x[script.vertex] = script.positions.front();
    model.v[script.vertex].setZero();
  }
}

}  // namespace

template <int Dim>
BuiltScene<Dim> build_model(const Scene& scene) {
  BuiltScene<Dim> result;
  Model<double, Dim>& model = result.model;
  model.window_length = scene.window;
  model.clocks = scene.steps;
  std::vector<BodyMesh> meshes;
  SourcedForces<Dim> sourced;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    meshes.push_back(make_body(scene, i));
    const Mesh& mesh = meshes.back().shape.mesh;
    BuiltBody& built = result.bodies.emplace_back();
    built = {scene.bodies[i].name, static_cast<VertexId>(model.x.size()), mesh.vertex_count, mesh.faces.size(),
             mesh.edges.size()};
    add_body(scene, i, meshes.back(), built, model);
    add_forces(scene, i, meshes.back(), built, sourced);
  }
  add_scripts(scene, meshes, result.bodies, model);
  const std::vector<std::uint8_t> held = held_vertices(model);
  std::vector<double> inverse_mass;
  for (std::size_t i = 0; i < held.size(); ++i) inverse_mass.push_back(held[i] ? 0 : 1 / model.mass[i]);
  auto lists = model.forces.lists();
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    ((std::get<I>(lists) = with_steps(scene, std::get<I>(sourced), model.x, inverse_mass, result.bodies)), ...);
  }
  (std::make_index_sequence<std::tuple_size_v<decltype(lists)>>());
  add_gravity(scene, model);
  add_contact(scene, meshes, inverse_mass, result);
  choose_gravity_steps(scene, model);
  limit_breakpoints(scene, model);
  return result;
}

template BuiltScene<2> build_model<2>(const Scene&);
template BuiltScene<3> build_model<3>(const Scene&);

}  // namespace noli::integrator
