// SPDX-License-Identifier: Apache-2.0
//
// Reads PLY files: ASCII, binary little-endian, binary big-endian.
//
//   element vertex   properties x, y and, where there is one, z, of any scalar type
//   element face     one list vertex_indices or vertex_index of any integer types: polygons (cells.h); none is empty
//   element edge     vertex1 and vertex2 of any integer types: a loose edge, unless a face has it (cells.h)
//   anything else    skipped, except tristrips: leaving them out would lose faces
//
// The declared type is what is read, in ASCII too: a float is rounded to float and then widened, so one mesh is the
// same in all three encodings. A number beyond the type's range, or so small that it would become 0, is an error, and
// so is an integer that is no double. In ASCII an entry is one line, and blank lines are skipped. Nothing may follow
// the last entry.
//
// What this does not do: it writes nothing (write_ply.h), welds nothing, and keeps no other property.
#pragma once

#include <string>
#include <string_view>

#include <noli/mesh.h>
#include "trajectory/formats/polygons.h"

namespace noli {

/// Reads the bytes of a PLY file; `file` is what errors call them. `polygons`: what to do with those, and where they
/// are noted. Throws InputError with line (header and ASCII) or byte (binary) for anything that is not as above: empty,
/// truncated, NaN or infinite coordinates, indices out of range, trailing content, malformed headers. Counts are
/// compared with the bytes that remain before anything is allocated for them.
Frame parse_ply(std::string_view bytes, const std::string& file, Polygons* polygons = nullptr);

}  // namespace noli
