// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli export RUN --figure`: figures and tables.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include <noli/run.h>
#include "tests/app/runs/simulate_fixture.h"

namespace noli::app_tests {
namespace {

/// A table of numbers with a header line.
struct Csv {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;

  std::size_t column(const std::string& name) const {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] == name) return i;
    }
    ADD_FAILURE() << "no column " << name;
    return 0;
  }
};

std::vector<std::string> parts(const std::string& line) {
  std::vector<std::string> result;
  std::istringstream in(line);
  for (std::string part; std::getline(in, part, ',');) result.push_back(part);
  return result;
}

Csv read_csv(const std::string& path) {
  Csv csv;
  std::istringstream in(bytes_of(path));
  std::string line;
  std::getline(in, line);
  csv.names = parts(line);
  while (std::getline(in, line)) {
    csv.rows.emplace_back();
    for (const std::string& part : parts(line)) csv.rows.back().push_back(std::stod(part));
    EXPECT_EQ(csv.rows.back().size(), csv.names.size());
  }
  return csv;
}

/// The number of elements with this name in a document; -1 if it is not well-formed XML. Knows what SVG files contain:
/// a declaration, elements, attributes, text with the five entities.
int count_elements(const std::string& xml, const std::string& name) {
  std::vector<std::string> open;
  int count = 0;
  std::size_t at = xml.starts_with("<?xml ") ? xml.find("?>") + 2 : 0;
  bool root = false;
  while ((at = xml.find('<', at)) != std::string::npos) {
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) return -1;
    const std::string tag = xml.substr(at + 1, end - at - 1);
    const std::size_t next = std::min(xml.find('<', end), xml.size());
    const std::string text = xml.substr(end + 1, next - end - 1);
    if (tag.empty() || tag.find('<') != std::string::npos || std::count(tag.begin(), tag.end(), '"') % 2 != 0)
      return -1;
    for (std::size_t i = text.find('&'); i != std::string::npos; i = text.find('&', i + 1)) {
      const std::string entity = text.substr(i, text.find(';', i) - i + 1);
      if (entity != "&amp;" && entity != "&lt;" && entity != "&gt;" && entity != "&quot;") return -1;
    }
    if (tag[0] == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return -1;
      open.pop_back();
    } else {
      if (open.empty() && root) return -1;
      root = true;
      const std::string element = tag.substr(0, tag.find_first_of(" \n/"));
      count += element == name ? 1 : 0;
      if (tag.back() != '/') open.push_back(element);
    }
    at = end + 1;
  }
  return open.empty() && root ? count : -1;
}

TEST(WellFormed, IsToldFromWhatIsNot) {
  EXPECT_EQ(count_elements("<?xml version=\"1.0\"?>\n<a><b x=\"1\"/>&lt;<b>t</b></a>", "b"), 2);
  for (const char* bad :
       {"", "<a>", "<a></b>", "<a/><a/>", "<a x=\"></a>", "<a>&b;</a>", "<a>&</a>", "<a", "<a><</a>"}) {
    EXPECT_EQ(count_elements(bad, "a"), -1) << bad;
  }
}

class Figures : public Simulate {
 protected:
  std::string figure(const std::string& name, const std::string& file) const {
    const Process process = run_noli({"export", run_path("run"), "--figure", name, "-o", run_path(file)});
    EXPECT_EQ(process.exit_code, 0) << process.err;
    return run_path(file);
  }
};

TEST_F(Figures, SharesOfStepsAddUpToAHundredPerCent) {
  ASSERT_EQ(run_noli({"simulate", scene(two_cloths()), "-o", run_path("run")}).exit_code, 0);
  const Csv csv = read_csv(figure("step-histogram", "steps.csv"));
  ASSERT_EQ(csv.rows.size(), 20u);
  ASSERT_GT(csv.names.size(), 7u);
  const std::size_t smallest = csv.column("smallest_step [s]"), median = csv.column("median_step [s]");
  const std::size_t one = csv.column("percentile_1_step [s]");
  double least = 1;
  for (const auto& row : csv.rows) {
    double sum = 0;
    for (std::size_t i = 5; i < row.size(); ++i) sum += row[i];
    EXPECT_NEAR(sum, 100, 1e-9);
    EXPECT_LE(row[smallest], row[one] * 1.19);
    EXPECT_LE(row[one], row[median]);
    EXPECT_LE(row[median], 0.011);
    least = std::min(least, row[smallest]);
  }
  EXPECT_EQ(csv.rows.back()[csv.column("end [s]")], 0.2);
  EXPECT_LT(least, csv.rows.front()[smallest]);  // layers have shorter steps than elastic forces
  const std::string svg = bytes_of(figure("step-histogram", "steps.svg"));
  EXPECT_GE(count_elements(svg, "polygon"), 3);
  EXPECT_NE(svg.find("step [s]"), std::string::npos);
  EXPECT_NE(svg.find("Two cloths: steps of vertices"), std::string::npos);
}

