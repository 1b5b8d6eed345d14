// SPDX-License-Identifier: Apache-2.0
//
// Frames as ParaView and VTK write them: unstructured grids (.vtu) and polygonal data (.vtp), of any number of pieces.
//
//   cells   vertices, lines and their strips, triangles and their strips, polygons, quads, pixels. Others, such as
//           tetrahedra, are refused: extract the surface first
//
// What this does not do: it reads no data of points or cells but what the mesh is made of.
#pragma once

#include <string>
#include <string_view>

#include <noli/mesh.h>
#include "trajectory/formats/polygons.h"

namespace noli {

/// What the coordinates of the first piece are: "Float64", and the text of those that are text.
struct VtkNumbers {
  std::string type, text;
};

/// Throws InputError with the element that is at fault. `polygons`: what to do with those, and where they are noted.
/// `numbers`: where to note what the coordinates are.
Frame parse_vtk(std::string_view bytes, const std::string& file, Polygons* polygons = nullptr,
                VtkNumbers* numbers = nullptr);

}  // namespace noli
