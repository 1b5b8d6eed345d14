// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>

#include "tests/app/runs/killer.h"
#include "tests/app/runs/simulate_fixture.h"
#include "tests/kernel/random_numbers.h"
#include "trajectory/blocks/folder_lock.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/blocks/run_log.h"
#include "trajectory/formats/frames.h"

namespace noli::app_tests {
namespace {

TEST_F(Simulate, CommitsWhatTouchesNothing) {
  const Json json = json_of({"simulate", scene(hanging_sheet()), "-o", run_path("run")}, 0);
  EXPECT_EQ(json["verdict"], "no_contact");
  EXPECT_EQ(json["end"], "done");
  EXPECT_EQ(json["windows"], 25);
  EXPECT_EQ(json["time"], 0.25);
  EXPECT_EQ(json["first"], nullptr);
  for (const char* file : {"manifest.json", "scene.json", "trajectory.blocks", "log.jsonl"}) {
    EXPECT_TRUE(fs::exists(fs::path(folder.path("run")) / file)) << file;
  }
  const Json verified = json_of({"verify", run_path("run")}, 0);
  EXPECT_EQ(verified["verdict"], "proved");
  EXPECT_EQ(json["proof"], (Json{{"whole", true}, {"ends", nullptr}}));
  EXPECT_EQ(verified["steps"], 25);
  EXPECT_EQ(verified["faces"], 72);
}

TEST_F(Simulate, EndsAtTheFirstContactAndNamesIt) {
  const std::string file = scene(falling_triangle());
  const Json json = json_of({"simulate", file, "-o", run_path("run")}, 1);
  EXPECT_EQ(json["verdict"], "contact");
  EXPECT_EQ(json["first_time"], 0.3125);
  EXPECT_EQ(json["first"]["pair"], "vertex_face");
  EXPECT_EQ(json["first"]["features"], Json::parse("[[3], [0, 1, 2]]"));
  EXPECT_EQ(json["first"]["names"], "vertex upright[0] meets face level[0]-level[1]-level[2]");
  EXPECT_EQ(json["windows"], 39);  // 39 * 2^-7 < 0.3125 <= 40 * 2^-7
  const Json last = last_entry(run_path("run"));
  EXPECT_EQ(last["event"], "end");
  EXPECT_EQ(last["end"], "contact");
  EXPECT_EQ(last["first_time"], 0.3125);
  const Json verified = json_of({"verify", run_path("run")}, 0);
  EXPECT_EQ(verified["steps"], 39);
  // If it ends slightly earlier, nothing touches.
  EXPECT_EQ(run_noli({"simulate", file, "-o", run_path("short"), "--until", "0.3"}).exit_code, 0);
}

TEST_F(Simulate, ABeginningInContactIsRefusedWithItsPairs) {
  Json json = falling_triangle();
  json["bodies"][1]["transform"] = {{"translate", {0, 0, -0.3125}}};
  const Process process = run_noli({"simulate", scene(json), "-o", run_path("run")});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("vertex upright[0] meets face level[0]-level[1]-level[2]"), std::string::npos)
      << process.err;
  EXPECT_FALSE(fs::exists(folder.path("run")));
}

TEST_F(Simulate, CellsThatIntersectAtTheBeginningAreNamed) {
  // Like a sail through a deck: no vertex meets a face, and no edge meets an edge.
  folder.write("deck.obj", "v 0 0 0\nv 8 0 0\nv 0 8 0\nf 1 2 3\n");
  folder.write("sail.obj", "v 2 2 -1\nv 2 2 1\nv 3 2 2\nf 1 2 3\n");
  Json json = falling_triangle();
  for (const char* name : {"deck", "sail"}) {
    Json& body = json["bodies"][name == std::string("sail") ? 1 : 0];
    body["name"] = name;
    body["mesh"]["file"] = name + std::string(".obj");
  }
  json.erase("scripts");
  const std::string file = scene(json);
  const Process process = run_noli({"simulate", file, "-o", run_path("run")});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("begins in contact: face deck[0]-deck[1]-deck[2] intersects face sail[0]-sail[1]-sail[2]; "
                             "in all, 1 pair of cells intersects; expected none"),
            std::string::npos)
      << process.err;
  const Process explained = run_noli({"explain", file});
  EXPECT_EQ(explained.exit_code, 0);
  EXPECT_NE(explained.out.find(
                "begins in contact, and `noli simulate` will refuse it: face deck[0]-deck[1]-deck[2] intersects"),
            std::string::npos)
      << explained.out;
}

