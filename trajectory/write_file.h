// SPDX-License-Identifier: Apache-2.0
//
// Whole files, written at once.
#pragma once

#include <filesystem>
#include <string_view>

namespace noli {

/// Writes the file, or what was there is overwritten. Throws std::system_error, naming the file, when it cannot be
/// written in full; then part of it may be there.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// The same by way of a new file beside it (".noli-0", or the next number that is free) that is synced and then takes
/// the name: at any moment, even after a loss of power, the old file is there or the new one. Throws std::system_error;
/// then the old one is. Throws it too when what is there is no regular file (but a device, a pipe, a link).
void replace_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace noli
