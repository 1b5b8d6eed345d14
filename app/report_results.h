// SPDX-License-Identifier: Apache-2.0
//
// Results that noli wrote with --json, as a report shows them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "noli/app/report_page.h"

namespace noli::app {

/// Throws InputError when it is no JSON object.
Json read_result(const std::filesystem::path& path);

/// Whether it is one of `noli verify`, with contacts and a statement.
bool is_of_verify(const Json& result);

/// Of how many frames, or windows of a run, a result of `noli verify` is, and which of the two. Throws InputError when
/// it does not say.
struct VerifiedSteps {
  bool run = false;
  std::uint64_t count = 0;
  bool at_rest = false;
};
VerifiedSteps verified_steps(const Json& result, const std::filesystem::path& path);

/// Fills verdict, statement, contacts from a result of `noli verify`; `vertices`: of the mesh that is shown, or nothing.
/// Throws InputError where members are not as `noli verify` writes them, or name a vertex that the mesh has not.
void put_verdict(const Json& result, const std::filesystem::path& path, std::optional<std::uint64_t> vertices,
                 ReportPage& report);

}  // namespace noli::app
