// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli audit ccd` on many libraries, most of them with a fault that must be found.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "tests/app/audits/libraries.h"
#include "tests/app/process.h"
#include "tests/app/scene.h"
#include "tests/app/worked_example.h"

namespace noli::app_tests {
namespace {

using Json = nlohmann::json;

std::string labelled_row(int x, int y, int z, const std::string& label) {
  const auto cell = [](int value) { return std::to_string(value) + ",1,"; };
  return cell(x) + cell(y) + cell(z) + label + "\n";
}

/// A vertex that moves from height 1 to `end` over a resting face.
std::string vertex_face(int x, int end, const std::string& label) {
  const std::string face =
      labelled_row(-4, -4, 0, label) + labelled_row(4, -4, 0, label) + labelled_row(0, 8, 0, label);
  return labelled_row(x, 0, 1, label) + face + labelled_row(x, 0, end, label) + face;
}

class AuditCcd : public testing::Test {
 protected:
  /// Two contacts at t = 1/2, and two queries without contact. Faulty libraries misbehave where x is above 0, in the
  /// second and fourth query.
  std::string queries() const {
    return folder.write("a-vertex-face.csv", vertex_face(-1, -1, "1") + vertex_face(1, -1, "1") +
                                                 vertex_face(-1, 1, "0") + vertex_face(1, 1, "0"));
  }

  static std::vector<std::string> command(const std::string& library, const std::string& file,
                                          const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"audit", "ccd", "--library", library, file};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  Json json(const std::string& library, int exit_code, const std::vector<std::string>& more = {}) const {
    return json_of(command(library, queries(), more), exit_code);
  }

  void refused(const std::string& library, const std::string& words) const {
    const Process process = run_noli(command(library, queries()));
    EXPECT_EQ(process.exit_code, 3) << library << process.out;
    EXPECT_NE(process.err.find(words), std::string::npos) << process.err;
    EXPECT_EQ(process.out, "");
  }

