// SPDX-License-Identifier: Apache-2.0
//
// Results that noli wrote with --json, as a report shows them.
//
// What this does not do: whether a result is about the very files that are shown is asked before (report_inputs.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <noli/errors.h>
#include "report/page/report_page.h"

namespace noli::report {

/// Throws InputError when it is no JSON object, has a number beyond the range of double, or more than 64 levels. Whole
/// numbers of which a browser would lose digits become texts.
Json read_result(const std::filesystem::path& path);

/// Whether it is one of `noli verify`, with contacts and a statement.
bool is_of_verify(const Json& result);

bool is_of_repair(const Json& result);

/// Calls f, which takes members of a result of `noli verify` as they should be. Throws InputError where they are not.
template <class F>
auto as_written(const std::filesystem::path& path, F&& f) {
  try {
    return f();
  } catch (const Json::exception& error) {
    throw InputError(path.string(), "", std::string("is not a result of noli verify: ") + error.what());
  }
}

/// Of how many frames, or windows of a run, a result of `noli verify` is, and which of the two. Throws InputError when
/// it does not say.
struct VerifiedSteps {
  bool run = false;
  std::uint64_t count = 0;
  bool at_rest = false;
  bool flat = false;  ///< in two dimensions
};
VerifiedSteps verified_steps(const Json& result, const std::filesystem::path& path);

/// Fills verdict, statement, contacts from a result of `noli verify`. Throws InputError where members are not as `noli
/// verify` writes them; or where it names or counts another mesh than that of the scene, if there is one.
void put_verdict(const Json& result, const std::filesystem::path& path, ReportPage& report);

/// "cloth.json", "cloth" for the folder of a run: as a page calls an input. Not where it is, which is nobody's matter.
std::string page_name(const std::filesystem::path& path);

}  // namespace noli::report
