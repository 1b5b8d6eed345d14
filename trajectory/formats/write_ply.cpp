// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/write_ply.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <iterator>

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

class AsciiBody {
 public:
  explicit AsciiBody(std::string& text) : out_(text) {}
  void position(const Position& x) {
    fmt::format_to(std::back_inserter(out_), "{:.17g} {:.17g} {:.17g}\n", x[0], x[1], x[2]);
  }
  void face(const std::array<VertexId, 3>& f) {
    fmt::format_to(std::back_inserter(out_), "3 {} {} {}\n", f[0], f[1], f[2]);
  }
  void point(VertexId v) { fmt::format_to(std::back_inserter(out_), "1 {}\n", v); }
  void edge(const std::array<VertexId, 2>& e) { fmt::format_to(std::back_inserter(out_), "{} {}\n", e[0], e[1]); }

 private:
  std::string& out_;
};

class BinaryBody {
 public:
  explicit BinaryBody(std::string& bytes) : out_(bytes) {}
  void position(const Position& x) {
    for (const double coordinate : x) put(std::bit_cast<std::uint64_t>(coordinate));
  }
  void face(const std::array<VertexId, 3>& f) {
    put(std::uint8_t{3});
    for (const VertexId v : f) put(v);
  }
  void point(VertexId v) {
    put(std::uint8_t{1});
    put(v);
  }
  void edge(const std::array<VertexId, 2>& e) {
    for (const VertexId v : e) put(v);
  }

 private:
  /// Little-endian whatever the machine.
  template <class T>
  void put(T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) out_ += static_cast<char>(value >> (8 * i) & 0xff);
  }
  std::string& out_;
};

template <class Body>
void append_body(const Frame& frame, Body body) {
  for (const Position& x : frame.positions) body.position(x);
  for (const auto& face : frame.mesh.faces) body.face(face);
  for (const VertexId v : frame.mesh.points) body.point(v);
  for (const auto& edge : frame.mesh.edges) body.edge(edge);
}

}  // namespace

std::string format_ply(const Frame& frame, PlyEncoding encoding) {
  std::string bytes = header(frame.mesh, encoding);
  if (encoding == PlyEncoding::ascii) {
    append_body(frame, AsciiBody(bytes));
  } else {
    append_body(frame, BinaryBody(bytes));
  }
  return bytes;
}

void write_ply(const std::filesystem::path& path, const Frame& frame, PlyEncoding encoding) {
  write_file(path, format_ply(frame, encoding));
}

}  // namespace noli
