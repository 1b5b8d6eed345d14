// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli fuzz queries --library` on an exact method without faults, on its mutants (ccd_libraries/mutants), each
// of which must be found, and on libraries that misbehave in other ways.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <sstream>

#include "tests/app/audits/libraries.h"
#include "tests/app/process.h"
#include "tests/app/scene.h"
#include "tests/app/worked_example.h"

namespace noli::app_tests {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

Words mutants() {
  std::istringstream words(NOLI_MUTANT_NAMES);
  Words result;
  for (std::string word; words >> word;) result.push_back(word);
  return result;
}

/// A vertex that falls through a face, and one that falls beside it.
const char* const two_queries =
    "0,1,0,1,1,1\n-4,1,-4,1,0,1\n4,1,-4,1,0,1\n0,1,8,1,0,1\n0,1,0,1,-1,1\n-4,1,-4,1,0,1\n4,1,-4,1,0,1\n0,1,8,1,0,1\n"
    "9,1,9,1,1,1\n-4,1,-4,1,0,1\n4,1,-4,1,0,1\n0,1,8,1,0,1\n9,1,9,1,-1,1\n-4,1,-4,1,0,1\n4,1,-4,1,0,1\n0,1,8,1,0,1\n";

class FuzzLibrary : public testing::Test {
 protected:
  Words command(const std::string& library, const Words& more) const {
    return Words{"fuzz", "queries", "--library", library, "--seed", "1", "--out", folder.path("out")} + more;
  }
  Json json(const std::string& library, int exit_code, const Words& more) const {
    return json_of(command(library, more), exit_code);
  }
  Process run(const std::string& library, const Words& more) const { return run_noli(command(library, more)); }

  /// The exit code of the command of a finding.
  static int again(const std::string& command) {
    return shell(replaced(command, "noli fuzz", std::string(NOLI_COMMAND) + " fuzz")).second;
  }
  /// The same with the method without a fault.
  static int again_without(const std::string& name, const std::string& command) {
    return again(replaced(command, mutant(name), mutant("none")));
  }

  Folder folder;
};

TEST_F(FuzzLibrary, FindsNothingInAnExactMethod) {
  const Json document = json(mutant("none"), 0, {"--exact", "--count", "9000"});
  EXPECT_EQ(document["verdict"], "no_finding");
  EXPECT_EQ(document["queries"], 9000);
  EXPECT_GT(document["contacts"], 4000);
  for (const auto& [name, count] : document["faults"].items()) EXPECT_EQ(count, 0) << name;
  EXPECT_EQ(document["knows_times"], true);
  EXPECT_FALSE(std::filesystem::exists(folder.path("out")));
  const Process noli = run(plugin("noli"), {"--exact", "--tolerance", "0", "--count", "9000"});
  EXPECT_EQ(noli.exit_code, 0) << noli.out;
}

TEST_F(FuzzLibrary, ShrinksAndSavesWhatItFinds) {
  const Json document = json(mutant("end_excluded"), 1, {"--count", "1000", "--first-only"});
  EXPECT_EQ(document["verdict"], "finding");
  const Json& finding = document["reports"].at(0);
  EXPECT_EQ(finding["finding"], "false_negative");
  EXPECT_LE(finding["distinct_coordinates"], 2);
  const std::string file = finding["file"], text = read_text(file), repeat = finding["command"];
  EXPECT_NE(text.find("# " + repeat + "\n"), std::string::npos) << text;
  EXPECT_EQ(again(repeat), 1);
  EXPECT_EQ(again_without("end_excluded", repeat), 0);
  EXPECT_EQ(run_noli({"ccd", file}).exit_code, 0) << "its label is the truth";
  EXPECT_EQ(run_noli({"audit", "ccd", "--library", mutant("end_excluded"), file}).exit_code, 1);
}

TEST_F(FuzzLibrary, ShowsMissedCrossingsFirstAndLatenessLast) {
  const Json document = json(plugin("textbook"), 1, {"--count", "3000"});
  const auto order = [](const Json& report) {
    return report["finding"] == "false_negative" ? (report["contact"] == "crossing" ? 0 : 1) : 2;
  };
  std::vector<int> orders;
  for (const Json& report : document["reports"]) orders.push_back(order(report));
  EXPECT_TRUE(std::is_sorted(orders.begin(), orders.end()));
  EXPECT_EQ(document["reports"].back()["finding"], "late");
}

/// A library that never answers "contact" has more kinds of findings than there is room for.
TEST_F(FuzzLibrary, KeepsOrdinaryQueriesWhereThereIsLittleRoom) {
  const Json all = json(mutant("end_excluded"), 1, {"--count", "20000", "--max-findings", "1000"});
  const Json few = json(mutant("end_excluded"), 1, {"--count", "20000", "--max-findings", "2"});
  EXPECT_EQ(few["findings"], all["findings"]) << "all are counted";
  ASSERT_GT(all["reports"].size(), 2U);
  ASSERT_EQ(few["reports"].size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(few["reports"][i]["generator"], all["reports"][i]["generator"]);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path("out")), fs::directory_iterator()),
            static_cast<std::ptrdiff_t>(all["reports"].size() + 2))
      << "those that were dropped leave no file";
}

