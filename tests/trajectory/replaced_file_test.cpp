// SPDX-License-Identifier: Apache-2.0
//
// Tests what is beside a file while it is replaced, what takes its name, and what a failure leaves. With each option.
#include "trajectory/replaced_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <regex>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "support.h"
#include "trajectory/write_file.h"

namespace noli {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

/// The message of the std::system_error that `f` throws, or "".
template <class F>
std::string system_error_of(const F& f) {
  try {
    f();
  } catch (const std::system_error& error) {
    return error.what();
  }
  return "";
}

std::string failure_to_take(ReplacedFile& file) {
  return system_error_of([&] { file.take_name(); });
}

/// While it exists, root is a user without rights, who owns the folder. Changes nothing for other users.
class AsNobody {
 public:
  explicit AsNobody(const fs::path& folder) {
    if (!was_root_) return;
    EXPECT_EQ(::chown(folder.c_str(), nobody, static_cast<gid_t>(-1)), 0);
    EXPECT_EQ(::seteuid(nobody), 0);
  }
  ~AsNobody() {
    if (was_root_) {
      EXPECT_EQ(::seteuid(0), 0);
    }
  }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;

 private:
  static constexpr uid_t nobody = 65534;
  const bool was_root_ = ::geteuid() == 0;
};

class ReplacedFiles : public ::testing::Test {
 public:
  ReplacedFiles(const ReplacedFiles&) = delete;
  ReplacedFiles& operator=(const ReplacedFiles&) = delete;

 protected:
  ReplacedFiles() : mask_(::umask(022)) {}
  ~ReplacedFiles() override { ::umask(mask_); }

  static unsigned mode_of(const fs::path& path) { return static_cast<unsigned>(fs::status(path).permissions()); }
  /// Replaces the file as a whole.
  void replace(const std::string& name, Replacing how) const {
    ReplacedFile file(folder / name, how);
    file.write("new");
    file.take_name();
  }

  static constexpr Replacing numbered{};
  static constexpr Replacing part{.name = ScratchName::part};
  static constexpr Replacing with_random_name{.name = ScratchName::random};
  static constexpr Replacing unsynced{.durable = false};
  /// All whose scratch file is created.
  static constexpr std::array created = {numbered, part, unsynced, Replacing{.keep_permissions = true},
                                         Replacing{.keep_permissions = true, .durable = false}};
  const test::TemporaryFolder folder;

 private:
  mode_t mask_;
};

TEST_F(ReplacedFiles, AreAsTheyWereUntilTheNameIsTaken) {
  for (const Replacing how : created) {
    folder.write("a", "old");
    ReplacedFile file(folder / "a", how);
    file.write("ne");
    file.write("w");
    EXPECT_EQ(test::read_text(folder / "a"), "old");
    EXPECT_EQ(file.path(), folder / (how.name == ScratchName::part ? "a.part" : ".noli-0"));
    EXPECT_EQ(test::read_text(file.path()), "new");
    file.take_name();
    EXPECT_EQ(test::read_text(folder / "a"), "new");
    EXPECT_EQ(folder.names(), Names{"a"});
  }
}

TEST_F(ReplacedFiles, AreAsTheyWereIfTheNameIsNeverTaken) {
  folder.write("a", "old");
  for (const Replacing how : created) ReplacedFile(folder / "a", how).write("new");
  EXPECT_EQ(test::read_text(folder / "a"), "old");
  EXPECT_EQ(folder.names(), Names{"a"});
}

TEST_F(ReplacedFiles, LeaveNothingWhenTheNameCannotBeTaken) {
  fs::create_directory(folder / "a");
  for (const Replacing how : created) {
    ReplacedFile file(folder / "a", how);
    EXPECT_NE(failure_to_take(file), "");
  }
  EXPECT_EQ(folder.names(), Names{"a"});
}

TEST_F(ReplacedFiles, SayWhichNameCannotBeTaken) {
  fs::create_directory(folder / "a");
  const std::string a = (folder / "a").string(), scratch = (folder / ".noli-0").string();
  ReplacedFile first(folder / "a"), second(folder / "a", part);
  EXPECT_EQ(failure_to_take(first), "filesystem error: cannot rename: Is a directory [" + scratch + "] [" + a + "]");
  EXPECT_EQ(failure_to_take(second), a + ": Is a directory");
}

TEST_F(ReplacedFiles, SayWhichFileCannotBeCreated) {
  const auto creating = [&](Replacing how) { return system_error_of([&] { ReplacedFile{folder / "absent/a", how}; }); };
  const std::string in = (folder / "absent/").string(), why = ": No such file or directory";
  EXPECT_EQ(creating(numbered), in + ".noli-0" + why);
  EXPECT_EQ(creating(part), in + "a.part" + why);
  EXPECT_EQ(creating(with_random_name), "") << "the caller creates it";
}

// --- The name of the scratch file ---

TEST_F(ReplacedFiles, TakeTheNextFreeNumber) {
  for (const char* const name : {".noli-0", ".noli-1"}) folder.write(name, "mine");
  fs::create_symlink(folder / "absent", folder / ".noli-2");
  const ReplacedFile file(folder / "a"), other(folder / "a");
  EXPECT_EQ(file.path(), folder / ".noli-3");
  EXPECT_EQ(other.path(), folder / ".noli-4");
  EXPECT_EQ(test::read_text(folder / ".noli-1"), "mine");
  EXPECT_FALSE(fs::exists(folder / "absent"));
}

TEST_F(ReplacedFiles, TakeNoPartThatIsThere) {
  const auto creating = [&] { return system_error_of([&] { ReplacedFile{folder / "a", part}; }); };
  const std::string refused = (folder / "a.part").string() + ": File exists";
  folder.write("a.part", "mine");
  EXPECT_EQ(creating(), refused);
  EXPECT_EQ(test::read_text(folder / "a.part"), "mine");
  fs::remove(folder / "a.part");
  fs::create_symlink(folder / "absent", folder / "a.part");
  EXPECT_EQ(creating(), refused);
  EXPECT_EQ(folder.names(), Names{"a.part"});
}

TEST_F(ReplacedFiles, GiveTheNameToNothingThatTookThePlaceOfAPart) {
  {
    ReplacedFile file(folder / "a", part);
    fs::remove(folder / "a.part");
    EXPECT_NE(failure_to_take(file).find("a.part: another process replaced it"), std::string::npos);
    folder.write("a.part", "another");
    EXPECT_NE(failure_to_take(file).find("a.part: another process replaced it"), std::string::npos);
  }
  EXPECT_EQ(folder.names(), Names{"a.part"}) << "it belongs to another process";
}

TEST_F(ReplacedFiles, WithARandomNameAreWrittenByTheCaller) {
  folder.write("a", "old");
  {
    ReplacedFile file(folder / "a", with_random_name);
    const ReplacedFile other(folder / "a", with_random_name);
    EXPECT_TRUE(std::regex_match(file.path().filename().string(), std::regex("a\\.[0-9a-f]{16}\\.part")));
    EXPECT_NE(file.path(), other.path());
    EXPECT_LT(file.descriptor(), 0);
    EXPECT_EQ(folder.names(), Names{"a"}) << "nothing is created";
    EXPECT_NE(failure_to_take(file), "") << "there is no file";
    EXPECT_EQ(test::read_text(folder / "a"), "old");
    write_file(file.path(), "new");
    write_file(other.path(), "other");
    file.take_name();
  }
  EXPECT_EQ(test::read_text(folder / "a"), "new");
  EXPECT_EQ(folder.names(), Names{"a"});
}

// --- What is replaced ---

TEST_F(ReplacedFiles, ReplaceALinkAndNotWhatItLeadsTo) {
  folder.write("theirs", "theirs");
  for (const char* const target : {"theirs", "absent"}) {
    for (const Replacing how : created) {
      fs::create_symlink(target, folder / "a");
      replace("a", how);
      EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder / "a")));
      fs::remove(folder / "a");
    }
  }
  EXPECT_EQ(test::read_text(folder / "theirs"), "theirs");
  EXPECT_EQ(folder.names(), Names{"theirs"});
}

