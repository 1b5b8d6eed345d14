// SPDX-License-Identifier: Apache-2.0
//
// Writes whole files at once.
#pragma once

#include <filesystem>
#include <string_view>

namespace noli {

/// Creates or overwrites the file. Throws std::system_error, naming the file, when it cannot be written in full; part
/// of it may then be written.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// The same by way of a ReplacedFile: at any moment, even after a loss of power, either the old or the new file is
/// there. Throws std::system_error; the old file then stays. Also throws it if the path names something else than a
/// regular file (a device, a pipe, a link).
void replace_file(const std::filesystem::path& path, std::string_view bytes);

/// Writes all bytes to an open file. False, with errno, when that fails.
bool write_all(int descriptor, std::string_view bytes);

}  // namespace noli
