// SPDX-License-Identifier: Apache-2.0
#include "integrator/scene/read_body.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "integrator/scene/json_text.h"

namespace noli::integrator {
namespace {

void require_exactly_one(const Field& f, const std::vector<std::string>& names) {
  std::vector<std::string> found;
  std::ranges::copy_if(names, std::back_inserter(found), [&f](const std::string& name) { return f.has(name); });
  if (found.size() == 1) return;
  f.fail(fmt::format("expected exactly one of the fields \"{}\", found {}", fmt::join(names, "\", \""),
                     found.empty() ? "none" : fmt::format("\"{}\"", fmt::join(found, "\" and \""))));
}

Box read_box(const Field& f) {
  const Box box{f[0].vector(), f[1].vector()};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(box.low[axis] <= box.high[axis]))
      f.fail("expected the lowest corner, then the highest, found " + brief(f.json()));
  }
  return box;
}

Deform read_deform(const Field& f) {
  Deform deform{f["stretch"].vector(), f["twist"].number()};
  if (f.dimension() == 2) deform.stretch[2] = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(deform.stretch[axis] > 0))
      f["stretch"].fail("expected factors greater than 0, found " + brief(f["stretch"].json()));
  }
  if (f.dimension() == 2 && deform.twist != 0) f["twist"].fail("expected 0 in a scene of dimension 2");
  return deform;
}

Quaternion read_quaternion(const Field& f) {
  const Quaternion quaternion{f.numbers<4>()};
  if (quaternion == Quaternion{{0, 0, 0, 0}}) f.fail("expected a quaternion that is not zero");
  return quaternion;
}

decltype(Transform::rotate) read_rotation(const Field& f) {
  const bool plane = f.dimension() == 2;
  if (plane && !f.has("degrees")) f.fail("expected the field \"degrees\", as the scene has dimension 2");
  for (const std::string_view name : {"axis", "quaternion"}) {
    if (plane && f.has(name)) f[name].fail("expected only \"degrees\", as the scene has dimension 2");
  }
  if (plane) return AxisTurn{{0, 0, 1}, f["degrees"].number()};
  if (f.has("quaternion")) {
    if (f.has("axis") || f.has("degrees")) f.fail("expected either \"quaternion\" or \"axis\" and \"degrees\"");
    return read_quaternion(f["quaternion"]);
  }
  if (!f.has("axis") || !f.has("degrees")) f.fail("expected both fields \"axis\" and \"degrees\"");
  return AxisTurn{f["axis"].direction(), f["degrees"].number()};
}

Transform read_transform(const Field& f) {
  Transform transform{f["scale"].number(), {}, f["translate"].vector()};
  if (f.has("rotate")) transform.rotate = read_rotation(f["rotate"]);
  return transform;
}

/// As many counts as the scene has dimensions.
Array read_array(const Field& f) {
  const Field counts = f["counts"];
  const Position numbers = counts.vector();
  Array array{{}, f["spacing"].vector()};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    array.counts[axis] = axis < counts.json().size() ? static_cast<std::uint32_t>(numbers[axis]) : 1;
    if (array.counts[axis] > 1 && array.spacing[axis] == 0) {
      f["spacing"].fail(
          fmt::format("expected a spacing along axis {}, of which there are {} copies", axis, array.counts[axis]));
    }
  }
  return array;
}

Position read_spin(const Field& f) {
  if (f.dimension() == 3) {
    if (f.json().is_number()) f.fail("expected 3 numbers, as the scene has dimension 3, found " + brief(f.json()));
    return f.vector();
  }
  if (!f.json().is_number()) f.fail("expected one number, as the scene has dimension 2, found " + brief(f.json()));
  return {0, 0, f.number()};
}

ElasticMaterial read_elastic(const Field& f) {
  const double thickness = f["thickness"].number();
  return {f["young"].number(),
          f["poisson"].number(),
          f["density"].number(),
          thickness,
          f.number_if("width").value_or(thickness),
          f["bending"].number()};
}

SpringMaterial read_springs(const Field& f) {
  require_exactly_one(f, {"mass_per_area", "mass_per_length", "mass_per_vertex"});
  const auto mass = [&f](const char* name) { return f.number_if(name).value_or(0); };
  return {f["edge_stiffness"].number(),
          f["bending_stiffness"].number(),
          {mass("mass_per_area"), mass("mass_per_length"), mass("mass_per_vertex")}};
}