TEST_F(ReplacedFiles, HaveThePermissionsOfNewFiles) {
  for (const Replacing how : created) {
    fs::remove(folder / "a");
    replace("a", how);
    EXPECT_EQ(mode_of(folder / "a"), 0644u);
  }
}

TEST_F(ReplacedFiles, KeepPermissionsWhereThatIsAsked) {
  for (const Replacing how : created) {
    folder.write("a", "old");
    fs::permissions(folder / "a", fs::perms(0460));
    ReplacedFile file(folder / "a", how);
    EXPECT_EQ(mode_of(file.path()), how.keep_permissions ? 0600u : 0644u) << "nobody else reads it before";
    file.take_name();
    EXPECT_EQ(mode_of(folder / "a"), how.keep_permissions ? 0460u : 0644u);
    fs::remove(folder / "a");
  }
}

TEST_F(ReplacedFiles, KeepTheOwnerWhereThatIsAsked) {
  // Only root gives files away. Whoever else runs this has no other files than their own, which stay theirs.
  const bool root = ::geteuid() == 0;
  const uid_t owner = root ? 12345 : ::geteuid();
  const gid_t group = root ? 12346 : ::getegid();
  for (const Replacing how : created) {
    const std::string a = folder.write("a", "old").string();
    ASSERT_EQ(::chown(a.c_str(), owner, group), 0);
    replace("a", how);
    struct stat now = {};
    ASSERT_EQ(::stat(a.c_str(), &now), 0);
    EXPECT_EQ(now.st_uid, how.keep_permissions ? owner : ::geteuid());
    EXPECT_EQ(now.st_gid, how.keep_permissions ? group : ::getegid());
  }
}

TEST_F(ReplacedFiles, ThatAreDurableSyncTheirFolder) {
  fs::permissions(folder.path(), fs::perms(0300));
  {
    const AsNobody as_nobody(folder.path());  // root may read all folders
    EXPECT_NE(system_error_of([&] { replace("a", numbered); }), "");
    EXPECT_EQ(system_error_of([&] { replace("b", unsynced); }), "");
  }
  fs::permissions(folder.path(), fs::perms(0700));
  EXPECT_EQ(folder.names(), (Names{"a", "b"}));
}

TEST_F(ReplacedFiles, ThatAreNotOfferedAreRefused) {
  const Replacing of_random_name{.name = ScratchName::random, .keep_permissions = true};
  EXPECT_THROW(ReplacedFile(folder / "a", of_random_name), std::logic_error);
  const Replacing unsynced_part{.name = ScratchName::part, .durable = false};
  EXPECT_THROW(ReplacedFile(folder / "a", unsynced_part), std::logic_error);
  EXPECT_EQ(folder.names(), Names());
}

}  // namespace
}  // namespace noli
