// SPDX-License-Identifier: Apache-2.0
//
// Tests one point of the sweeps of stability.h: runs `noli` on a scene or on two frames.
#pragma once

#include <filesystem>

#include "audit/numerics/stability.h"

namespace noli::audit {

/// Writes the input and the runs into `folder`, which must be empty. Does not fill in the value. After a stop the other
/// results are meaningless. Throws like audit_stability().
StabilityPoint ask_point(const StabilityCase& what, const std::filesystem::path& folder,
                         const StabilityOptions& options);

/// The bytes of a file; empty if it cannot be read.
std::string bytes_of(const std::filesystem::path& path);

}  // namespace noli::audit