TEST_F(Simulate, ExplainWarnsOfNoContactWhereNoneIs) {
  const Process explained = run_noli({"explain", scene(falling_triangle())});
  EXPECT_EQ(explained.exit_code, 0);
  EXPECT_EQ(explained.out.find("begins in contact"), std::string::npos) << explained.out;
}

TEST_F(Simulate, ABeginningInContactIsRefusedWhenResumedToo) {
  Json json = falling_triangle();
  json["bodies"][1]["transform"] = {{"translate", {0, 0, -0.3125}}};
  const std::string file = scene(json);
  fs::create_directory(run_path("run"));  // left by a call that ended before the run began
  const Process process = run_noli({"simulate", file, "-o", run_path("run"), "--resume"});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("the scene begins in contact"), std::string::npos) << process.err;
  EXPECT_TRUE(fs::is_empty(run_path("run")));
}

TEST_F(Simulate, ThreadsChangeNoByte) {
  const std::string file = scene(hanging_sheet());
  for (const char* threads : {"1", "2", "5"}) {
    EXPECT_EQ(run_noli({"simulate", file, "-o", run_path(threads), "--threads", threads}).exit_code, 0);
  }
  EXPECT_FALSE(blocks("1").empty());
  EXPECT_TRUE(blocks("1") == blocks("2"));
  EXPECT_TRUE(blocks("1") == blocks("5"));
}

TEST_F(Simulate, ResumingGivesTheBytesOfTheWholeRun) {
  const std::string file = scene(hanging_sheet());
  EXPECT_EQ(run_noli({"simulate", file, "-o", run_path("whole")}).exit_code, 0);
  EXPECT_EQ(run_noli({"simulate", file, "-o", run_path("parts"), "--until", "0.07"}).exit_code, 0);
  EXPECT_FALSE(blocks("parts") == blocks("whole"));
  const Json json = json_of({"simulate", file, "-o", run_path("parts"), "--resume"}, 0);
  EXPECT_EQ(json["timing"]["windows_before"], 7);
  EXPECT_TRUE(blocks("parts") == blocks("whole"));
  const Process past = run_noli({"simulate", file, "-o", run_path("parts"), "--resume", "--until", "0.07"});
  EXPECT_EQ(past.exit_code, 3);
  EXPECT_NE(past.err.find("reaches 0.25 s, but the windows asked for end at 0.07 s"), std::string::npos) << past.err;
}

TEST_F(Simulate, KilledRunsGoOn) {
  Json json = hanging_sheet();
  json["duration"] = 1;
  const std::string file = scene(json);
  EXPECT_EQ(run_noli({"simulate", file, "-o", run_path("whole")}).exit_code, 0);
  int microseconds = 12'000;
  const auto pause = [&] { return std::chrono::microseconds(microseconds += 977); };
  const int kills = kill_until_done({file}, run_path("killed"), 5, pause);
  EXPECT_GE(kills, 1);
  EXPECT_TRUE(blocks("killed") == blocks("whole"));
}

TEST_F(Simulate, SlowKilledAHundredTimesARunHasTheSameBytes) {
  Json json = hanging_sheet();
  json["duration"] = 1;
  const std::string file = scene(json);
  EXPECT_EQ(run_noli({"simulate", file, "-o", run_path("whole")}).exit_code, 0);
  test::Random random(1);
  const auto pause = [&] { return std::chrono::microseconds(9000 + random.below(9000)); };
  int kills = 0;
  while (kills < 100) {
    const int more = kill_until_done({file}, run_path("killed"), 20, pause);
    ASSERT_GE(more, 0);
    kills += more;
    ASSERT_TRUE(blocks("killed") == blocks("whole"));
    fs::remove_all(run_path("killed"));
  }
}