TEST_F(Figures, WhatRestsHasStepsOfAWindow) {
  ASSERT_EQ(run_noli({"simulate", scene(falling_triangle()), "-o", run_path("run"), "--until", "0.25"}).exit_code, 0);
  const Csv csv = read_csv(figure("step-histogram", "steps.csv"));
  ASSERT_EQ(csv.names.size(), 6u);
  for (const auto& row : csv.rows) {
    EXPECT_EQ(row[2], 0.0078125);
    EXPECT_NEAR(row[4], 0.0078125, 1e-12);
    EXPECT_EQ(row[5], 100);
  }
  EXPECT_EQ(count_elements(bytes_of(figure("step-histogram", "steps.svg")), "polygon"), 1);
}

TEST_F(Figures, ManyWindowsMakeASmallPicture) {
  Json json = resting_bar(30, 0.01);
  json["bodies"][0]["velocity"] = {1, 0};
  ASSERT_EQ(run_noli({"simulate", scene(json), "-o", run_path("run")}).exit_code, 0);
  EXPECT_EQ(read_csv(figure("step-histogram", "steps.csv")).rows.size(), 3000u);
  for (const char* name : {"step-histogram", "energy", "momentum"}) {
    const std::string svg = bytes_of(figure(name, std::string(name) + ".svg"));
    EXPECT_GE(count_elements(svg, "text"), 8) << name;
    EXPECT_LT(svg.size(), 100'000u) << name;
  }
}

TEST_F(Figures, EnergyAndMomentumAreThoseOfTheSeries) {
  ASSERT_EQ(run_noli({"simulate", scene(hanging_sheet()), "-o", run_path("run")}).exit_code, 0);
  const Csv energy = read_csv(figure("energy", "energy.csv"));
  ASSERT_EQ(energy.rows.size(), 25u);
  const std::size_t total = energy.column("total [J]"), mean = energy.column("kinetic_mean [J]");
  const std::size_t gravity = energy.column("potential_gravity [J]");
  for (const auto& row : energy.rows) {
    double sum = row[mean];
    for (std::size_t k = gravity; k < gravity + 6; ++k) sum += row[k];
    EXPECT_NEAR(row[total], sum, 1e-12);
    EXPECT_GT(row[mean], 0);
    EXPECT_LT(row[gravity], 0);
  }
  const Csv momentum = read_csv(figure("momentum", "momentum.csv"));
  ASSERT_EQ(momentum.rows.size(), 25u);
  EXPECT_LT(momentum.rows.front()[momentum.column("momentum_z [N s]")], 0);
  EXPECT_GE(count_elements(bytes_of(figure("energy", "energy.svg")), "polyline"), 4);
  EXPECT_EQ(count_elements(bytes_of(figure("momentum", "momentum.svg")), "polyline"), 6);
}

/// Figures of a scene with damping, friction, restitution and two scripts, resumed in the middle.
class Books : public Figures {
 protected:
  void SetUp() override {
    const std::string file = (fs::path(NOLI_SOURCE_DIR) / "scenes/plane_compactor.json").string();
    const auto simulate = [&](const char* until, const char* resume) {
      return run_noli({"simulate", file, "--short", "-o", run_path("run"), "--until", until, resume}).exit_code;
    };
    ASSERT_EQ(simulate("0.3", "--force"), 0);
    ASSERT_EQ(simulate("0.6", "--resume"), 0);
    energy = read_csv(figure("energy", "energy.csv"));
    ASSERT_EQ(energy.rows.size(), 120u);
  }

  double at(std::size_t window, const std::string& name) const { return energy.rows[window][energy.column(name)]; }
  /// The sum of all columns whose names start with `begin`.
  double sum(std::size_t window, const std::string& begin) const {
    double result = 0;
    for (std::size_t i = 0; i < energy.names.size(); ++i) {
      if (energy.names[i].starts_with(begin)) result += energy.rows[window][i];
    }
    return result;
  }
  double kinds(std::size_t window, const std::string& what) const {
    double result = 0;
    for (std::size_t k = 0; k < force_kinds; ++k) {
      result += at(window, what + "_" + std::string(name(static_cast<ForceKind>(k))) + " [J]");
    }
    return result;
  }
  double given(std::size_t window) const {
    return kinds(window, "damping_work") + kinds(window, "held_work") + at(window, "restitution_work [J]");
  }

  Csv energy;
};

TEST_F(Books, WorksAddUpToTheChangeOfEnergy) {
  double scripts = 0, restitution = 0;
  for (std::size_t w = 1; w < energy.rows.size(); ++w) {
    const double in_play = at(w, "kinetic [J]") + std::abs(kinds(w, "held_work")) + 1;
    const double kinetic = at(w, "kinetic [J]") - at(w - 1, "kinetic [J]");
    EXPECT_NEAR(kinetic, kinds(w, "work") + given(w), 1e-10 * in_play) << w;
    const auto all = [&](std::size_t window) { return at(window, "total [J]") + at(window, "held_ahead [J]"); };
    EXPECT_NEAR(at(w, "integration [J]"), all(w) - all(w - 1) - given(w), 1e-12 * in_play) << w;
    EXPECT_NEAR(sum(w, "script_work_"), kinds(w, "held_work"), 1e-12 * in_play) << w;
    EXPECT_NEAR(at(w, "work_of_material_0 [J]"), at(w, "work_contact [J]"), 1e-12 * in_play) << w;
    EXPECT_EQ(at(w, "friction_work_of_material_0 [J]"), at(w, "damping_work_contact [J]")) << w;
    EXPECT_EQ(at(w, "restitution_work_of_material_0 [J]"), at(w, "restitution_work [J]")) << w;
    scripts += kinds(w, "held_work");
    restitution += at(w, "restitution_work [J]");
  }
  EXPECT_GT(scripts, 0.1) << "the plates press";
  EXPECT_LT(restitution, -0.1);
}

TEST_F(Books, AreSummedUpByExplain) {
  const Json found = json_of({"explain", run_path("run")}, 0)["energy"];
  double damping = 0, restitution = 0, held = 0, integration = 0;
  for (std::size_t w = 0; w < energy.rows.size(); ++w) {
    damping += kinds(w, "damping_work");
    restitution += at(w, "restitution_work [J]");
    held += kinds(w, "held_work");
    integration += at(w, "integration [J]");
  }
  EXPECT_NEAR(found["damping_work"].get<double>(), damping, 1e-9);
  EXPECT_NEAR(found["restitution_work"].get<double>(), restitution, 1e-9);
  EXPECT_NEAR(found["held_work"].get<double>(), held, 1e-9);
  EXPECT_NEAR(found["integration"].get<double>(), integration, 1e-9);
  const double change = found["last"].get<double>() - found["begin"].get<double>();
  const double ahead = at(energy.rows.size() - 1, "held_ahead [J]");
  EXPECT_NEAR(change + ahead, damping + restitution + held + integration, 1e-9);
  EXPECT_NEAR(found["work"]["materials"][0]["restitution"].get<double>(), restitution, 1e-9);
  ASSERT_EQ(found["work"]["scripts"].size(), 2);
  EXPECT_NEAR(found["work"]["scripts"][0].get<double>() + found["work"]["scripts"][1].get<double>(), held, 1e-9);
  const std::string text = run_noli({"explain", run_path("run")}).out;
  EXPECT_NE(text.find("\n  scripts/1: "), std::string::npos) << text;
  EXPECT_NE(text.find(" J of restitution, "), std::string::npos) << text;
}

TEST_F(Books, AreTheSameForARunThatWasNotStopped) {
  const std::string file = (fs::path(NOLI_SOURCE_DIR) / "scenes/plane_compactor.json").string();
  ASSERT_EQ(run_noli({"simulate", file, "--short", "-o", run_path("whole"), "--until", "0.6"}).exit_code, 0);
  EXPECT_TRUE(bytes_of(run_path("whole/trajectory.blocks")) == bytes_of(run_path("run/trajectory.blocks")));
}

TEST_F(Figures, RecordedFramesHaveTheSameSeries) {
  Json json = two_cloths();
  ASSERT_EQ(run_noli({"simulate", scene(json), "-o", run_path("run")}).exit_code, 0);
  const std::string full = bytes_of(figure("step-histogram", "full.csv"));
  json["record"] = "frames";
  ASSERT_EQ(run_noli({"simulate", scene(json), "-o", run_path("run"), "--force"}).exit_code, 0);
  EXPECT_EQ(bytes_of(figure("step-histogram", "frames.csv")), full);
}

TEST_F(Figures, OfNothingFreeHaveNoSteps) {
  Json json = resting_bar(0.1, 0.01);
  json["bodies"][0]["pin"] = {"all"};
  ASSERT_EQ(run_noli({"simulate", scene(json), "-o", run_path("run")}).exit_code, 0);
  EXPECT_EQ(read_csv(figure("step-histogram", "steps.csv")).names.size(), 5u);
  EXPECT_EQ(count_elements(bytes_of(figure("step-histogram", "steps.svg")), "polygon"), 0);
  EXPECT_EQ(count_elements(bytes_of(figure("energy", "energy.svg")), "svg"), 1);
}

TEST_F(Figures, TitlesAreEscaped) {
  Json json = resting_bar(0.1, 0.01);
  json["title"] = "a < b & \"c\"";
  ASSERT_EQ(run_noli({"simulate", scene(json), "-o", run_path("run")}).exit_code, 0);
  const std::string svg = bytes_of(figure("energy", "energy.svg"));
  EXPECT_EQ(count_elements(svg, "svg"), 1);
  EXPECT_NE(svg.find("a &lt; b &amp; &quot;c&quot;"), std::string::npos);
}

TEST_F(Figures, BadInputIsRefused) {
  const std::string file = scene(resting_bar(0.1, 0.01));
  ASSERT_EQ(run_noli({"simulate", file, "-o", run_path("run")}).exit_code, 0);
  const auto refused = [&](const std::string& run, const std::string& name, const std::string& output,
                           const std::vector<std::string>& more, const std::string& words) {
    std::vector<std::string> line = {"export", run, "--figure", name, "-o", output};
    line.insert(line.end(), more.begin(), more.end());
    const Process process = run_noli(line);
    EXPECT_EQ(process.exit_code, 3);
    EXPECT_NE(process.err.find(words), std::string::npos) << process.err;
  };
  refused(run_path("run"), "entropy", run_path("a.svg"), {}, "expected one of step-histogram, energy, momentum");
  refused(run_path("run"), "energy", run_path("a.png"), {}, "expected a name that ends in .svg or .csv");
  refused(run_path("run"), "energy", run_path("a"), {}, "expected a name that ends in .svg or .csv");
  refused(run_path("none"), "energy", run_path("a.svg"), {}, "none");
  refused(fs::path(file).parent_path().string(), "energy", run_path("a.svg"), {}, "trajectory.blocks");
  refused(run_path("run"), "energy", run_path("no/folder/a.svg"), {}, "no/folder");
  refused(run_path("run"), "energy", run_path("a.svg"), {"--fps", "30"}, "--f");
  EXPECT_FALSE(fs::exists(run_path("a.svg")));
  const std::string there = figure("energy", "there.svg");
  refused(run_path("run"), "energy", there, {}, "exists already");
  EXPECT_EQ(run_noli({"export", run_path("run"), "--figure", "energy", "-o", there, "--force"}).exit_code, 0);
}

TEST_F(Figures, ARunOfNoWindowsHasNone) {
  Json json = falling_triangle();
  json["window"] = 0.5;  // contact is in the first window
  ASSERT_EQ(run_noli({"simulate", scene(json), "-o", run_path("run")}).exit_code, 1);
  const Process process = run_noli({"export", run_path("run"), "--figure", "energy", "-o", run_path("a.svg")});
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("has no windows"), std::string::npos) << process.err;
  EXPECT_EQ(json_of({"explain", run_path("run")}, 0)["windows"], 0);
}

}  // namespace
}  // namespace noli::app_tests