TEST_F(FuzzLibrary, GivesACArrayToPaste) {
  const Process process = run(mutant("end_excluded"), {"--count", "1000", "--first-only"});
  EXPECT_NE(process.out.find("\n  double x[2][4][3] = {{{"), std::string::npos) << process.out;
  const std::string array =
      json(mutant("end_excluded"), 1, {"--count", "1000", "--first-only"})["reports"][0]["c_array"];
  const auto source =
      folder.write("array.c", "int main(void) { " + array + " return x[0][0][0] == x[0][0][0] ? 0 : 1; }\n");
  EXPECT_EQ(std::system((NOLI_C_COMPILER " -o '" + folder.path("array") + "' '" + source + "'").c_str()), 0) << array;
}

TEST_F(FuzzLibrary, AllowsTimesThatAreLateByNoMoreThanIsSaid) {
  const Json strict = json(plugin("textbook"), 1, {"--count", "3000"});
  const Json lenient = json(plugin("textbook"), 1, {"--count", "3000", "--late-tolerance", "1e-9"}),
             blind = json(plugin("textbook"), 1, {"--count", "3000", "--late-tolerance", "1"});
  EXPECT_GT(strict["faults"]["late"], 0);
  EXPECT_LT(lenient["faults"]["late"], strict["faults"]["late"]);
  EXPECT_EQ(blind["faults"]["late"], 0);
  EXPECT_EQ(lenient["faults"]["false_negative"], strict["faults"]["false_negative"]);
  const std::string command = lenient["reports"][0]["command"];
  EXPECT_NE(command.find(" --late-tolerance 1e-09 "), std::string::npos) << command;
}

TEST_F(FuzzLibrary, ReplaysManyFiles) {
  const Json found = json(plugin("textbook"), 1, {"--count", "2000"});
  std::vector<std::string> words = {"fuzz", "queries", "--library", plugin("textbook"), "--replay"};
  for (const Json& report : found["reports"]) words.push_back(report["file"]);
  ASSERT_GT(found["reports"].size(), 2U);
  const Json all = json_of(words, 1);
  EXPECT_EQ(all["queries"], found["reports"].size());
  EXPECT_EQ(all["findings"], found["reports"].size());
  const std::string first = all["differences"][0];
  EXPECT_TRUE(first.starts_with(found["reports"][0]["file"].get<std::string>() + ": ")) << first;
}

