// SPDX-License-Identifier: Apache-2.0
//
// Tests time limits and interruptions: every command reacts soon, whatever it is doing, and a limit that is not reached
// changes nothing.
#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/stat.h>

#include <array>
#include <chrono>
#include <cmath>
#include <functional>

#include "tests/app/runs/simulate_fixture.h"
#include "tests/support/numpy.h"
#ifdef NOLI_SERIES
#include "tests/support/vtkhdf.h"
#endif

namespace noli::app_tests {
namespace {

/// Without a stop, every input here would take many times as long.
constexpr double soon = 3;  ///< seconds; loaded machines are slow

struct Timed {
  Process process;
  double seconds;
};

Timed timed(const std::vector<std::string>& arguments, const ProcessOptions& options = {}) {
  const auto begin = std::chrono::steady_clock::now();
  Process process = run_noli(arguments, options);
  return {std::move(process), std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()};
}

std::string pipe_in(const Folder& folder, const std::string& name) {
  const std::string path = folder.path(name);
  if (::mkfifo(path.c_str(), 0600) != 0) ADD_FAILURE() << "no pipe";
  return path;
}

/// A scene whose generator makes 4 million vertices, and many times as many forces.
Json large_scene() {
  Json json = Json::parse(R"({
      "noli_scene": 1, "duration": 1, "window": 0.01, "gravity": [0, 0, -9.81],
      "bodies": [{"name": "sheet", "mesh": {"grid": {"size": [1, 1], "cells": [2000, 2000]}},
                  "material": {"young": 2e4, "poisson": 0.3, "density": 200, "thickness": 0.001, "bending": 100}}],
      "contact": {"thickness": 1e-5}})");
  return json;
}

/// A script moves one of two tools with many cells each; the test for pinching examines all pairs.
Json scene_of_tools() {
  const Json mesh = {{"grid", {{"size", {1, 1}}, {"cells", {150, 150}}}}};
  const Json material = {{"young", 2e4}, {"density", 200}, {"thickness", 0.001}};
  Json json = {{"noli_scene", 1}, {"duration", 1}, {"window", 0.01}};
  json["bodies"] = {
      {{"name", "low"}, {"mesh", mesh}, {"material", material}, {"pin", {"all"}}},
      {{"name", "high"}, {"mesh", mesh}, {"material", material}, {"transform", {{"translate", {0, 0, 1}}}}},
      {{"name", "free"},
       {"mesh", {{"grid", {{"size", {1, 1}}, {"cells", {2, 2}}}}}},
       {"material", material},
       {"transform", {{"translate", {0, 0, 5}}}}}};
  json["scripts"] = {
      {{"body", "high"}, {"path", {{{"t", 0}, {"move", {0, 0, 0}}}, {{"t", 1}, {"move", {0, 0, -0.5}}}}}}};
  json["contact"] = {{"thickness", 1e-4}, {"stiffness", 100}};
  return json;
}

/// A run of one window, whose frames can be sampled at any density.
std::string small_run(const Folder& folder) {
  const std::string scene = folder.write("bar.json", resting_bar(1, 1).dump()), run = folder.path("bar");
  EXPECT_EQ(run_noli({"simulate", scene, "-o", run}).exit_code, 0);
  return run;
}

const std::string exact_library = std::string(NOLI_CCD_PLUGINS) + "/noli.so";

/// A command that would take hours.
struct Endless {
  const char* name;
  std::function<std::vector<std::string>(const Folder&)> arguments;
  bool tells = true;     ///< ends with a verdict; else only with a message
  bool reports = false;  ///< needs `noli report`
};

void PrintTo(const Endless& endless, std::ostream* out) { *out << endless.name; }

class LongWork : public testing::TestWithParam<Endless> {
 protected:
  void SetUp() override {
    if (GetParam().reports && !reports_are_there()) GTEST_SKIP() << "skipped: reports (NOLI_WITH_REPORT)";
  }

