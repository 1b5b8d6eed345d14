// SPDX-License-Identifier: Apache-2.0
//
// Where tests and benchmarks find real data: the folder that the environment variable NOLI_DATA names, else
// ../shared/data beside the source tree. It need not exist.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace noli::test {

/// A file or folder of the real data; nothing when it is not there, and then what is skipped is said on standard error.
std::optional<std::filesystem::path> real_data(const std::string& name);

}  // namespace noli::test