TEST_F(FuzzLibrary, CallsALibraryInItsOwnProcess) {
  const auto file = folder.write("two-vertex-face.csv", two_queries);
  const auto replay = [&](const std::string& library, const Words& more) {
    return run_noli(Words{"fuzz", "queries", "--library", library, "--replay", file} + more);
  };
  for (const std::string& library : {mutant("none"), faulty("never_hits")}) {
    const Process apart = replay(library, {}), within = replay(library, {"--in-process"});
    EXPECT_EQ(within.out, apart.out);
    EXPECT_EQ(within.exit_code, apart.exit_code);
  }
  EXPECT_EQ(replay(faulty("crashes"), {}).exit_code, 1) << "a finding, and noli is alive";
  const Process killed = replay(faulty("crashes"), {"--in-process"});
  EXPECT_EQ(killed.out, "") << "a debugger has it";
  EXPECT_NE(killed.exit_code, 0);
  // The address sanitizer catches the signal, and ends the program with its own code.
  EXPECT_TRUE(killed.exit_code != 1 || killed.err.find("AddressSanitizer") != std::string::npos) << killed.err;
  expect_refused({"fuzz", "queries", "--library", faulty("has_another_version"), "--replay", file, "--in-process"},
                 "version");
  expect_refused({"fuzz", "queries", "--library", mutant("none"), "--in-process"}, "--replay");
}

TEST_F(FuzzLibrary, GivesTheSameForAnyNumberOfThreads) {
  const auto bytes = [&](const std::string& seed, const std::string& threads) {
    std::filesystem::remove_all(folder.path("out" + seed));  // existing findings would change the names
    return without_timing(
        json_of({"fuzz", "queries", "--library", mutant("double_roots_dropped"), "--count", "5000", "--seed", seed,
                 "--threads", threads, "--max-findings", "2", "--out", folder.path("out" + seed)},
                1));
  };
  const std::string one = bytes("5", "1");
  EXPECT_EQ(one, bytes("5", "3"));
  EXPECT_NE(one, bytes("6", "3"));
}

TEST_F(FuzzLibrary, LeavesWhatAnEarlierRunHasFound) {
  const auto run_of = [&](const std::string& library) {
    return json_of({"fuzz", "queries", "--library", library, "--count", "1000", "--out", folder.path("out")}, 1);
  };
  const Json first = run_of(mutant("double_roots_dropped"));
  std::vector<std::string> texts;
  for (const Json& report : first["reports"]) texts.push_back(read_text(report["file"]));
  std::set<std::string> files;
  for (const Json& run : {run_of(mutant("double_roots_dropped")), run_of(faulty("never_hits"))}) {
    for (const Json& report : run["reports"]) files.insert(report["file"]);
  }
  ASSERT_FALSE(texts.empty());
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const std::string file = first["reports"][i]["file"];
    EXPECT_EQ(read_text(file), texts[i]);
    EXPECT_FALSE(files.contains(file)) << file;
  }
  EXPECT_TRUE(std::any_of(files.begin(), files.end(), [](const std::string& file) {
    return std::filesystem::path(file).filename().string().starts_with("2-");
  }));
}

TEST_F(FuzzLibrary, TellsFalsePositivesAndEarlyTimesOnlyOfWhatClaimsToBeExact) {
  const Process careful = run(faulty("swept_boxes"), {"--count", "1000"});
  EXPECT_EQ(careful.exit_code, 0) << careful.out;
  EXPECT_EQ(careful.out.find("false_positive 0 "), std::string::npos) << careful.out;
  const Json exact = json(faulty("swept_boxes"), 1, {"--count", "1000", "--exact", "--max-findings", "4"});
  std::set<std::string> found;
  for (const Json& report : exact["reports"]) found.insert(report["finding"]);
  EXPECT_EQ(found, (std::set<std::string>{"early", "false_positive"}));
}

