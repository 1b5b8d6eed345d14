// SPDX-License-Identifier: Apache-2.0
//
// Tests contacts at the limits of double: `noli verify` writes a witness for each, which both checkers accept.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "tests/app/process.h"
#include "tests/app/runs/simulate_fixture.h"
#include "tests/app/scene.h"

namespace noli::app_tests {
namespace {

class ContactWitness : public testing::Test {
 protected:
  std::string frame(const std::string& name, const std::string& vertices, const std::string& cells) const {
    return folder.write(name + ".obj", vertices + cells);
  }

  /// Expects a contact with a witness that both checkers accept.
  void expect_witness(const std::vector<std::string>& frames, const std::vector<std::string>& options = {}) const {
    const std::string proof = folder.path("proof.noli");
    std::vector<std::string> words = {"verify", "--force", "--proof", proof};
    words.insert(words.end(), options.begin(), options.end());
    words.insert(words.end(), frames.begin(), frames.end());
    const Json said = json_of(words, 1);
    EXPECT_EQ(said["verdict"], "contact");
    EXPECT_EQ(said["proof"]["witnesses"], 1);
    for (const char* const checker : {"plain", "--verified"}) {
      if (checker[0] == '-' && !verified_checker_is_there()) continue;
      std::vector<std::string> check = {"check", proof};
      if (checker[0] == '-') check.emplace_back(checker);
      check.insert(check.end(), frames.begin(), frames.end());
      for (const std::string& option : options) {
        if (option == "--points") check.insert(check.end(), {"--require", "points"});
        if (option == "--min-distance") check.insert(check.end(), {"--require", "distance=" + options.back()});
      }
      const Process checked = run_noli(check);
      EXPECT_EQ(checked.exit_code, 1) << checker << checked.out << checked.err;
    }
  }

  Process verify_distance(const std::string& a, const std::string& b, double distance) const {
    return run_noli({"verify", a, b, "--min-distance", fmt::format("{:.17g}", distance)});
  }