TEST_F(Simulate, InterruptedRunsEndAtTheLastWindow) {
  Json json = hanging_sheet();
  json["bodies"][0].erase("pin");  // it falls forever without contact
  json["duration"] = 10000;
  const std::string file = scene(json);
  ProcessOptions options;
  options.signal = SIGINT;
  options.signal_after = std::chrono::milliseconds(200);
  const Process process = run_noli({"simulate", file, "-o", run_path("run"), "--ignore-space"}, options);
  EXPECT_EQ(process.exit_code, 2) << process.out;
  EXPECT_EQ(process.verdict_line().rfind("UNDECIDED  ", 0), 0) << process.out;
  EXPECT_EQ(json_of({"verify", run_path("run")}, 0)["verdict"], "proved");
}

TEST_F(Simulate, AFolderThatIsThereIsNotOverwritten) {
  const std::string file = scene(falling_triangle());
  EXPECT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--until", "0.1"}).exit_code, 0);
  EXPECT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--until", "0.1"}).exit_code, 3);
  EXPECT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--until", "0.1", "--force"}).exit_code, 0);
  folder.write("precious.txt", "not a run");
  EXPECT_EQ(run_noli({"simulate", file, "-o", fs::path(folder.path("x")).parent_path().string(), "--force"}).exit_code,
            3);
  EXPECT_TRUE(fs::exists(folder.path("precious.txt")));
  EXPECT_EQ(run_noli({"simulate", file, "-o", run_path("none"), "--resume"}).exit_code, 3);
}

TEST_F(Simulate, AnotherSceneDoesNotGoOnWithARun) {
  Json json = hanging_sheet();
  EXPECT_EQ(run_noli({"simulate", scene(json), "-o", run_path("run"), "--until", "0.05"}).exit_code, 0);
  json["gravity"] = {0, 0, -1};
  EXPECT_EQ(run_noli({"simulate", scene(json), "-o", run_path("run"), "--resume"}).exit_code, 3);
}

TEST_F(Simulate, NumbersThatRunOutAreNamed) {
  Json json = hanging_sheet();
  json["bodies"][0]["steps"] = {{"stretch", 0.01}};
  const Process refused = run_noli({"simulate", scene(json), "-o", run_path("run")});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("/bodies/0/steps/stretch"), std::string::npos) << refused.err;
  // A chain in the plane meets nothing before its numbers overflow.
  json = Json::parse(R"({
      "noli_scene": 1, "dimension": 2, "duration": 1000, "window": 0.01, "allow_unstable": true,
      "bodies": [{"name": "pair", "mesh": {"chain": {"points": [[0, 0], [1, 0]], "segments": 1}},
                  "material": {"edge_stiffness": 1e6, "mass_per_vertex": 1}, "velocity": [0, 0], "spin": 1,
                  "steps": {"stretch": 0.01}}]})");
  const Json blown = json_of({"simulate", scene(json), "-o", run_path("run")}, 1);
  EXPECT_EQ(blown["verdict"], "not_finite");
  EXPECT_EQ(blown["end"], "not_finite");
  EXPECT_EQ(blown["not_finite"]["force"], "edge_spring");
  EXPECT_EQ(json_of({"verify", run_path("run")}, 0)["verdict"], "proved");
}

TEST_F(Simulate, FieldsAreNamedInErrors) {
  Json json = hanging_sheet();
  json["bodies"][0]["material"]["density"] = -1;
  const Process process = run_noli({"simulate", scene(json), "-o", run_path("run")});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("/bodies/0/material/density"), std::string::npos) << process.err;
  EXPECT_EQ(run_noli({"explain", scene(json)}).exit_code, 3);
}

TEST_F(Simulate, ExplainSaysWhatIsActive) {
  const Process process = run_noli({"explain", scene(hanging_sheet())});
  EXPECT_EQ(process.exit_code, 0);
  EXPECT_NE(process.out.find("membrane"), std::string::npos);
  EXPECT_NE(process.out.find("hinge"), std::string::npos);
  const Json json = json_of({"explain", scene(hanging_sheet())}, 0);
  EXPECT_EQ(json["bodies"][0]["vertices"], 49);
}

