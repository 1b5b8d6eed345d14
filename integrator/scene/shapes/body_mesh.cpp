// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/shapes/body_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include <noli/errors.h>
#include "integrator/scene/json_text.h"
#include "integrator/scene/shapes/connectivity.h"
#include "integrator/scene/shapes/curve.h"
#include "integrator/scene/shapes/generators.h"
#include "integrator/scene/shapes/place.h"
#include "trajectory/stop.h"

namespace noli::integrator {
namespace {

/// Loads a file's mesh. In dimension 2 it must have only edges, and z = 0.
Shape load(const Scene& scene, const MeshFile& file, const Field& at) {
  Frame frame = load_frame(scene, file.path, at);
  if (frame.mesh.vertex_count == 0) at.fail("expected a mesh with vertices");
  if (scene.dimension == 2 && !frame.mesh.faces.empty()) {
    at.fail("expected a mesh of edges without faces, as the scene has dimension 2");
  }
  require_plane(scene, frame.positions, at);
  return {std::move(frame.mesh), std::move(frame.positions), {}};
}

Shape shape_of(const Scene& scene, const Body& body, const Field& mesh) {
  const Field at = mesh[mesh.json().begin().key()];
  if (const auto* file = std::get_if<MeshFile>(&body.mesh)) return load(scene, *file, at);
  try {
    return std::visit(
        [](const auto& generator) -> Shape {
          if constexpr (requires { make_shape(generator); }) return make_shape(generator);
          throw std::logic_error("files are loaded, not generated");
        },
        body.mesh);
  } catch (const std::invalid_argument& error) {
    at.fail(error.what());
  }
}

void require_few_copies(const Array& array, std::size_t vertices, const Field& at) {
  const double all = 1.0 * array.counts[0] * array.counts[1] * array.counts[2] * static_cast<double>(vertices);
  if (!(all <= most_vertices)) at.fail(fmt::format("expected at most {} vertices, found {}", most_vertices, all));
}

/// Makes copies in rows of the mesh, its shape at rest and its sets; start positions are moved.
void repeat(BodyMesh& made, const Array& array) {
  const std::size_t n = made.shape.mesh.vertex_count, copies = array.copies();
  if (copies == 1) return;
  const Shape one = made.shape;
  for (std::size_t copy = 1; copy < copies; ++copy) {
    append(made.shape.mesh, one.mesh);
    for (auto& [name, ids] : made.shape.sets) {
      for (const VertexId i : one.sets.at(name)) ids.push_back(static_cast<VertexId>(copy * n) + i);
    }
    const std::array<std::size_t, 3> at{copy % array.counts[0], copy / array.counts[0] % array.counts[1],
                                        copy / array.counts[0] / array.counts[1]};
    for (std::size_t i = 0; i < n; ++i) {
      end_if_stopped();
      Position x = made.start[i];
      for (std::size_t axis = 0; axis < 3; ++axis) x[axis] += static_cast<double>(at[axis]) * array.spacing[axis];
      made.start.push_back(x);
      made.rest.push_back(made.rest[i]);
    }
  }
}

template <std::size_t N>
void require_different(const std::vector<std::array<VertexId, N>>& cells, const char* name, const Field& at) {
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (std::size_t i = 0; i < N; ++i) {
      if (cells[c][i] == cells[c][(i + 1) % N]) {
        at.fail(fmt::format("expected {}s with {} different vertices; {} {} has vertex {} twice", name, N, name, c,
                            cells[c][i]));
      }
    }
  }
}

double edge_length(const std::vector<Position>& x, const std::array<VertexId, 2>& edge) {
  return length(to_vec(x[edge[1]]) - to_vec(x[edge[0]]));
}

double face_area(const std::vector<Position>& x, const std::array<VertexId, 3>& face) {
  const Vec3 a = to_vec(x[face[1]]) - to_vec(x[face[0]]), b = to_vec(x[face[2]]) - to_vec(x[face[0]]);
  return length(cross(a, b)) / 2;
}

Densities densities(const ElasticMaterial& m) {
  return {m.density * m.thickness, m.density * m.thickness * m.width, 0};
}
Densities densities(const SpringMaterial& m) { return m.densities; }

std::vector<double> lumped_masses(const Body& body, const BodyMesh& made) {
  const Densities density = std::visit([](const auto& m) { return densities(m); }, body.material.kind);
  const auto factor = [&body](const Position& x) { return patch_factor(body, x, &Patch::density_factor); };
  const Mesh& mesh = made.shape.mesh;
  std::vector<double> mass(mesh.vertex_count);
  for (std::size_t i = 0; i < mass.size(); ++i) mass[i] = density.vertex * factor(made.start[i]);
  for (const auto& face : mesh.faces) {
    end_if_stopped();
    const double part = density.area * factor(centre(made.start, face)) * face_area(made.rest, face) / 3;
    for (const VertexId i : face) mass[i] += part;
  }
  for (const auto& edge : mesh.edges) {
    end_if_stopped();
    const double part = density.length * factor(centre(made.start, edge)) * edge_length(made.rest, edge) / 2;
    for (const VertexId i : edge) mass[i] += part;
  }
  return mass;
}

void require_masses(const BodyMesh& made, const Field& material) {
  for (std::size_t i = 0; i < made.mass.size(); ++i) {
    if (made.mass[i] > 0 && std::isfinite(1 / made.mass[i]) && std::isfinite(made.mass[i])) continue;
    material.fail(fmt::format(
        "expected a mass at every vertex; that of vertex {} is {} [kg]: faces have mass by density or mass_per_area, "
        "edges of no face by density or mass_per_length, any vertex by mass_per_vertex",
        i, made.mass[i]));
  }
}

// --- Selections ------------------------------------------------------------------------------------------------------

/// Vertices of one part of a selection.
struct Part {
  const Shape& shape;
  const std::vector<Position>& start;
  const Field& at;

