// SPDX-License-Identifier: Apache-2.0
//
// Tests where help is available, and its order and width.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <sstream>

#include "tests/app/process.h"

namespace noli::app_tests {
namespace {

using Arguments = std::vector<std::string>;

Arguments with(Arguments words, const std::string& word) {
  words.push_back(word);
  return words;
}

class HelpOf : public testing::TestWithParam<Arguments> {};

/// The width of UTF-8 text in columns.
std::size_t width(const std::string& line) {
  return static_cast<std::size_t>(std::ranges::count_if(line, [](char c) { return (c & 0xC0) != 0x80; }));
}

TEST_P(HelpOf, StandsOnAScreenOfAHundredColumns) {
  const Process process = run_noli(with(GetParam(), "--help"));
  EXPECT_EQ(process.exit_code, 0);
  std::istringstream lines(process.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(width(line), 100U) << line;
}

TEST_P(HelpOf, HasExamplesFirstAndLimitsLast) {
  const std::string help = run_noli(with(GetParam(), "--help")).out;
  const std::size_t usage = help.find("\nUsage: noli"), examples = help.find("\nExamples:\n"),
                    options = help.find("\nOptions:\n"), output = help.find("\nOutput:\n"),
                    limits = help.find("\nLimits:\n");
  ASSERT_NE(usage, std::string::npos) << help;
  ASSERT_NE(examples, std::string::npos) << help;
  ASSERT_NE(options, std::string::npos) << help;
  EXPECT_LT(usage, examples);
  EXPECT_LT(examples, options);
  if (output != std::string::npos) {
    EXPECT_LT(options, output);
    EXPECT_TRUE(limits == std::string::npos || output < limits);
  }
}

TEST_P(HelpOf, IsTheSameByHelpAndByItsOption) {
  Arguments words = GetParam();
  words.insert(words.begin(), "help");
  const Process process = run_noli(words);
  EXPECT_EQ(process.exit_code, 0);
  EXPECT_EQ(process.out, run_noli(with(GetParam(), "--help")).out);
}

/// The parser accepts all examples: none ends in an error about the command line.
TEST_P(HelpOf, HasExamplesThatCanBeParsed) {
  const std::string help = run_noli(with(GetParam(), "--help")).out;
  std::istringstream lines(help.substr(help.find("\nExamples:\n") + 11));
  for (std::string line; std::getline(lines, line) && line.starts_with("  noli ");) {
    const std::string command = line.substr(7, std::min(line.find("   ", 7), line.find_first_of(";|>", 7)) - 7);
    std::istringstream words(command);
    Arguments arguments;
    for (std::string word; words >> word;) arguments.push_back(word);
    arguments.emplace_back("--nonsense");  // reported only if nothing else is wrong
    const Process process = run_noli(arguments);
    const bool file_is_missing = process.err.find(" does not exist: ") != std::string::npos;
    const bool only_nonsense = process.err.find("has no option --nonsense") != std::string::npos;
    EXPECT_EQ(process.exit_code, 3);
    EXPECT_TRUE(only_nonsense || file_is_missing || arguments[0] == "help") << command << ": " << process.err;
  }
}

const std::vector<Arguments> commands_with_help = {{},
                                                   {"verify"},
                                                   {"check"},
                                                   {"simulate"},
                                                   {"explain"},
                                                   {"repair"},
                                                   {"merge"},
                                                   {"export"},
                                                   {"report"},
                                                   {"info"},
                                                   {"ccd"},
                                                   {"schema"},
                                                   {"help"},
                                                   {"fuzz"},
                                                   {"fuzz", "queries"},
                                                   {"fuzz", "trajectories"},
                                                   {"fuzz", "proofs"},
                                                   {"fuzz", "scenes"},
                                                   {"audit"},
                                                   {"audit", "ccd"},
                                                   {"audit", "precision"},
                                                   {"audit", "integrator"},
                                                   {"audit", "stability"},
                                                   {"audit", "self"}};

INSTANTIATE_TEST_SUITE_P(All, HelpOf, testing::ValuesIn(commands_with_help), [](const auto& test) {
  std::string name = "noli";
  for (const std::string& word : test.param) name += "_" + word;
  return name;
});

TEST(Help, OfNoCommandAtAllIsPrintedButIsNoSuccess) {
  for (const Arguments& words : {Arguments{}, {"fuzz"}, {"audit"}}) {
    const Process process = run_noli(words);
    EXPECT_EQ(process.exit_code, 3);
    EXPECT_EQ(process.out, run_noli(with(words, "--help")).out);
    EXPECT_EQ(process.err, "");
  }
}

TEST(Help, VersionHasAShortName) {
  const Process brief = run_noli({"-V"});
  EXPECT_EQ(brief.exit_code, 0);
  EXPECT_EQ(brief.out, run_noli({"--version"}).out);
}

TEST(Help, VerifyStandsBeforeFuzz) {
  const std::string help = run_noli({"--help"}).out;
  EXPECT_LT(help.find("\n  verify "), help.find("\n  fuzz "));
}

}  // namespace
}  // namespace noli::app_tests
