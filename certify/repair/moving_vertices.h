// SPDX-License-Identifier: Apache-2.0
//
// What a repair is asked to move: vertices that go as given whatever they meet, and the masses of the others.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include <noli/repair.h>

namespace noli {

/// By vertex, 1 if it moves as given. Throws UsageError.
std::vector<std::uint8_t> fixed_vertices(const RepairRequest& request, std::size_t count,
                                         const std::vector<FrameBody>& bodies);

/// The numbers in a text file, for RepairRequest::fixed_listed. Throws InputError, with the line: anything else.
std::vector<VertexId> listed_vertices(const std::filesystem::path& file);

/// By vertex, of any unit. Throws InputError.
std::vector<double> masses_of(const RepairRequest& request, const Mesh& mesh, std::span<const Position> x);

/// What moves as given: of each cell the vertices that do, as a cell. An edge of two cells is there twice, as a feature
/// of one may meet a feature of the other. `whole`: of cells that move as a whole alone.
Mesh fixed_parts(const Mesh& mesh, std::span<const std::uint8_t> fixed, bool whole);

}  // namespace noli
