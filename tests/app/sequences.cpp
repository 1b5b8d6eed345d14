// SPDX-License-Identifier: Apache-2.0
#include "tests/app/sequences.h"

#include <fmt/format.h>

#include <cmath>

#include "trajectory/formats/write_ply.h"

namespace noli::app_tests {

namespace {

using Places = std::vector<Position>;

/// Adds a sheet of n by m squares; returns the number of its first vertex.
VertexId add_sheet(Mesh& mesh, std::uint32_t n, std::uint32_t m) {
  const auto first = static_cast<VertexId>(mesh.vertex_count);
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < m; ++j) {
      const VertexId a = first + i * (m + 1) + j, b = a + m + 1;
      mesh.faces.push_back({a, b, a + 1});
      mesh.faces.push_back({b, b + 1, a + 1});
    }
  }
  mesh.vertex_count += std::size_t{n + 1} * (m + 1);
  return first;
}

/// A smooth wave of height 1 and period 1 that only uses + - * /.
double wave(double s) {
  const double u = s - std::floor(s);
  return 16 * u * u * (1 - u) * (1 - u);
}

/// Places a sheet: position(i, j) for its vertices, row by row.
template <class At>
void place_sheet(Places& frame, std::uint32_t n, std::uint32_t m, const At& at) {
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= m; ++j) frame.push_back(at(i, j));
  }
}

/// `count` sheets of n by n squares above each other, `gap` squares apart. They wave, and each slides over the one
/// below by `slide` squares per frame.
Sequence sliding(const std::string& name, std::uint32_t n, int count, int frames, double gap, double slide) {
  Sequence s{name, {}, {}};
  for (int k = 0; k < count; ++k) add_sheet(s.mesh, n, n);
  for (int f = 0; f < frames; ++f) {
    Places frame;
    for (int k = 0; k < count; ++k) {
      place_sheet(frame, n, n, [&](std::uint32_t i, std::uint32_t j) {
        const double x = i + k * slide * f + 0.25 * k, y = j + 0.125 * k;
        return Position{x, y, gap * k + 0.3 * gap * (wave(x / 7 + 0.05 * f) + wave(y / 5 - 0.03 * f)) + 0.1 * f};
      });
    }
    s.frames.push_back(std::move(frame));
  }
  return s;
}

/// A ribbon around an axis, twisted by `turns` quarter turns at the end of the sequence. Directions are points of a
/// diamond, so only + - * / are used.
Sequence twisted(const std::string& name, std::uint32_t n, int frames, double turns) {
  Sequence s{name, {}, {}};
  add_sheet(s.mesh, n, 2);
  const auto diamond = [](double q) {
    const double u = q - 4 * std::floor(q / 4);
    const double x = u < 2 ? 1 - u : u - 3, y = u < 1 ? u : u < 3 ? 2 - u : u - 4;
    return std::array<double, 2>{x, y};
  };
  for (int f = 0; f < frames; ++f) {
    Places frame;
    place_sheet(frame, n, 2, [&](std::uint32_t i, std::uint32_t j) {
      const auto d = diamond(turns * i * f / (frames - 1) / n);
      const double r = 0.5 * (j - 1.0);
      return Position{i * 0.5, r * d[0], r * d[1]};
    });
    s.frames.push_back(std::move(frame));
  }
  return s;
}

/// Boxes that fall above each other, the upper ones faster, and stop `gap` apart.
Sequence falling_stack(const std::string& name, int count, int frames, double gap) {
  Sequence s{name, {}, {}};
  constexpr std::array<std::array<VertexId, 3>, 12> faces = {{{0, 2, 1},
                                                              {1, 2, 3},
                                                              {4, 5, 6},
                                                              {5, 7, 6},
                                                              {0, 1, 4},
                                                              {1, 5, 4},
                                                              {2, 6, 3},
                                                              {3, 6, 7},
                                                              {0, 4, 2},
                                                              {2, 4, 6},
                                                              {1, 3, 5},
                                                              {3, 7, 5}}};
  for (int k = 0; k < count; ++k) {
    for (const auto& face : faces) {
      const auto base = static_cast<VertexId>(8 * k);
      s.mesh.faces.push_back({face[0] + base, face[1] + base, face[2] + base});
    }
  }
  s.mesh.vertex_count = 8 * static_cast<std::size_t>(count);
  for (int f = 0; f < frames; ++f) {
    Places frame;
    const double left = 1 - static_cast<double>(f) / (frames - 1);
    for (int k = 0; k < count; ++k) {
      for (int c = 0; c < 8; ++c) {
        frame.push_back({(c & 1) + 0.03125 * k, (c >> 1 & 1) - 0.0625 * k, (c >> 2) + k * (1 + gap + 2 * left) + left});
      }
    }
    s.frames.push_back(std::move(frame));
  }
  return s;
}