  Folder folder;
};

TEST_F(AuditCcd, FindsNothingInWhatIsRight) {
  const Process process = run_noli(command(plugin("noli"), queries()));
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_EQ(process.verdict_line(),
            "NO FINDING  audits 1, queries 4, findings 0, false_positives 0, false_negatives 0, "
            "late 0, bad_times 0, changed 0, failures 0, crashes 0, hangs 0, memory 0, leaks 0, wrong_labels 0, "
            "complete true");
  const Json document = json(plugin("noli"), 0, {"--tolerance", "0"});
  EXPECT_EQ(document["audits"][0]["early"]["count"], 2);
  EXPECT_EQ(document["audits"][0]["early"]["worst"], 0);
  EXPECT_EQ(document["files"][0]["contacts"], 2);
  EXPECT_GT(document["timing"]["audits"][0]["ns_per_query"], 0);
  EXPECT_GT(document["timing"]["audits"][0]["textbook"], 0);
}

TEST_F(AuditCcd, CountsFalsePositivesWhichAreNoFindings) {
  const Json audit = json(faulty("always_hits"), 0)["audits"][0];
  EXPECT_EQ(audit["false_positives"], 2);
  EXPECT_EQ(audit["early"]["count"], 2);
  EXPECT_EQ(audit["early"]["median"], 0.5);
  EXPECT_EQ(audit["early"]["worst_relative"], 1);
  EXPECT_EQ(audit["files"][0]["false_positive_reports"], Json::parse("[3, 4]"));
}

TEST_F(AuditCcd, FindsMissedContacts) {
  const Json audit = json(faulty("never_hits"), 1)["audits"][0];
  EXPECT_EQ(audit["false_negatives"], 2);
  EXPECT_EQ(audit["files"][0]["reports"][1]["query"], 2);
  EXPECT_EQ(audit["files"][0]["reports"][1]["finding"], "false_negative");
  const Process process = run_noli(command(faulty("never_hits"), queries(), {"--max-reports", "0"}));
  EXPECT_EQ(process.exit_code, 1);
  EXPECT_EQ(process.verdict_line().rfind("FINDING  audits 1, queries 4, findings 2, ", 0), 0u) << process.out;
  EXPECT_EQ(process.out.find(": query "), std::string::npos) << process.out;
}

TEST_F(AuditCcd, GoesOnBehindACrash) {
  for (const char* const name : {"crashes", "ends_the_program"}) {
    const Json audit = json(faulty(name), 1)["audits"][0];
    EXPECT_EQ(audit["crashes"], 2) << name;
    EXPECT_EQ(audit["answered"], 2) << name;
    EXPECT_EQ(audit["false_positives"], 1) << name;
    EXPECT_EQ(audit["files"][0]["reports"][0]["finding"], "crash") << name;
    EXPECT_EQ(audit["files"][0]["reports"][0]["query"], 2) << name;
    EXPECT_EQ(audit["files"][0]["complete"], true) << name;
  }
}

TEST_F(AuditCcd, IsNotMisledByALibraryThatWritesBehindThePoints) {
  const Json audit = json(faulty("writes_behind_the_points"), 1)["audits"][0];
  EXPECT_EQ(audit["answered"], 4);
  EXPECT_EQ(audit["false_negatives"], 2);
}

/// The library's own answers are lost and count as findings; those of other libraries are kept.
TEST_F(AuditCcd, SurvivesALibraryThatWritesAllOver) {
  const std::vector<std::string> more = {"--library", plugin("noli"), "--query-limit", "100ms", "--max-hangs", "1000"};
  const Json audits = json(faulty("writes_all_over"), 1, more)["audits"];
  EXPECT_GT(audits[0]["crashes"].get<int>() + audits[0]["hangs"].get<int>(), 0);
  EXPECT_LT(audits[0]["answered"], 4);
  EXPECT_EQ(audits[1]["crashes"], 0);
  EXPECT_EQ(audits[1]["answered"], 4);
}

/// The library overwrites the record that it was loaded.
TEST_F(AuditCcd, TellsACrashFromALibraryThatCannotBeLoaded) {
  const Json audit = json(faulty("writes_zeros_and_crashes"), 1)["audits"][0];
  EXPECT_GE(audit["crashes"], 2);
  EXPECT_EQ(audit["files"][0]["complete"], true);
}

TEST_F(AuditCcd, GoesOnBehindAHang) {
  for (const char* const name : {"hangs", "sleeps"}) {
    const Json audit = json(faulty(name), 1, {"--query-limit", "100ms"})["audits"][0];
    EXPECT_EQ(audit["hangs"], 2) << name;
    EXPECT_EQ(audit["answered"], 2) << name;
    EXPECT_EQ(audit["files"][0]["reports"][1]["query"], 4) << name;
    EXPECT_EQ(audit["files"][0]["reports"][1]["finding"], "hang") << name;
  }
}

TEST_F(AuditCcd, GivesUpALibraryThatHangsTooOften) {
  const Json document = json(faulty("hangs"), 1, {"--query-limit", "100ms", "--max-hangs", "1"});
  EXPECT_EQ(document["complete"], false);
  EXPECT_EQ(document["audits"][0]["hangs"], 1);
  EXPECT_EQ(document["audits"][0]["answered"], 1);
}

TEST_F(AuditCcd, FindsWhatOnlyHappensWhenAskedAgain) {
  const Json crashing = json(faulty("crashes_when_asked_again"), 1)["audits"][0];
  EXPECT_GE(crashing["crashes"], 1);
  const Json changing = json(faulty("changes_its_mind"), 1)["audits"][0];
  EXPECT_GE(changing["changed"], 3);
}

TEST_F(AuditCcd, FindsMemoryThatGrows) {
  const Json document = json(faulty("leaks"), 1);
  EXPECT_EQ(document["audits"][0]["leaks"], 1);
  EXPECT_GT(document["timing"]["audits"][0]["files"][0]["growth_bytes_per_query"], 3000);
  EXPECT_EQ(document["findings"], 1);
}

TEST_F(AuditCcd, GoesOnBehindWhatTakesAllMemory) {
  const Json audit = json(faulty("takes_memory"), 1, {"--memory-limit", "300", "--query-limit", "60s"})["audits"][0];
  EXPECT_EQ(audit["memory"], 2);
  EXPECT_EQ(audit["answered"], 2);
  EXPECT_EQ(audit["files"][0]["reports"][0]["finding"], "memory");
  EXPECT_EQ(audit["files"][0]["reports"][0]["words"], "more than 300000000 bytes");
}

TEST_F(AuditCcd, FindsTimesThatAreLateOrNone) {
  const Json late = json(faulty("lies_about_time"), 1)["audits"][0];
  EXPECT_EQ(late["late"]["count"], 2);
  EXPECT_EQ(late["late"]["worst"], 0.5);
  EXPECT_EQ(late["files"][0]["reports"][0]["words"], "1, exact first time 0.5");
  const Json wild = json(faulty("has_wild_times"), 1)["audits"][0];
  EXPECT_EQ(wild["bad_times"], 2);
  EXPECT_EQ(wild["late"]["count"], 0);
  const Json none = json(plugin("root_parity"), 0)["audits"][0];
  EXPECT_EQ(none["times"], 0);
}

TEST_F(AuditCcd, AContactWithoutATimeIsAFindingWhereOthersHaveOne) {
  const Json audit = json(faulty("has_few_times"), 1)["audits"][0];
  EXPECT_EQ(audit["times"], 1);
  EXPECT_EQ(audit["no_times"], 1);
  EXPECT_EQ(json(faulty("lies_about_time"), 1)["audits"][0]["no_times"], 0);
}

TEST_F(AuditCcd, AnAnswerThatTheInterfaceDoesNotKnowIsAFailure) {
  const Json audit = json(faulty("answers_two"), 1)["audits"][0];
  EXPECT_EQ(audit["failures"], 4);
  EXPECT_EQ(audit["false_positives"], 0);
}

TEST_F(AuditCcd, EndsWhatALibraryHasStarted) {
  const std::string file = folder.path("pid");
  ::setenv("NOLI_TEST_PID_FILE", file.c_str(), 1);
  json(faulty("leaves_a_process"), 0);
  ::unsetenv("NOLI_TEST_PID_FILE");
  std::string pid;
  ASSERT_TRUE(std::ifstream(file) >> pid);
  // A killed process takes a moment to end; a zombie has ended but was not waited for yet.
  const auto ended = [&] {
    std::string number, name, state;
    return !(std::ifstream("/proc/" + pid + "/stat") >> number >> name >> state) || state == "Z";
  };
  for (int i = 0; i < 1000 && !ended(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(ended()) << pid;
}

TEST_F(AuditCcd, CountsFailures) {
  const Json audit = json(faulty("fails"), 1)["audits"][0];
  EXPECT_EQ(audit["failures"], 4);
  EXPECT_EQ(audit["false_negatives"], 0);
}

TEST_F(AuditCcd, RefusesWhatIsNoSuchLibrary) {
  refused(faulty("has_no_version"), "has no visible function noli_ccd_version");
  refused(faulty("has_no_query"), "has no visible function noli_ccd_query");
  refused(faulty("has_another_version"), "is for version 2 of the interface; expected 1");
  refused(faulty("crashes_when_loaded"), "cannot be loaded: ");
  refused(folder.path("absent.so"), "does not exist");
  refused(folder.path("."), "is not a file");
  refused(folder.write("text.so", "int noli_ccd_query();\n"), "is not a shared library");
  refused(folder.write("empty.so", ""), "is not a shared library");
  refused(NOLI_COMMAND, "cannot be loaded: ");
}

/// The first bytes of an ELF file of this type for this machine.
std::string elf(char bits, char order, std::uint8_t type, std::uint8_t machine) {
  std::string bytes = std::string("\x7f") + "ELF" + bits + order + '\x01' + std::string(9, '\0');
  const bool little = order == '\x01';
  for (const std::uint8_t number : {type, machine}) {
    const char low = static_cast<char>(number);
    bytes += little ? std::string{low, '\0'} : std::string{'\0', low};
  }
  return bytes + std::string(200, '\0');
}

TEST_F(AuditCcd, SaysForWhichMachineALibraryIs) {
  refused(folder.write("arm.so", elf(2, 1, 3, 183)),
          "is for another machine (ELF: machine 183, 64 bits, little endian");
  refused(folder.write("old.so", elf(1, 1, 3, 3)), "is for another machine (ELF: machine 3, 32 bits, little endian");
  refused(folder.write("big.so", elf(2, 2, 3, 22)), "is for another machine (ELF: machine 22, 64 bits, big endian");
  std::ifstream own(NOLI_COMMAND, std::ios::binary);
  std::string head(64, '\0');
  own.read(head.data(), 64);
  refused(folder.write("torn.so", head), "cannot be loaded: ");
  head[16] = 1;
  refused(folder.write("object.so", head), "not a shared library (type 1; expected 3)");
}

TEST_F(AuditCcd, RefusesOtherQueries) {
  const std::string point = "0,1,0,1,1,1,0\n0,1,0,1,0,1,0\n0,1,0,1,2,1,0\n0,1,0,1,0,1,0\n";
  for (const char* const name : {"vertex-vertex.csv", "queries.csv"}) {
    const Process process = run_noli(command(plugin("noli"), folder.write(name, point)));
    EXPECT_EQ(process.exit_code, 3);
    EXPECT_NE(process.err.find("expected vertex-face or edge-edge"), std::string::npos) << process.err;
  }
  for (const char* const tolerance : {"-1", "x", "inf", "1e-6,x"}) {
    EXPECT_EQ(run_noli(command(plugin("noli"), queries(), {"--tolerance", tolerance})).exit_code, 3) << tolerance;
  }
}

TEST_F(AuditCcd, SaysWhichLabelsAreWrong) {
  const std::string file = folder.write("wrong-vertex-face.csv", vertex_face(-1, -1, "1") + vertex_face(-1, -1, "0"));
  const Process process = run_noli(command(plugin("noli"), file));
  EXPECT_EQ(process.exit_code, 1);
  EXPECT_EQ(process.verdict_line().rfind("DISAGREEMENT ", 0), 0u) << process.out;
  EXPECT_EQ(json_of(command(plugin("noli"), file), 1)["files"][0]["wrong_labels"], Json::parse("[2]"));
}

TEST_F(AuditCcd, ComparesLibrariesAndTolerances) {
  const std::string svg = folder.path("out.svg");
  const std::vector<std::string> more = {"--library", plugin("inclusion"), "--tolerance", "1e-6,1e-3", "--svg", svg};
  const Json document = json(plugin("textbook"), 0, more);
  ASSERT_EQ(document["audits"].size(), 4u);
  EXPECT_EQ(document["audits"][2]["library"], plugin("inclusion"));
  EXPECT_EQ(document["audits"][2]["tolerance"], 1e-6);
  EXPECT_GT(document["audits"][3]["early"]["worst"], document["audits"][2]["early"]["worst"]);
  const std::string picture = read_text(svg);
  EXPECT_NE(picture.find("<svg "), std::string::npos);
  EXPECT_NE(picture.find(">inclusion, 0.001</text>"), std::string::npos) << picture;
}

TEST_F(AuditCcd, DrawsWhatIsMissedApartFromWhatIsFoundInVain) {
  const std::string svg = folder.path("out.svg");
  json(faulty("never_hits"), 1, {"--library", faulty("always_hits"), "--library", faulty("fails"), "--svg", svg});
  const std::string picture = read_text(svg);
  for (const char* const words : {"contacts missed", "false positives", "never_hits, 1e-06", "always_hits, 1e-06",
                                  "fails, 1e-06, 4 without an answer"}) {
    EXPECT_NE(picture.find(">" + std::string(words) + "</text>"), std::string::npos) << words << "\n" << picture;
  }
  EXPECT_NE(picture.find(">textbook: "), std::string::npos) << picture;
}

TEST_F(AuditCcd, LosesNeitherResultNorPictureToTheOther) {
  const std::string both = folder.path("both"), again = folder.path("./both");
  const Process process = run_noli(command(plugin("noli"), queries(), {"--svg", both, "--json", again}));
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("is where --json goes"), std::string::npos) << process.err;
  const std::string json_file = folder.path("out.json");
  const Process full = run_noli(command(plugin("noli"), queries(), {"--svg", "/dev/full", "--json", json_file}));
  EXPECT_EQ(full.exit_code, 4);
  EXPECT_EQ(full.verdict_line().rfind("NO FINDING ", 0), 0u) << full.out;
  EXPECT_EQ(Json::parse(read_text(json_file))["verdict"], "no_finding");
}

TEST_F(AuditCcd, TellsWhatALibrarySaysThatItIs) {
  const std::string library = faulty("says_what_it_is"), svg = folder.path("out.svg");
  const Process process = run_noli(command(library, queries(), {"--svg", svg}));
  EXPECT_NE(process.out.find("says_what_it_is is tests 1.0\\nof Noli\n"), std::string::npos) << process.out;
  EXPECT_NE(read_text(svg).find(">says_what_it_is, 1e-06 (tests 1.0"), std::string::npos);
  EXPECT_EQ(json(library, 0)["audits"][0]["description"], "tests 1.0\nof Noli");
  EXPECT_EQ(json(faulty("says_too_much"), 0)["audits"][0]["description"], std::string(100, 'x'));
  EXPECT_FALSE(json(plugin("noli"), 0)["audits"][0].contains("description"));
}

TEST_F(AuditCcd, GivesTheSameBytesTwice) {
  EXPECT_EQ(without_timing(json(plugin("additive"), 0)), without_timing(json(plugin("additive"), 0)));
}

TEST_F(AuditCcd, StopsWhenItsTimeIsOver) {
  const Process process =
      run_noli(command(faulty("hangs"), queries(), {"--query-limit", "60s", "--time-limit", "500ms"}));
  EXPECT_EQ(process.exit_code, 2) << process.err;
  EXPECT_EQ(process.verdict_line().rfind("UNDECIDED ", 0), 0u) << process.out;
}

TEST_F(AuditCcd, StopsWhenInterrupted) {
  ProcessOptions options;
  options.signal = SIGINT;
  options.signal_after = std::chrono::milliseconds(300);
  const Process process = run_noli(command(faulty("sleeps"), queries(), {"--query-limit", "60s"}), options);
  EXPECT_EQ(process.exit_code, 2) << process.err;
  EXPECT_NE(process.verdict_line().find("complete false"), std::string::npos) << process.out;
}

TEST_F(AuditCcd, TheWorkedExampleIsTrue) {
#if defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the thread sanitizer's own memory grows with each query, and is told as a leak";
#endif
  const auto commands = worked_example("docs/audit/ccd.md", "## A worked example");
  ASSERT_EQ(commands.size(), 4u);
  expect_worked_example(commands, {{"cc ", std::string(NOLI_C_COMPILER) + " "},
                                   {"build/release/app/noli", NOLI_COMMAND},
                                   {"build/release/audit/ccd/plugins", NOLI_CCD_PLUGINS},
                                   {"build/swept_boxes.so", folder.path("swept_boxes.so")},
                                   {"build/audit.svg", folder.path("audit.svg")}});
}

// --- third-party libraries -------------------------------------------------------------------------------------------

/// Tests the third-party libraries that this Noli was built with.
class AuditCcdOfOthers : public AuditCcd {
 protected:
  static bool is_built(const std::string& name) { return std::filesystem::exists(plugin(name)); }

  /// Compares with the library's own description, such as "FCL 0.7.0, as installed".
  static bool is_version(const Json& audit, const std::string& begin) {
    return audit["description"].get<std::string>().starts_with(begin);
  }

  /// Two contacts and one query without contact, with all coordinates divided by a power of two.
  std::string divided_by(const std::string& denominator) const {
    std::string text = vertex_face(-1, -1, "1") + vertex_face(1, -1, "1") + vertex_face(-1, 1, "0");
    for (std::size_t at = 0; (at = text.find(",1,", at)) != std::string::npos; at += denominator.size() + 2) {
      text.replace(at, 3, "," + denominator + ",");
    }
    return folder.write("a-vertex-face.csv", text);
  }
};

TEST_F(AuditCcdOfOthers, Fcl) {
  if (!is_built("fcl")) GTEST_SKIP() << "skipped: the plug-in over FCL, which is not built (NOLI_WITH_FCL)";
  const Json audit = json_of(command(plugin("fcl"), divided_by("1")), 0)["audits"][0];
  EXPECT_TRUE(is_version(audit, "FCL ")) << audit;
  EXPECT_EQ(audit["answered"], 3);
  EXPECT_EQ(audit["false_negatives"], 0);
  EXPECT_EQ(audit["false_positives"], 0);
  EXPECT_EQ(audit["times"], 2);
}

/// FCL's answers depend on the unit of length (docs/audit/ccd.md).
TEST_F(AuditCcdOfOthers, FclTakesSmallVolumesForNone) {
  if (!is_built("fcl")) GTEST_SKIP() << "skipped: the plug-in over FCL, which is not built (NOLI_WITH_FCL)";
  const Json audit = json_of(command(plugin("fcl"), divided_by("4096")), 1)["audits"][0];
  if (!is_version(audit, "FCL 0.7.")) GTEST_SKIP() << "skipped: another version of FCL, " << audit["description"];
  EXPECT_EQ(audit["false_negatives"], 2);
}

TEST_F(AuditCcdOfOthers, IpcToolkit) {
  if (!is_built("ipc_toolkit")) {
    GTEST_SKIP() << "skipped: the plug-in over the IPC Toolkit, which is not built (NOLI_WITH_IPC_TOOLKIT)";
  }
  const Json audit = json_of(command(plugin("ipc_toolkit"), divided_by("1")), 0)["audits"][0];
  EXPECT_EQ(audit["answered"], 3);
  EXPECT_EQ(audit["false_negatives"], 0);
  EXPECT_EQ(audit["late"]["count"], 0);
}

struct Expected {
  const char* method;
  std::array<int, 6> wrong;  ///< false positives and negatives of each file
};

/// The errors of the methods on real queries are those measured by their authors and others (docs/audit/ccd.md).
TEST_F(AuditCcdOfOthers, MethodsErrAsMeasuredSlow) {
  std::vector<std::string> words = {"audit", "ccd"};
  for (const char* const name :
       {"cloth-funnel-edge-edge", "cloth-funnel-vertex-face", "armadillo-rollers-vertex-face"}) {
    const auto path = real_data("queries/" + std::string(name) + ".csv");
    if (!path) GTEST_SKIP() << "no real data";
    words.push_back(*path);
  }
  std::vector<Expected> all = {{"inclusion", {156, 0, 65, 0, 2, 0}},
                               {"textbook", {0, 37, 0, 6, 0, 0}},
                               {"additive", {156, 0, 65, 0, 2, 0}},
                               {"root_parity", {0, 1, 0, 0, 0, 63}},
                               {"noli", {0, 0, 0, 0, 0, 0}}};
  if (is_built("fcl")) all.push_back({"fcl", {0, 107, 0, 27, 2, 5}});  // FCL 0.7.0
  words.insert(words.end(), {"--query-limit", "60s"});
  for (const Expected& one : all) words.insert(words.end(), {"--library", plugin(one.method)});
  const Json document = json_of(words, 1);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t file = 0; file < 3; ++file) {
      const Json& part = document["audits"][i]["files"][file];
      EXPECT_EQ(part["false_positives"], all[i].wrong[2 * file]) << all[i].method << " " << file;
      EXPECT_EQ(part["false_negatives"], all[i].wrong[2 * file + 1]) << all[i].method << " " << file;
      EXPECT_EQ(part["failures"], 0) << all[i].method;
      EXPECT_EQ(part["crashes"], 0) << all[i].method;
    }
  }
  for (const char* const finding : {"false_negatives", "bad_times", "changed", "leaks", "hangs"}) {
    EXPECT_EQ(document["audits"][4][finding], 0) << finding;
  }
  EXPECT_EQ(document["audits"][4]["late"]["count"], 0);
}

}  // namespace
}  // namespace noli::app_tests
