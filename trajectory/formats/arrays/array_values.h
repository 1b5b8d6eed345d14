// SPDX-License-Identifier: Apache-2.0
//
// From the numbers of arrays to cells and positions. Memory grows with the bytes that have come: no shape is believed.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <noli/mesh.h>
#include "trajectory/formats/arrays/npy.h"

namespace noli {

/// All numbers of an array, the last index running fastest whatever its order is. Throws InputError, Stopped.
/// Precondition: one or two dimensions; integers, or real numbers.
std::vector<std::int64_t> integers_of(ByteStream& bytes, const NpyHeader& header, const std::string& name);
std::vector<double> reals_of(ByteStream& bytes, const NpyHeader& header, const std::string& name);

/// How many vertices a cell has in an array of cells: 1 where it has one dimension.
std::size_t corners_of(const NpyHeader& header);

/// Appends cells of so many vertices each. Throws InputError where one is not below mesh.vertex_count.
void append_cells(Mesh& mesh, std::span<const std::int64_t> vertices, std::size_t corners, const std::string& name);

/// Throws InputError where one is not finite. `coordinates`: 2 or 3 of each vertex. `frame`: what errors call it.
std::vector<Position> positions_of(std::span<const double> numbers, std::size_t coordinates, const std::string& frame);

}  // namespace noli