TEST_F(Simulate, WhatExplainNotesIsToldBeforeTheRun) {
  Json json = beam(0.1);
  const std::string calm = scene(json);
  ASSERT_EQ(run_noli({"explain", calm}).out.find("Note: "), std::string::npos);
  const std::string calmly = run_noli({"simulate", calm, "-o", run_path("calm")}).err;
  EXPECT_EQ(calmly.find("noli: note: about "), 0u) << calmly;  // only about its size
  EXPECT_EQ(std::count(calmly.begin(), calmly.end(), '\n'), 1) << calmly;
  json["allow_unstable"] = true;
  const std::string unstable = scene(json);
  const std::string note = "steps above the limit of stability are accepted (\"allow_unstable\").\n";
  EXPECT_NE(run_noli({"explain", unstable}).out.find("Note: " + note), std::string::npos);
  const Process told = run_noli({"simulate", unstable, "-o", run_path("run"), "--json", "-"});
  EXPECT_EQ(told.err.rfind("noli: note: " + note + "noli: note: about ", 0), 0u) << told.err;
  EXPECT_EQ(Json::parse(told.out)["end"], "done");
  // A refusal is a single line.
  const Process refused = run_noli({"simulate", unstable, "-o", run_path("run")});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_EQ(refused.err.find("note"), std::string::npos) << refused.err;
}

TEST_F(Simulate, FramesAreExported) {
  EXPECT_EQ(run_noli({"simulate", scene(falling_triangle()), "-o", run_path("run"), "--until", "0.25"}).exit_code, 0);
  const Process process = run_noli({"export", run_path("run"), "--fps", "8", "-o", run_path("frames/%03d.ply")});
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_NE(process.out.find("not the certified motion"), std::string::npos);
  const Frame last = read_frame(run_path("frames/002.ply"));
  EXPECT_EQ(last.positions[3], (Position{0, -0.25, 0.0625}));
  EXPECT_FALSE(fs::exists(run_path("frames/003.ply")));
  EXPECT_EQ(run_noli({"export", run_path("run"), "-o", run_path("frames/x.ply")}).exit_code, 3);
  EXPECT_EQ(run_noli({"export", run_path("run"), "--fps", "8", "-o", run_path("vtu/f_%d.vtu")}).exit_code, 0);
  EXPECT_TRUE(fs::exists(run_path("vtu/f.pvd")));
  const Process many = run_noli({"export", run_path("run"), "--fps", "1e300", "-o", run_path("many/%d.ply")});
  EXPECT_EQ(many.exit_code, 3);
  EXPECT_NE(many.err.find("--fps 1e+300: expected at most 1000000 frames"), std::string::npos) << many.err;
  EXPECT_TRUE(fs::is_empty(run_path("many")));
}

TEST_F(Simulate, WindowsThatTheLogKnowsAreMissed) {
  ASSERT_EQ(run_noli({"simulate", scene(hanging_sheet()), "-o", run_path("run")}).exit_code, 0);
  const std::string path = run_path("run/trajectory.blocks");
  fs::resize_file(path, fs::file_size(path) / 2);
  for (const char* command : {"verify", "explain"}) {
    const Process process = run_noli({command, run_path("run")});
    EXPECT_EQ(process.exit_code, 3) << process.out;
    EXPECT_NE(process.err.find("trajectory.blocks: windows are missing: it has "), std::string::npos) << process.err;
    EXPECT_NE(process.err.find(", the log lists 25"), std::string::npos) << process.err;
  }
  EXPECT_EQ(run_noli({"simulate", scene(hanging_sheet()), "-o", run_path("run"), "--resume"}).exit_code, 0);
  EXPECT_EQ(json_of({"verify", run_path("run")}, 0)["steps"], 25);
}

