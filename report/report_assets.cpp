// SPDX-License-Identifier: Apache-2.0
#include "report/report_assets.h"

#ifdef NOLI_WITH_REPORT

/// Made by viewer/embed.cmake.
extern const char noli_report_page[];
extern const unsigned long noli_report_page_size;

namespace noli::report {

bool has_report_page() { return true; }
std::string_view report_page() { return {noli_report_page, noli_report_page_size}; }

}  // namespace noli::report

#else

namespace noli::report {

bool has_report_page() { return false; }
std::string_view report_page() { return {}; }

}  // namespace noli::report

#endif