  Folder folder;
};

/// The point passes the end of the edge within the last ulp of the step. At the end of the step the three points are
/// collinear, so the determinant vanishes there too.
TEST_F(ContactWitness, InTheLastUlpBeforeARootAtTheEnd) {
  for (const std::string last : {"6e-17", "5e-324", "1e-300"}) {
    const auto begin = frame("begin", "v 0 0 0\nv 1 1 0\nv -1 0 0\n", "l 1 2\n"),
               end = frame("end", "v 0 0 0\nv 1 0 0\nv " + last + " 0 0\n", "l 1 2\n");
    expect_witness({begin, end}, {"--points"});
    expect_witness({end, begin}, {"--points"});
  }
}

/// In space: the point reaches the edge of a face, and another corner of the face lands at the end of the step.
TEST_F(ContactWitness, InTheLastUlpOfAFaceThatLands) {
  const auto begin = frame("begin", "v 0 -1 0\nv 0 1 0\nv 1 0 1\nv -1 0 0\n", "f 1 2 3\np 4\n"),
             end = frame("end", "v 0 -1 0\nv 0 1 0\nv 1 0 0\nv 6e-17 0 0\n", "f 1 2 3\np 4\n");
  expect_witness({begin, end});
  expect_witness({end, begin});
}

/// With the greatest and the least doubles together, a common unit makes integers of 2,100 bits, and weights are
/// products of these.
TEST_F(ContactWitness, OfEdgesAtTheGreatestDoubles) {
  const std::string cells = "l 1 2\nl 3 4\n";
  expect_witness({frame("a",
                        "v -1.7e308 5e-324 1.7e308\nv 1.79e308 -1.5e-323 1.7e308\n"
                        "v 2.5e-323 -1.7e308 0\nv 5e-324 1.7e308 0\n",
                        cells),
                  frame("b",
                        "v -5e-324 1e-323 -1.7e308\nv 5e-324 5e-324 -1.7e308\n"
                        "v 1e-323 -1.7e308 5e-324\nv 2.5e-323 1e-323 0\n",
                        cells)});
}

/// These edges stay apart. Either a direction needs more bits than a proof can hold, or time must be split into shorter
/// pieces.
TEST_F(ContactWitness, ThereIsNoneOfEdgesThatAreApartAtTheGreatestDoublesSlow) {
  const std::string cells = "l 1 2\nl 3 4\n";
  const std::string begin = frame("a",
                                  "v -9.874789749538684e+307 -8.977429631287785e-301 1e+308\n"
                                  "v 1e+308 5.832074528801915e-301 9.87760021051951e+307\n"
                                  "v 3.5e-323 -9.797142976272272e-301 -1e+305\n"
                                  "v 1.0163341553452634e+308 0.8568574778858657 0\n",
                                  cells),
                    end = frame("b",
                                "v -4e-323 -0.6382894254807006 -1.5282775445787211e-301\n"
                                "v 9.643080783031505e-301 1e+308 -3e-323\n"
                                "v 1e-323 -1e+308 0\n"
                                "v -1e-323 4.184931710532345e-301 0\n",
                                cells);
  const Process process = run_noli({"verify", begin, end});
  EXPECT_EQ(process.exit_code, 0) << process.out << process.err;
}

TEST_F(ContactWitness, OfAVertexAndAFaceAtTheGreatestDoubles) {
  const std::string cells = "f 1 2 3\np 4\n";
  expect_witness(
      {frame("a", "v -1e308 -1.1e308 5e-324\nv 1e308 -1e308 -5e-324\nv 3e-320 1.7e308 0\nv 7e-310 5e-324 1.3e308\n",
             cells),
       frame("b", "v -1.5e308 -1e308 1e-323\nv 1e308 -1.2e308 3e-310\nv 3e-323 1.6e308 0\nv 7e-323 5e-324 -1.6e308\n",
             cells)});
}

/// A point flies past a thing at a distance of 1, and is nearer than 1.0001 for a hundredth of the step or less.
TEST_F(ContactWitness, OfALeastDistanceThatIsBrokenBriefly) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> heights(1, 80);
  for (int k = 0; k < 12; ++k) {
    const double from = heights(random), to = -heights(random);
    for (const char* const thing : {"p 2\n", "l 2 3\n", "f 2 3 4\n"}) {
      const auto at = [&](const char* name, double height) {
        const std::string fixed = "v 0 0 0\nv 0 0 1\nv -1 0 0\n";
        return frame(name, fmt::format("v 1 {:.17g} 0\n{}", height, fixed), std::string("p 1\n") + thing);
      };
      const std::string a = at("a", from), b = at("b", to);
      EXPECT_EQ(verify_distance(a, b, 0.9999).exit_code, 0) << from << " to " << to << " past " << thing;
      EXPECT_EQ(verify_distance(a, b, 1.0001).exit_code, 1) << from << " to " << to << " past " << thing;
    }
  }
}

/// Differences of coordinates of 1e308 overflow.
TEST_F(ContactWitness, OfTheLeastDistanceAtTheGreatestDoubles) {
  const std::string cells = "l 1 2\nl 3 4\n";
  const std::string a =
      frame("a", "v -1e308 5e-324 1e307\nv 1e308 -1.5e-323 1e307\nv 2.5e-323 -1e308 0\nv 5e-324 1e308 0\n", cells);
  const std::string proof = folder.path("proof.noli");
  const Process near = run_noli({"verify", "--force", "--proof", proof, "--min-distance", "2e307", a, a});
  EXPECT_EQ(near.exit_code, 1) << near.out << near.err;
  EXPECT_EQ(run_noli({"check", proof, a, a, "--require", "distance=2e307"}).exit_code, 1);
}

}  // namespace
}  // namespace noli::app_tests
