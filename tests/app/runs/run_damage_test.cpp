// SPDX-License-Identifier: Apache-2.0
//
// Flips bits of runs: every command that reads the run gives the answer of the intact run, or none.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <vector>

#include "tests/app/runs/simulate_fixture.h"

namespace noli::app_tests {
namespace {

constexpr const char* run_files[] = {"trajectory.blocks", "proof.blocks", "log.jsonl",
                                     "manifest.json",     "scene.json",   "series.h5"};

/// Two bars in the plane that do not meet, for three windows.
Json two_bars() {
  return Json::parse(R"({
      "noli_scene": 1, "dimension": 2, "title": "bars", "duration": 0.75, "window": 0.25, "bodies": [
        {"name": "a", "mesh": {"chain": {"points": [[-1, 0], [1, 0]], "segments": 1}},
         "material": {"edge_stiffness": 0, "mass_per_vertex": 1}},
        {"name": "b", "mesh": {"chain": {"points": [[0, 1], [0, 2]], "segments": 1}}, "velocity": [0, -1],
         "material": {"edge_stiffness": 0, "mass_per_vertex": 1}}]})");
}

void flip(const fs::path& file, std::size_t bit) {
  std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
  stream.seekg(static_cast<std::streamoff>(bit / 8));
  const int byte = stream.get();
  stream.seekp(static_cast<std::streamoff>(bit / 8));
  stream.put(static_cast<char>(byte ^ 1 << bit % 8));
}

class Damage : public Simulate {
 protected:
  void SetUp() override {
    file_ = scene(two_bars());
    ASSERT_EQ(run_noli({"simulate", file_, "-o", run_}).exit_code, 0);
    commands_ = {{"verify", {"verify", run_, "--json", "-"}},
                 {"check", {"check", run_, "--json", "-"}},
                 {"explain", {"explain", run_, "--json", "-"}},
                 {"info", {"info", run_, "--json", "-"}}};
    if (reports_are_there()) commands_["report"] = {"report", run_, "--force", "-o", folder.path("page.html")};
    if (verified_checker_is_there()) commands_["check --verified"] = {"check", run_, "--verified", "--json", "-"};
    for (const auto& [name, words] : commands_) {
      const Process process = run_noli(words);
      ASSERT_EQ(process.exit_code, 0) << name << process.err;
      truth_[name] = answer(name, process);
    }
  }

  std::string answer(const std::string& name, const Process& process) const {
    if (name == "report") return bytes_of(folder.path("page.html"));
    Json json = Json::parse(process.out);
    json.erase("timing");  // if there is any
    return json.dump();
  }

  std::vector<std::string> names() const {
    std::vector<std::string> list = {"--resume"};
    for (const auto& [name, words] : commands_) list.push_back(name);
    return list;
  }

  /// Expects the true answer or an input error; returns true for an answer.
  bool expect_truth(const std::string& name, const std::string& damaged, std::size_t bit) {
    if (name == "--resume") return expect_resumption(damaged, bit);
    flip(fs::path(run_) / damaged, bit);
    const Process process = run_noli(commands_[name]);
    flip(fs::path(run_) / damaged, bit);
    EXPECT_TRUE(process.exit_code == 0 || process.exit_code == 3) << what(name, damaged, bit) << process.err;
    if (process.exit_code != 0) return false;
    EXPECT_EQ(answer(name, process), truth_[name]) << what(name, damaged, bit);
    return true;
  }

  bool expect_resumption(const std::string& damaged, std::size_t bit) {
    const std::string copy = run_path("copy");
    fs::remove_all(copy);
    fs::copy(run_, copy);
    flip(fs::path(copy) / damaged, bit);
    const Process process = run_noli({"simulate", file_, "-o", copy, "--resume"});
    EXPECT_TRUE(process.exit_code == 0 || process.exit_code == 3) << what("--resume", damaged, bit) << process.err;
    if (process.exit_code != 0) return false;
    for (const std::string file : run_files) {
      if (file == "log.jsonl") continue;  // has one more line
      EXPECT_TRUE(bytes_of(fs::path(copy) / file) == bytes_of(fs::path(run_) / file))
          << what("--resume", damaged, bit) << ": " << file;
    }
    EXPECT_EQ(last_entry(copy)["running"], last_entry(run_)["running"]);
    return true;
  }

  static std::string what(const std::string& name, const std::string& damaged, std::size_t bit) {
    return name + ": " + damaged + ", byte " + std::to_string(bit / 8) + ", bit " + std::to_string(bit % 8) + ": ";
  }

  std::size_t bytes(const std::string& file) const { return fs::file_size(fs::path(run_) / file); }

