// SPDX-License-Identifier: Apache-2.0
//
// Tests where results are written: what is replaced, what is written in place, and what is refused.
#include "certify/result_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>
#include <vector>

#include <noli/errors.h>
#include "tests/support/temporary_folder.h"

namespace noli {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

TEST(ResultFile, IsReplacedAndNotOverwritten) {
  const test::TemporaryFolder folder;
  const fs::path a = folder.write("a", "old"), hard = folder / "hard";
  fs::create_hard_link(a, hard);
  write_result(a.string(), "new");
  EXPECT_EQ(test::read_text(a), "new");
  EXPECT_EQ(test::read_text(hard), "old") << "it is another file now";
  EXPECT_EQ(folder.names(), (Names{"a", "hard"}));
}

TEST(ResultFile, IsTheOneALinkLeadsTo) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "far");
  const fs::path far = folder.write("far/a", "old"), link = folder / "link", dangling = folder / "dangling";
  fs::create_symlink("far/a", link);
  require_writable_file(link, "--json");
  write_result(link.string(), "new");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(test::read_text(far), "new");
  fs::create_symlink("absent", dangling);
  write_result(dangling.string(), "new");
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(dangling)));
  EXPECT_EQ(folder.names(), (Names{"dangling", "far", "link"}));
}

TEST(ResultFile, MayBeADeviceOrAPipe) {
  const test::TemporaryFolder folder;
  write_result("/dev/null", "new");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  const std::string pipe = (folder / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  write_result(pipe, "new");
  std::string bytes(9, '?');
  EXPECT_EQ(::read(reader, bytes.data(), bytes.size()), 3);
  ::close(reader);
  EXPECT_EQ(bytes.substr(0, 3), "new");
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(folder.names(), Names{"pipe"});
}

TEST(ResultFile, IsNoFolder) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "a");
  const std::string a = (folder / "a").string(), absent = (folder / "absent/a").string();
  const auto message = [](const std::string& path) -> std::string {
    try {
      write_result(path, "new");
    } catch (const WriteError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message(a), a + ": cannot be written: Is a directory");
  EXPECT_EQ(message(absent), absent + ": cannot be written: No such file or directory");
  EXPECT_THROW(require_writable_file(a, "--json"), UsageError);
  EXPECT_THROW(require_writable_file(absent, "--json"), UsageError);
  EXPECT_EQ(folder.names(), Names{"a"});
}

TEST(ResultFile, IsLeftAsItWasByTheQuestionWhetherItCanBeWritten) {
  const test::TemporaryFolder folder;
  const fs::path a = folder.write("a", "old");
  require_writable_file(a, "--json");
  require_writable_file(folder / "b", "--json");
  require_writable_folder(folder.path().string(), "-o");
  EXPECT_EQ(test::read_text(a), "old");
  EXPECT_EQ(folder.names(), Names{"a"});
}

TEST(ResultFile, IsRegularOrNothing) {
  const test::TemporaryFolder folder;
  const fs::path a = folder.write("a", "old");
  fs::create_symlink("a", folder / "link");
  fs::create_symlink("absent", folder / "dangling");
  for (const char* const name : {"a", "absent", "link", "dangling"}) {
    EXPECT_TRUE(is_regular_or_nothing(folder / name)) << name;
  }
  EXPECT_FALSE(is_regular_or_nothing("/dev/null"));
  EXPECT_FALSE(is_regular_or_nothing(folder.path()));
}

}  // namespace
}  // namespace noli
