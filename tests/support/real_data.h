// SPDX-License-Identifier: Apache-2.0
//
// Finds real data for tests and benchmarks: in the folder named by the environment variable NOLI_DATA, else in
// ../shared/data beside the source tree. The folder need not exist.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace noli::test {

/// A file or folder of the real data. If it is missing, returns nullopt and prints what is skipped to standard error.
std::optional<std::filesystem::path> real_data(const std::string& name);

}  // namespace noli::test
