// SPDX-License-Identifier: Apache-2.0
//
// Is this file a shared library of this machine? The loader's own words for one that is not are misleading.
//
// What this does not do: it reads the first bytes. Whether the rest is whole, the loader finds out.
#pragma once

#include <filesystem>

namespace noli::audit {

/// Throws InputError, with what the file is instead.
void require_shared_library(const std::filesystem::path& file);

}  // namespace noli::audit
