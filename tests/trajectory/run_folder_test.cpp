// SPDX-License-Identifier: Apache-2.0
//
// Tests the files of a run folder other than the motion: manifest, copy of the scene, log.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>

#include "support.h"
#include "trajectory/blocks/block_sink.h"
#include "trajectory/blocks/folder_lock.h"
#include "trajectory/blocks/run_log.h"
#include "trajectory/blocks/run_manifest.h"
#include "trajectory/write_file.h"

namespace noli {
namespace {

using testing::input_error;
using Json = nlohmann::ordered_json;

TEST(RunManifest, IsReadBackWithItsScene) {
  const test::TemporaryFolder folder;
  write_manifest(folder.path(), "{\"scene\": 1}\r\n", {{"noli", "0.1.0"}, {"gmp", "6.2.1"}});
  const RunManifest manifest = read_manifest(folder.path());
  EXPECT_EQ(manifest, (RunManifest{sha256("{\"scene\": 1}\r\n"), {{"noli", "0.1.0"}, {"gmp", "6.2.1"}}, std::nullopt}));
  EXPECT_EQ(read_scene(folder.path(), manifest), "{\"scene\": 1}\r\n");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"manifest.json", "scene.json"}));
}

TEST(RunManifest, MayHaveTheHashOfTheModel) {
  const test::TemporaryFolder folder;
  write_manifest(folder.path(), "{}", {{"noli", "0.1.0"}}, sha256("model"));
  EXPECT_EQ(read_manifest(folder.path()).model_sha256, sha256("model"));
}

TEST(RunManifest, HasTheseBytes) {
  const test::TemporaryFolder folder;
  write_manifest(folder.path(), "abc", {{"noli", "0.1.0"}});
  EXPECT_EQ(test::read_text(folder / "manifest.json"),
            "{\n  \"format\": \"noli run\",\n  \"version\": 1,\n  \"scene\": {\n    \"file\": \"scene.json\",\n"
            "    \"sha256\": \"ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad\"\n  },\n"
            "  \"versions\": {\n    \"noli\": \"0.1.0\"\n  }\n}\n");
}

TEST(RunManifest, AnotherSceneIsNoticed) {
  const test::TemporaryFolder folder;
  write_manifest(folder.path(), "abc", {});
  folder.write("scene.json", "abd");
  EXPECT_EQ(
      input_error([&] { read_scene(folder.path(), read_manifest(folder.path())); }),
      (folder / "scene.json").string() + ": is not the scene of this run: its SHA-256 is not that in the manifest");
}

struct BadManifest {
  const char* name;
  std::string text;
  std::string message;
  friend void PrintTo(const BadManifest& bad, std::ostream* out) { *out << bad.name; }
};

const std::string digest(64, '0');
const std::string before_scene = R"({"format": "noli run", "version": 1, )";
const BadManifest bad_manifests[] = {
    {"no_json", "{\"format\": ", "byte 11: expected JSON"},
    {"array", "[1]", "/format: is missing"},
    {"number", "1", "/format: is missing"},
    {"other_format", R"({"format": "something else"})", "/format: expected 'noli run', found 'something else'"},
    {"format_type", R"({"format": 3})", "/format: expected a string"},
    {"later_version", R"({"format": "noli run", "version": 2})", "/version: expected 1, found '2'"},
    {"version_type", R"({"format": "noli run", "version": "1"})", "/version: expected 1, found '\"1\"'"},
    {"no_hash", before_scene + R"("scene": {}})", "/scene/sha256: is missing"},
    {"short_hash", before_scene + R"("scene": {"sha256": "00"}})",
     "/scene/sha256: expected 64 hexadecimal digits in lower case"},
    {"capital_hash", before_scene + R"("scene": {"sha256": "A)" + digest.substr(1) + "\"}}",
     "/scene/sha256: expected 64 hexadecimal digits in lower case"},
    {"no_versions", before_scene + R"("scene": {"sha256": ")" + digest + "\"}}", "/versions: is missing"},
    {"versions_type", before_scene + R"("versions": [], "scene": {"sha256": ")" + digest + "\"}}",
     "/versions: expected an object"},
    {"version_of_type", before_scene + R"("versions": {"noli": 1}, "scene": {"sha256": ")" + digest + "\"}}",
     "/versions/noli: expected a string"},
};

