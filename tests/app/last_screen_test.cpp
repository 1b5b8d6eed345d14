// SPDX-License-Identifier: Apache-2.0
//
// Tests what is visible on a terminal of 80 columns and 24 lines when a command has ended: the verdict, its place, and
// what to do next.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "tests/app/process.h"
#include "tests/app/runs/simulate_fixture.h"
#include "tests/app/scene.h"

namespace noli::app_tests {
namespace {

/// The last 24 rows of 80 columns, without the last one, which holds the shell's prompt.
std::string last_screen(const Process& process) {
  std::vector<std::string> rows;
  std::istringstream lines(process.err + process.out);
  for (std::string line; std::getline(lines, line);) {
    std::string row;
    std::size_t columns = 0;
    for (const char c : line) {
      if ((c & 0xC0) != 0x80 && ++columns > 80) {
        rows.push_back(std::exchange(row, ""));
        columns = 1;
      }
      row += c;
    }
    rows.push_back(row);
  }
  std::string text;
  for (std::size_t i = rows.size() < 23 ? 0 : rows.size() - 23; i < rows.size(); ++i) text += rows[i];
  return text;
}

class LastScreen : public Simulate {
 protected:
  /// A triangle that moves up and down through another one, with contacts in every step.
  std::vector<std::string> to_and_fro(int count, std::vector<std::string> more) const {
    more.insert(more.begin(), "verify");
    for (int k = 0; k < count; ++k) {
      more.push_back(folder.write("sheet_" + std::to_string(100 + k) + ".ply", two_triangles(k % 2 == 0 ? 1 : -1)));
    }
    return more;
  }

  static void expect_on_screen(const Process& process, const std::vector<std::string>& parts) {
    const std::string screen = last_screen(process);
    for (const std::string& part : parts) EXPECT_NE(screen.find(part), std::string::npos) << part << " in\n" << screen;
  }
};

TEST_F(LastScreen, OfContactsInManySteps) {
  expect_on_screen(
      run_noli(to_and_fro(30, {"--keep-going"})),
      {"Contacts: ", "in 29 of 29 steps", "... and 24 more (-v)", "Next: ", "export result.json -o first.png",
       "CONTACT  step 1 (sheet_100.ply → sheet_101.ply)  t = ", " at ("});
}

TEST_F(LastScreen, OfAContact) {
  expect_on_screen(run_noli(to_and_fro(3, {})), {"--keep-going counts", "CONTACT  step 1 (", "t = ", " × ", " at ("});
}

TEST_F(LastScreen, OfIntersectionsAtRest) {
  const auto pierced = folder.write("pierced.ply", sail_through_deck());
  expect_on_screen(run_noli({"verify", "--static", pierced}),
                   {"1 pair of cells intersects", "Next: ", "CONTACT  frame 1 (pierced.ply)", "cell 0 × cell 1"});
}

TEST_F(LastScreen, OfAProof) {
  expect_on_screen(
      run_noli({"verify", folder.write("a.ply", two_triangles(1)), folder.write("b.ply", two_triangles(2))}),
      {"Next: --proof OUT.noli", "PROVED  2 frames, 1 step: nothing touches"});
}

TEST_F(LastScreen, OfNoCheck) {
  const auto a = folder.write("a.ply", two_triangles(1)), b = folder.write("b.ply", two_triangles(2));
  expect_on_screen(run_noli({"verify", a, b, "--no-check"}), {"Next: drop --no-check", "NO CONTACT  2 frames, 1 step"});
}

TEST_F(LastScreen, OfTooLittleDistance) {
  const auto a = folder.write("a.ply", two_triangles(1)), b = folder.write("b.ply", two_triangles(0.5));
  expect_on_screen(run_noli({"verify", a, b, "--min-distance", "0.75"}),
                   {"Next: ask for ", "TOO NEAR  step 1 (a.ply → b.ply)", "cell 0 × cell 1"});
}

TEST_F(LastScreen, OfTooLittleTime) {
  std::vector<std::string> words = {"verify", "--time-limit", "1ms"};
  for (int k = 0; k < 40; ++k) words.push_back(folder.write(std::to_string(k) + ".ply", sheets(40, 1.0 + k)));
  expect_on_screen(run_noli(words), {"Next: give it more time (--time-limit)", "UNDECIDED  ", "(time limit)"});
}

TEST_F(LastScreen, OfCheckedProofs) {
  const auto a = folder.write("a.ply", two_triangles(1)), b = folder.write("b.ply", two_triangles(2)),
             c = folder.write("c.ply", two_triangles(-1));
  ASSERT_EQ(run_noli({"verify", a, b, "--proof", folder.path("good.noli")}).exit_code, 0);
  ASSERT_EQ(run_noli({"verify", a, c, "--proof", folder.path("bad.noli")}).exit_code, 1);
  expect_on_screen(run_noli({"check", folder.path("good.noli"), a, b}),
                   {verified_checker_is_there() ? "Next: --verified" : "", "ACCEPTED  nothing touches"});
  expect_on_screen(run_noli({"check", folder.path("bad.noli"), a, c}), {"Next: noli verify", "REFUTED  in step 1"});
  expect_on_screen(run_noli({"check", folder.path("good.noli"), a, c}), {"Next: check that these are", "REJECTED  "});
}

TEST_F(LastScreen, OfASimulation) {
  expect_on_screen(
      run_noli({"simulate", scene(hanging_sheet()), "-o", run_path("run"), "--until", "0.1"}),
      {reports_are_there() ? "Next: noli report " : "Next: noli export ", "NO CONTACT  10 of 10 windows, 0.1 s"});
}

TEST_F(LastScreen, OfAWrongCommandLine) {
  expect_on_screen(run_noli({"verify", "--keep-goin", "a.ply"}), {"noli: error: ", "did you mean --keep-going?"});
}

}  // namespace
}  // namespace noli::app_tests
