// SPDX-License-Identifier: Apache-2.0
#include "certify/series/frames_out.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "certify/series/ending.h"
#include "certify/series/hdf5_input.h"
#include "certify/series/vtkhdf.h"
#include "trajectory/blocks/sha256.h"
#include "trajectory/formats/arrays/npy.h"
#include "trajectory/formats/polygons.h"

namespace noli::series {
namespace {

class ArraysOut {
 public:
  explicit ArraysOut(int output) : output_(output) {}

  template <class Row, std::size_t N>
  void rows(const std::vector<std::array<Row, N>>& rows) {
    if (rows.empty()) return;
    header<Row>({rows.size(), N});
    bytes(rows.data(), rows.size() * sizeof rows[0]);
  }
  template <class T>
  void numbers(const std::vector<T>& numbers, std::vector<std::uint64_t> shape) {
    header<T>(std::move(shape));
    bytes(numbers.data(), numbers.size() * sizeof(T));
  }

 private:
  template <class T>
  void header(std::vector<std::uint64_t> shape) {
    const NpyHeader::Kind kind =
        std::is_floating_point_v<T> ? NpyHeader::Kind::real : NpyHeader::Kind::unsigned_integer;
    const std::string text = npy_header(kind, sizeof(T), shape);
    bytes(text.data(), text.size());
  }
  void bytes(const void* from, std::size_t size) const {
    const auto* at = static_cast<const char*>(from);
    while (size > 0) {
      const ssize_t written = ::write(output_, at, size);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) end_lost(errno);
      at += written;
      size -= static_cast<std::size_t>(written);
    }
  }

  int output_;
};

void put_line(int output, const std::string& text) {
  const std::string line = text + '\n';
  [[maybe_unused]] const ssize_t written = ::write(output, line.data(), line.size());
}

/// What is known of frames before they are written.
struct Contents {
  std::uint64_t frames;
  const Mesh& mesh;
  Hdf5Array::Type type;
  std::size_t polygons;  ///< that are cut
};

/// Of all cells.
std::string hash_of(const Mesh& mesh) {
  Sha256 hash;
  const auto add = [&hash](const auto& cells) {
    const std::string count = fmt::format("{} ", cells.size());
    hash.update(count);
    hash.update({reinterpret_cast<const char*>(cells.data()), cells.size() * sizeof cells[0]});
  };
  add(mesh.faces);
  add(mesh.edges);
  add(mesh.points);
  return hex(hash.digest());
}

void write_cells(const Mesh& mesh, ArraysOut& out) {
  out.rows(mesh.faces);
  out.rows(mesh.edges);
  if (!mesh.points.empty()) out.numbers(mesh.points, {mesh.points.size()});
}

/// Positions of one frame after the other, from rows of an array of them.
class FramesOut {
 public:
  FramesOut(ArraysOut& out, const Mesh& mesh, const Polygons& polygons) : out_(out), mesh_(mesh), polygons_(polygons) {}

  /// The numbers of these rows are the positions of a frame.
  void write(const Hdf5Array& array, Rows rows) {
    if (array.type() == Hdf5Array::Type::f32) return write<float>(array, rows);
    write<double>(array, rows);
  }
  double non_planarity() const { return non_planarity_; }

 private:
  template <class T>
  void write(const Hdf5Array& array, Rows rows) {
    std::vector<T> numbers(static_cast<std::size_t>(rows.count * array.row()));
    array.read(rows.first, rows.count, numbers.data());
    out_.numbers(numbers, {numbers.size() / 3, 3});
    if (polygons_.fans.empty()) return;
    std::vector<Position> positions;
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
      positions.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    const bool finite = std::ranges::all_of(numbers, [](T x) { return std::isfinite(x); });
    if (finite) non_planarity_ = largest_non_planarity(mesh_, polygons_.fans, positions, non_planarity_);
  }

  ArraysOut& out_;
  const Mesh& mesh_;
  const Polygons& polygons_;
  double non_planarity_ = 0;
};

/// Frames of VTKHDF, all of one mesh.
class VtkHdfFrames {
 public:
  /// Throws BadInput when a step has other cells than the first, or points that are not there.
  VtkHdfFrames(const Hdf5Input& file, PolygonRule rule) : frames_(file), polygons_{rule} {
    if (frames_.steps() == 0) throw BadInput("VTKHDF/Steps", "has no steps");
    mesh_ = frames_.mesh_of(0, polygons_);
    std::vector<std::uint64_t> last = frames_.cells_key(0);
    for (std::uint64_t k = 0; k < frames_.steps(); ++k) {
      frames_.points_of(k);
      auto key = frames_.cells_key(k);
      if (key == last) continue;
      require_same_cells(k);
      last = std::move(key);
    }
  }

