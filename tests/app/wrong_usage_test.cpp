// SPDX-License-Identifier: Apache-2.0
//
// Tests the messages for mistyped command lines: one line that says what was probably meant, or what to write.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <sstream>

#include "tests/app/process.h"

namespace noli::app_tests {
namespace {

struct WrongUsage {
  const char *name, *line, *remedy;
};

void PrintTo(const WrongUsage& wrong, std::ostream* out) { *out << wrong.line; }

class WrongUsages : public testing::TestWithParam<WrongUsage> {};

TEST_P(WrongUsages, NameTheRemedyInOneLine) {
  std::istringstream words(GetParam().line);
  std::vector<std::string> arguments;
  for (std::string word; words >> word;) arguments.push_back(word);
  const Process process = run_noli(arguments);
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_EQ(process.out, "");
  EXPECT_TRUE(process.err.starts_with("noli: error: ")) << process.err;
  EXPECT_EQ(std::ranges::count(process.err, '\n'), 1) << process.err;
  EXPECT_NE(process.err.find(GetParam().remedy), std::string::npos) << process.err;
}

constexpr WrongUsage wrong_usages[] = {
    {"verfy", "verfy a.ply b.ply", "did you mean verify?"},
    {"verification", "verificaton a.ply", "noli --help"},
    {"simulte", "simulte s.json", "did you mean simulate?"},
    {"exprot", "exprot run", "did you mean export?"},
    {"chek", "chek p a", "did you mean check?"},
    {"rport", "rport r.json", "did you mean report?"},
    {"ino", "ino a.ply", "did you mean info?"},
    {"cdc", "cdc q.csv", "did you mean ccd?"},
    {"uppercase", "VERIFY a b", "expected one of verify"},
    {"files_without_command", "a.ply b.ply", "noli verify FRAMES..."},
    {"unknown_command", "prove a b", "expected one of verify"},
    {"option_as_command", "--verfy", "has no option --verfy"},
    {"fuzz_quereis", "fuzz quereis", "did you mean queries?"},
    {"fuzz_trajectory", "fuzz trajectory", "did you mean trajectories?"},
    {"fuzz_nothing_like", "fuzz kernel", "expected one of queries"},
    {"audit_cdd", "audit cdd", "did you mean ccd?"},
    {"audit_stabilty", "audit stabilty", "did you mean stability?"},
    {"help_verfy", "help verfy", "did you mean verify?"},
    {"help_fuzz_querie", "help fuzz querie", "did you mean queries?"},
    {"keep_goin", "verify --keep-goin a b", "did you mean --keep-going?"},
    {"keep", "verify --keep a b", "did you mean --keep-going?"},
    {"keep_going_underscore", "verify --keep_going a b", "did you mean --keep-going?"},
    {"keep_going_one_dash", "verify -keep-going a b", "did you mean --keep-going?"},
    {"keep_going_capitals", "verify --Keep-Going a b", "did you mean --keep-going?"},
    {"first_olny", "verify --first-olny a b", "did you mean --first-only?"},
    {"tolerance", "verify --tolerance 1e-6 a b", "--min-distance DISTANCE"},
    {"epsilon", "verify --epsilon 1e-6 a b", "there is no tolerance"},
    {"jobs_at_once", "verify -j4 a b", "--threads N"},
    {"value_with_choices", "verify a b --order", "--order needs a value, natural|given;"},
    {"report_tolerance", "report --tolerance 1 r.json -o r.html", "noli report --help"},
    {"unknown_option_first", "-x verify a b", "has no option -x"},
    {"jobs", "verify --jobs 4 a b", "--threads N"},
    {"j", "verify -j 4 a b", "--threads N"},
    {"timeout", "verify --timeout 5s a b", "--time-limit TIME"},
    {"overwrite", "verify --overwrite a b", "--force"},
    {"output_of_verify", "verify a b --output r.json", "--json OUT"},
    {"o_of_verify", "verify a b -o r.json", "--json OUT"},
    {"all_steps", "verify --all a b", "--keep-going"},
    {"silent", "verify --silent a b", "-q"},
    {"ring", "verify a b --ring 3", "did you mean --min-distance-from-ring?"},
    {"unknown_letter", "verify -x a b", "noli verify --help"},
    {"order_natrual", "verify a b --order natrual", "did you mean natural?"},
    {"order_bogus", "verify a b --order bogus", "expected one of natural, given"},
    {"polygons_fans", "verify a b --polygons fans", "did you mean fan?"},
    {"no_frames", "verify", "needs FRAMES"},
    {"threads_x", "verify --threads x a b", "expected a number from 0 to 1024"},
    {"threads_negative", "verify --threads=-1 a b", "expected a number from 0 to 1024"},
    {"max_reports", "verify --max-reports 1e3 a b", "expected a number from 0"},
    {"distance_negative", "verify a b --min-distance -1", "expected a number above 0"},
    {"distance_zero", "verify a b --min-distance 0", "expected a number above 0"},
    {"dimension", "verify a b --dimension 4", "expected 2 or 3"},
    {"both_ways", "verify a b --keep-going --first-only", "cannot be combined"},
    {"two_voices", "verify a b --porcelain -q", "cannot be combined"},
    {"scene_folder", "verify a b --scene-folder x", "needs --reproduce"},
    {"json_nowhere", "verify a --json", "needs a value, OUT"},
    {"json_twice", "verify a b --json c --json d", "2 times; expected it once"},
    {"time_soon", "verify a b --time-limit soon", "60s"},
    {"quiet_first", "-q verify a b", "noli verify -q"},
    {"simulate_no_output", "simulate s.json", "needs -o, --output RUN"},
    {"simulate_no_scene", "simulate -o run", "needs SCENE.json"},
    {"simulate_outptu", "simulate s.json --outptu run", "did you mean --output?"},
    {"simulate_window", "simulate s.json -o r --window 3", "needs --reproduce"},
    {"simulate_until", "simulate s.json -o r --until soon", "expected a number above 0"},
    {"simulate_shrot", "simulate s.json -o r --shrot", "did you mean --short?"},
    {"explain_nothing", "explain", "needs SCENE.json|RUN"},
    {"export_no_output", "export run", "needs -o, --output"},
    {"export_at_x", "export run -o x.png --at x", "--at: x is not a number"},
    {"export_at_and_fps", "export run -o x.png --at 1 --fps 3", "cannot be combined"},
    {"export_size", "export run -o x.png --at 1 --size 10", "expected WIDTHxHEIGHT"},
    {"report_no_output", "report r.json", "needs -o, --output OUT.html"},
    {"schema_verfy", "schema verfy", "noli schema"},
    {"check_nothing", "check", "needs PROOF"},
    {"check_verifed", "check --verifed p a", "did you mean --verified?"},
    {"ccd_kind", "ccd q.csv --kind vertexface", "did you mean vertex-face?"},
    {"ccd_kind_underscore", "ccd q.csv --kind edge_edge", "did you mean edge-edge?"},
    {"info_nothing", "info", "needs FILE"},
    {"fuzz_seed", "fuzz queries --seed -1", "expected a whole number"},
    {"fuzz_count", "fuzz queries --count 0", "expected a whole number from 1"},
    {"fuzz_minimize", "fuzz queries --minimize f.csv", "did you mean --minimise?"},
    {"fuzz_tolerance_alone", "fuzz queries --tolerance 1", "needs --library"},
    {"audit_ccd_no_library", "audit ccd q.csv", "needs --library LIB.so"},
    {"audit_ccd_one_frame", "audit ccd --library x.so --frames a.ply", "needs 2 values, but got 1"},
    {"audit_only_fuz", "audit self --only fuz", "fuz"},
};

INSTANTIATE_TEST_SUITE_P(All, WrongUsages, testing::ValuesIn(wrong_usages),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(WrongUsage, OfAnyLengthIsOneShortLine) {
  std::vector<std::string> many = {"export", "run", "-o", "x.ply"};
  for (int i = 0; i < 50'000; ++i) many.push_back(std::to_string(i));
  for (const std::vector<std::string>& arguments : {many,
                                                    {"verify", "--threads", std::string(100'000, 'x'), "a", "b"},
                                                    {std::string(100'000, 'v')},
                                                    {"verify", "--" + std::string(100'000, 'k')}}) {
    const Process process = run_noli(arguments);
    EXPECT_EQ(process.exit_code, 3);
    EXPECT_LT(process.err.size(), 600U);
    EXPECT_EQ(std::ranges::count(process.err, '\n'), 1);
  }
}

}  // namespace
}  // namespace noli::app_tests
