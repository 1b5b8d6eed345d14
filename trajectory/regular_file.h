// SPDX-License-Identifier: Apache-2.0
//
// Files that have to be files: whoever opens a pipe waits for its writer.
#pragma once

#include <filesystem>
#include <fstream>

namespace noli {

/// Throws InputError when there is something else by that name: a folder, a pipe, a device. Links are followed.
void require_regular_file(const std::filesystem::path& path);

/// Opens it for reading. Throws InputError when it cannot be opened, or is no regular file.
std::ifstream open_regular_file(const std::filesystem::path& path);

}  // namespace noli
