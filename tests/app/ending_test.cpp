// SPDX-License-Identifier: Apache-2.0
//
// Tests how the command ends when stopped by the user, a limit or the machine: never with exit code 0.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "tests/app/process.h"
#include "tests/app/scene.h"

namespace noli::app_tests {
namespace {

using Json = nlohmann::json;

/// A sequence that takes minutes: two frames that never touch, over and over.
std::vector<std::string> endless_verify(const Folder& folder) {
  const auto a = folder.write("a.ply", sheets(20000, 0)), b = folder.write("b.ply", sheets(20000, 3));
  std::vector<std::string> arguments = {"verify"};
  for (int i = 0; i < 20000; ++i) arguments.push_back(i % 2 == 0 ? a : b);
  arguments.insert(arguments.end(), {"--json", folder.path("result.json")});
  return arguments;
}

ProcessOptions sends(int signal) {
  ProcessOptions options;
  options.signal = signal;
  options.signal_after = std::chrono::milliseconds(500);
  return options;
}

class EndedBySignal : public testing::TestWithParam<int> {};

TEST_P(EndedBySignal, VerifyLeavesValidJson) {
  const Folder folder;
  const Process process = run_noli(endless_verify(folder), sends(GetParam()));
  EXPECT_EQ(process.exit_code, 2) << process.err;
  EXPECT_EQ(process.verdict_line().rfind("UNDECIDED ", 0), 0u) << process.out;
  const Json json = Json::parse(read_text(folder.path("result.json")));
  EXPECT_EQ(json["verdict"], "undecided");
  EXPECT_EQ(json["complete"], false);
  EXPECT_LT(json["steps"], json["steps_total"]);
}

TEST_P(EndedBySignal, FuzzLeavesValidJson) {
  const Folder folder;
  const Process process =
      run_noli({"fuzz", "queries", "--for", "1h", "--out", folder.path("out"), "--json", folder.path("result.json")},
               sends(GetParam()));
  EXPECT_EQ(process.exit_code, 2) << process.err;
  const Json json = Json::parse(read_text(folder.path("result.json")));
  EXPECT_EQ(json["verdict"], "undecided");
  EXPECT_EQ(json["findings"], 0);
}

TEST_P(EndedBySignal, WhileAPipeIsWaitedFor) {
  const Folder folder;
  const auto good = folder.write("good.ply", two_triangles(1));
  const auto pipe = folder.path("pipe.ply"), queries = folder.path("edge-edge.csv");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600) + ::mkfifo(queries.c_str(), 0600), 0);
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"verify", pipe, good}, {"verify", good, pipe}, {"ccd", queries}}) {
    auto with_json = arguments;
    with_json.insert(with_json.end(), {"--json", "-"});
    const Process process = run_noli(with_json, sends(GetParam()));
    EXPECT_EQ(process.exit_code, 2) << process.err;
    EXPECT_EQ(Json::parse(process.out)["verdict"], "undecided");
  }
  const Process info = run_noli({"info", pipe}, sends(GetParam()));
  EXPECT_EQ(info.exit_code, 2);
  EXPECT_EQ(info.err, "noli: error: " + pipe + ": interrupted while it was read\n");
}

TEST_P(EndedBySignal, WhileTheRestOfAPipeIsWaitedFor) {
  const Folder folder;
  const auto pipe = folder.path("pipe.ply");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int writer = ::open(pipe.c_str(), O_RDWR | O_CLOEXEC);  // does not wait for a reader
  ASSERT_EQ(::write(writer, "ply\n", 4), 4);
  const Process process = run_noli({"verify", pipe, folder.write("good.ply", two_triangles(1))}, sends(GetParam()));
  ::close(writer);
  EXPECT_EQ(process.exit_code, 2) << process.err;
  EXPECT_NE(process.out.find("nothing found so far (interrupted)"), std::string::npos) << process.out;
}

TEST_P(EndedBySignal, AMomentBeforeAPipeIsWaitedFor) {
  const Folder folder;
  const auto pipe = folder.path("pipe.ply");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  ProcessOptions at_once;
  at_once.signal = GetParam();
  for (int i = 0; i < 2; ++i) EXPECT_EQ(run_noli({"info", pipe}, at_once).exit_code, 2);
}

INSTANTIATE_TEST_SUITE_P(All, EndedBySignal, testing::Values(SIGINT, SIGTERM, SIGHUP), [](const auto& test) {
  return test.param == SIGINT ? "Interrupt" : test.param == SIGTERM ? "Terminate" : "HangUp";
});