/// A triangle that comes down to `gap` above another one; both are at an offset of `shift`.
Sequence near_miss(const std::string& name, double gap, double shift) {
  Sequence s{name, {6, {{0, 1, 2}, {3, 4, 5}}, {}, {}}, {}};
  const double end = gap > 0 ? gap : std::nextafter(shift, shift + 1) - shift;
  for (const double height : {1.0, end}) {
    s.frames.push_back({{shift - 1, -1, shift},
                        {shift + 1, -1, shift},
                        {shift, 1, shift},
                        {shift - 0.5, -0.5, shift + height},
                        {shift + 0.5, -0.5, shift + height},
                        {shift, 0.5, shift + height}});
  }
  return s;
}

/// Two crossed edges that rotate past each other at a distance of `gap`.
Sequence passing_edges(const std::string& name, double gap) {
  Sequence s{name, {4, {}, {{0, 1}, {2, 3}}, {}}, {}};
  s.frames.push_back({{-1, -1, 0}, {1, 1, 0}, {-1, 1, gap}, {1, -1, 1}});
  s.frames.push_back({{-1, 1, 0}, {1, -1, 0}, {-1, -1, 1}, {1, 1, gap}});
  return s;
}

/// Polygons of edges in the plane that go around each other.
Sequence in_the_plane(const std::string& name, int count, int frames) {
  Sequence s{name, {}, {}, {"--dimension", "2"}};
  for (int k = 0; k < count; ++k) {
    const auto base = static_cast<VertexId>(4 * k);
    for (VertexId i = 0; i < 4; ++i) s.mesh.edges.push_back({base + i, base + (i + 1) % 4});
  }
  s.mesh.vertex_count = 4 * static_cast<std::size_t>(count);
  for (int f = 0; f < frames; ++f) {
    Places frame;
    for (int k = 0; k < count; ++k) {
      const double x = 3 * k + (k % 2 == 0 ? 0.125 : -0.125) * f, y = k % 2 == 0 ? 0 : 2.25;
      frame.insert(frame.end(), {{x + 1, y, 0}, {x, y + 1, 0}, {x - 1, y, 0}, {x, y - 1, 0}});
    }
    s.frames.push_back(std::move(frame));
  }
  return s;
}

/// A cloud of loose points and edges that rises through the holes of a grid of edges.
Sequence points_and_edges(const std::string& name, std::uint32_t n, int frames) {
  Sequence s{name, {}, {}};
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return i * (n + 1) + j; };
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) {
      if (i < n) s.mesh.edges.push_back({at(i, j), at(i + 1, j)});
      if (j < n) s.mesh.edges.push_back({at(i, j), at(i, j + 1)});
    }
  }
  const auto first = (n + 1) * (n + 1);
  for (std::uint32_t i = 0; i < n * n; ++i) s.mesh.points.push_back(first + i);
  s.mesh.vertex_count = first + n * n;
  for (int f = 0; f < frames; ++f) {
    Places frame;
    place_sheet(frame, n, n, [&](std::uint32_t i, std::uint32_t j) {
      return Position{1.0 * i, 1.0 * j, wave(0.1 * i + 0.07 * j)};
    });
    for (std::uint32_t i = 0; i < n * n; ++i) {
      const std::uint32_t row = i / n;
      frame.push_back(
          {i % n + 0.3 + 0.05 * f, row + 0.6 - 0.03 * f, -2 + 4.0 * f / (frames - 1) + 0.1 * wave(0.3 * i)});
    }
    s.frames.push_back(std::move(frame));
  }
  return s;
}

