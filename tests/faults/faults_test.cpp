// SPDX-License-Identifier: Apache-2.0
//
// Makes each system call of a command fail, once or from then on: memory, files, the disk. The command must then give
// the true answer or none (exit 2, 3 or 4, with a message). It must never end by a signal, or exit with 0 and an
// incomplete answer. Every run that was begun resumes to the same bytes.
//
// Notation
//   kind    of a call, as counted by preload/faults.cpp
//   number  of a call among those of its kind, from 1
//
// The fast tests try some numbers of each kind, the slow ones more. With NOLI_EVERY_FAULT=1 the slow ones try all
// single faults, and at most `most_lasting` lasting ones of a kind.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "tests/app/runs/simulate_fixture.h"

namespace noli::app_tests {
namespace {

/// In arguments, "IN/" is the input folder, made once, and "OUT/" is a folder that is emptied before each call.
struct Command {
  const char* name;
  std::vector<std::string> arguments;
  const char* program = "noli";  ///< whose calls fail; may be a child of noli
  const char* begun = nullptr;   ///< copied from IN to OUT/run first
};

void PrintTo(const Command& command, std::ostream* out) { *out << command.name; }

const std::vector<std::string>& kinds() {
  static const std::vector<std::string> names = {"allocate", "open", "read", "write", "sync", "rename", "close"};
  return names;
}

const std::vector<Command>& commands() {
  static const std::vector<Command> all = {
      {"VerifyFrames", {"verify", "IN/a.obj", "IN/b.obj", "--json", "OUT/a.json", "--proof", "OUT/a.noli"}},
      {"VerifyContact", {"verify", "IN/a.obj", "IN/c.obj", "--json", "OUT/a.json", "--proof", "OUT/a.noli"}},
      {"VerifyInTheChecker", {"verify", "IN/a.obj", "IN/b.obj", "--json", "OUT/a.json"}, "noli_check"},
      {"VerifyRun", {"verify", "IN/run", "--json", "OUT/a.json"}},
      {"Check", {"check", "IN/proof.noli", "IN/a.obj", "IN/b.obj", "--json", "OUT/a.json"}},
      {"CheckInTheChecker", {"check", "IN/proof.noli", "IN/a.obj", "IN/b.obj", "--json", "OUT/a.json"}, "noli_check"},
      {"CheckRun", {"check", "IN/run", "--json", "OUT/a.json"}},
      {"Ccd", {"ccd", "IN/vertex-vertex.csv", "--porcelain"}},
      {"VerifyShard", {"verify", "IN/a.obj", "IN/b.obj", "--shard", "1/1", "-o", "OUT/shards"}},
      {"VerifyParts", {"verify", "IN/a.obj", "IN/b.obj", "--divide", "--shard", "1/16", "-o", "OUT/shards"}},
      {"Merge", {"merge", "IN/shards", "--json", "OUT/a.json", "--proof", "OUT/a.noli"}},
      {"Simulate", {"simulate", "IN/scene.json", "-o", "OUT/run"}},
      {"SimulateFrames", {"simulate", "IN/frames.json", "-o", "OUT/run"}},
      {"Resume", {"simulate", "IN/scene.json", "-o", "OUT/run", "--resume"}, "noli", "half"},
      {"Repair",
       {"repair", "IN/a.obj", "IN/c.obj", "IN/a.obj", "-o", "OUT/%d.obj", "--run", "OUT/run", "--json", "OUT/a.json"}},
      {"ExplainScene", {"explain", "IN/scene.json", "--json", "OUT/a.json"}},
      {"ExplainRun", {"explain", "IN/run", "--json", "OUT/a.json"}},
      {"Export", {"export", "IN/run", "--fps", "50", "-o", "OUT/frames/%02d.obj"}},
      {"Report", {"report", "IN/run", "-o", "OUT/page.html"}},
      {"Info", {"info", "IN/a.obj", "--json", "OUT/a.json"}},
      {"FuzzQueries", {"fuzz", "queries", "--count", "2", "--seed", "1", "--json", "OUT/a.json"}},
  };
  return all;
}

/// The result of a call: exit code, output, files.
struct Outcome {
  int exit_code = -1;
  std::string out, err;
  std::map<std::string, std::string> files;

