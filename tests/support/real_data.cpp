// SPDX-License-Identifier: Apache-2.0
#include "tests/support/real_data.h"

#include <cstdio>
#include <cstdlib>

namespace noli::test {

std::optional<std::filesystem::path> real_data(const std::string& name) {
  const char* const given = std::getenv("NOLI_DATA");
  const std::filesystem::path root =
      given != nullptr ? std::filesystem::path(given) : std::filesystem::path(NOLI_SOURCE_DIR) / "../shared/data";
  const std::filesystem::path path = root / name;
  if (std::filesystem::exists(path)) return path;
  std::fprintf(stderr, "skipped: %s is not there (see NOLI_DATA)\n", path.c_str());
  return std::nullopt;
}

}  // namespace noli::test