Sequence with_option(Sequence s, const std::string& name, const std::vector<std::string>& options) {
  s.name = name;
  s.options.insert(s.options.end(), options.begin(), options.end());
  return s;
}

/// Gives each face its own vertices, so that only merging makes it one mesh.
Sequence with_seams(Sequence s, const std::string& name) {
  Sequence seamed{name, {}, std::vector<Places>(s.frames.size()), {"--merge-identical"}};
  for (const auto& face : s.mesh.faces) {
    const auto base = static_cast<VertexId>(seamed.mesh.vertex_count);
    seamed.mesh.faces.push_back({base, base + 1, base + 2});
    seamed.mesh.vertex_count += 3;
    for (std::size_t f = 0; f < s.frames.size(); ++f) {
      for (const VertexId v : face) seamed.frames[f].push_back(s.frames[f][v]);
    }
  }
  return seamed;
}

}  // namespace

std::vector<Sequence> untouched_sequences() {
  std::vector<Sequence> all;
  all.push_back(sliding("one sheet", 8, 1, 3, 1, 0));
  all.push_back(sliding("two sheets", 8, 2, 4, 1, 0.3));
  all.push_back(sliding("two sheets, near", 8, 2, 4, 0.01, 0.1));
  all.push_back(sliding("two sheets, very near", 6, 2, 3, 1e-9, 0.01));
  all.push_back(sliding("five sheets", 10, 5, 5, 0.5, 0.2));
  all.push_back(sliding("200 frames", 3, 2, 200, 0.5, 0.02));
  all.push_back(sliding("fast", 6, 2, 3, 0.5, 3));
  all.push_back(sliding("two frames", 12, 3, 2, 0.2, 0.5));
  for (const double turns : {0.1, 0.5, 1.0, 3.0})
    all.push_back(twisted(fmt::format("ribbon, {} quarter turns", turns), 24, 5, turns));
  all.push_back(twisted("ribbon in 40 frames", 12, 40, 2));
  for (const double gap : {0.5, 0.01, 1e-6, 0x1p-50})
    all.push_back(falling_stack(fmt::format("stack, {} apart", gap), 5, 4, gap));
  for (const double gap : {1e-3, 1e-9, 1e-15, 1e-100, 5e-324})
    all.push_back(near_miss(fmt::format("near miss by {}", gap), gap, 0));
  for (const double shift : {1.0, 1000.0, 0x1p40})
    all.push_back(near_miss(fmt::format("near miss by a unit at {}", shift), 0, shift));
  for (const double gap : {0.1, 1e-6, 0x1p-52}) all.push_back(passing_edges(fmt::format("edges, {} apart", gap), gap));
  all.push_back(in_the_plane("in the plane", 6, 4));
  all.push_back(in_the_plane("in the plane, 20 frames", 3, 8));
  all.push_back(points_and_edges("points and edges", 5, 6));
  all.push_back(with_option(sliding("", 5, 2, 3, 0.5, 0.1), "strict", {"--strict"}));
  all.push_back(with_option(sliding("", 5, 2, 3, 0.5, 0.1), "at rest", {"--static"}));
  all.push_back(with_option(points_and_edges("", 4, 3), "unreferenced points", {"--points"}));
  all.back().mesh.points.clear();
  all.push_back(with_seams(sliding("", 4, 2, 3, 0.5, 0.1), "seams"));
  return all;
}

Sequence large_sequence(std::size_t faces) {
  std::uint32_t n = 1;
  while (std::size_t{4} * (n + 1) * (n + 1) <= faces) ++n;
  return sliding("large", n, 2, 2, 0.7, 0.2);
}

std::vector<std::string> write_frames(const Sequence& sequence,
                                      const std::function<std::string(const std::string&, const std::string&)>& write) {
  std::vector<std::string> paths;
  for (std::size_t f = 0; f < sequence.frames.size(); ++f) {
    paths.push_back(
        write(fmt::format("{:03}.ply", f), format_ply({sequence.mesh, sequence.frames[f]}, PlyEncoding::ascii)));
  }
  return paths;
}

}  // namespace noli::app_tests
