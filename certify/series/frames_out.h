// SPDX-License-Identifier: Apache-2.0
//
// Writes the frames of an HDF5 file as noli reads them from standard input: arrays of numpy, cells first, then the
// positions of each frame (trajectory/formats/arrays/stream_frames.h). Numbers keep their type and bits.
#pragma once

#include <noli/frames.h>

namespace noli::series {

/// Writes the frames of the file on a descriptor to another one. A line on standard error says what was done with
/// polygons. Throws BadInput; ends the program when nobody reads.
void write_frames(int input, int output, PolygonRule rule);

/// Writes a line about them, without the frames: "60 1000 1922 float64 0 HASH", the numbers of frames, of vertices and
/// cells of each, the type of coordinates, how many polygons are cut, and the SHA-256 of the cells. Throws BadInput
/// when frames are not of one mesh.
void write_look(int input, int output, PolygonRule rule);

}  // namespace noli::series