  bool same_answer(const Outcome& other) const {
    return exit_code == other.exit_code && out == other.out && files == other.files;
  }
};

Json scene_of(const char* record) {
  Json json = Json::parse(R"({
      "noli_scene": 1, "duration": 0.03, "window": 0.01, "gravity": [0, 0, -9.81],
      "bodies": [{"name": "upper", "mesh": {"grid": {"size": [1, 1], "cells": [1, 1]}},
                  "transform": {"translate": [0, 0, 1]},
                  "material": {"young": 2e4, "density": 200, "thickness": 0.001}},
                 {"name": "lower", "mesh": {"grid": {"size": [1, 1], "cells": [1, 1]}},
                  "material": {"young": 2e4, "density": 200, "thickness": 0.001}}]})");
  json["record"] = record;
  json["frame_rate"] = 200;
  return json;
}

class Faults : public testing::TestWithParam<std::tuple<Command, std::string>> {
 protected:
  static void SetUpTestSuite() {
    in_ = new Folder;
    in_->write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nf 1 2 3\nf 4 5 6\n");
    in_->write("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 2\nv 1 0 2\nv 0 1 2\nf 1 2 3\nf 4 5 6\n");
    in_->write("c.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 -2\nv 1 0 -2\nv 0 1 -2\nf 1 2 3\nf 4 5 6\n");
    in_->write("vertex-vertex.csv", "0,1,0,1,0,1\n1,1,0,1,0,1\n0,1,0,1,0,1\n1,1,0,1,0,1\n");
    in_->write("scene.json", scene_of("full").dump());
    in_->write("frames.json", scene_of("frames").dump());
    const auto made = [](const std::vector<std::string>& arguments, int code) {
      const Process process = run_noli(arguments);
      ASSERT_EQ(process.exit_code, code) << process.out << process.err;
    };
    made({"simulate", in_->path("scene.json"), "-o", in_->path("run")}, 0);
    made({"simulate", in_->path("scene.json"), "-o", in_->path("half"), "--until", "0.01"}, 0);
    made({"verify", in_->path("a.obj"), in_->path("b.obj"), "--proof", in_->path("proof.noli")}, 0);
    made({"verify", in_->path("a.obj"), in_->path("b.obj"), "--shard", "1/1", "-o", in_->path("shards")}, 0);
  }
  static void TearDownTestSuite() {
    delete in_;
    in_ = nullptr;
  }

  const Command& command() const { return std::get<0>(GetParam()); }
  const std::string& kind() const { return std::get<1>(GetParam()); }

  std::string out_path(const std::string& name) const { return out_.path(name); }

  std::vector<std::string> words() const {
    std::vector<std::string> words = command().arguments;
    for (std::string& word : words) {
      if (word.starts_with("IN/")) word = in_->path(word.substr(3));
      if (word.starts_with("OUT/")) word = out_path("now/" + word.substr(4));
    }
    return words;
  }

  /// The file without anything that depends on the clock.
  static std::string content_of(const fs::path& path) {
    std::string bytes = bytes_of(path);
    if (path.extension() == ".html" || path.filename() == "log.jsonl" || path.extension() == ".h5") return "";
    if (path.extension() != ".json") return bytes;
    Json json = Json::parse(bytes, nullptr, false);
    if (json.is_object()) json.erase("timing");
    return json.dump();
  }

  Outcome call(const std::string& fault, const std::string& counts = "") const {
    fs::remove_all(out_path("now"));
    fs::create_directories(out_path("now"));
    if (command().begun != nullptr) fs::copy(in_->path(command().begun), out_path("now/run"));
    ProcessOptions options;
    options.environment = {
        {"LD_PRELOAD", NOLI_FAULT_LIBRARY}, {"NOLI_FAULT_PROGRAM", command().program}, {"NOLI_FAULT", fault}};
    if (!counts.empty()) options.environment.emplace_back("NOLI_FAULT_COUNTS", counts);
    const Process process = run_noli(words(), options);
    return {process.exit_code, process.out, process.err, files_now()};
  }

  /// Those have random names; those of a run do not.
  bool is_part_of_a_shard(const fs::path& path) const { return makes("OUT/shards") && path.extension() == ".part"; }

