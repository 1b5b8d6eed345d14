// SPDX-License-Identifier: Apache-2.0
//
// Joins what checkers said of the parts of one proof, on other machines for example, to one answer.
#pragma once

#include <filesystem>
#include <vector>

#include "report/check_report.h"

namespace noli::app {

/// What one checker would say of all steps, from files of `noli check --json` about parts, in any order. Nothing is
/// checked again: the files are trusted. Throws InputError unless all of them accept parts of one proof, asked for with
/// the same options, that cover its steps from the first to the last exactly once. Precondition: there is a file.
report::Checked joined_answers(const std::vector<std::filesystem::path>& files);

}  // namespace noli::app
