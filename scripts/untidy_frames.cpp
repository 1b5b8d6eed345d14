// SPDX-License-Identifier: Apache-2.0
//
// untidy_frames KIND N FOLDER: writes PLY frames of motions that ignore contact, for `noli repair`.
//   shot     an octahedron flies through four sheets of N by N squares: 4 frames, FOLDER/000.ply to FOLDER/003.ply
//   drape    a cloth of N by N squares, held at its corners, falls through a ball that moves: 60 frames. A cheap solver
//            made it, which knows springs and gravity, and no contact. The ball's vertices come first; the program
//            prints how many there are
// Coordinates are in metres. Only +, -, *, / and sqrt are used, so the bytes are the same everywhere.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Point = std::array<double, 3>;

struct Mesh {
  std::vector<Point> points;
  std::vector<std::array<int, 3>> faces;
};

Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
double length(const Point& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

/// Adds n by n squares of a side in all, around a centre; the number of their first vertex.
int add_sheet(Mesh& mesh, int n, double side, const Point& centre) {
  const int first = static_cast<int>(mesh.points.size());
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      mesh.points.push_back(
          centre + Point{side * (static_cast<double>(i) / n - 0.5), side * (static_cast<double>(j) / n - 0.5), 0});
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int a = first + i * (n + 1) + j, b = a + n + 1;
      mesh.faces.push_back({a, b, a + 1});
      mesh.faces.push_back({b, b + 1, a + 1});
    }
  }
  return first;
}

/// An octahedron whose faces are halved so many times, its vertices at distance 1 from the origin.
Mesh ball(int halvings) {
  Mesh mesh;
  mesh.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int k = 0; k < halvings; ++k) {
    std::vector<std::array<int, 3>> finer;
    std::vector<std::array<int, 3>> middles;  // a < b, and the vertex between them
    const auto between = [&](int a, int b) {
      if (a > b) std::swap(a, b);
      for (const auto& [p, q, m] : middles) {
        if (p == a && q == b) return m;
      }
      const Point sum = mesh.points[a] + mesh.points[b];
      mesh.points.push_back((1 / length(sum)) * sum);
      middles.push_back({a, b, static_cast<int>(mesh.points.size()) - 1});
      return middles.back()[2];
    };
    for (const auto& [a, b, c] : mesh.faces) {
      const int ab = between(a, b), bc = between(b, c), ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.faces = finer;
  }
  return mesh;
}

void write(const Mesh& mesh, const std::string& folder, int frame) {
  std::ostringstream name;
  name << folder << '/' << std::setw(3) << std::setfill('0') << frame << ".ply";
  std::ofstream out(name.str());
  out.precision(17);
  out << "ply\nformat ascii 1.0\nelement vertex " << mesh.points.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << mesh.faces.size()
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& [x, y, z] : mesh.points) out << x << ' ' << y << ' ' << z << '\n';
  for (const auto& [a, b, c] : mesh.faces) out << "3 " << a << ' ' << b << ' ' << c << '\n';
  out.close();
  if (!out.fail()) return;
  std::cerr << name.str() << ": cannot be written\n";
  std::exit(4);
}

void shot(int n, const std::string& folder) {
  Mesh mesh = ball(0);
  const std::size_t size = mesh.points.size();
  const std::vector<Point> shape = mesh.points;
  for (int k = 0; k < 4; ++k) add_sheet(mesh, n, 1, {0, 0, -0.1 * k});
  for (int f = 0; f < 4; ++f) {
    // Between frames 1 and 2 it flies through all sheets.
    const Point at = {0.013, 0.017, std::array{1.0, 0.2, -0.6, -1.4}[f]};
    for (std::size_t v = 0; v < size; ++v) mesh.points[v] = at + 0.05 * shape[v];
    write(mesh, folder, f);
  }
}

/// Springs between neighbours along the squares and across them.
std::vector<std::array<int, 2>> springs_of(int first, int n) {
  std::vector<std::array<int, 2>> springs;
  const auto at = [&](int i, int j) { return first + i * (n + 1) + j; };
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      if (i < n) springs.push_back({at(i, j), at(i + 1, j)});
      if (j < n) springs.push_back({at(i, j), at(i, j + 1)});
      if (i < n && j < n) springs.push_back({at(i, j), at(i + 1, j + 1)});
      if (i < n && j < n) springs.push_back({at(i + 1, j), at(i, j + 1)});
    }
  }
  return springs;
}

void drape(int n, const std::string& folder) {
  constexpr int frames = 60;
  const int sweeps = std::max(30, n * n / 30);  // a pull goes one square further in each: finer cloth needs more
  constexpr double dt = 1.0 / 60, gravity = 9.81;
  Mesh mesh = ball(4);
  const std::size_t size = mesh.points.size();
  const std::vector<Point> shape = mesh.points;
  const int first = add_sheet(mesh, n, 1, {0, 0, 0.4});
  const auto springs = springs_of(first, n);
  std::vector<double> rest;
  for (const auto& [a, b] : springs) rest.push_back(length(mesh.points[b] - mesh.points[a]));
  const std::array<int, 4> held = {first, first + n, first + n * (n + 1), first + n * (n + 1) + n};
  std::vector<Point> before = mesh.points;
  for (int f = 0; f < frames; ++f) {
    const Point at = {0.002 * f, 0, -0.1 + 0.004 * f};
    for (std::size_t v = 0; v < size; ++v) mesh.points[v] = at + 0.22 * shape[v];
    write(mesh, folder, f);
    const std::vector<Point> now = mesh.points;
    for (std::size_t v = size; v < now.size(); ++v) {
      mesh.points[v] = now[v] + 0.99 * (now[v] - before[v]) - Point{0, 0, gravity * dt * dt};
    }
    for (int k = 0; k < sweeps; ++k) {
      for (const int v : held) mesh.points[v] = now[v];
      for (std::size_t s = 0; s < springs.size(); ++s) {
        const auto [a, b] = springs[s];
        const Point along = mesh.points[b] - mesh.points[a];
        const Point half = (0.5 * (1 - rest[s] / length(along))) * along;
        mesh.points[a] = mesh.points[a] + half;
        mesh.points[b] = mesh.points[b] - half;
      }
    }
    for (const int v : held) mesh.points[v] = now[v];
    before = now;
  }
  std::cout << size << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  const std::string kind = argc == 4 ? argv[1] : "", number = argc == 4 ? argv[2] : "";
  int n = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), n);
  if ((kind != "shot" && kind != "drape") || error != std::errc() || *end != 0 || n < 1 || n > 1000) {
    std::cerr << "usage: untidy_frames shot|drape N FOLDER\n";
    return 3;
  }
  kind == "shot" ? shot(n, argv[3]) : drape(n, argv[3]);
}