Material read_material(const Field& f) {
  Material material;
  if (f.has("young")) {
    material.kind = read_elastic(f);
  } else {
    material.kind = read_springs(f);
  }
  material.damping = f["damping"].number();
  material.bending_damping = f.number_if("bending_damping").value_or(material.damping);
  return material;
}

GivenSteps read_steps(const Field& f) { return {read_step(f, "stretch"), read_step(f, "bend")}; }

Patch read_patch(const Field& f) {
  return {read_box(f["box"]), f["stiffness_factor"].number(), f["density_factor"].number(), read_steps(f["steps"])};
}

bool lists(const Field& f, std::string_view word) {
  return std::find(f.json().begin(), f.json().end(), word) != f.json().end();
}

ScriptPath read_path(const Field& f) {
  ScriptPath path;
  for (const Field& point : f.items()) {
    const double t = point["t"].number();
    if (!path.times.empty() && !(t > path.times.back())) {
      point["t"].fail(fmt::format("expected a time after the one before it, {} [s], found {}", path.times.back(), t));
    }
    path.times.push_back(t);
    path.moves.push_back(point["move"].vector());
  }
  return path;
}

// --- Meshes ----------------------------------------------------------------------------------------------------------

void require_few(const Field& mesh, double vertices) {
  if (!(vertices <= most_vertices))
    mesh.fail(fmt::format("expected at most {} vertices, found {}", most_vertices, vertices));
}

Chain read_chain(const Field& f) {
  Chain chain{f["points"].vectors(), f["segments"].count(), f["smooth"].flag(), f["closed"].flag()};
  if (chain.closed && chain.segments < 3) {
    f["segments"].fail(fmt::format("expected at least 3, as the chain is closed, found {}", chain.segments));
  }
  return chain;
}

/// About eight triangles of the least size for each square of the fine edge within the radius.
void require_few_fine(const Field& f, const Grid& grid) {
  const double x = grid.size[0] / grid.cells[0], y = grid.size[1] / grid.cells[1];
  const double across = 2 * grid.refine->radius * grid.refine->factor / std::sqrt(x * x + y * y);
  require_few(f, 8 * across * across);
  for (std::size_t k = 0; k < 2; ++k) {
    if (std::abs(grid.refine->at[k]) <= grid.size[k] / 2) continue;
    f["at"][k].fail(fmt::format("expected a place in the grid, from {} to {} [m], found {}", -grid.size[k] / 2,
                                grid.size[k] / 2, grid.refine->at[k]));
  }
}

Grid read_grid(const Field& f) {
  Grid grid{f["size"].numbers<2>(), f["cells"].counts<2>(), Diagonals::alternating, {}};
  if (f["diagonals"].text() == "parallel") grid.diagonals = Diagonals::parallel;
  require_few(f["cells"], (grid.cells[0] + 1.0) * (grid.cells[1] + 1.0));
  if (f.has("refine")) {
    const Field fine = f["refine"];
    grid.refine = FinePlace{fine["at"].numbers<2>(), fine["factor"].number(), fine["radius"].number()};
    require_few_fine(fine, grid);
  }
  return grid;
}

Ribbon read_ribbon(const Field& f) {
  Ribbon ribbon{f["points"].vectors(), f["width"].number(), f["segments"].count(), f["across"].count(),
                f["side"].direction()};
  require_few(f, (ribbon.segments + 1.0) * (ribbon.across + 1.0));
  return ribbon;
}

Rod read_rod(const Field& f) {
  Rod rod{f["length"].number(), f["radius"].number(), f["segments"].count(), f["sides"].count()};
  require_few(f, (rod.segments + 1.0) * rod.sides);
  return rod;
}

SurfaceOfBox read_box_surface(const Field& f) {
  SurfaceOfBox box{f["size"].numbers<3>(), f["cells"].counts<3>()};
  const double x = box.cells[0], y = box.cells[1], z = box.cells[2];
  require_few(f["cells"], 2 * (x * y + y * z + z * x) + 2);
  return box;
}

