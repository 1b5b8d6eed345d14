// SPDX-License-Identifier: Apache-2.0
//
// Reads the meshes in Wavefront OBJ files.
//
//   v x y [z]      a vertex; z = 0 if no vertex of the file has one. A weight, a colour, or a weight and a colour may
//                  follow z: finite numbers that are ignored
//   f a b c ...    a polygon (trajectory/cells.h), three corners or more
//   l a b ...      a line through two vertices or more: loose edges
//   p a ...        loose points
//
// A corner is v, v/vt, v//vn or v/vt/vn; everything after the first '/' is ignored.
// Indices count from 1, negative ones back from the last vertex so far; a positive one may refer to a vertex that
// follows. A '#' that begins a word begins a comment. A '\' at the end of a line joins the next one to it. Ignored: vt
// vn vp g o s mg usemtl mtllib usemap maplib lod bevel c_interp d_interp shadow_obj trace_obj. Every other statement
// (curves, surfaces) is an error: ignoring it could lose faces.
#pragma once

#include <string>
#include <string_view>

#include <noli/mesh.h>
#include "trajectory/formats/polygons.h"

namespace noli {

/// Reads the text of an OBJ file; errors name `file`. `polygons`: the rule for polygons, which are also listed there.
/// Throws InputError with the line for anything else than the above.
Frame parse_obj(std::string_view text, const std::string& file, Polygons* polygons = nullptr);

}  // namespace noli
