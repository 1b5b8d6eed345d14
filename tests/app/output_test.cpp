// SPDX-License-Identifier: Apache-2.0
//
// Tests version, help, and where results are written.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "tests/app/process.h"
#include "tests/app/scene.h"

namespace noli::app_tests {
namespace {

TEST(Help, HasExamplesForEveryCommand) {
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{}, {"verify"}, {"ccd"}, {"info"}, {"fuzz"}, {"fuzz", "queries"}}) {
    auto arguments = command;
    std::string usage = "Usage: noli";
    for (const std::string& word : command) usage += " " + word;
    arguments.emplace_back("--help");
    const Process process = run_noli(arguments);
    EXPECT_EQ(process.exit_code, 0);
    EXPECT_NE(process.out.find("Examples:\n  noli "), std::string::npos) << process.out;
    EXPECT_NE(process.out.find(usage), std::string::npos) << process.out;
    EXPECT_EQ(process.err, "");
  }
}

TEST(Version, NamesLibrariesAndTestsRounding) {
  const Process process = run_noli({"--version"});
  EXPECT_EQ(process.exit_code, 0);
  EXPECT_EQ(process.out.rfind("noli ", 0), 0u);
  for (const char* const part :
       {"\ncommit ", "\nGMP 6", "\nMPFR 4", "\nCGAL 5", "\nBoost 1.", "\nrounding self-test passed\n"}) {
    EXPECT_NE(process.out.find(part), std::string::npos) << part << " not in: " << process.out;
  }
}

TEST(Version, SaysWhatItIsWithout) {
  const std::string out = run_noli({"--version"}).out;
  const std::size_t at = out.find("\nwith");
  ASSERT_NE(at, std::string::npos) << out;
  const bool reports = run_noli({"report", "absent", "-o", "x.html"}).err.find("NOLI_WITH_REPORT") == std::string::npos;
  EXPECT_EQ(out.find("reports", at) == std::string::npos, reports) << out;
}

class JsonOutput : public testing::Test {
 protected:
  Process run(const std::string& out) const { return run_noli({"info", mesh, "--force", "--json", out}); }

  Folder folder;
  std::string mesh = folder.write("a.ply", two_triangles(1));
};

TEST_F(JsonOutput, GoesToAFileBesideTheText) {
  const Process process = run(folder.path("out.json"));
  EXPECT_EQ(process.exit_code, 0);
  EXPECT_EQ(process.verdict_line(), "DESCRIBED  files 1");
  EXPECT_EQ(nlohmann::json::parse(read_text(folder.path("out.json")))["verdict"], "described");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.ply", "out.json"}));
}

TEST_F(JsonOutput, TakesThePlaceOfTheTextOnStandardOutput) {
  const Process process = run("-");
  EXPECT_EQ(nlohmann::json::parse(process.out)["verdict"], "described");
}

TEST_F(JsonOutput, IsNeverWrittenOverAnInput) {
  const Process process = run(mesh);
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("is also an input"), std::string::npos) << process.err;
  EXPECT_EQ(run_noli({"info", mesh}).exit_code, 0);  // still a mesh
}

TEST_F(JsonOutput, ReplacesAFileWhole) {
  const auto path = folder.write("out.json", std::string(100'000, 'x'));
  EXPECT_EQ(run(path).exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(read_text(path))["verdict"], "described");
}

TEST_F(JsonOutput, FollowsALinkToTheFile) {
  const auto target = folder.write("target.json", "old");
  std::filesystem::create_symlink(target, folder.path("link.json"));
  EXPECT_EQ(run(folder.path("link.json")).exit_code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path("link.json")));
  EXPECT_EQ(nlohmann::json::parse(read_text(target))["verdict"], "described");
}

TEST_F(JsonOutput, IsReadableByWhomNewFilesAre) {
  const mode_t before = ::umask(022);
  run(folder.path("out.json"));
  ::umask(before);
  const auto permissions = std::filesystem::status(folder.path("out.json")).permissions();
  EXPECT_EQ(static_cast<unsigned>(permissions), 0644u);
}

TEST_F(JsonOutput, KeepsThePermissionsOfTheFileThatItReplaces) {
  const auto path = folder.write("out.json", "old");
  std::filesystem::permissions(path, std::filesystem::perms(0640));
  EXPECT_EQ(run(path).exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(read_text(path))["verdict"], "described");
  EXPECT_EQ(static_cast<unsigned>(std::filesystem::status(path).permissions()), 0640u);
}

TEST_F(JsonOutput, IsWrittenInPlaceWhereTheFolderMayNotChange) {
  std::filesystem::create_directory(folder.path("closed"));
  const auto writable = folder.write("closed/writable.json", std::string(100'000, 'x'));
  const auto readable = folder.write("closed/readable.json", "old");
  std::filesystem::permissions(readable, std::filesystem::perms(0444));
  std::filesystem::permissions(folder.path("closed"), std::filesystem::perms(0555));
  ProcessOptions options;
  options.obey_permissions = true;
  const auto exit_code = [&](const std::string& out) {
    return run_noli({"info", mesh, "--force", "--json", out}, options).exit_code;
  };
  EXPECT_EQ(exit_code(writable), 0);
  EXPECT_EQ(exit_code(readable), 3);
  EXPECT_EQ(exit_code(folder.path("closed/new.json")), 3);
  std::filesystem::permissions(folder.path("closed"), std::filesystem::perms(0755));  // so that it can be removed
  EXPECT_EQ(nlohmann::json::parse(read_text(writable))["verdict"], "described");
  EXPECT_EQ(read_text(readable), "old");
}

TEST_F(JsonOutput, MayHaveTheLongestNameThereIs) {
  const auto longest = folder.path(std::string(250, 'n') + ".json");
  EXPECT_EQ(run(longest).exit_code, 0);
  EXPECT_EQ(run(longest).exit_code, 0);  // replaced
  EXPECT_EQ(nlohmann::json::parse(read_text(longest))["verdict"], "described");
  const auto names = folder.names();
  EXPECT_EQ(run(folder.path(std::string(251, 'n') + ".json")).exit_code, 3);
  EXPECT_EQ(folder.names(), names);
}

TEST_F(JsonOutput, StaysJsonWhenANameIsNoText) {
  const auto odd = folder.write("odd\xff\".ply", two_triangles(1));
  const Process process = run_noli({"info", odd, "--json", "-"});
  EXPECT_EQ(process.exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(process.out)["verdict"], "described");
}

}  // namespace
}  // namespace noli::app_tests
