// SPDX-License-Identifier: Apache-2.0
//
// What must hold between the windows of a run and within one. Whoever writes a run keeps to it (or the program is at
// fault), whoever reads one checks it (or the file is). Internal to run_file.h.
//
// Each function gives "" when all is well, else what is wrong.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "trajectory/blocks/run_file.h"

namespace noli {

/// Equal bit for bit: 0 and -0 differ.
bool same_bits(double a, double b);
bool same_bits(const Position& a, const Position& b);

/// Whether the vertices of each cell are of one group. Precondition: a group for each vertex.
bool cells_of_one_group(const Mesh& mesh, std::span<const std::uint16_t> groups);

std::vector<Position> positions_at_end(const WorldLines& lines);
std::uint64_t count_breakpoints(const WorldLines& lines);

/// A window that begins at this time goes on from the one before.
std::string time_problem(const WindowEnd& before, double begin);
/// ... with the first positions of these.
std::string position_problem(const WindowEnd& before, const WorldLines& lines);

/// Frames ascend in time. Those of window 0 are in [begin, end], those of later ones in (begin, end], so that each
/// moment belongs to one window; one at the end has the positions there.
std::string frames_problem(std::uint64_t index, double begin, const WindowEnd& end, std::span<const RunFrame> frames);

}  // namespace noli
