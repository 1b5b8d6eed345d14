// SPDX-License-Identifier: Apache-2.0
//
// Which parts this noli was built or installed without.
#pragma once

#include <string>

namespace noli::app {

/// Whether `noli fuzz` and `noli audit` are part of this program.
bool has_audits();

/// A line for --version: "without reports, pictures", or "with all parts".
std::string parts_text();

}  // namespace noli::app
