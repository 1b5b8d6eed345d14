// SPDX-License-Identifier: Apache-2.0
//
// Reads PLY files: ASCII, binary little-endian, binary big-endian.
//
//   element vertex   properties x, y and optionally z, of any scalar type
//   element face     one list vertex_indices or vertex_index of any integer types: polygons (trajectory/cells.h), none
//                    empty
//   element edge     vertex1 and vertex2 of any integer types: a loose edge, unless a face has it (trajectory/cells.h)
//   anything else    skipped, except tristrips, which are an error: skipping them would lose faces
//
// Values have their declared type, in ASCII too: a float is rounded to float and then widened, so a mesh is the same in
// all three encodings. It is an error if a number is beyond the type's range, or so small that it would become 0, or if
// an integer is not a double. In ASCII an entry is one line, and blank lines are skipped. Nothing may follow the last
// entry.
//
// It welds nothing. write_ply.h writes PLY files.
#pragma once

#include <string>
#include <string_view>

#include <noli/mesh.h>
#include "trajectory/formats/polygons.h"

namespace noli {

/// Reads the bytes of a PLY file; errors name `file`. `polygons`: the rule for polygons, which are also listed there.
/// Throws InputError with line (header and ASCII) or byte (binary) for anything else than the above: empty, truncated,
/// NaN or infinite coordinates, indices out of range, trailing content, malformed headers. Counts are compared with the
/// remaining bytes before anything is allocated for them.
Frame parse_ply(std::string_view bytes, const std::string& file, Polygons* polygons = nullptr);

}  // namespace noli
