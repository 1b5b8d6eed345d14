// SPDX-License-Identifier: Apache-2.0
//
// Tests results against their published schemas with an independent validator (python3-jsonschema).
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "report/page/report_verdict.h"
#include "tests/app/process.h"
#include "tests/app/runs/simulate_fixture.h"
#include "tests/app/scene.h"
#include "tests/app/worked_example.h"

namespace noli::app_tests {
namespace {

class Schema : public Simulate {
 protected:
  /// The validator's complaint about a document; "" if it is valid.
  std::string complaint(const std::string& schema, const std::string& document) const {
    const std::string file = folder.write("document.json", document);
    const std::string printed = folder.write("schema.json", run_noli({"schema", schema}).out);
    const auto [words, code] = shell("'" NOLI_JSONSCHEMA "' --instance '" + file + "' '" + printed + "' 2>&1");
    return code == 0 ? "" : words + " (exit " + std::to_string(code) + ")";
  }

  /// Expects that the result of a command is valid under the schema that it names.
  Json expect_valid(const std::string& schema, std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--json", "-"});
    const Process process = run_noli(arguments);
    EXPECT_LE(process.exit_code, 2) << process.err;
    Json json = Json::parse(process.out, nullptr, false);
    EXPECT_EQ(json.value("schema", ""), "noli-" + schema);
    EXPECT_EQ(complaint(schema, process.out), "") << process.out;
    return json;
  }