TEST_F(Simulate, MemoryDoesNotGrowWithTheLength) {
#if defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "what the thread sanitizer remembers of memory grows too";
#endif
  // The address sanitizer keeps freed memory, by default up to 256 MB; without it, this has no effect.
  add_sanitizer_options("quarantine_size_mb=0:thread_local_quarantine_size_kb=0");
  for (const char* record : {"frames", "full"}) {
    Json json = beam(2);
    json["record"] = record;
    const auto run = [&](const std::string& name, double duration) {
      json["duration"] = duration;
      return run_noli({"simulate", scene(json), "-o", run_path(record + name)});
    };
    const Process once = run("once", 2), tenfold = run("tenfold", 20);
    ASSERT_EQ(once.exit_code, 0) << once.err;
    ASSERT_EQ(tenfold.exit_code, 0) << tenfold.err;
    EXPECT_LT(static_cast<double>(tenfold.peak_bytes), 1.1 * static_cast<double>(once.peak_bytes)) << record;
    // Nor does the memory for reading the run, including resumption.
    const Process short_verify = run_noli({"verify", run_path(record + std::string("once"))});
    const Process long_verify = run_noli({"verify", run_path(record + std::string("tenfold"))});
    EXPECT_LT(static_cast<double>(long_verify.peak_bytes), 1.1 * static_cast<double>(short_verify.peak_bytes));
    json["duration"] = 20.02;
    const Process resumed =
        run_noli({"simulate", scene(json), "-o", run_path(record + std::string("tenfold")), "--resume"});
    ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_LT(static_cast<double>(resumed.peak_bytes), 1.2 * static_cast<double>(once.peak_bytes)) << record;
  }
}

/// The hash of each window's world lines.
std::vector<Sha256Digest> hashes(const std::string& run) {
  std::vector<Sha256Digest> result;
  RunReader reader(run);
  while (auto window = reader.next_window()) {
    result.push_back(window->lines ? lines_hash(reader.scene().header.dimension, *window->lines) : window->lines_hash);
  }
  return result;
}

TEST_F(Simulate, WhatIsWrittenDoesNotChangeTheMotion) {
  Json json = beam(0.2);
  const auto run = [&](const std::string& name) {
    EXPECT_EQ(run_noli({"simulate", scene(json), "-o", run_path(name)}).exit_code, 0);
    return hashes(run_path(name));
  };
  const auto at_100 = run("100");
  json["frame_rate"] = 37;
  const auto at_37 = run("37");
  json["record"] = "full";
  const auto full = run("full");
  EXPECT_EQ(at_100.size(), 10u);
  EXPECT_TRUE(at_100 == at_37);
  EXPECT_TRUE(at_100 == full);
  json["gravity"] = {0, -0.06};
  EXPECT_FALSE(at_100 == run("another"));
}

TEST_F(Simulate, AFullDiskLeavesTheCommittedWindows) {
  const std::string file = scene(hanging_sheet());
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("whole")}).exit_code, 0);
  ProcessOptions options;
  options.file_size = blocks("whole").size() / 2;
  const Process process = run_noli({"simulate", file, "-o", run_path("run")}, options);
  EXPECT_EQ(process.exit_code, 4);
  EXPECT_NE(process.err.find("trajectory.blocks: File too large"), std::string::npos) << process.err;
  const Json verified = json_of({"verify", run_path("run")}, 0);
  EXPECT_GT(verified["steps"], 5);
  EXPECT_LT(verified["steps"], 20);
  EXPECT_EQ(verified["verdict"], "no_contact");
  EXPECT_NE(verified["proof"]["not_checked"].get<std::string>().find("ends within a window"), std::string::npos);
  EXPECT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--resume"}).exit_code, 0);
  EXPECT_TRUE(blocks("run") == blocks("whole"));
}

