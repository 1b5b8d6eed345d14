// SPDX-License-Identifier: Apache-2.0
//
// The worked examples of pages of documentation, run as they stand.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace noli::app_tests {

/// Runs the commands of a page from the folder of the sources, each `from` of `replacements` in them as its `to`, and
/// expects of each the first line, and of `echo $?` the exit code, that the page says.
void expect_worked_example(const std::string& page, std::size_t commands,
                           const std::vector<std::pair<std::string, std::string>>& replacements);

}  // namespace noli::app_tests
