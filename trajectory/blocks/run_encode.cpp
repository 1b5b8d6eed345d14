// SPDX-License-Identifier: Apache-2.0
#include "trajectory/blocks/bytes.h"
#include "trajectory/blocks/run_checks.h"
#include "trajectory/blocks/run_payload.h"

namespace noli::run_block {
namespace {

void put_positions(std::string& out, std::uint32_t dimension, std::span<const Position> positions) {
  if (dimension == 3) return put_all(out, coordinates(positions));
  for (const Position& x : positions) put_all(out, std::span<const double>(x).first(2));
}

/// Collects bytes and passes them on in parts that are large enough to be efficient and still fit the processor's
/// cache.
class Parts {
 public:
  explicit Parts(const ByteConsumer& consumer) : consumer_(consumer) {}

  /// Where the next bytes are to be appended.
  std::string& next() {
    if (bytes_.size() >= enough) flush();
    return bytes_;
  }
  void flush() {
    consumer_(bytes_);
    bytes_.clear();
  }

 private:
  static constexpr std::size_t enough = std::size_t{1} << 17;
  const ByteConsumer& consumer_;
  std::string bytes_;
};

}  // namespace

std::string encode_head(const RunHeader& header) {
  std::string out;
  put(out, header.dimension);
  put(out, static_cast<std::uint32_t>(header.record));
  put(out, header.window_length);
  return out;
}

std::string encode_mesh(const Mesh& mesh) {
  std::string out;
  for (const std::size_t count : {mesh.vertex_count, mesh.faces.size(), mesh.edges.size(), mesh.points.size()}) {
    put(out, std::uint64_t{count});
  }
  for (const auto& face : mesh.faces) put_all(out, std::span<const VertexId>(face));
  for (const auto& edge : mesh.edges) put_all(out, std::span<const VertexId>(edge));
  put_all(out, std::span<const VertexId>(mesh.points));
  return out;
}

std::string encode_labels(std::span<const std::uint8_t> labels) { return {labels.begin(), labels.end()}; }

std::string encode_exclusions(const Exclusions& exclusions) {
  std::string out;
  put(out, static_cast<std::uint32_t>(exclusions.pairs.size()));
  for (const Exclusions::Pair& pair : exclusions.pairs) put_all(out, std::span<const std::uint16_t>(pair));
  put_all(out, std::span<const std::uint16_t>(exclusions.groups));
  return out;
}

std::string encode_window(std::uint64_t index, double begin, double end) {
  std::string out;
  put(out, index);
  put(out, begin);
  put(out, end);
  return out;
}

std::uint64_t encoded_lines_size(std::uint32_t dimension, const WorldLines& lines) {
  return lines.vertex_count() * sizeof(std::uint32_t) + count_breakpoints(lines) * (1 + dimension) * sizeof(double);
}

void encode_lines(std::uint32_t dimension, const WorldLines& lines, const ByteConsumer& consumer) {
  Parts parts(consumer);
  const auto vertex_count = static_cast<VertexId>(lines.vertex_count());
  for (VertexId v = 0; v < vertex_count; ++v) put(parts.next(), static_cast<std::uint32_t>(lines.times(v).size()));
  for (VertexId v = 0; v < vertex_count; ++v) put_all(parts.next(), lines.times(v));
  for (VertexId v = 0; v < vertex_count; ++v) put_positions(parts.next(), dimension, lines.positions(v));
  parts.flush();
}

std::string encode_vectors(std::uint32_t dimension, std::span<const Position> vectors) {
  std::string out;
  out.reserve(vectors.size() * dimension * sizeof(double));
  put_positions(out, dimension, vectors);
  return out;
}

std::string encode_frame(std::uint32_t dimension, const RunFrame& frame) {
  std::string out;
  put(out, frame.time);
  return out += encode_vectors(dimension, frame.positions);
}

std::string encode_lines_hash(std::uint64_t breakpoints, const Sha256Digest& hash) {
  std::string out;
  put(out, breakpoints);
  return out.append(bytes_of(hash));
}

}  // namespace noli::run_block