  void expect_end(const Timed& timed, const std::string& why) const {
    const auto& [process, seconds] = timed;
    EXPECT_EQ(process.exit_code, 2) << process.out << process.err;
    EXPECT_LT(seconds, soon);
    if (GetParam().tells) {
      EXPECT_NE(process.out.find("UNDECIDED"), std::string::npos) << process.out;
    } else {
      EXPECT_NE(process.err.find(why), std::string::npos) << process.err;
    }
  }

  Folder folder;
};

TEST_P(LongWork, EndsAtItsTimeLimit) {
  auto arguments = GetParam().arguments(folder);
  arguments.insert(arguments.end(), {"--time-limit", "200ms"});
  expect_end(timed(arguments), "the time limit has passed");
}

TEST_P(LongWork, EndsWhenItIsInterrupted) {
  expect_end(timed(GetParam().arguments(folder), interrupt_after(200)), "interrupted");
}

const Endless long_work[] = {
    {"SimulateALargeScene",
     [](const Folder& folder) -> std::vector<std::string> {
       return {"simulate", folder.write("s.json", large_scene().dump()), "-o", folder.path("run"), "--ignore-space"};
     }},
    {"SimulateTools",
     [](const Folder& folder) -> std::vector<std::string> {
       return {"simulate", folder.write("s.json", scene_of_tools().dump()), "-o", folder.path("run")};
     }},
    {"SimulateAPipe",
     [](const Folder& folder) -> std::vector<std::string> {
       return {"simulate", pipe_in(folder, "s.json"), "-o", folder.path("run")};
     },
     false},
    {"ExplainALargeScene",
     [](const Folder& folder) -> std::vector<std::string> {
       return {"explain", folder.write("s.json", large_scene().dump())};
     },
     false},
    {"ExplainTools",
     [](const Folder& folder) -> std::vector<std::string> {
       return {"explain", folder.write("s.json", scene_of_tools().dump())};
     },
     false},
    {"ExplainAPipe",
     [](const Folder& folder) -> std::vector<std::string> {
       return {"explain", pipe_in(folder, "s.json")};
     },
     false},
    {"CcdAPipe",
     [](const Folder& folder) -> std::vector<std::string> {
       return {"ccd", pipe_in(folder, "vertex-vertex.csv")};
     }},
    {"AuditCcdOfAPipe",
     [](const Folder& folder) -> std::vector<std::string> {
       return {"audit", "ccd", "--library", exact_library, pipe_in(folder, "vertex-face.csv")};
     }},
    {"AuditCcdOfAPipelineAndAPipe",
     [](const Folder& folder) -> std::vector<std::string> {
       return {"audit",
               "ccd",
               "--library",
               exact_library,
               "--frames",
               folder.write("a.ply", two_triangles(1)),
               pipe_in(folder, "b.ply")};
     },
     false},
    {"AuditPrecisionOfALargeScene",
     [](const Folder& folder) -> std::vector<std::string> {
       return {"audit", "precision", folder.write("s.json", large_scene().dump())};
     },
     false},
    {"AuditPrecisionOfAPipe",
     [](const Folder& folder) -> std::vector<std::string> {
       return {"audit", "precision", pipe_in(folder, "s.json")};
     },
     false},
    {"VerifyAPipe",
     [](const Folder& folder) -> std::vector<std::string> {
       return {"verify", folder.write("a.ply", two_triangles(1)), pipe_in(folder, "b.ply")};
     }},
    {"CheckAPipe",
     [](const Folder& folder) -> std::vector<std::string> {
       return {"check", pipe_in(folder, "proof.noli"), folder.write("a.ply", two_triangles(1))};
     },
     false},
    {"InfoOfAPipe",
     [](const Folder& folder) -> std::vector<std::string> {
       return {"info", pipe_in(folder, "a.ply")};
     },
     false},
    {"ReportOfAPipe",
     [](const Folder& folder) -> std::vector<std::string> {
       return {"report", pipe_in(folder, "result.json"), "-o", folder.path("page.html")};
     },
     false, true},
};

INSTANTIATE_TEST_SUITE_P(All, LongWork, testing::ValuesIn(long_work),
                         [](const auto& of) { return std::string(of.param.name); });

class Limits : public Simulate {};

TEST_F(Limits, AnExportEndsAndSaysSo) {
  const std::string run = small_run(folder);
  const std::vector<std::string> arguments = {"export", run, "--fps", "1e6", "-o", folder.path("f/%06d.ply")};
  auto limited = arguments;
  limited.insert(limited.end(), {"--time-limit", "200ms"});
  for (const Timed& end : {timed(limited), timed(
                                               [&] {
                                                 auto again = arguments;
                                                 again.emplace_back("--force");
                                                 return again;
                                               }(),
                                               interrupt_after(200))}) {
    EXPECT_EQ(end.process.exit_code, 2) << end.process.err;
    EXPECT_NE(end.process.out.find("INTERRUPTED  "), std::string::npos) << end.process.out;
    EXPECT_LT(end.seconds, soon);
  }
}

TEST_F(Limits, ARunThatIsStoppedBeforeItBeginsLeavesNothing) {
  const std::string file = scene(large_scene());
  const Json json = json_of({"simulate", file, "-o", run_path("run"), "--ignore-space", "--time-limit", "100ms"}, 2);
  EXPECT_EQ(json["verdict"], "undecided");
  EXPECT_EQ(json["end"], "time_limit");
  EXPECT_EQ(json["windows"], 0);
  EXPECT_EQ(json["windows_total"], 100);
  EXPECT_FALSE(fs::exists(run_path("run")));
  const Process process =
      run_noli({"simulate", file, "-o", run_path("run"), "--ignore-space", "--time-limit", "100ms"});
  EXPECT_NE(process.out.find("Out of time before the run began; nothing was written."), std::string::npos);
  EXPECT_EQ(process.out.find("--resume"), std::string::npos) << process.out;
}

TEST_F(Limits, ALimitThatIsNotReachedChangesNothing) {
  const std::string run = small_run(folder);
  const auto a = folder.write("a.ply", two_triangles(1)), b = folder.write("b.ply", two_triangles(2));
  ASSERT_EQ(run_noli({"verify", a, b, "--proof", folder.path("p.noli"), "--json", folder.path("r.json")}).exit_code, 0);
  const std::string file = scene(hanging_sheet());
  std::vector<std::vector<std::string>> commands = {
      {"explain", file},
      {"explain", run},
      {"verify", a, b},
      {"check", folder.path("p.noli"), a, b},
      {"info", a, run, folder.path("p.noli")},
      {"export", run, "--fps", "10", "-o", folder.path("e/%d.ply"), "--force"},
      {"simulate", file, "-o", folder.path("sheet"), "--force"},
  };
  if (reports_are_there()) {
    commands.push_back({"report", folder.path("r.json"), a, b, "-o", folder.path("page.html"), "--force"});
  }
  for (auto command : commands) {
    const Process without = run_noli(command);
    command.insert(command.end(), {"--time-limit", "10m"});
    const Process with = run_noli(command);
    EXPECT_EQ(without.exit_code, 0) << command[0] << without.err;
    EXPECT_EQ(with.exit_code, 0) << command[0] << with.err;
    EXPECT_EQ(with.verdict_line(), without.verdict_line()) << command[0];
  }
}

TEST_F(Limits, ALimitHasToBeADuration) {
  const auto a = folder.write("a.ply", two_triangles(1));
  for (const std::vector<std::string>& command : {std::vector<std::string>{"explain", a},
                                                  {"check", a, a},
                                                  {"info", a},
                                                  {"report", a, "-o", folder.path("p.html")},
                                                  {"export", folder.path("run"), "-o", folder.path("%d.ply")}}) {
    auto arguments = command;
    arguments.insert(arguments.end(), {"--time-limit", "soon"});
    const Process process = run_noli(arguments);
    EXPECT_EQ(process.exit_code, 3) << command[0];
    EXPECT_NE(process.err.find("--time-limit: 'soon' is not a duration"), std::string::npos) << process.err;
  }
}

TEST_F(Limits, AFileWithoutAnEndIsRefused) {
  const auto link = folder.path("zeros.ply");
  fs::create_symlink("/dev/zero", link);
  for (const std::vector<std::string>& command : {std::vector<std::string>{"info", "/dev/zero"},
                                                  {"info", link},
                                                  {"verify", link, link},
                                                  {"explain", "/dev/zero"}}) {
    const auto [process, seconds] = timed(command);
    EXPECT_EQ(process.exit_code, 3) << process.out;
    EXPECT_LT(seconds, soon);
    EXPECT_LT(process.peak_bytes, 1'000'000'000u);
  }
  // An empty sparse file that is larger than memory.
  const auto huge = folder.write("huge.ply", two_triangles(1));
  fs::resize_file(huge, std::uintmax_t{1} << 42);
  const auto [process, seconds] = timed({"info", huge});
  EXPECT_EQ(process.exit_code, 3) << process.out;
  EXPECT_NE(process.err.find("half of this machine's memory"), std::string::npos) << process.err;
  EXPECT_LT(seconds, soon);
}

/// `noli` with a script as its checker.
class OtherChecker : public Limits {
 protected:
  ProcessOptions with(const std::string& script) const {
    ProcessOptions options;
    options.program = folder.path("noli");
    if (!fs::exists(options.program)) fs::copy_file(NOLI_COMMAND, options.program);
    fs::permissions(folder.write("noli_check", "#!/bin/sh\n" + script + "\n"), fs::perms::owner_all);
    return options;
  }
  std::vector<std::string> verify(const std::string& limit) const {
    return {"verify", folder.write("a.ply", two_triangles(1)), folder.write("b.ply", two_triangles(2)), "--time-limit",
            limit};
  }
};

TEST_F(OtherChecker, ThatSaysNothingIsEndedAtTheLimit) {
  const auto [process, seconds] = timed(verify("300ms"), with("exec sleep 60"));
  EXPECT_EQ(process.exit_code, 2) << process.err;
  EXPECT_NE(process.out.find("UNDECIDED"), std::string::npos) << process.out;
  EXPECT_LT(seconds, soon);
}

/// A stopped check leaves a complete proof; stopping before all steps are decided leaves an incomplete one.
TEST_F(OtherChecker, ThatSaysNothingLeavesAWholeProof) {
  const std::string proof = folder.path("proof.noli"), unfinished = "is not complete, and proves nothing";
  std::vector<std::string> words = verify("300ms");
  words.insert(words.end(), {"--proof", proof});
  const Process whole = run_noli(words, with("exec sleep 60"));
  EXPECT_EQ(whole.exit_code, 2) << whole.err;
  EXPECT_NE(whole.out.find("was not checked: time limit"), std::string::npos) << whole.out;
  EXPECT_EQ(whole.out.find(unfinished), std::string::npos) << whole.out;
  EXPECT_EQ(run_noli({"check", proof, words[1], words[2]}).exit_code, 0);

  words.insert(words.begin() + 3, pipe_in(folder, "c.ply"));
  words.emplace_back("--force");
  const Process begun = run_noli(words);
  EXPECT_EQ(begun.exit_code, 2) << begun.err;
  EXPECT_NE(begun.out.find(unfinished), std::string::npos) << begun.out;
  EXPECT_EQ(run_noli({"check", proof, words[1], words[2], folder.write("d.ply", two_triangles(3))}).exit_code, 3);
}

TEST_F(OtherChecker, ThatClosesItsOutputAndStaysIsEnded) {
  const std::string closes = "cat >/dev/null; exec >&- 2>&-; exec sleep 60";
  const auto [limited, seconds] = timed(verify("500ms"), with(closes));
  EXPECT_EQ(limited.exit_code, 2) << limited.err;
  EXPECT_LT(seconds, soon);
  const auto [patient, longer] = timed(verify("10m"), with(closes));
  EXPECT_EQ(patient.exit_code, 4) << patient.out;
  EXPECT_NE(patient.err.find("closed its output, but did not end"), std::string::npos) << patient.err;
  EXPECT_LT(longer, 10);
}

TEST_F(OtherChecker, ThatSaysTooMuchTakesNoMemory) {
  const auto [process, seconds] = timed(verify("10m"), with("cat >/dev/null; head -c 500000000 /dev/zero"));
  EXPECT_EQ(process.exit_code, 4) << process.out;
  if (!sanitized) {
    EXPECT_LT(process.peak_bytes, 100'000'000u);
  }
}

TEST_F(Limits, ManyTinyFramesTakeLittleMemory) {
  std::vector<std::string> few = {"verify"}, many = {"verify"};
  for (int k = 0; k < 10'000; ++k) {
    const std::string frame = folder.write(std::to_string(100'000 + k) + ".obj",
                                           "v 0 0 0\nv 1 0 0\nv 0 1 " + std::to_string(k) + "\nf 1 2 3\n");
    if (k < 10) few.push_back(frame);
    many.push_back(frame);
  }
  const Process small = run_noli(few), large = run_noli(many);
  ASSERT_EQ(small.exit_code, 0) << small.err;
  ASSERT_EQ(large.exit_code, 0) << large.err;
  if (!sanitized) {
    EXPECT_LT(large.peak_bytes, small.peak_bytes + 20'000'000u);
  }
}

/// A waving sheet, written as one file of all frames by `write(path, coordinates, frames, faces)`.
class LongMotion : public testing::Test {
 protected:
  static constexpr std::size_t side = 150, vertices = side * side;
  using Faces = std::vector<std::array<std::int64_t, 3>>;

  static std::vector<double> coordinates(std::size_t frames) {
    std::vector<double> x;
    for (std::size_t k = 0; k < frames; ++k) {
      for (std::size_t v = 0; v < vertices; ++v) {
        const std::size_t column = v % side, row = v / side;
        const auto u = static_cast<double>(column), w = static_cast<double>(row);
        x.insert(x.end(), {u, w, std::sin(0.1 * u + 0.2 * static_cast<double>(k)) * std::cos(0.07 * w)});
      }
    }
    return x;
  }
  static Faces faces() {
    Faces faces;
    for (std::size_t i = 0; i + 1 < side; ++i) {
      for (std::size_t j = 0; j + 1 < side; ++j) {
        const auto a = static_cast<std::int64_t>(i * side + j), b = static_cast<std::int64_t>(a + side);
        faces.push_back({a, a + 1, b + 1});
        faces.push_back({a, b + 1, b});
      }
    }
    return faces;
  }
  template <class Write>
  void expect_memory_of_two_frames(const Write& write) const {
    const std::string few = write(2), all = write(60);
#ifdef __GLIBC__
    malloc_trim(0);  // what a process has before it becomes another program counts as that one's
#endif
    expect_same_memory({"verify", "--no-check"}, few, all);
    expect_same_memory({"verify", "--no-check", "--force", "--proof", folder.path("proof.noli")}, few, all);
  }

  Folder folder;

 private:
  static void expect_same_memory(std::vector<std::string> words, const std::string& few, const std::string& all) {
    words.push_back(few);
    const Process two = run_noli(words);
    words.back() = all;
    const Process many = run_noli(words);
    ASSERT_EQ(two.exit_code, 0) << two.err;
    ASSERT_EQ(many.exit_code, 0) << many.err;
    if (!sanitized) {
      EXPECT_LT(static_cast<double>(many.peak_bytes), 1.3 * static_cast<double>(two.peak_bytes));
    }
  }
};

TEST_F(LongMotion, InAnArchiveTakesTheMemoryOfTwoFrames) {
  test::NumpyArray cells{"<u4", {faces().size(), 3}, {}};
  for (const auto& face : faces()) cells.numbers.insert(cells.numbers.end(), face.begin(), face.end());
  expect_memory_of_two_frames([&](std::size_t frames) {
    const test::NumpyArray x{"<f8", {frames, vertices, 3}, coordinates(frames)};
    return folder.write(std::to_string(frames) + ".npz",
                        test::stored_zip({{"x.npy", x.bytes()}, {"f.npy", cells.bytes()}}));
  });
}

#ifdef NOLI_SERIES
TEST_F(LongMotion, InHdf5TakesTheMemoryOfTwoFrames) {
  expect_memory_of_two_frames([&](std::size_t frames) {
    const std::string file = folder.path(std::to_string(frames) + ".vtkhdf");
    test::write_vtkhdf(file, coordinates(frames), frames, faces(), H5T_IEEE_F64LE);
    return file;
  });
}
#endif

}  // namespace
}  // namespace noli::app_tests