Torus read_torus(const Field& f) {
  const Torus torus{f["radius"].number(), f["tube_radius"].number(), f["segments"].count(), f["sides"].count()};
  require_few(f, static_cast<double>(torus.segments) * torus.sides);
  if (!(torus.tube_radius < torus.radius)) {
    f["tube_radius"].fail(
        fmt::format("expected less than the radius, {} [m], found {}", torus.radius, torus.tube_radius));
  }
  return torus;
}

/// Sheets need space; curves and files work in both dimensions.
void require_dimension(const Field& mesh, std::string_view kind) {
  if (mesh.dimension() == 3 || kind == "points" || kind == "chain" || kind == "ring" || kind == "file") return;
  mesh[kind].fail("expected \"points\", \"chain\", \"ring\" or \"file\" in a scene of dimension 2");
}

MeshSource read_mesh_source(const Field& mesh) {
  const std::string kind = mesh.json().begin().key();
  const Field f = mesh[kind];
  require_dimension(mesh, kind);
  if (kind == "file") return MeshFile{f.text()};
  if (kind == "points") return LoosePoints{f["at"].vectors()};
  if (kind == "chain") return read_chain(f);
  if (kind == "ring") return Ring{f["radius"].number(), f["segments"].count()};
  if (kind == "grid") return read_grid(f);
  if (kind == "ribbon") return read_ribbon(f);
  if (kind == "disc") return Disc{f["radius"].number(), f["rings"].count()};
  if (kind == "rod") return read_rod(f);
  if (kind == "sphere") return Sphere{f["radius"].number(), f["subdivisions"].count()};
  if (kind == "box") return read_box_surface(f);
  if (kind == "torus") return read_torus(f);
  return Pyramid{f["radius"].number(), f["height"].number(), f["sides"].count()};
}

Selection read_selection(const Field& selection) {
  Selection parts;
  for (const Field& part : selection.items()) {
    if (part.json().is_object()) {
      parts.emplace_back(read_box(part["box"]));
    } else if (part.json().is_string()) {
      parts.emplace_back(part.text());
    } else {
      parts.emplace_back(part.count<VertexId>());
    }
  }
  return parts;
}

}  // namespace

std::optional<double> read_step(const Field& f, std::string_view name) {
  if (!f.has(name)) return std::nullopt;
  const double step = f[name].countable_time();
  if (step > f.window()) f[name].fail(fmt::format("expected at most the window, {} [s], found {}", f.window(), step));
  return step;
}

std::size_t find_body(const Field& name, const std::vector<Body>& bodies) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].name == name.text()) return i;
    names.push_back(bodies[i].name);
  }
  name.fail(fmt::format("no body has the name {}; {}", brief(name.json()), nearest_or_all(name.text(), names)));
}

Body read_body(const Field& f, std::size_t index) {
  Body body;
  body.name = f.has("name") ? f["name"].text() : fmt::format("body{}", index);
  body.mesh = read_mesh_source(f["mesh"]);
  body.deform = read_deform(f["deform"]);
  body.transform = read_transform(f["transform"]);
  body.array = read_array(f["array"]);
  body.perturb = f["perturb"].number();
  body.velocity = f["velocity"].vector();
  if (f.has("spin")) body.spin = read_spin(f["spin"]);
  body.material = read_material(f["material"]);
  for (const Field& patch : f["patches"].items()) body.patches.push_back(read_patch(patch));
  body.stretch = lists(f["forces"], "stretch");
  body.bend = lists(f["forces"], "bend");
  body.steps = read_steps(f["steps"]);
  body.pin = read_selection(f["pin"]);
  return body;
}

ScriptedVertices read_script(const Field& f, const std::vector<Body>& bodies) {
  ScriptedVertices script;
  script.body = find_body(f["body"], bodies);
  script.vertices = read_selection(f["vertices"]);
  require_exactly_one(f, {"path", "frames"});
  if (f.has("path")) {
    script.motion = read_path(f["path"]);
  } else {
    const Field frames = f["frames"];
    script.motion = ScriptFrames{frames["files"].json().get<std::vector<std::string>>(), frames["rate"].number(),
                                 frames["from"].number()};
  }
  return script;
}

}  // namespace noli::integrator
