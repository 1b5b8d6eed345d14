// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/write_ply.h"

#include <fmt/format.h>

#include <iterator>

#include "trajectory/blocks/bytes.h"
#include "trajectory/write_file.h"

namespace noli {
namespace {

std::string header(const Mesh& mesh, PlyEncoding encoding) {
  std::string text = fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar uint vertex_indices\n",
      encoding == PlyEncoding::ascii ? "ascii" : "binary_little_endian", mesh.vertex_count,
      mesh.faces.size() + mesh.points.size());
  if (!mesh.edges.empty()) {
    text += fmt::format("element edge {}\nproperty uint vertex1\nproperty uint vertex2\n", mesh.edges.size());
  }
  return text + "end_header\n";
}

void append_ascii(std::string& text, const Frame& frame) {
  const auto out = std::back_inserter(text);
  for (const Position& x : frame.positions) fmt::format_to(out, "{:.17g} {:.17g} {:.17g}\n", x[0], x[1], x[2]);
  for (const auto& f : frame.mesh.faces) fmt::format_to(out, "3 {} {} {}\n", f[0], f[1], f[2]);
  for (const VertexId v : frame.mesh.points) fmt::format_to(out, "1 {}\n", v);
  for (const auto& e : frame.mesh.edges) fmt::format_to(out, "{} {}\n", e[0], e[1]);
}

void append_binary(std::string& bytes, const Frame& frame) {
  for (const Position& x : frame.positions) put_all(bytes, std::span<const double>(x));
  for (const auto& face : frame.mesh.faces) {
    put(bytes, std::uint8_t{3});
    put_all(bytes, std::span<const VertexId>(face));
  }
  for (const VertexId v : frame.mesh.points) {
    put(bytes, std::uint8_t{1});
    put(bytes, v);
  }
  for (const auto& edge : frame.mesh.edges) put_all(bytes, std::span<const VertexId>(edge));
}

}  // namespace

std::string format_ply(const Frame& frame, PlyEncoding encoding) {
  std::string bytes = header(frame.mesh, encoding);
  if (encoding == PlyEncoding::ascii) {
    append_ascii(bytes, frame);
  } else {
    append_binary(bytes, frame);
  }
  return bytes;
}

void write_ply(const std::filesystem::path& path, const Frame& frame, PlyEncoding encoding) {
  write_file(path, format_ply(frame, encoding));
}

}  // namespace noli