TEST_F(Simulate, InfoSaysWhatIsInARun) {
  const std::string file = scene(hanging_sheet());
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--until", "0.07"}).exit_code, 0);
  const Json info = json_of({"info", run_path("run")}, 0)["files"][0];
  EXPECT_EQ(info["format"], "Noli run");
  EXPECT_EQ(info["dimension"], 3);
  EXPECT_EQ(info["record"], "full");
  EXPECT_EQ(info["vertices"], 49);
  EXPECT_EQ(info["faces"], 72);
  EXPECT_EQ(info["windows"], 7);
  EXPECT_EQ(info["end_time"], 0.07);
  EXPECT_EQ(info["open_window"], false);
  EXPECT_EQ(info["bytes"], blocks("run").size());
  EXPECT_GT(info["breakpoints"], 7 * 49);
  EXPECT_EQ(run_noli({"info", folder.path("none")}).exit_code, 3);
  const Process none = run_noli({"verify", folder.path("none")});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_NE(none.err.find("no such file or folder"), std::string::npos) << none.err;
}

/// Two bars in the plane; the upper one reaches the lower one at 0.5 s.
Json falling_bar() {
  return Json::parse(R"({
      "noli_scene": 1, "dimension": 2, "duration": 1, "window": 0.25, "bodies": [
        {"name": "a", "mesh": {"chain": {"points": [[-1, 0], [1, 0]], "segments": 1}},
         "material": {"edge_stiffness": 0, "mass_per_vertex": 1}},
        {"name": "b", "mesh": {"chain": {"points": [[0, 0.5], [0, 1.5]], "segments": 1}}, "velocity": [0, -1],
         "material": {"edge_stiffness": 0, "mass_per_vertex": 1}}]})");
}

TEST_F(Simulate, TimesBeyondAllWindowsAreRefused) {
  const std::string file = scene(falling_bar());
  for (const char* until : {"1e300", "1e19", "nan", "inf", "-1", "0"}) {
    EXPECT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--until", until}).exit_code, 3) << until;
    EXPECT_FALSE(fs::exists(run_path("run"))) << until;
  }
  const std::vector<std::string> late = {"simulate", file, "-o", run_path("run"), "--until", "1e9"};
  EXPECT_EQ(run_noli(late).exit_code, 3);
  auto meant = late;
  meant.insert(meant.end(), {"--past-duration", "--ignore-space"});
  EXPECT_EQ(json_of(meant, 1)["first_time"], 0.5);
}

TEST_F(Simulate, WhatIsNotComparedIsPartOfTheStatement) {
  Json json = falling_bar();
  json["bodies"][0]["pin"] = {"all"};
  json["scripts"] = Json::parse(R"([{"body": "b", "path": [{"t": 0, "move": [0, 0]}, {"t": 1, "move": [0, -0.75]}]}])");
  const Json result = json_of({"simulate", scene(json), "-o", run_path("run")}, 0);
  EXPECT_NE(result["statement"].get<std::string>().find("all scripted or pinned"), std::string::npos);
  EXPECT_EQ(result["scripted_or_pinned"], Json::parse(R"(["a", "b"])"));
  const std::string headline = "Not compared: two cells of a and b whose vertices are all scripted or pinned.\n";
  const Process told = run_noli({"simulate", scene(json), "-o", run_path("told")});
  EXPECT_NE(told.out.find("Nothing that is compared touches from 0 to 1 s. " + headline), std::string::npos)
      << told.out;
  const Process verified = run_noli({"verify", run_path("run")});
  EXPECT_NE(verified.out.find(": nothing that is compared touches; not compared: two cells of a and b "),
            std::string::npos)
      << verified.out;
  const Json statement = json_of({"verify", run_path("run")}, 0)["statement"];
  EXPECT_EQ(statement["excluded"][0], "two cells of a and b whose vertices are all scripted or pinned");
  EXPECT_EQ(statement["windows"], result["windows"]);
  EXPECT_FALSE(statement.contains("frames"));
  // Without the log bodies have no names.
  fs::remove(run_path("run/log.jsonl"));
  EXPECT_NE(run_noli({"verify", run_path("run")}).out.find("nothing that is compared touches"), std::string::npos);
}

TEST_F(Simulate, WhereOneBodyIsScriptedOrPinnedNothingTouches) {
  const Process told = run_noli({"simulate", scene(falling_triangle()), "-o", run_path("run"), "--until", "0.3"});
  EXPECT_NE(told.out.find("Nothing touches from 0 to 0.3046875 s.\n"), std::string::npos) << told.out;
  const Process verified = run_noli({"verify", run_path("run")});
  EXPECT_NE(verified.out.find("\nPROVED  39 of 128 windows, "), std::string::npos) << verified.out;
}

