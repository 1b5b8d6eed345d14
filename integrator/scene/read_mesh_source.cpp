// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "integrator/scene/read_body.h"

namespace noli::integrator {
namespace {

void require_few(const Field& mesh, double vertices) {
  if (!(vertices <= most_vertices))
    mesh.fail(fmt::format("expected at most {} vertices, found {}", most_vertices, vertices));
}

LoosePoints read_points(const Field& f) { return {f["at"].vectors()}; }

Chain read_chain(const Field& f) {
  Chain chain{f["points"].vectors(), f["segments"].count(), f["smooth"].flag(), f["closed"].flag()};
  if (chain.closed && chain.segments < 3) {
    f["segments"].fail(fmt::format("expected at least 3, as the chain is closed, found {}", chain.segments));
  }
  return chain;
}

Ring read_ring(const Field& f) { return {f["radius"].number(), f["segments"].count()}; }

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

Disc read_disc(const Field& f) { return {f["radius"].number(), f["rings"].count()}; }

Rod read_rod(const Field& f) {
  Rod rod{f["length"].number(), f["radius"].number(), f["segments"].count(), f["sides"].count()};
  require_few(f, (rod.segments + 1.0) * rod.sides);
  return rod;
}

Sphere read_sphere(const Field& f) { return {f["radius"].number(), f["subdivisions"].count()}; }

SurfaceOfBox read_box(const Field& f) {
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

Pyramid read_pyramid(const Field& f) { return {f["radius"].number(), f["height"].number(), f["sides"].count()}; }

/// Sheets are for space; curves, and what files have, for both.
void require_dimension(const Field& mesh, std::string_view kind) {
  if (mesh.dimension() == 3 || kind == "points" || kind == "chain" || kind == "ring" || kind == "file") return;
  mesh[kind].fail("expected \"points\", \"chain\", \"ring\" or \"file\" in a scene of dimension 2");
}

}  // namespace

MeshSource read_mesh_source(const Field& mesh) {
  const std::string kind = mesh.json().begin().key();
  const Field f = mesh[kind];
  require_dimension(mesh, kind);
  if (kind == "file") return MeshFile{f.text()};
  if (kind == "points") return read_points(f);
  if (kind == "chain") return read_chain(f);
  if (kind == "ring") return read_ring(f);
  if (kind == "grid") return read_grid(f);
  if (kind == "ribbon") return read_ribbon(f);
  if (kind == "disc") return read_disc(f);
  if (kind == "rod") return read_rod(f);
  if (kind == "sphere") return read_sphere(f);
  if (kind == "box") return read_box(f);
  if (kind == "torus") return read_torus(f);
  return read_pyramid(f);
}

}  // namespace noli::integrator