  std::string run_ = run_path("run"), file_;
  std::map<std::string, std::vector<std::string>> commands_;
  std::map<std::string, std::string> truth_;
};

/// Flips single bits, which no checksum can miss, also in the first and last byte of each file.
TEST_F(Damage, NobodyAnswersWithLessThanTheTruth) {
  constexpr std::size_t positions = 36;
  const std::vector<std::string> commands = names();
  std::size_t number = 0, answers = 0;
  for (const std::string file : run_files) {
    for (std::size_t i = 0; i <= positions; ++i, ++number) {
      const std::size_t byte = i * (bytes(file) - 1) / positions;
      answers += expect_truth(commands[number % commands.size()], file, 8 * byte + number % 8) ? 1 : 0;
    }
  }
  EXPECT_GT(answers, 0);       // files that the command does not read
  EXPECT_LT(answers, number);  // files that it reads
}

TEST_F(Damage, TheLastCommitIsMissed) {
  for (std::size_t back = 1; back <= 88; back += 3) {
    EXPECT_FALSE(expect_truth("verify", "trajectory.blocks", 8 * (bytes("trajectory.blocks") - back) + back % 8));
  }
  flip(fs::path(run_) / "trajectory.blocks", 8 * (bytes("trajectory.blocks") - 1));
  for (const auto& [name, words] : commands_) {
    const Process process = run_noli(words);
    EXPECT_EQ(process.exit_code, 3) << name << process.out;
    if (name.starts_with("check")) continue;  // the checker words it differently
    EXPECT_NE(process.err.find("windows are missing: it has 2, the log lists 3"), std::string::npos) << process.err;
  }
}

TEST_F(Damage, AnotherMotionThanTheLogTellsOf) {
  Json other = two_bars();
  other["bodies"][1]["velocity"] = {0, -0.5};
  const std::string changed = folder.write("other.json", other.dump());
  ASSERT_EQ(run_noli({"simulate", changed, "-o", run_path("other")}).exit_code, 0);
  for (const char* const file : {"trajectory.blocks", "proof.blocks"}) {
    fs::copy_file(run_path("other") + "/" + file, fs::path(run_) / file, fs::copy_options::overwrite_existing);
  }
  for (const auto& [name, words] : commands_) {
    const Process process = run_noli(words);
    EXPECT_EQ(process.exit_code, 3) << name << process.out;
    EXPECT_NE(process.err.find("window 3: has running hash "), std::string::npos) << process.err;
  }
  EXPECT_EQ(run_noli({"simulate", file_, "-o", run_, "--resume"}).exit_code, 3);
}

TEST_F(Damage, TheLogMayLagBehind) {
  const fs::path log = fs::path(run_) / "log.jsonl";
  std::string text = bytes_of(log);
  for (int lines = 0; !text.empty(); ++lines) {
    text.resize(text.size() - 1);
    text.resize(text.rfind('\n') + 1);  // 0 if there is none
    std::ofstream(log, std::ios::binary) << text;
    for (const auto& [name, words] : commands_) EXPECT_EQ(run_noli(words).exit_code, 0) << name << lines;
  }
  EXPECT_EQ(run_noli({"simulate", file_, "-o", run_, "--resume"}).exit_code, 0);
  EXPECT_EQ(json_of({"explain", run_}, 0)["timing"]["parts"], 2) << "begun, as the log had lost it, and resumed";
}

TEST_F(Damage, ALostLogIsTold) {
  const auto notes = [&](const char* command) { return json_of({command, run_}, 0)["notes"].dump(); };
  for (const char* command : {"verify", "check"}) {
    EXPECT_EQ(notes(command).find("has no log.jsonl"), std::string::npos);
  }
  fs::remove(fs::path(run_) / "log.jsonl");
  for (const char* command : {"verify", "check"}) {
    EXPECT_NE(notes(command).find("has no log.jsonl: windows that are missing"), std::string::npos) << notes(command);
  }
}

TEST_F(Damage, SeriesThatAreDamagedAreWrittenAgain) {
  flip(fs::path(run_) / "series.h5", 8 * (bytes("series.h5") / 2));
  const Process info = run_noli({"info", run_});
  EXPECT_EQ(info.exit_code, 3);
  EXPECT_NE(info.err.find("series.h5: is damaged: "), std::string::npos) << info.err;
  EXPECT_EQ(run_noli({"simulate", file_, "-o", run_, "--resume"}).exit_code, 0);
  EXPECT_EQ(run_noli({"info", run_}).exit_code, 0);
}

/// Flips bits in all bytes of each file, or in some of them, and runs every command.
TEST_F(Damage, SlowNobodyAnswersWithLessThanTheTruth) {
  for (const std::string file : run_files) {
    const std::size_t step = file == "series.h5" ? 2001 : trials(61, 1);
    for (std::size_t byte = 0; byte < bytes(file); byte += step) {
      for (const std::string& name : names()) expect_truth(name, file, 8 * byte + byte % 8);
    }
  }
}

}  // namespace
}  // namespace noli::app_tests
