// SPDX-License-Identifier: Apache-2.0
//
// `noli verify --static` of files with different meshes: each is verified by itself.
#pragma once

#include <vector>

#include <noli/verify.h>
#include "report/meshes_report.h"

namespace noli::app {

/// Verifies each frame of the request alone. `result`: also keeps what the JSON has of each. Stops when the process is
/// interrupted; files that were not begun are then undecided. Throws as run_verify().
std::vector<report::MeshVerdict> verify_meshes(const VerifyRequest& request, bool result);

}  // namespace noli::app
