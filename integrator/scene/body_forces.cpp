// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/body_forces.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "integrator/scene/shapes/connectivity.h"
#include "integrator/scene/shapes/curve.h"
#include "trajectory/stop.h"

namespace noli::integrator {
namespace {

/// The factor of springs in series: compliances add. Written so that factors in the range of double do not overflow.
double in_series(double f, double g) { return f == g ? f : 2 / (1 / f + 1 / g); }

/// Shared by all parts of the work.
template <int Dim>
struct Work {
  const Scene& scene;
  std::size_t index;
  const BodyMesh& mesh;
  BuiltBody& built;
  SourcedForces<Dim>& forces;
  const Body& body = scene.bodies[index];
  const Field field = field_of_body(scene, index);

  const ElasticMaterial* elastic() const { return std::get_if<ElasticMaterial>(&body.material.kind); }
  const SpringMaterial* springs() const { return std::get_if<SpringMaterial>(&body.material.kind); }

  template <std::size_t N>
  VertexVectors<double, Dim, N> rest(const std::array<VertexId, N>& ids) const {
    VertexVectors<double, Dim, N> x;
    for (std::size_t i = 0; i < N; ++i) x[i] = to_vec(mesh.rest[ids[i]]).template head<Dim>();
    return x;
  }
  template <std::size_t N>
  std::array<VertexId, N> in_scene(std::array<VertexId, N> ids) const {
    for (VertexId& id : ids) id += built.first;
    return ids;
  }
  template <std::size_t N>
  double factor(const std::array<VertexId, N>& cell) const {
    return patch_factor(body, centre(mesh.start, cell), &Patch::stiffness_factor);
  }
  double length(const std::array<VertexId, 2>& edge) const {
    const auto x = rest(edge);
    return std::sqrt((x[1] - x[0]).squaredNorm());
  }

  /// `cell`: the cell of the force.
  template <class F, std::size_t N>
  void add(const F& force, const std::array<VertexId, N>& cell) {
    std::get<Sourced<F>>(forces).add(force, {static_cast<std::uint32_t>(index), centre(mesh.start, cell)});
  }
  /// Adds a force made from the shape at rest. Throws an InputError that names this cell of the mesh if the force
  /// refuses it.
  template <class F, class Stiffness, std::size_t N>
  void add_from_rest(const std::array<VertexId, F::size>& ids, const Stiffness& stiffness, double damping,
                     const std::array<VertexId, N>& cell, const char* name, std::size_t number) {
    try {
      add(F::from_rest(in_scene(ids), rest(ids), stiffness, damping), cell);
    } catch (const std::invalid_argument& error) {
      field["mesh"].fail(fmt::format("expected cells with a size; at {} {}: {}", name, number, error.what()));
    }
  }
};

template <int Dim>
void add_spring(Work<Dim>& work, const std::array<VertexId, 2>& edge, double constant) {
  const double damping = work.body.material.damping;
  work.add(EdgeSpring<double, Dim>{work.in_scene(edge), constant, work.length(edge), damping}, edge);
}

/// Adds springs of loose edges.
template <int Dim>
void stretch_curves(Work<Dim>& work) {
  const auto& edges = work.mesh.shape.mesh.edges;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    end_if_stopped();
    double constant = 0;
    if (const ElasticMaterial* m = work.elastic()) {
      const double length = work.length(edges[e]);
      if (!(length > 0)) work.field["mesh"].fail(fmt::format("expected edges with a length; edge {} has none", e));
      constant = m->young * m->thickness * m->width / length;
    } else {
      constant = work.springs()->edge_stiffness;
    }
    if (constant > 0) add_spring(work, edges[e], constant * work.factor(edges[e]));
  }
}

/// Adds turning angles at vertices where two loose edges meet.
void bend_curves(Work<2>& work) {
  const Joints found = joints(work.mesh.shape.mesh);
  work.built.crowded += found.branchings;
  const ElasticMaterial* m = work.elastic();
  const double rigidity = m != nullptr
                              ? m->bending * m->young * m->thickness * m->thickness * m->thickness * m->width / 12
                              : work.springs()->bending_stiffness;
  if (!(rigidity > 0)) return;
  const auto& edges = work.mesh.shape.mesh.edges;
  for (const Joint& joint : found.joints) {
    end_if_stopped();
    const double factor = in_series(work.factor(edges[joint.edges[0]]), work.factor(edges[joint.edges[1]]));
    work.add_from_rest<Turning<double>>(joint.vertices, factor * rigidity, work.body.material.bending_damping,
                                        std::array{joint.vertices[1]}, "vertex", joint.vertices[1]);
  }
}

void stretch_sheets(Work<3>& work, const std::vector<FaceEdge>& edges) {
  if (const SpringMaterial* springs = work.springs()) {
    for (const FaceEdge& edge : edges) {
      end_if_stopped();
      if (springs->edge_stiffness > 0) add_spring(work, edge.ends, springs->edge_stiffness * work.factor(edge.ends));
    }
    return;
  }
  const ElasticMaterial& m = *work.elastic();
  const auto& faces = work.mesh.shape.mesh.faces;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    end_if_stopped();
    const SheetMaterial<double> sheet{m.young * work.factor(faces[f]), m.poisson, m.thickness};
    work.add_from_rest<Membrane<double>>(faces[f], sheet, work.body.material.damping, faces[f], "face", f);
  }
}

/// Whether an edge bends: it has two faces, and they are not the same three vertices.
bool bends(const FaceEdge& edge) { return edge.count == 2 && edge.opposite[0] != edge.opposite[1]; }

void bend_sheets(Work<3>& work, const std::vector<FaceEdge>& edges) {
  const ElasticMaterial* m = work.elastic();
  const double rigidity = m != nullptr ? m->bending * flexural_rigidity(m->young, m->poisson, m->thickness)
                                       : work.springs()->bending_stiffness;
  if (!(rigidity > 0)) return;
  const auto& faces = work.mesh.shape.mesh.faces;
  for (const FaceEdge& edge : edges) {
    end_if_stopped();
    if (!bends(edge)) continue;
    const double factor = in_series(work.factor(faces[edge.faces[0]]), work.factor(faces[edge.faces[1]]));
    const std::array ids{edge.ends[0], edge.ends[1], edge.opposite[0], edge.opposite[1]};
    work.add_from_rest<Hinge<double>>(ids, factor * rigidity, work.body.material.bending_damping, edge.ends, "face",
                                      edge.faces[0]);
  }
}

}  // namespace

void add_forces(const Scene& scene, std::size_t body, const BodyMesh& mesh, BuiltBody& built,
                SourcedForces<3>& forces) {
  Work<3> work{scene, body, mesh, built, forces};
  const std::vector<FaceEdge> edges = face_edges(mesh.shape.mesh);
  for (const FaceEdge& edge : edges) {
    built.open_edges += edge.count == 1;
    built.crowded += edge.count >= 2 && !bends(edge);
  }
  if (work.body.stretch) stretch_curves(work);
  if (work.body.stretch) stretch_sheets(work, edges);
  if (work.body.bend) bend_sheets(work, edges);
}

void add_forces(const Scene& scene, std::size_t body, const BodyMesh& mesh, BuiltBody& built,
                SourcedForces<2>& forces) {
  Work<2> work{scene, body, mesh, built, forces};
  if (work.body.stretch) stretch_curves(work);
  if (work.body.bend) bend_curves(work);
}

}  // namespace noli::integrator
