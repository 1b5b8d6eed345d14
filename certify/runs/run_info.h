// SPDX-License-Identifier: Apache-2.0
//
// What is in the folder of a run, for `noli info`.
#pragma once

#include <filesystem>

#include "certify/json.h"

namespace noli {

/// Reads the run from beginning to end, one window at a time, checking what its files say of themselves and what its
/// log says of them. Throws InputError when it is no run or is damaged.
Json run_info(const std::filesystem::path& folder);

}  // namespace noli
