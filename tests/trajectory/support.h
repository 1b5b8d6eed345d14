// SPDX-License-Identifier: Apache-2.0
//
// What the tests of the readers share.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "noli/trajectory/error.h"
#include "noli/trajectory/mesh.h"

namespace noli::testing {

/// A folder that lives as long as this object, with a name of its own for each test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("noli-") + test->test_suite_name() + "-" + test->name();
    for (char& c : name) c = c == '/' ? '-' : c;
    path_ = std::filesystem::temp_directory_path() / name;
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path write(const std::string& file, std::string_view content) const {
    std::ofstream(path_ / file, std::ios::binary) << content;
    return path_ / file;
  }
  std::filesystem::path operator/(const std::string& file) const { return path_ / file; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// What the InputError says that `f` throws; a test failure and "" when it throws none.
template <class F>
std::string input_error(F&& f) {
  try {
    f();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no InputError was thrown";
  return "";
}

/// Positions as bits, so that -0 and 0 differ in comparisons.
inline std::vector<std::array<std::uint64_t, 3>> bits(const std::vector<Position>& positions) {
  std::vector<std::array<std::uint64_t, 3>> result;
  result.reserve(positions.size());
  for (const Position& x : positions) result.push_back(std::bit_cast<std::array<std::uint64_t, 3>>(x));
  return result;
}

/// The folder of real data: what NOLI_DATA says, else ../shared/data next to the sources.
inline std::filesystem::path data_folder() {
  const char* chosen = std::getenv("NOLI_DATA");
  return chosen != nullptr ? std::filesystem::path(chosen)
                           : std::filesystem::path(NOLI_SOURCE_DIR) / ".." / "shared" / "data";
}

}  // namespace noli::testing

/// Skips the test, saying so, where a file of the real data is not there.
#define NOLI_REQUIRE_DATA(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "skipped, no such file: " << (path)
