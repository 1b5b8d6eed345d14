// SPDX-License-Identifier: Apache-2.0
//
// The page of reports without its data: viewer/ as it was bundled when this was built (NOLI_WITH_REPORT).
#pragma once

#include <string_view>

namespace noli::report {

/// Whether there is one.
bool has_report_page();

/// HTML with the places @TITLE@, @PAGE@, @CELLS@ and @MOTION@. Precondition: has_report_page().
std::string_view report_page();

}  // namespace noli::report
