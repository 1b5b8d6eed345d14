// SPDX-License-Identifier: Apache-2.0
//
// Reads Wavefront OBJ files, as far as they are meshes.
//
//   v x y [z]      a vertex; without z, z = 0. After z may follow a weight, a colour, or a weight and a colour: finite
//                  numbers that are ignored
//   f a b c ...    a polygon (cells.h), three corners or more
//   l a b ...      a line through two vertices or more: loose edges
//   p a ...        loose points
//
// A corner is v, v/vt, v//vn or v/vt/vn; what follows the first '/' is not looked at.
// Indices count from 1, negative ones back from the last vertex so far; a positive one may refer to a vertex that
// follows. A '#' that begins a word begins a comment. A '\' at the end of a line joins the next one to it. Ignored: vt
// vn vp g o s mg usemtl mtllib usemap maplib lod bevel c_interp d_interp shadow_obj trace_obj. Every other statement
// (curves, surfaces) is an error: leaving it out could lose faces.
#pragma once

#include <string>
#include <string_view>

#include <noli/mesh.h>
#include "trajectory/formats/polygons.h"

namespace noli {

/// Reads the text of an OBJ file; `file` is what errors call it. `polygons`: what to do with those, and where they are
/// noted. Throws InputError with the line for anything that is not as above.
Frame parse_obj(std::string_view text, const std::string& file, Polygons* polygons = nullptr);

}  // namespace noli
