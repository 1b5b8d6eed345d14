// SPDX-License-Identifier: Apache-2.0
//
// `noli verify --static` of files with different meshes: each is verified by itself.
#pragma once

#include <vector>

#include <noli/verify.h>
#include "report/meshes_report.h"

namespace noli::app {

/// What is kept of each file.
struct MeshesWanted {
  bool json = false, details = false;
};

/// Verifies each file of the request alone. When the process is interrupted, the files that are left are undecided.
/// Throws as run_verify() and ProofRoute::check().
std::vector<report::MeshVerdict> verify_meshes(VerifyRequest request, MeshesWanted wanted);

}  // namespace noli::app
