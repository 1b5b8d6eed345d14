// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/frame_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "trajectory/error.h"
#include "trajectory/text.h"

namespace noli {
namespace {

/// In lower case.
std::string extension_of(const std::filesystem::path& path) {
  std::string text = path.extension().string();
  std::ranges::transform(text, text.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

constexpr std::string_view arrays =
    "write each frame as PLY from Python, which keeps float64: "
    "meshio.Mesh(points, [(\"triangle\", faces)]).write(\"frame_0.ply\")";
constexpr std::string_view scene =
    "import it into Blender and export Wavefront OBJ with Animation: one file for each frame; its text has 6 decimals";
constexpr std::string_view soup =
    "STL repeats every corner and has no shared vertices: export PLY or OBJ from the program that made it; otherwise "
    "merge equal corners in one frame and apply the same merge to all frames";

struct Advice {
  std::string_view extension, text;
};
constexpr std::array<Advice, 24> advices = {
    {{".npz", arrays},     {".npy", arrays},   {".h5", arrays},        {".hdf5", arrays},    {".mat", arrays},
     {".abc", scene},      {".usd", scene},    {".usda", scene},       {".usdc", scene},     {".usdz", scene},
     {".glb", scene},      {".gltf", scene},   {".fbx", scene},        {".dae", scene},      {".blend", scene},
     {".stl", soup},       {".vtk", "meshio"}, {".vtu", "meshio"},     {".vtp", "ParaView"}, {".off", "meshio"},
     {".gz", "gunzip -k"}, {".xz", "unxz -k"}, {".bz2", "bunzip2 -k"}, {".zst", "unzstd"}}};

}  // namespace

std::string conversion_advice(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  const auto* const found = std::ranges::find(advices, extension, &Advice::extension);
  if (found == advices.end()) return "";
  if (found->text == arrays || found->text == scene || found->text == soup) return std::string(found->text);
  const std::string name = path.filename().string(), stem = path.stem().string();
  if (found->text == "meshio") return fmt::format("convert it: meshio convert {} {}.ply", name, stem);
  if (found->text == "ParaView") return fmt::format("open it in ParaView and save the data as {}.ply", stem);
  return fmt::format("unpack it: {} {}", found->text, name);
}

MeshFormat mesh_format(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".obj") return MeshFormat::obj;
  const std::string advice = conversion_advice(path);
  throw InputError(path.string(), "",
                   fmt::format("expected a file that ends in .ply or .obj, found {}{}{}", in_quotes(extension),
                               advice.empty() ? "" : "; ", advice));
}

}  // namespace noli