TEST(Ending, ATimeLimitGivesWhatWasSettledSoFar) {
  const Folder folder;
  auto arguments = endless_verify(folder);
  arguments.insert(arguments.end(), {"--time-limit", "700ms"});
  const Process process = run_noli(arguments);
  EXPECT_EQ(process.exit_code, 2) << process.err;
  EXPECT_NE(process.out.find("nothing found so far (time limit)"), std::string::npos) << process.out;
  const Json json = Json::parse(read_text(folder.path("result.json")));
  EXPECT_EQ(json["verdict"], "undecided");
  EXPECT_EQ(json["per_step"].size(), json["steps"].get<std::size_t>());
}

TEST(Ending, ATimeLimitAfterAContactLeavesTheContact) {
  const Folder folder;
  const auto a = folder.write("a.ply", two_triangles(1)), b = folder.write("b.ply", two_triangles(-1));
  const std::string never = folder.path("never.ply");
  ASSERT_EQ(::mkfifo(never.c_str(), 0600), 0);
  const Json json = json_of({"verify", "--keep-going", "--time-limit", sanitized ? "10s" : "2s", a, b, a, never}, 1);
  EXPECT_EQ(json["verdict"], "contact");
  EXPECT_EQ(json["complete"], false);
  EXPECT_GE(json["contacts"]["vertex_face"], 3);
}

TEST(Ending, AFullDiskIsNoSuccess) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this machine";
  const Folder folder;
  const auto a = folder.write("a.ply", two_triangles(1));
  ProcessOptions options;
  options.standard_output = "/dev/full";
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"verify", a, a}, {"info", a}, {"--version"}, {"--help"}, {"ccd", "--help"}}) {
    const Process process = run_noli(arguments, options);
    EXPECT_EQ(process.exit_code, 4) << arguments[0];
    EXPECT_NE(process.err.find("standard output"), std::string::npos) << process.err;
  }
  const Process json = run_noli({"verify", a, a, "--json", "/dev/full"});
  EXPECT_EQ(json.exit_code, 4);
  EXPECT_EQ(json.out, "") << "a verdict that does not agree with the exit code";
}

TEST(Ending, AClosedOutputIsNoSuccess) {
  const Folder folder;
  const auto a = folder.write("a.ply", two_triangles(1));
  ProcessOptions closed, hung_up;
  closed.close_standard_output = true;
  hung_up.hang_up = true;
  EXPECT_EQ(run_noli({"verify", a, a}, closed).exit_code, 4);
  EXPECT_EQ(run_noli({"verify", a, a}, hung_up).exit_code, 4);
  // The JSON file must not take the descriptor of standard output.
  EXPECT_EQ(run_noli({"verify", a, a, "--json", folder.path("result.json")}, closed).exit_code, 4);
  EXPECT_EQ(Json::parse(read_text(folder.path("result.json")))["verdict"], "proved");
}

TEST(Ending, TooLittleMemoryIsNoSuccess) {
  if (sanitized) GTEST_SKIP() << "sanitizers reserve address space of their own";
  const Folder folder;
  // A sparse file: a mesh of 20 million vertices at the origin, in hardly a block on the disk.
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 20000000\nproperty double x\nproperty double y\nproperty "
      "double z\nend_header\n";
  const auto path = folder.write("large.ply", header);
  std::filesystem::resize_file(path, header.size() + 20'000'000ull * 24);
  ProcessOptions options;
  options.address_space = 300'000'000;
  const Process process = run_noli({"verify", path, path, "--points"}, options);
  EXPECT_EQ(process.exit_code, 4) << process.out << process.err;
  EXPECT_EQ(process.err, "noli: error: out of memory\n");
}

TEST(Ending, ALimitIsHeardWhateverSignalsWereKeptFromIt) {
  const Folder folder;
  const auto pipe = folder.path("pipe.ply");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, &before);
  const Process info = run_noli({"info", pipe, "--time-limit", "200ms"});
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  EXPECT_EQ(info.exit_code, 2) << info.err;
}

/// A process that ignores SIGCHLD passes this on to `noli`, whose children would then vanish without an exit code.
TEST(Ending, AParentThatIgnoresItsChildrenChangesNothing) {
  const Folder folder;
  const auto a = folder.write("a.ply", sheets(4, 0)), b = folder.write("b.ply", sheets(4, 3));
  ProcessOptions options;
  options.program = "/bin/sh";
  const Process process =
      run_noli({"-c", "trap '' CHLD; exec \"$0\" verify \"$1\" \"$2\" --porcelain", NOLI_COMMAND, a, b}, options);
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_TRUE(process.out.starts_with("verdict=proved")) << process.out;
}

}  // namespace
}  // namespace noli::app_tests
