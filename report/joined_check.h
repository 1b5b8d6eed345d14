// SPDX-License-Identifier: Apache-2.0
//
// Joins what checkers said of the parts of one proof, on other machines for example, into one answer.
#pragma once

#include <string>
#include <vector>

#include "report/check_report.h"

namespace noli::report {

/// A document of schema check.
struct PartAnswer {
  std::string name;  ///< of its file, for errors
  Json json;
};

/// What one checker would say of all steps, from answers about parts, in any order. Nothing is checked again: the
/// answers are trusted. Throws InputError unless all of them accept parts of one proof, asked for with the same
/// options, that cover its steps from the first to the last exactly once. Precondition: there is one.
Checked joined_check(const std::vector<PartAnswer>& answers);

}  // namespace noli::report