class RunManifestErrors : public ::testing::TestWithParam<BadManifest> {};
INSTANTIATE_TEST_SUITE_P(All, RunManifestErrors, ::testing::ValuesIn(bad_manifests),
                         [](const auto& bad) { return bad.param.name; });

TEST_P(RunManifestErrors, SayWhatAndWhere) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("manifest.json", GetParam().text).string();
  EXPECT_EQ(input_error([&] { read_manifest(folder.path()); }), file + ": " + GetParam().message);
}

/// The entries of the log.
std::vector<Json> entries(const test::TemporaryFolder& folder) {
  std::vector<Json> list;
  read_log_lines(folder.path(), [&list](const Json& entry) { list.push_back(entry); });
  return list;
}

/// A log line. Another program computed the CRC-32C of the text before ",\"crc32c\"".
constexpr const char* begin_line = "{\"event\":\"begin\",\"window\":0,\"crc32c\":\"ffad3c79\"}\n";

TEST(RunLog, HasALineForEachEntryAcrossResumptions) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(entries(folder).empty());
  RunLog(folder.path()).append({{"event", "begin"}, {"window", 0}});
  EXPECT_EQ(test::read_text(folder / "log.jsonl"), begin_line);
  RunLog(folder.path()).append({{"event", "line\nend"}, {"timing", {{"seconds", 0.5}}}});
  EXPECT_EQ(entries(folder), (std::vector<Json>{{{"event", "begin"}, {"window", 0}},
                                                {{"event", "line\nend"}, {"timing", {{"seconds", 0.5}}}}}));
}

TEST(RunLog, ALastLineThatWasCutOffIsRemoved) {
  const std::string before = log_line({{"event", "a"}}), last = log_line({{"event", "b"}, {"text", "\"crc32c\":\""}});
  for (std::size_t size = 0; size <= last.size(); ++size) {
    const test::TemporaryFolder folder;
    folder.write("log.jsonl", before + last.substr(0, size));
    const bool whole = size + 1 >= last.size();  // at most its newline is missing
    EXPECT_EQ(entries(folder).size(), whole ? 2 : 1) << size;
    RunLog(folder.path()).append({{"event", "c"}});
    EXPECT_EQ(test::read_text(folder / "log.jsonl"), before + (whole ? last : "") + log_line({{"event", "c"}}));
  }
}

/// This includes the last byte, the newline of the last line.
TEST(RunLog, AnyBitThatIsFlippedIsNoticed) {
  const std::string first = log_line({{"event", "begin"}, {"a", 1}}), last = log_line({{"event", "end"}, {"b", 2}});
  const std::string log = first + log_line({{"event", "window"}}) + last;
  for (std::size_t at = 0; at < 8 * log.size(); ++at) {
    const test::TemporaryFolder folder;
    std::string flipped = log;
    flipped[at / 8] = static_cast<char>(flipped[at / 8] ^ 1 << at % 8);
    folder.write("log.jsonl", flipped);
    const std::string line = at / 8 < first.size() ? "1" : at / 8 < log.size() - last.size() ? "2" : "3";
    const std::string error = input_error([&] { entries(folder); });
    EXPECT_NE(error.find("log.jsonl: line " + line + ": "), std::string::npos) << at << ": " << error;
  }
}

TEST(RunLog, WantsChecksumsAndAFile) {
  const test::TemporaryFolder folder;
  folder.write("log.jsonl", "{\"event\":\"begin\"}\n");
  EXPECT_NE(input_error([&] { entries(folder); }).find("line 1: expected a line that ends in its checksum"),
            std::string::npos);
  std::filesystem::remove(folder / "log.jsonl");
  ASSERT_EQ(::mkfifo((folder / "log.jsonl").c_str(), 0600), 0);
  EXPECT_NE(input_error([&] { entries(folder); }).find("is not a regular file"), std::string::npos);
  EXPECT_THROW(FileSink(folder / "log.jsonl", FileSink::Open::existing), std::system_error);
}

TEST(RunLog, BytesThatAreNoTextAreReplaced) {
  const test::TemporaryFolder folder;
  RunLog(folder.path()).append({{"file", "a\xff"}});
  EXPECT_EQ(entries(folder).at(0)["file"], "a\xEF\xBF\xBD");
}

