// SPDX-License-Identifier: Apache-2.0
//
// One point of the sweeps of stability.h: a scene, or two frames, and what `noli` makes of it.
#pragma once

#include <filesystem>

#include "audit/numerics/stability.h"

namespace noli::audit {

/// `folder` is empty, and takes the input and the runs. The value is not filled in; after a stop the rest is of no use.
/// Throws as audit_stability() does.
StabilityPoint ask_point(const StabilityCase& what, const std::filesystem::path& folder,
                         const StabilityOptions& options);

/// Of a file; nothing where it cannot be read.
std::string bytes_of(const std::filesystem::path& path);

}  // namespace noli::audit