TEST_F(Simulate, WithoutCellsThereIsNothingToCertify) {
  folder.write("points.obj", "v 0 0 0\nv 1 0 0\n");
  Json json = falling_triangle();
  json["bodies"] = Json::parse(R"([{"name": "points", "mesh": {"file": "points.obj"},
                                   "material": {"edge_stiffness": 0, "mass_per_vertex": 1}}])");
  json.erase("scripts");
  const Process process = run_noli({"simulate", scene(json), "-o", run_path("run")});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("/bodies: expected a mesh with faces, edges or points"), std::string::npos) << process.err;
}

TEST_F(Simulate, OnlyRunsAreReplaced) {
  const std::string file = scene(hanging_sheet());
  const std::string there = fs::path(file).parent_path();  // contains only the scene
  for (const char* how : {"--force", "--resume"}) {
    const Process process = run_noli({"simulate", file, "-o", there, how, "--until", "0.01"});
    EXPECT_EQ(process.exit_code, 3) << how;
    EXPECT_TRUE(fs::exists(file)) << how;
  }
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("run/."), "--until", "0.05"}).exit_code, 0);
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("run/"), "--until", "0.05", "--force"}).exit_code, 0);
  fs::remove(run_path("run/manifest.json"));
  const Process process = run_noli({"simulate", file, "-o", run_path("run"), "--resume"});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("has lost its manifest.json"), std::string::npos) << process.err;
}

TEST_F(Simulate, ARunThatIsBeingWrittenIsNotReplaced) {
  const std::string file = scene(hanging_sheet());
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--until", "0.05"}).exit_code, 0);
  {
    const FolderLock writer(run_path("run"));
    const Process process = run_noli({"simulate", file, "-o", run_path("run"), "--force"});
    EXPECT_EQ(process.exit_code, 3);
    EXPECT_NE(process.err.find("is being written by"), std::string::npos) << process.err;
  }
  EXPECT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--force", "--until", "0.05"}).exit_code, 0);
}

TEST_F(Simulate, FilesOfARunAreNotOverwritten) {
  const std::string file = scene(hanging_sheet());
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--until", "0.05"}).exit_code, 0);
  const std::string before = blocks("run");
  const std::string kept = run_path("run/trajectory.blocks");
  EXPECT_EQ(run_noli({"verify", run_path("run"), "--json", kept}).exit_code, 3);
  EXPECT_EQ(run_noli({"info", run_path("run"), "--json", kept}).exit_code, 3);
  EXPECT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--resume", "--json", kept}).exit_code, 3);
  EXPECT_EQ(run_noli({"simulate", file, "--reproduce", run_path("run"), "--window", "1", "-o", kept}).exit_code, 3);
  EXPECT_EQ(run_noli({"simulate", file, "--reproduce", run_path("run"), "--window", "1", "-o", file}).exit_code, 3);
  EXPECT_TRUE(blocks("run") == before);
  const Json again =
      json_of({"simulate", file, "--reproduce", run_path("run"), "--window", "1", "-o", run_path("1.block")}, 0);
  EXPECT_EQ(again["verdict"], "same");
}

TEST_F(Simulate, ARunDoesNotGoOnWithOtherFiles) {
  const std::string file = scene(falling_triangle());
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("run"), "--until", "0.1"}).exit_code, 0);
  folder.write("upright.obj", "v 0 -0.25 0.375\nv -0.25 -0.25 1\nv 0.25 -0.25 1\nf 1 2 3\n");
  const Process process = run_noli({"simulate", file, "-o", run_path("run"), "--resume"});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("/model/sha256"), std::string::npos) << process.err;
}