  Contents look() const { return {frames_.steps(), mesh_, frames_.points().type(), polygons_.fans.size()}; }

  void write(ArraysOut& out) const {
    write_cells(mesh_, out);
    FramesOut positions(out, mesh_, polygons_);
    for (std::uint64_t k = 0; k < frames_.steps(); ++k) positions.write(frames_.points(), frames_.points_of(k));
    if (polygons_.fans.empty()) return;
    put_line(STDERR_FILENO, "note: " + polygons_note(polygons_.fans.size(), "all frames", positions.non_planarity()));
  }

 private:
  void require_same_cells(std::uint64_t step) const {
    Polygons others{polygons_.rule};
    if (frames_.mesh_of(step, others) == mesh_) return;
    throw BadInput("VTKHDF",
                   "step " + std::to_string(step) + " has other points or cells than step 0; all must have the same");
  }

  VtkHdf frames_;
  Polygons polygons_;
  Mesh mesh_;
};

template <std::size_t N>
std::vector<std::array<VertexId, N>> cells_of(const Hdf5Input& file, const std::string& name, std::uint64_t vertices) {
  std::vector<std::array<VertexId, N>> cells;
  if (!file.has(name)) return cells;
  const Hdf5Array array = file.array(name);
  if (array.row() != N) throw BadInput(name, "expected " + std::to_string(N) + " vertices for each cell");
  const std::vector<std::int64_t> numbers = array.integers(0, array.shape()[0]);
  for (std::size_t i = 0; i < numbers.size(); i += N) {
    auto& cell = cells.emplace_back();
    for (std::size_t c = 0; c < N; ++c) {
      const std::int64_t v = numbers[i + c];
      if (v < 0 || static_cast<std::uint64_t>(v) >= vertices)
        throw BadInput(name, "there is no vertex " + std::to_string(v));
      cell[c] = static_cast<VertexId>(v);
    }
  }
  return cells;
}

/// The frames of a run's series.h5.
class SeriesFrames {
 public:
  explicit SeriesFrames(const Hdf5Input& file) : positions_(file.array("frames/positions")) {
    const auto& shape = positions_.shape();
    if (positions_.type() == Hdf5Array::Type::integer || shape.size() != 3 || shape[2] != 3 || shape[1] > 0xffffffff) {
      throw BadInput(positions_.name(), "expected real numbers of shape (frames, vertices, 3)");
    }
    if (!file.has("mesh")) {
      throw BadInput("mesh", "is not there: an earlier Noli wrote this; `noli export RUN` writes frames");
    }
    if (shape[0] == 0) throw BadInput(positions_.name(), "has no frame");
    mesh_.vertex_count = shape[1];
    mesh_.faces = cells_of<3>(file, "mesh/faces", shape[1]);
    mesh_.edges = cells_of<2>(file, "mesh/edges", shape[1]);
    for (const auto& point : cells_of<1>(file, "mesh/points", shape[1])) mesh_.points.push_back(point[0]);
  }

  Contents look() const { return {positions_.shape()[0], mesh_, positions_.type(), 0}; }

  void write(ArraysOut& out) const {
    write_cells(mesh_, out);
    const Polygons none;
    FramesOut frames(out, mesh_, none);
    for (std::uint64_t k = 0; k < positions_.shape()[0]; ++k) frames.write(positions_, {k, 1});
  }

 private:
  Hdf5Array positions_;
  Mesh mesh_;
};

/// Calls visit with the frames of the file.
template <class Visit>
void with_frames(int input, PolygonRule rule, const Visit& visit) {
  const Hdf5Input file(input);
  if (file.has("VTKHDF")) return visit(VtkHdfFrames(file, rule));
  if (file.has("frames/positions")) return visit(SeriesFrames(file));
  throw BadInput("the file",
                 "has neither VTKHDF nor the frames of a run's series.h5; save arrays as .npz with numpy, or as .npy");
}

}  // namespace

void write_frames(int input, int output, PolygonRule rule) {
  ArraysOut out(output);
  with_frames(input, rule, [&](const auto& frames) { frames.write(out); });
}

void write_look(int input, int output, PolygonRule rule) {
  with_frames(input, rule, [&](const auto& frames) {
    const Contents look = frames.look();
    put_line(output,
             fmt::format("{} {} {} {} {} {}", look.frames, look.mesh.vertex_count, look.mesh.cell_count(),
                         look.type == Hdf5Array::Type::f32 ? "float32" : "float64", look.polygons, hash_of(look.mesh)));
  });
}

}  // namespace noli::series
