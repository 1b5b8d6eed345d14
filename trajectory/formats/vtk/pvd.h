// SPDX-License-Identifier: Apache-2.0
//
// Series of ParaView (.pvd): the files of frames, with a time each.
#pragma once

#include <filesystem>
#include <vector>

namespace noli {

/// The files in the order of time, relative to the series' folder. Throws InputError: times that do not ascend, for
/// example because a time has several parts.
std::vector<std::filesystem::path> files_of_pvd(const std::filesystem::path& series);

}  // namespace noli