  /// What a command has written, without what it could not remove: faults of "rename" are of that too.
  std::map<std::string, std::string> files_now() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(out_path("now"))) {
      const bool left = entry.path().filename().string().starts_with(".noli-") ||
                        (kind() == "rename" && is_part_of_a_shard(entry.path()));
      if (!entry.is_regular_file() || left) continue;
      files[fs::relative(entry.path(), out_path("now")).string()] = content_of(entry.path());
    }
    return files;
  }

  /// The number of calls of the kind that the command makes.
  std::uint64_t count() const {
    const std::string path = out_path("counts");
    fs::remove(path);
    call("", path);
    std::istringstream lines(bytes_of(path));
    std::string name;
    for (std::uint64_t number = 0; lines >> name >> number;) {
      if (name == kind()) return number;
    }
    ADD_FAILURE() << "the library did not count";
    return 0;
  }

  bool makes(const char* folder) const {
    return std::ranges::find(command().arguments, folder) != command().arguments.end();
  }

  /// The log without anything that depends on the clock.
  static std::string log_of(const fs::path& path) {
    std::istringstream lines(bytes_of(path));
    std::string line, all;
    while (std::getline(lines, line)) {
      Json json = Json::parse(line, nullptr, false);
      if (json.is_object()) json.erase("timing"), json.erase("crc32c");
      all += (json.is_object() ? json.dump() : line) + '\n';
    }
    return all;
  }

  /// What is in the folder of the run, or in that of the shards.
  std::string left_over() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(out_path("now"))) {
      const bool log = entry.path().filename() == "log.jsonl";
      if (!entry.is_regular_file() || is_part_of_a_shard(entry.path())) continue;
      files[fs::relative(entry.path(), out_path("now"))] = log ? log_of(entry.path()) : bytes_of(entry.path());
    }
    std::string all;
    for (const auto& [name, bytes] : files) all += name + '\0' + bytes + '\0';
    return all;
  }

  /// Expects that a run cut short by a fault resumes to the same bytes. Most faults leave what others left, which is
  /// tried once.
  void expect_goes_on(const Outcome& whole) {
    const bool there = fs::exists(out_path("now/run"));
    const bool begins_anew = !there && command().arguments[0] == "simulate";
    if (!resumed_.insert(begins_anew ? "nothing" : left_over()).second) return;
    const Process process = run_noli(words_to_go_on(there));
    ASSERT_EQ(process.exit_code, 0) << process.err;
    for (const auto& [name, bytes] : whole.files) {
      const bool kept =
          name.ends_with(".blocks") || name.ends_with(".obj") || name.ends_with(".csv") || name == "changed.jsonl";
      if (!kept) continue;
      EXPECT_TRUE(bytes_of(out_path("now/" + name)) == bytes) << name;
    }
  }

  /// `there`: the run.
  std::vector<std::string> words_to_go_on(bool there) const {
    const std::vector<std::string> all = words();
    if (all[0] == "simulate") return {all[0], all[1], "-o", out_path("now/run"), there ? "--resume" : "--force"};
    std::vector<std::string> again(all.begin(), std::ranges::find(all, "--json"));
    again.emplace_back("--resume");
    return again;
  }

  /// Expects that the same command does what a fault left undone.
  void expect_done_again(const Outcome& whole) {
    if (!resumed_.insert(left_over()).second) return;
    const Process process = run_noli(words());
    EXPECT_EQ(process.exit_code, 0) << process.err;
    EXPECT_TRUE(files_now() == whole.files);
  }

  void expect_answer_or_none(const Outcome& found, const Outcome& whole) {
    ASSERT_NE(found.exit_code, -1) << "a signal: " << found.err;
    if (!found.same_answer(whole)) {
      EXPECT_TRUE(found.exit_code >= 2 && found.exit_code <= 4) << found.exit_code << ": " << found.out << found.err;
      const bool said = found.err.find("noli: ") != std::string::npos ||
                        found.out.find("UNDECIDED") != std::string::npos ||
                        found.out.find("REJECTED") != std::string::npos;
      EXPECT_TRUE(said) << found.exit_code << "without a message: " << found.out << found.err;
    }
    if (makes("OUT/run")) expect_goes_on(whole);
    if (makes("OUT/shards")) expect_done_again(whole);
  }

  /// Numbers from 1 to `end`: all, or at most `most` of them, with the first and the last.
  static std::vector<std::uint64_t> numbers(std::uint64_t end, std::uint64_t most) {
    std::vector<std::uint64_t> list;
    for (std::uint64_t i = 0; i < std::min(end, most); ++i) {
      list.push_back(end <= most ? i + 1 : 1 + i * (end - 1) / (most - 1));
    }
    return list;
  }

  static constexpr std::uint64_t most_lasting = 2000;

  void try_faults(std::uint64_t most) {
    if (command().arguments[0] == "report" && !reports_are_there()) GTEST_SKIP() << "skipped: reports";
    const Outcome whole = call("");
    ASSERT_TRUE(whole.exit_code == 0 || whole.exit_code == 1) << whole.err;
    ASSERT_TRUE(call("").same_answer(whole)) << "two answers to one question";
    const std::uint64_t end = count();
    int tried = 0;
    const auto try_fault = [&](std::uint64_t number, const char* after) {
      if (HasFailure()) return;
      const std::string fault = kind() + ":" + std::to_string(number) + after;
      SCOPED_TRACE(fault);
      expect_answer_or_none(call(fault), whole);
      ++tried;
    };
    for (const std::uint64_t number : numbers(end, most)) try_fault(number, "");
    for (const std::uint64_t number : numbers(end, std::min(most, most_lasting))) try_fault(number, "+");
    RecordProperty("faults", tried);
  }

  static Folder* in_;
  Folder out_;
  std::set<std::string> resumed_;  ///< the leftovers that were resumed
};

Folder* Faults::in_ = nullptr;

TEST_P(Faults, AreNeverAFalseAnswer) { try_faults(4); }

TEST_P(Faults, AreNeverAFalseAnswerSlow) { try_faults(trials(8, ~std::uint64_t{0})); }

INSTANTIATE_TEST_SUITE_P(Each, Faults, testing::Combine(testing::ValuesIn(commands()), testing::ValuesIn(kinds())),
                         [](const auto& one) {
                           return std::string(std::get<0>(one.param).name) + "_" + std::get<1>(one.param);
                         });

}  // namespace
}  // namespace noli::app_tests
