// SPDX-License-Identifier: Apache-2.0
//
// Checks what must hold within a window of a run and between windows. A failure in writing is a fault of the program, a
// failure in reading one of the file.
//
// A function that returns a string gives "" if all is well, otherwise what is wrong.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "trajectory/blocks/run_file.h"

namespace noli {

/// Equal bit for bit: 0 and -0 differ.
bool same_bits(double a, double b);
bool same_bits(const Position& a, const Position& b);
bool same_bits(std::span<const Position> a, std::span<const Position> b);

/// Whether all vertices of each cell have the same group. Precondition: a group for each vertex.
bool cells_of_one_group(const Mesh& mesh, std::span<const std::uint16_t> groups);

std::vector<Position> positions_at_end(const WorldLines& lines);
std::uint64_t count_breakpoints(const WorldLines& lines);

/// Whether a window that begins at this time continues the previous one.
std::string time_problem(const WindowEnd& before, double begin);
/// Whether the first positions of these lines continue the previous window.
std::string position_problem(const WindowEnd& before, const WorldLines& lines);

/// Frames must ascend in time. Those of window 0 are in [begin, end], those of later windows in (begin, end], so that
/// each moment belongs to one window. A frame at the end must have the positions there.
std::string frames_problem(std::uint64_t index, double begin, const WindowEnd& end, std::span<const RunFrame> frames);

}  // namespace noli