TEST_F(Simulate, RecordedFramesKeepTheirRate) {
  Json json = beam(0.1);
  ASSERT_EQ(run_noli({"simulate", scene(json), "-o", run_path("run"), "--until", "0.04"}).exit_code, 0);
  json["frame_rate"] = 37;
  EXPECT_EQ(run_noli({"simulate", scene(json), "-o", run_path("run"), "--resume"}).exit_code, 3);
  json["frame_rate"] = 100;
  json["duration"] = 0.2;
  EXPECT_EQ(run_noli({"simulate", scene(json), "-o", run_path("run"), "--resume"}).exit_code, 0);
}

TEST_F(Simulate, ExportWantsAFiniteRate) {
  ASSERT_EQ(run_noli({"simulate", scene(falling_triangle()), "-o", run_path("run"), "--until", "0.1"}).exit_code, 0);
  for (const char* fps : {"nan", "inf", "0", "-1", "1e999"}) {
    EXPECT_EQ(run_noli({"export", run_path("run"), "--fps", fps, "-o", run_path("%d.ply")}).exit_code, 3) << fps;
  }
}

TEST_F(Simulate, AMissingShortFormIsNoted) {
  const std::string note = "noli: note: --short changes nothing: the scene has no \"short\".\n";
  Json json = beam(0.1);
  for (const char* where : {"with", "without"}) {
    const bool expected = where == std::string("without");
    if (expected)
      json.erase("short");
    else
      json["short"] = {{"/duration", 0.06}};  // whole windows
    const std::string file = scene(json);
    EXPECT_EQ(run_noli({"explain", file, "--short"}).err, expected ? note : "");
    const std::string told = run_noli({"simulate", file, "--short", "-o", run_path(where)}).err;
    EXPECT_EQ(told.substr(0, told.find("noli: note: about ")), expected ? note : "") << told;
    EXPECT_EQ(run_noli({"explain", file}).err, "");
  }
}

TEST_F(Simulate, AFolderThatIsNoRunIsCalledThat) {
  const std::string none = fs::path(scene(hanging_sheet())).parent_path();
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"verify", none},
                                                    {"explain", none},
                                                    {"info", none},
                                                    {"export", none, "-o", run_path("%d.ply")},
                                                    {"export", run_path("nosuch"), "-o", run_path("%d.ply")}}) {
    const Process process = run_noli(arguments);
    EXPECT_EQ(process.exit_code, 3) << arguments[0];
    EXPECT_NE(process.err.find(": is not a run: it has no trajectory.blocks"), std::string::npos) << process.err;
  }
}

TEST_F(Simulate, WindowsToReproduceAreCountedFromOne) {
  const std::string file = scene(beam(0.1));
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("run")}).exit_code, 0);
  for (const char* window : {"-1", "0", "1.5", "one", "99999999999999999999"}) {
    const Process process =
        run_noli({"simulate", file, "--reproduce", run_path("run"), "--window", window, "-o", run_path("block")});
    EXPECT_EQ(process.exit_code, 3) << window;
    EXPECT_NE(process.err.find(std::string("--window: ") + window + ": expected a whole number from 1"),
              std::string::npos)
        << process.err;
  }
}

TEST_F(Simulate, NamesOfBodiesAreToldOnOneLine) {
  Json json = falling_triangle();
  json["bodies"][0]["name"] = "a\x1b[31m\nb";
  const std::string file = scene(json);
  const Process explained = run_noli({"explain", file});
  EXPECT_EQ(explained.out.find('\x1b'), std::string::npos) << explained.out;
  EXPECT_NE(explained.out.find("\n  a\\x1b[31m\\nb: 3 vertices"), std::string::npos) << explained.out;
  const Process simulated = run_noli({"simulate", file, "-o", run_path("run")});
  EXPECT_EQ(simulated.out.find('\x1b'), std::string::npos) << simulated.out;
  EXPECT_EQ(simulated.err.find('\x1b'), std::string::npos) << simulated.err;
}

TEST_F(Simulate, ShortFormsNameTheirBadPointer) {
  Json json = hanging_sheet();
  json["short"] = {{"/bodies/99999999999999999999", Json::object()}};
  const Process process = run_noli({"simulate", scene(json), "--short", "-o", run_path("run")});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("/short"), std::string::npos) << process.err;
}

}  // namespace
}  // namespace noli::app_tests