  std::string frame(const std::string& name, double height) const { return folder.write(name, two_triangles(height)); }
};

TEST_F(Schema, NamesAreListedAndEachIsPrinted) {
  std::istringstream names(run_noli({"schema"}).out);
  std::set<std::string> seen;
  for (std::string name; names >> name;) {
    seen.insert(name);
    const std::string printed = run_noli({"schema", name}).out;
    EXPECT_EQ(run_noli({"schema", "noli-" + name}).out, printed);
    const Json schema = Json::parse(printed);
    const Json version = schema["properties"].contains("version") ? schema["properties"]["version"]["const"] : Json(1);
    EXPECT_EQ(schema["$id"], "urn:noli:schema:" + name + ":" + version.dump());
    EXPECT_EQ(complaint(name, "[]").find("Traceback"), std::string::npos) << name;
  }
  for (const char* name : {"scene", "groups", "claim", "verify", "check", "simulate", "ccd"}) {
    EXPECT_EQ(seen.count(name), 1u) << name;
  }
}

/// A word without a tone looks like "undecided" on terminals and pages.
TEST_F(Schema, EachVerdictHasATone) {
  std::istringstream names(run_noli({"schema"}).out);
  std::set<std::string> open;
  for (std::string name; names >> name;) {
    const Json schema = Json::parse(run_noli({"schema", name}).out);
    const Json verdict = schema["properties"].value("verdict", Json::object());
    for (const std::string word : verdict.value("enum", Json::array())) {
      if (report::tone_of(word) == report::Tone::open) open.insert(word);
    }
  }
  EXPECT_EQ(open, std::set<std::string>{"undecided"});
  EXPECT_EQ(report::tone_of("done"), report::Tone::neutral);  // of `verify --shard`, which has no schema
}

TEST_F(Schema, AnUnknownNameIsRefused) {
  const Process process = run_noli({"schema", "verdict"});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("there is no schema verdict; `noli schema` lists the names"), std::string::npos);
}

TEST_F(Schema, TheValidatorSeesWhatIsWrong) {
  Json json = expect_valid("verify", {"verify", frame("a.ply", 1), frame("b.ply", 0.5)});
  json["verdict"] = "fine";
  EXPECT_NE(complaint("verify", json.dump()), "");
  json["verdict"] = "proved";
  EXPECT_EQ(complaint("verify", json.dump()), "");
  json["surprise"] = 1;
  EXPECT_NE(complaint("verify", json.dump()), "");
  json.erase("surprise");
  json.erase("inputs");
  EXPECT_NE(complaint("verify", json.dump()), "");
}

TEST_F(Schema, OfVerify) {
  const std::string a = frame("a.ply", 1), b = frame("b.ply", 0.5), c = frame("c.ply", -1);
  expect_valid("verify", {"verify", a, b, c, "--keep-going"});
  expect_valid("verify", {"verify", a, b, c, "--no-check", "--proof", folder.path("abc.noli")});
  expect_valid("verify", {"verify", a, "--static", "--strict", "--points", "--merge-identical"});
  expect_valid("verify", {"verify", a, b, "--only-new"});
  const std::string other = folder.write("other.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expect_valid("verify-meshes", {"verify", a, other, "--static"});
  expect_valid("verify", {"verify", a, b, "--min-distance", "0.25"});
  expect_valid("verify", {"verify", a, b, "--min-distance", "0.75"});
  expect_valid("verify", {"verify", a, b, "--min-distance", "2"});
  expect_valid("verify", {"verify", a, b, "--time-limit", "0.001ms"});
  const std::string pierced = folder.write("pierced.ply", sail_through_deck());
  expect_valid("verify", {"verify", pierced, pierced});
  const std::string groups =
      folder.write("groups.json", R"({"groups": {"low": [[0, 2]], "high": [3, 4, 5]}, "ignore": [["low", "high"]]})");
  EXPECT_EQ(complaint("groups", bytes_of(groups)), "");
  expect_valid("verify", {"verify", a, b, c, "--ignore", groups});
}

TEST_F(Schema, OfCheckAndClaim) {
  const std::string a = frame("a.ply", 1), b = frame("b.ply", 0.5), c = frame("c.ply", -1);
  const std::string proof = folder.path("p.noli"), claim = folder.path("claim.json");
  ASSERT_EQ(run_noli({"verify", a, b, "--proof", proof, "--claim-out", claim}).exit_code, 0);
  EXPECT_EQ(complaint("claim", bytes_of(claim)), "");
  EXPECT_NE(complaint("claim", "{}"), "");
  expect_valid("check", {"check", proof, a, b});
  expect_valid("repair", {"repair", a, c, "-o", folder.path("mended/%d.ply")});
  expect_valid("repair", {"repair", a, c, "-o", folder.path("blocked/%d.ply"), "--fixed-first", "6"});
  ASSERT_EQ(run_noli({"verify", a, c, "--force", "--proof", proof}).exit_code, 1);
  expect_valid("check", {"check", proof, a, c});
  const Process rejected = run_noli({"check", proof, a, b, "--json", "-"});
  EXPECT_EQ(rejected.exit_code, 3);
  EXPECT_EQ(complaint("check", rejected.out), "") << rejected.out;
}

TEST_F(Schema, OfRuns) {
  const std::string file = scene(hanging_sheet());
  EXPECT_EQ(complaint("scene", bytes_of(file)), "");
  EXPECT_NE(complaint("scene", R"({"noli_scene": 1})"), "");
  expect_valid("simulate", {"simulate", file, "-o", run_path("run"), "--until", "0.1"});
  expect_valid("verify", {"verify", run_path("run")});
  expect_valid("check", {"check", run_path("run")});
  expect_valid("explain-run", {"explain", run_path("run")});
  expect_valid("explain-scene", {"explain", file});
  expect_valid("info", {"info", run_path("run"), frame("a.ply", 1)});
  expect_valid("reproduce",
               {"simulate", file, "--reproduce", run_path("run"), "--window", "3", "-o", folder.path("window.block")});
  expect_valid("simulate",
               {"simulate", folder.write("falling.json", falling_triangle().dump()), "-o", run_path("falls")});
}

TEST_F(Schema, OfQueriesAndFuzzers) {
  const std::string queries =
      std::string(NOLI_SOURCE_DIR) + "/tests/kernel/queries/border-near-the-begin-edge-edge.csv";
  ASSERT_TRUE(fs::exists(queries));
  expect_valid("ccd", {"ccd", queries, "--times"});
  const std::string out = folder.path("findings");
  expect_valid("fuzz-queries", {"fuzz", "queries", "--count", "500", "--out", out});
  expect_valid("fuzz-trajectories", {"fuzz", "trajectories", "--count", "4", "--out", out});
  expect_valid("fuzz-proofs", {"fuzz", "proofs", "--count", "50", "--out", out});
  expect_valid("fuzz-scenes", {"fuzz", "scenes", "--count", "2", "--out", out});
}

TEST_F(Schema, OfAudits) {
  const std::string library = std::string(NOLI_CCD_PLUGINS) + "/textbook.so";
  const std::string queries =
      std::string(NOLI_SOURCE_DIR) + "/tests/kernel/queries/border-near-the-begin-edge-edge.csv";
  expect_valid("audit-ccd", {"audit", "ccd", "--library", library, queries});
  expect_valid("audit-pipeline",
               {"audit", "ccd", "--library", library, "--frames", frame("a.ply", 1), frame("b.ply", 0.5)});
  expect_valid("audit-precision", {"audit", "precision", scene(hanging_sheet()), "--until", "0.02"});
  expect_valid("audit-stability",
               {"audit", "stability", "--row", "frames-offset", "--points", "1", "--out", folder.path("findings")});
  expect_valid("audit-self", {"audit", "self", "--only", "rounding", "--out", folder.path("self")});
}

}  // namespace
}  // namespace noli::app_tests
