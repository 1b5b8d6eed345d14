// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include <noli/errors.h>
#include "trajectory/blocks/bytes.h"
#include "trajectory/blocks/run_checks.h"
#include "trajectory/blocks/run_payload.h"
#include "trajectory/text.h"

namespace noli::run_block {
namespace {

/// Decodes a payload from its beginning; errors name the place of the last item.
class Payload {
 public:
  explicit Payload(const Source& source) : source_(source) {}

  [[noreturn]] void fail(const std::string& problem) const { fail_at(last_, problem); }
  std::uint64_t left() const { return source_.block.payload.size() - at_; }

  /// Fails unless exactly `count` items of `size` bytes are left. It cannot overflow: count is compared, not
  /// multiplied.
  void require(std::uint64_t count, std::uint64_t size, const char* what) {
    last_ = at_;
    if (left() % size == 0 && left() / size == count) return;
    fail(fmt::format("expected {}, {} of {} bytes each, found {} bytes", what, count, size, left()));
  }
  void finish() {
    last_ = at_;
    if (left() > 0) fail(fmt::format("expected the end of the block, found {} more bytes", left()));
  }

  const char* take(std::uint64_t size) {
    last_ = at_;
    if (size > left()) fail(fmt::format("the block ends within a value: expected {} bytes, found {}", size, left()));
    at_ += size;
    return source_.block.payload.data() + last_;
  }
  template <class T>
  T number() {
    return get<T>(take(sizeof(T)));
  }
  /// Precondition: that many are left.
  template <class T>
  void numbers(std::span<T> values) {
    get_all(take(values.size_bytes()), values);
  }
  double finite(const char* what) {
    const auto value = number<double>();
    if (!std::isfinite(value)) fail(fmt::format("expected a finite {}, found {}", what, value));
    return value;
  }

  /// The rest, as vectors of `dimension` coordinates; their values are not checked. Precondition: require() has checked
  /// the size.
  std::vector<Position> vectors(std::uint32_t dimension) {
    std::vector<Position> all(left() / (dimension * sizeof(double)), Position{});
    if (dimension == 3) {
      numbers(std::span<double>(all.empty() ? nullptr : all.front().data(), 3 * all.size()));
    } else {
      for (Position& x : all) numbers(std::span<double>(x).first(2));
    }
    return all;
  }
  /// The same; fails unless there is a finite vector for each vertex.
  std::vector<Position> finite_vectors(std::uint32_t dimension, std::size_t vertex_count) {
    require(vertex_count, dimension * sizeof(double), "the vectors of all vertices");
    std::vector<Position> all = vectors(dimension);
    for (std::size_t v = 0; v < all.size(); ++v) {
      for (const double x : all[v]) {
        if (!std::isfinite(x)) fail_at(0, fmt::format("vertex {}: expected a finite coordinate, found {}", v, x));
      }
    }
    return all;
  }

 private:
  [[noreturn]] void fail_at(std::uint64_t offset, const std::string& problem) const {
    throw InputError(source_.file, byte_place(source_.block.payload_offset() + offset), problem);
  }