TEST_F(FuzzLibrary, GoesOnBehindCrashesAndHangs) {
  for (const auto& [library, fault] : {std::pair{"crashes", "crash"}, {"ends_the_program", "crash"}}) {
    const Json document = json(faulty(library), 1, {"--count", "256"});
    EXPECT_EQ(document["queries"], 256) << library;
    EXPECT_GT(document["faults"][fault], 50) << library;
    EXPECT_EQ(document["reports"][0]["finding"], fault) << library;
  }
  const Json hanging = json(faulty("hangs"), 1, {"--count", "300", "--query-limit", "20ms", "--max-findings", "1"});
  EXPECT_GE(hanging["faults"]["hang"], 2);
  EXPECT_EQ(hanging["reports"][0]["finding"], "hang");
}

TEST_F(FuzzLibrary, FindsFailuresAndTimesThatAreNone) {
  EXPECT_EQ(json(faulty("fails"), 1, {"--count", "256"})["faults"]["failure"], 256);
  EXPECT_GT(json(faulty("has_wild_times"), 1, {"--count", "256"})["faults"]["bad_time"], 100);
  const Json none = json(mutant("no_time_when_coplanar"), 1, {"--count", "256"});
  EXPECT_EQ(none["reports"][0]["finding"], "no_time");
  const Json parity = json(plugin("root_parity"), 0, {"--count", "256"});
  EXPECT_EQ(parity["knows_times"], false);
  EXPECT_EQ(parity["faults"]["no_time"], 0);
}

TEST_F(FuzzLibrary, MakesAFileSimpler) {
  const std::string file = folder.write("two-vertex-face.csv", two_queries);
  const Words words = {"fuzz", "queries", "--library", faulty("never_hits"), "--minimise", file};
  const Json document = json_of(words, 1);
  ASSERT_EQ(document["findings"], 1);
  const std::string result = document["reports"][0]["file"];
  EXPECT_EQ(result, folder.path("two-vertex-face-query1-minimised.csv"));
  EXPECT_LE(document["reports"][0]["distinct_coordinates"], 3) << "and they still cross";
  EXPECT_EQ(run_noli({"ccd", result}).exit_code, 0);
  EXPECT_EQ(again(document["reports"][0]["command"]), 1);
  EXPECT_EQ(json_of(words + Words{"--out", folder.path("elsewhere")}, 1)["reports"][0]["file"],
            folder.path("elsewhere/two-vertex-face-query1-minimised.csv"));
  const Process right = run_noli({"fuzz", "queries", "--minimise", file});
  EXPECT_EQ(right.exit_code, 0) << right.err;
  EXPECT_EQ(right.verdict_line(), "NOTHING FAILS  queries 2, findings 0");
}

TEST_F(FuzzLibrary, KeepsWhatReachesSomethingNew) {
  const std::string corpus = folder.path("corpus");
  const Words more = {"--corpus", corpus, "--count", "2000"};
  const Json first = json(mutant("none"), 0, more)["corpus"];
  EXPECT_EQ(first["replayed"], 0);
  EXPECT_GT(first["kept"], 10);
  EXPECT_EQ(first["kept"], first["signatures"]);
  const Json second = json(mutant("none"), 0, more)["corpus"];
  EXPECT_EQ(second["replayed"], first["kept"]);
  EXPECT_EQ(second["signatures"], first["signatures"]);
  EXPECT_EQ(second["kept"], 0);
  const Json other = json(mutant("end_excluded"), 1, {"--corpus", corpus, "--first-only", "--count", "1"});
  EXPECT_EQ(other["reports"][0]["generator"].get<std::string>().substr(0, 7), "corpus/") << "it is asked first";
}

TEST_F(FuzzLibrary, KeepsFindingsWhenInterrupted) {
  expect_findings_kept(command(faulty("never_hits"), {"--for", "10m"}), std::chrono::milliseconds(3000));
}

