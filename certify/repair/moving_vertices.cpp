// SPDX-License-Identifier: Apache-2.0
#include "certify/repair/moving_vertices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <string>
#include <string_view>

#include <noli/errors.h>
#include "certify/repair/step_contact.h"
#include "trajectory/text.h"
#include "trajectory/write_file.h"

namespace noli {
namespace {

/// Sums and ratios of masses stay far from the ends of doubles.
constexpr double least_mass = 1e-100, most_ratio = 1e4;

/// Calls take(word, number of its line) for each word of a text file. Throws InputError.
template <class Take>
void each_word_of(const std::filesystem::path& file, const Take& take) {
  const std::string text = read_whole_file(file);
  Lines lines(text);
  for (std::string_view line; lines.next(line);) {
    Words words(line);
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) take(word, lines.number());
  }
}

}  // namespace

std::vector<std::uint8_t> fixed_vertices(const RepairRequest& request, std::size_t count,
                                         const std::vector<FrameBody>& bodies) {
  std::vector<std::uint8_t> fixed(count, 0);
  if (request.fixed_first > count) {
    throw UsageError(fmt::format("--fixed-first {}: the frames have {} vertices", request.fixed_first, count));
  }
  std::fill_n(fixed.begin(), request.fixed_first, std::uint8_t{1});
  for (const VertexId v : request.fixed_listed) {
    if (v >= count) throw UsageError(fmt::format("fixed: there is no vertex {}; the frames have {}", v, count));
    fixed[v] = 1;
  }
  for (const std::string& name : request.fixed_bodies) {
    if (std::ranges::find(bodies, name, &FrameBody::name) == bodies.end()) {
      throw UsageError("--fixed " + name + ": there is no such body; expected the name of one (--body NAME=FRAMES)");
    }
  }
  for (const FrameBody& body : bodies) {
    const bool named = std::ranges::find(request.fixed_bodies, body.name) != request.fixed_bodies.end();
    if (!body.still && !named) continue;
    const auto begin = fixed.begin() + static_cast<std::ptrdiff_t>(body.first_vertex);
    std::fill_n(begin, body.vertices, std::uint8_t{1});
  }
  return fixed;
}

std::vector<VertexId> listed_vertices(const std::filesystem::path& file) {
  std::vector<VertexId> vertices;
  each_word_of(file, [&](std::string_view word, std::size_t line) {
    VertexId vertex = 0;
    if (parse_number(word, vertex) != std::errc()) {
      throw InputError(file.string(), line_place(line), "expected the number of a vertex, found " + in_quotes(word));
    }
    vertices.push_back(vertex);
  });
  return vertices;
}

std::vector<double> masses_of(const RepairRequest& request, const Mesh& mesh, std::span<const Position> x) {
  if (request.masses == "size") return masses_by_size(mesh, x);
  if (request.masses == "uniform") return std::vector<double>(mesh.vertex_count, 1);
  std::vector<double> masses;
  each_word_of(request.masses, [&](std::string_view word, std::size_t line) {
    double mass = 0;
    const std::string problem = parse_finite(word, mass);
    if (!problem.empty() || mass < least_mass || mass > 1 / least_mass) {
      throw InputError(
          request.masses, line_place(line),
          fmt::format("expected a mass from {} to {}, found {}", least_mass, 1 / least_mass, in_quotes(word)));
    }
    masses.push_back(mass);
  });
  if (masses.size() != mesh.vertex_count) {
    throw InputError(request.masses, "",
                     fmt::format("has {} numbers; expected {}, one for each vertex", masses.size(), mesh.vertex_count));
  }
  const auto [least, greatest] = std::ranges::minmax_element(masses);
  if (*greatest > most_ratio * *least) {
    throw InputError(request.masses, "",
                     fmt::format("masses from {} to {}; expected a ratio of at most {}, as larger ones take "
                                 "very short steps: fix the heavy vertices instead",
                                 *least, *greatest, most_ratio));
  }
  const double sum = std::accumulate(masses.begin(), masses.end(), 0.0);
  for (double& mass : masses) mass *= static_cast<double>(masses.size()) / sum;
  return masses;
}

Mesh fixed_parts(const Mesh& mesh, std::span<const std::uint8_t> fixed, bool whole) {
  Mesh parts;
  parts.vertex_count = mesh.vertex_count;
  const auto take = [&](const auto& cell) {
    std::vector<VertexId> part;
    std::ranges::copy_if(cell, std::back_inserter(part), [&](VertexId v) { return fixed[v] != 0; });
    if (whole && part.size() != cell.size()) return;
    if (part.size() == 3) parts.faces.push_back({part[0], part[1], part[2]});
    if (part.size() == 2) parts.edges.push_back({part[0], part[1]});
    if (part.size() == 1) parts.points.push_back(part[0]);
  };
  for (const auto& face : mesh.faces) take(face);
  for (const auto& edge : mesh.edges) take(edge);
  for (const VertexId point : mesh.points) take(std::array{point});
  std::ranges::sort(parts.points);
  parts.points.erase(std::unique(parts.points.begin(), parts.points.end()), parts.points.end());
  return parts;
}

}  // namespace noli
