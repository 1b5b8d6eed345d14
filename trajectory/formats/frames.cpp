// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/frames.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include <noli/errors.h>
#include "trajectory/formats/obj.h"
#include "trajectory/formats/ply.h"
#include "trajectory/formats/vtk/vtu.h"
#include "trajectory/text.h"

namespace noli {
namespace {

/// Throws when two lists of cells differ, naming the first difference.
template <class Cell>
void require_same_cells(std::string_view what, const std::vector<Cell>& expected, const std::string& expected_name,
                        const std::vector<Cell>& found, const std::string& found_name) {
  if (found.size() != expected.size()) {
    throw OtherMesh(
        found_name, "",
        fmt::format("has {} {}s, but {} has {}; all frames must have the same mesh; --body is for several bodies",
                    found.size(), what, expected_name, expected.size()));
  }
  const auto [theirs, ours] = std::mismatch(found.begin(), found.end(), expected.begin());
  if (theirs == found.end()) return;
  throw OtherMesh(found_name, "",
                  fmt::format("{} {} has vertices {}, but {} has {} there; all frames must have the same mesh; --body "
                              "is for several bodies",
                              what, theirs - found.begin(), *theirs, expected_name, *ours));
}

// --- Formats ---------------------------------------------------------------------------------------------------------

constexpr std::string_view arrays =
    "write positions (frames, vertices, 3) and faces from Python: numpy.savez(\"motion.npz\", x=positions, "
    "faces=faces)";
constexpr std::string_view scene =
    "import it into Blender and export Wavefront OBJ with Animation: one file for each frame; its text has 6 decimals";
constexpr std::string_view soup =
    "STL repeats every corner and has no shared vertices: export PLY or OBJ from the program that made it; otherwise "
    "merge equal corners in one frame and apply the same merge to all frames";

struct Advice {
  std::string_view extension, text;
};
constexpr std::array<Advice, 20> advices = {
    {{".h5", arrays},    {".hdf5", arrays},    {".mat", arrays},   {".abc", scene},        {".usd", scene},
     {".usda", scene},   {".usdc", scene},     {".usdz", scene},   {".glb", scene},        {".gltf", scene},
     {".fbx", scene},    {".dae", scene},      {".blend", scene},  {".stl", soup},         {".vtk", "meshio"},
     {".off", "meshio"}, {".gz", "gunzip -k"}, {".xz", "unxz -k"}, {".bz2", "bunzip2 -k"}, {".zst", "unzstd"}}};

}  // namespace

Frame read_frame(const std::filesystem::path& path) {
  mesh_format(path);  // before the file is opened
  return parse_frame(read_whole_file(path), path);
}

Frame parse_frame(std::string_view bytes, const std::filesystem::path& path, Polygons* polygons) {
  switch (mesh_format(path)) {
    case MeshFormat::ply: return parse_ply(bytes, path.string(), polygons);
    case MeshFormat::obj: return parse_obj(bytes, path.string(), polygons);
    case MeshFormat::vtk: return parse_vtk(bytes, path.string(), polygons);
  }
  throw std::logic_error("a format of meshes without a reader");
}

void require_same_mesh(const Mesh& expected, const std::filesystem::path& expected_path, const Mesh& found,
                       const std::filesystem::path& found_path) {
  const std::string expected_name = expected_path.string(), found_name = found_path.string();
  if (found.vertex_count != expected.vertex_count) {
    throw OtherMesh(
        found_name, "",
        fmt::format("has {} vertices, but {} has {}; all frames must have the same mesh; --body is for several bodies",
                    found.vertex_count, expected_name, expected.vertex_count));
  }
  require_same_cells("face", expected.faces, expected_name, found.faces, found_name);
  require_same_cells("loose edge", expected.edges, expected_name, found.edges, found_name);
  require_same_cells("loose point", expected.points, expected_name, found.points, found_name);
}

bool all_z_equal(std::span<const Position> positions) {
  return std::all_of(positions.begin(), positions.end(), [&](const Position& x) { return x[2] == positions[0][2]; });
}

bool in_one_plane(std::span<const Position> a, std::span<const Position> b) {
  return all_z_equal(a) && all_z_equal(b) && (a.empty() || a[0][2] == b[0][2]);
}

void require_one_plane(std::span<const Position> a, std::span<const Position> b, const std::string& name_b) {
  if (in_one_plane(a, b)) return;
  throw InputError(name_b, "",
                   "leaves the plane of the frames before; expected the same z everywhere (see --dimension)");
}

std::string conversion_advice(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  const auto* const found = std::ranges::find(advices, extension, &Advice::extension);
  if (found == advices.end()) return "";
  if (found->text == arrays || found->text == scene || found->text == soup) return std::string(found->text);
  const std::string name = path.filename().string(), stem = path.stem().string();
  if (found->text == "meshio") return fmt::format("convert it: meshio convert {} {}.ply", name, stem);
  return fmt::format("unpack it: {} {}", found->text, name);
}

std::string extension_of(const std::filesystem::path& path) {
  std::string text = path.extension().string();
  std::ranges::transform(text, text.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

namespace {

std::optional<MeshFormat> format_of(std::string_view extension) {
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".vtu" || extension == ".vtp") return MeshFormat::vtk;
  return std::nullopt;
}

}  // namespace

bool is_frame_name(const std::filesystem::path& path) { return format_of(extension_of(path)).has_value(); }

MeshFormat mesh_format(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (const auto format = format_of(extension)) return *format;
  const std::string advice = conversion_advice(path);
  throw InputError(path.string(), "",
                   fmt::format("expected a file that ends in .ply, .obj, .vtu or .vtp, found {}{}{}",
                               in_quotes(extension), advice.empty() ? "" : "; ", advice));
}

}  // namespace noli
