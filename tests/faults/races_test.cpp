// SPDX-License-Identifier: Apache-2.0
//
// Starts two or three commands on one run folder at random moments. One writer wins, and the others report that the
// folder is in use. Readers report what they find. In the end the folder holds what the winner reported.
#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <random>
#include <thread>

#include "tests/app/runs/simulate_fixture.h"

namespace noli::app_tests {
namespace {

class Races : public Simulate {
 protected:
  struct Runner {
    std::vector<std::string> words;
    bool writes = false;
    Process process;
  };

  std::vector<std::string> simulate(const char* option) const {
    std::vector<std::string> words = {"simulate", run_path("scene.json"), "-o", run_path("run"), "--threads", "1"};
    if (*option != 0) words.emplace_back(option);
    return words;
  }

  Runner any_runner() {
    switch (random_() % 7) {
      case 0: return {simulate(""), true, {}};
      case 1: return {simulate("--resume"), true, {}};
      case 2: return {simulate("--force"), true, {}};
      case 3: return {{"verify", run_path("run"), "--threads", "1"}, false, {}};
      case 4: return {{"check", run_path("run")}, false, {}};
      case 5: return {{"explain", run_path("run")}, false, {}};
      default: return {{"report", run_path("run"), "-o", run_path("page.html"), "--force"}, false, {}};
    }
  }

  void run_all(std::vector<Runner>& runners) {
    std::vector<std::future<void>> all;
    for (Runner& runner : runners) {
      const auto pause = std::chrono::microseconds(random_() % 60'000);
      all.push_back(std::async(std::launch::async, [&runner, pause] {
        std::this_thread::sleep_for(pause);
        runner.process = run_noli(runner.words);
      }));
    }
    for (auto& one : all) one.get();
  }

  static std::string words_of(const std::vector<Runner>& runners) {
    std::string text;
    for (const Runner& runner : runners) {
      for (const std::string& word : runner.words) text += word + " ";
      text += "\n  exit " + std::to_string(runner.process.exit_code) + ": " + runner.process.out + runner.process.err;
    }
    return text;
  }

  void race(int times, const std::string& whole) {
    for (int i = 0; i < times && !HasFailure(); ++i) {
      fs::remove_all(run_path("run"));
      std::vector<Runner> runners = {{simulate(""), true, {}}};
      for (std::size_t more = 1 + random_() % 2; more > 0; --more) runners.push_back(any_runner());
      run_all(runners);
      SCOPED_TRACE(words_of(runners));
      int won = 0;
      for (const Runner& runner : runners) {
        const int code = runner.process.exit_code;
        EXPECT_TRUE(code == 0 || code == 2 || code == 3);
        EXPECT_FALSE(runner.writes && code == 2);
        won += runner.writes && code == 0 ? 1 : 0;
      }
      EXPECT_GE(won, 1);
      EXPECT_TRUE(blocks("run") == whole);
      EXPECT_EQ(run_noli({"verify", run_path("run"), "--no-check"}).exit_code, 0);
    }
  }

  std::string whole() const {
    folder.write("scene.json", hanging_sheet().dump());
    EXPECT_EQ(run_noli({"simulate", run_path("scene.json"), "-o", run_path("whole")}).exit_code, 0);
    return blocks("whole");
  }

  std::mt19937_64 random_{3};
};

TEST_F(Races, OneWinsAndNothingIsLost) { race(12, whole()); }

TEST_F(Races, OneWinsAndNothingIsLostSlow) { race(static_cast<int>(trials(60, 5000)), whole()); }

}  // namespace
}  // namespace noli::app_tests