  std::vector<VertexId> operator()(VertexId vertex) const {
    if (vertex >= shape.mesh.vertex_count) {
      at.fail(fmt::format("the body has no vertex {}; expected a number below {}", vertex, shape.mesh.vertex_count));
    }
    return {vertex};
  }

  std::vector<VertexId> operator()(const std::string& name) const {
    if (name == "all") return all();
    if (const auto set = shape.sets.find(name); set != shape.sets.end()) return set->second;
    std::vector<std::string> names{"all"};
    for (const auto& set : shape.sets) names.push_back(set.first);
    at.fail(fmt::format("the body has no set of vertices {}; {}", Json(name).dump(), nearest_or_all(name, names)));
  }

  std::vector<VertexId> operator()(const Box& box) const {
    std::vector<VertexId> inside = all();
    std::erase_if(inside, [&](VertexId i) { return !contains(box, start[i]); });
    if (inside.empty()) at["box"].fail("expected at least one vertex of the body in this box at the start, found none");
    return inside;
  }

  std::vector<VertexId> all() const {
    std::vector<VertexId> ids(shape.mesh.vertex_count);
    std::iota(ids.begin(), ids.end(), VertexId{0});
    return ids;
  }
};

}  // namespace

Frame load_frame(const Scene& scene, const std::string& file, const Field& at) {
  try {
    return read_frame(scene.path.parent_path() / file);
  } catch (const InputError& error) {
    at.fail(fmt::format("expected a mesh that loads: {}", error.what()));
  }
}

void require_plane(const Scene& scene, const std::vector<Position>& x, const Field& at) {
  const bool flat = std::all_of(x.begin(), x.end(), [](const Position& p) { return p[2] == 0; });
  if (scene.dimension == 2 && !flat) at.fail("expected z = 0 at every vertex, as the scene has dimension 2");
}

double patch_factor(const Body& body, const Position& x, double Patch::*which) {
  double factor = 1;
  for (const Patch& patch : body.patches) factor *= contains(patch.box, x) ? patch.*which : 1;
  return factor;
}

BodyMesh make_body(const Scene& scene, std::size_t index) {
  const Body& body = scene.bodies[index];
  const Field at = field_of_body(scene, index);
  BodyMesh made;
  made.shape = shape_of(scene, body, at["mesh"]);
  require_different(made.shape.mesh.faces, "face", at["mesh"]);
  require_different(made.shape.mesh.edges, "edge", at["mesh"]);
  std::tie(made.rest, made.start) = place(made.shape, body.deform, body.transform);
  require_few_copies(body.array, made.shape.mesh.vertex_count, at["array"]["counts"]);
  repeat(made, body.array);
  for (std::size_t i = 0; i < made.start.size(); ++i) {
    if (!std::isfinite(to_vec(made.start[i]).squaredNorm()))
      at.fail(fmt::format("expected vertices nearer to the origin; the squared distance of vertex {} overflows", i));
  }
  made.mass = lumped_masses(body, made);
  require_masses(made, at["material"]);
  made.pinned = select(body.pin, made.shape, made.start, at["pin"]);
  return made;
}

bool contains(const Box& box, const Position& x) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(box.low[axis] <= x[axis] && x[axis] <= box.high[axis])) return false;
  }
  return true;
}

std::vector<VertexId> select(const Selection& selection, const Shape& shape, const std::vector<Position>& start,
                             const Field& at) {
  std::vector<VertexId> ids;
  for (std::size_t i = 0; i < selection.size(); ++i) {
    const std::vector<VertexId> more = std::visit(Part{shape, start, at[i]}, selection[i]);
    ids.insert(ids.end(), more.begin(), more.end());
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

}  // namespace noli::integrator