  const Source& source_;
  std::uint64_t at_ = 0, last_ = 0;
};

template <class Cell>
void take_cells(Payload& payload, std::size_t vertex_count, std::vector<Cell>& cells) {
  for (Cell& cell : cells) {
    payload.numbers(std::span<VertexId>(cell));
    for (const VertexId v : cell) {
      if (v >= vertex_count) payload.fail(fmt::format("vertex {} of {}", v, vertex_count));
    }
  }
}

}  // namespace

RunHeader decode_head(const Source& source) {
  Payload payload(source);
  RunHeader header;
  header.dimension = payload.number<std::uint32_t>();
  if (header.dimension != 2 && header.dimension != 3) {
    payload.fail(fmt::format("dimension {}; expected 2 or 3", header.dimension));
  }
  const auto record = payload.number<std::uint32_t>();
  if (record > 1) payload.fail(fmt::format("record mode {}; expected 0 (full) or 1 (frames)", record));
  header.record = static_cast<RecordMode>(record);
  header.window_length = payload.finite("window length");
  if (header.window_length <= 0)
    payload.fail(fmt::format("window length {}; expected more than 0", header.window_length));
  payload.finish();
  return header;
}

Mesh decode_mesh(const Source& source) {
  Payload payload(source);
  const auto vertices = payload.number<std::uint64_t>(), faces = payload.number<std::uint64_t>(),
             edges = payload.number<std::uint64_t>(), points_listed = payload.number<std::uint64_t>();
  const std::uint64_t words = payload.left() / sizeof(VertexId);
  if (vertices == 0 || vertices > std::uint64_t{1} << 32) {
    payload.fail(fmt::format("a mesh of {} vertices; expected 1 to 4294967296", vertices));
  }
  if (faces > words || edges > words || points_listed > words) payload.fail("more cells than the block has bytes");
  payload.require(3 * faces + 2 * edges + points_listed, sizeof(VertexId), "the vertices of all cells");
  Mesh mesh;
  mesh.vertex_count = vertices;
  mesh.faces.resize(faces);
  mesh.edges.resize(edges);
  take_cells(payload, mesh.vertex_count, mesh.faces);
  take_cells(payload, mesh.vertex_count, mesh.edges);
  std::vector<std::array<VertexId, 1>> points(points_listed);
  take_cells(payload, mesh.vertex_count, points);
  for (const auto& [v] : points) mesh.points.push_back(v);
  return mesh;
}

std::vector<std::uint8_t> decode_labels(const Source& source, std::size_t vertex_count) {
  Payload payload(source);
  payload.require(vertex_count, 1, "the labels of all vertices");
  std::vector<std::uint8_t> labels(vertex_count);
  for (std::uint8_t& label : labels) {
    label = payload.number<std::uint8_t>();
    if (label > scripted_vertex) payload.fail(fmt::format("the label {} is not known; expected 0 or 1", label));
  }
  return labels;
}

Exclusions decode_exclusions(const Source& source, const Mesh& mesh) {
  Payload payload(source);
  Exclusions exclusions;
  const auto count = payload.number<std::uint32_t>();
  if (count == 0) payload.fail("no pairs of groups; expected at least one");
  payload.require(2 * std::uint64_t{count} + mesh.vertex_count, 2, "pairs of groups and the groups of all vertices");
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto a = payload.number<std::uint16_t>(), b = payload.number<std::uint16_t>();
    if (a > b || (i > 0 && Exclusions::Pair{a, b} <= exclusions.pairs.back())) {
      payload.fail(fmt::format("the pair of groups {} and {}; expected ascending pairs", a, b));
    }
    exclusions.pairs.push_back({a, b});
  }
  for (std::size_t i = 0; i < mesh.vertex_count; ++i) exclusions.groups.push_back(payload.number<std::uint16_t>());
  if (!cells_of_one_group(mesh, exclusions.groups)) payload.fail("a cell of two groups; expected cells of one");
  return exclusions;
}

RunWindow decode_window(const Source& source) {
  Payload payload(source);
  RunWindow window;
  window.index = payload.number<std::uint64_t>();
  window.begin = payload.finite("time");
  window.end = payload.finite("time");
  if (!(window.begin < window.end)) payload.fail(fmt::format("a window from {} to {}", window.begin, window.end));
  payload.finish();
  return window;
}

WorldLines decode_lines(const Source& source, std::uint32_t dimension, std::size_t vertex_count) {
  Payload payload(source);
  if (payload.left() / sizeof(std::uint32_t) < vertex_count) {
    payload.fail(fmt::format("{} bytes cannot hold the counts of {} vertices", payload.left(), vertex_count));
  }
  std::vector<std::uint32_t> counts(vertex_count);
  payload.numbers(std::span<std::uint32_t>(counts));
  std::vector<std::size_t> offsets{0};
  offsets.reserve(vertex_count + 1);
  for (const std::uint32_t count : counts) offsets.push_back(offsets.back() + count);
  payload.require(offsets.back(), (1 + dimension) * sizeof(double), "times and positions of all breakpoints");
  std::vector<double> times(offsets.back());
  payload.numbers(std::span<double>(times));
  return WorldLines::from_breakpoints(std::move(offsets), std::move(times), payload.vectors(dimension),
                                      source.file + ": " + byte_place(source.block.payload_offset()));
}

std::vector<Position> decode_vectors(const Source& source, std::uint32_t dimension, std::size_t vertex_count) {
  return Payload(source).finite_vectors(dimension, vertex_count);
}

RunFrame decode_frame(const Source& source, std::uint32_t dimension, std::size_t vertex_count) {
  Payload payload(source);
  RunFrame frame;
  frame.time = payload.finite("time");
  frame.positions = payload.finite_vectors(dimension, vertex_count);
  return frame;
}

void decode_lines_hash(const Source& source, RunWindow& window) {
  Payload payload(source);
  window.breakpoints = payload.number<std::uint64_t>();
  payload.require(window.lines_hash.size(), 1, "the bytes of a hash");
  payload.numbers(std::span<std::uint8_t>(window.lines_hash));
}

}  // namespace noli::run_block