TEST(RunLog, FollowsNoLink) {
  const test::TemporaryFolder folder, elsewhere;
  elsewhere.write("mine", "");
  for (const char* const target : {"mine", "absent"}) {
    std::filesystem::create_symlink(elsewhere / target, folder / "log.jsonl");
    try {
      RunLog(folder.path()).append({{"event", "a"}});
      ADD_FAILURE() << target;
    } catch (const std::system_error& error) {
      EXPECT_NE(std::string(error.what()).find("log.jsonl: is a link"), std::string::npos) << error.what();
    }
    std::filesystem::remove(folder / "log.jsonl");
  }
  EXPECT_EQ(test::read_text(elsewhere / "mine"), "");
  EXPECT_EQ(elsewhere.names(), std::vector<std::string>{"mine"});
}

TEST(FolderLock, IsHadByOneAtATime) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(is_locked(folder.path()));
  {
    const FolderLock lock(folder.path());
    EXPECT_TRUE(is_locked(folder.path()));
    try {
      const FolderLock second(folder.path());
      ADD_FAILURE();
    } catch (const FolderLocked& locked) {
      const std::string by = folder.path().string() + ": is being written by ";
      const std::string what = locked.what();
      EXPECT_TRUE(what == by + "process " + std::to_string(::getpid()) || what == by + "another process") << what;
    }
  }
  EXPECT_FALSE(is_locked(folder.path()));
  const FolderLock again(folder.path());
  EXPECT_TRUE(folder.names().empty()) << "no file is left";
  EXPECT_FALSE(is_locked(folder / "absent"));
  EXPECT_THROW(FolderLock(folder / "absent"), std::system_error);
}

/// is_locked() takes the lock for a moment.
TEST(FolderLock, WaitsForThoseWhoOnlyAsk) {
  const test::TemporaryFolder folder;
  std::atomic<bool> done = false;
  std::vector<std::thread> asking;
  for (int i = 0; i < 2; ++i) {
    asking.emplace_back([&] {
      while (!done) is_locked(folder.path());
    });
  }
  for (int i = 0; i < 200; ++i) EXPECT_NO_THROW(FolderLock(folder.path()));
  done = true;
  for (std::thread& thread : asking) thread.join();
}

TEST(RunLog, IsWrittenByOneAtATime) {
  const test::TemporaryFolder folder;
  const RunLog log(folder.path());
  EXPECT_THROW(RunLog(folder.path()), std::system_error);
}

TEST(ReplaceFile, IsThereWholeOrAsItWas) {
  const test::TemporaryFolder folder;
  replace_file(folder / "a", "one");
  replace_file(folder / "a", "two");
  EXPECT_EQ(test::read_text(folder / "a"), "two");
  std::filesystem::create_directory(folder / "b");
  EXPECT_THROW(replace_file(folder / "b", "x"), std::system_error);
  EXPECT_THROW(replace_file(folder / "absent/a", "x"), std::system_error);
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a", "b"})) << "nothing is left beside them";
}

TEST(ReplaceFile, TakesNothingThatSomebodyHas) {
  const test::TemporaryFolder folder;
  const std::vector<std::string> others = {".noli-0", ".noli-1", "a.part"};
  for (const std::string& name : others) folder.write(name, "mine");
  replace_file(folder / "a", "one");
  EXPECT_EQ(test::read_text(folder / "a"), "one");
  for (const std::string& name : others) EXPECT_EQ(test::read_text(folder / name), "mine");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{".noli-0", ".noli-1", "a", "a.part"}));
}

TEST(ReplaceFile, LeavesWhatIsNoFile) {
  const test::TemporaryFolder folder;
  folder.write("a", "mine");
  std::filesystem::create_symlink(folder / "a", folder / "link");
  std::filesystem::create_symlink(folder / "absent", folder / "dangling");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const char* const name : {"link", "dangling", "pipe"}) {
    EXPECT_THROW(replace_file(folder / name, "x"), std::system_error) << name;
  }
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link") && std::filesystem::is_symlink(folder / "dangling"));
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
  EXPECT_EQ(test::read_text(folder / "a"), "mine");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a", "dangling", "link", "pipe"}));
}

}  // namespace
}  // namespace noli
