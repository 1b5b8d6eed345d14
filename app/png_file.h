// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "noli/app/picture.h"

namespace noli::app {

/// Whether this program was built with a library for it.
bool can_write_png();

/// Throws std::system_error when the file cannot be written, std::logic_error without a library.
void write_png(const std::filesystem::path& path, const Picture& picture);

}  // namespace noli::app