TEST_F(FuzzLibrary, RefusesWhatCannotBe) {
  const auto refused = [](const Words& words, const std::string& because) {
    expect_refused(Words{"fuzz", "queries"} + words, because);
  };
  const std::string file = folder.write("two-vertex-face.csv", two_queries);
  const std::string text = folder.write("text", "x");
  refused({"--library", faulty("has_no_query"), "--count", "1"}, "has no visible function noli_ccd_query");
  refused({"--library", faulty("has_another_version"), "--count", "1"}, "is for version 2");
  refused({"--library", folder.path("absent.so"), "--count", "1"}, "does not exist");
  refused({"--count", "1", "--exact"}, "--library");
  refused({"--count", "1", "--tolerance", "1"}, "--library");
  refused({"--library", mutant("none"), "--count", "1", "--tolerance", "-1"}, "--tolerance");
  refused({"--replay", file, "--minimise", file}, "--minimise");
  refused({"--minimise", file, "--seed", "1"}, "--seed");
  refused({"--minimise", folder.path("absent-edge-edge.csv")}, "absent-edge-edge.csv");
  refused({"--count", "1", "--corpus", text}, "--corpus");
  refused({"--count", "1", "--out", text + "/out"}, "--out");
  std::filesystem::create_directory(folder.path("bad"));
  folder.write("bad/some-edge-edge.csv", "1,2\n");
  refused({"--count", "1", "--corpus", folder.path("bad")}, "some-edge-edge.csv");
  const std::string point = folder.write("vertex-vertex.csv", "0,1,0,1,1,1\n0,1,0,1,0,1\n0,1,0,1,-1,1\n0,1,0,1,0,1\n");
  refused({"--library", mutant("none"), "--replay", point}, "a vertex and a face or two edges");
}

TEST_F(FuzzLibrary, TheWorkedExampleIsTrue) {
  const auto commands = worked_example("docs/audit/fuzz.md", "## Queries");
  ASSERT_GE(commands.size(), 4u);
  expect_worked_example(commands, {{"build/release/app/noli", NOLI_COMMAND},
                                   {"build/release/audit/ccd/plugins", NOLI_CCD_PLUGINS},
                                   {"build/findings", folder.path("findings")}});
}

/// Its wrong answers are false positives and early times, which count as faults only for libraries that claim to be
/// exact.
const char* const only_wrong_when_exact = "edges_prolonged";

const Json& simplest(const Json& reports) {
  return *std::min_element(reports.begin(), reports.end(), [](const Json& a, const Json& b) {
    return a["distinct_coordinates"] < b["distinct_coordinates"];
  });
}

/// A row of the table in docs/audit/fuzz.md.
void print_row(const std::string& name, const Json& document, const Json& finding) {
  std::printf("| `%s` | %s, %s | %d | %.1f | %d |\n", name.c_str(), finding["finding"].get<std::string>().c_str(),
              finding["contact"].get<std::string>().c_str(), document["queries"].get<int>(),
              document["timing"]["seconds"].get<double>(), finding["distinct_coordinates"].get<int>());
}

TEST_F(FuzzLibrary, EachMutantIsFoundWithinAMinuteSlow) {
  ASSERT_GE(mutants().size(), 30u);
  for (const std::string& name : mutants()) {
    Words more = {"--for", "60s", "--first-only"};
    if (name == only_wrong_when_exact) more.emplace_back("--exact");
    const Json document = json(mutant(name), 1, more);
    const Json& finding = simplest(document["reports"]);
    print_row(name, document, finding);
    EXPECT_LE(finding["distinct_coordinates"], 8u) << name;
    EXPECT_EQ(again(finding["command"]), 1) << name;
    EXPECT_EQ(again_without(name, finding["command"]), 0) << name;
    EXPECT_EQ(run_noli({"ccd", finding["file"]}).exit_code, 0) << name;
  }
}

TEST_F(FuzzLibrary, NothingIsFoundInTheMethodWithinAMinuteSlow) {
  const Json document = json(mutant("none"), 0, {"--for", "60s", "--exact"});
  EXPECT_EQ(document["findings"], 0);
  EXPECT_GT(document["queries"], 5000);
}

}  // namespace
}  // namespace noli::app_tests
