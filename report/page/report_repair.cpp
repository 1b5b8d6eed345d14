// SPDX-License-Identifier: Apache-2.0
#include "report/page/report_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include "report/page/report_motion.h"
#include "report/page/report_results.h"
#include "report/page/report_scene.h"
#include "report/page/report_verdict.h"
#include "report/repaired_motions.h"
#include "trajectory/cells.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli::report {
namespace {

namespace fs = std::filesystem;

class Repaired {
 public:
  Repaired(const Json& result, const fs::path& path, const ReportLimits& limits, ReportPage& report)
      : result_(result), path_(path), limits_(limits), report_(report) {}

  void put() {
    put_verdict();
    put_plot();
    if (!result_.at("outputs").empty()) put_motion();
    put_result();
  }

 private:
  std::uint64_t count(const char* what) const { return result_.at(what).get<std::uint64_t>(); }

  void put_verdict() {
    const auto word = result_.at("verdict").get<std::string>();
    take_word(word, report_);
    Json& lines = report_.page["verdict"]["lines"];
    lines.push_back(fmt::format("noli repair says {} ({}): {} of {} steps changed, {} frames inserted.", spoken(word),
                                page_name(path_), result_.at("changed").size(), count("steps"), count("inserted")));
    put_stated();
    if (const Json most = most_changed(); !most.is_null()) lines.push_back(words_of(most));
    const auto end = result_.at("end").get<std::string>();
    if (end == "done") return;
    add_caveat(fmt::format("It ended ({}) after {} of {} steps: later frames are not repaired.", spoken(end),
                           count("steps"), count("steps_total")),
               report_);
  }

  void put_stated() {
    const Json& stated = result_.at("stated");
    if (!stated.is_string()) return;
    const Json& checker = result_.at("checker");
    const std::string who = checker.is_object()
                                ? fmt::format("{} {} accepted the proof of it", checker.at("name").get<std::string>(),
                                              checker.at("version").get<std::string>())
                                : "decided exactly, not checked";
    const std::string line = fmt::format("Of the new frames: {} ({}).", stated.get<std::string>(), who);
    if (stated == "nothing touches") {
      report_.page["verdict"]["lines"].push_back(line);
    } else {
      add_caveat(line, report_);  // something is not compared
    }
  }

  /// Of the steps that were changed, the one with the largest displacement.
  Json most_changed() const {
    const Json& changed = result_.at("changed");
    const auto most =
        std::ranges::max_element(changed, {}, [](const Json& step) { return step.at("largest").get<double>(); });
    return most == changed.end() ? Json() : *most;
  }

  std::string words_of(const Json& step) const {
    return fmt::format("Moved most from its given position: vertex {} at the end of step {}, by {}.",
                       step.at("vertex").get<std::uint64_t>(), step.at("step").get<std::uint64_t>(),
                       digits4(step.at("largest").get<double>()));
  }

  void put_plot() {
    Json times = Json::array(), largest = Json::array(), rms = Json::array();
    for (const Json& step : result_.at("changed")) {
      times.push_back(step.at("step"));
      largest.push_back(step.at("largest"));
      rms.push_back(step.at("rms"));
    }
    if (times.size() < 2) return;
    report_.page["plots"].push_back(
        {{"title", "How far vertices end from their given positions, in steps that were changed"},
         {"x", "step"},
         {"y", "distance"},
         {"log", false},
         {"times", times},
         {"series", {{{"name", "largest"}, {"values", largest}}, {{"name", "root mean square"}, {"values", rms}}}}});
  }

  void put_motion() {
    const RepairedMotions motions = repaired_motions(result_, path_);
    TimedFrames& given = *motions.given;
    const std::size_t vertices = motions.mesh.vertex_count;
    MotionPacker packer(2 * vertices, limits_.most_bytes);
    const std::vector<double>& times = motions.repaired->times();
    for (std::size_t k = 0; k < times.size(); ++k) {
      end_if_stopped();
      if (limits_.progress) limits_.progress(static_cast<double>(k + 1) / static_cast<double>(times.size()));
      if (packer.skip()) continue;
      std::vector<Position> both = motions.repaired->at(times[k]);
      const std::vector<Position> y = given.at(times[k]);
      both.insert(both.end(), y.begin(), y.end());
      packer.add(times[k], both);
    }
    std::string note =
        "The new motion is solid, the given one is transparent; between its frames vertices move on straight lines.";
    if (packer.stride() > 1) note += fmt::format(" One frame in {} is shown.", packer.stride());
    note += " Positions are rounded for the picture.";
    std::vector<double> ends;
    for (std::uint64_t step = 1; step <= count("steps"); ++step) ends.push_back(static_cast<double>(step));
    Mesh both = motions.mesh;
    append_mesh(both, motions.mesh);
    put_scene({static_cast<int>(count("dimension")), both, parts(vertices), "steps", 0, ends, note}, packer.pack(),
              report_);
    put_focus(vertices);
    report_.page["facts"].push_back(
        {"From", fmt::format("{}: what noli repair says; the frames that it read and wrote, with the same SHA-256",
                             page_name(path_))});
  }

  std::vector<ReportPart> parts(std::size_t vertices) const {
    std::vector<ReportPart> parts;
    for (const Json& body : result_.at("bodies")) {
      parts.push_back({body.at("name").get<std::string>(), body.at("first_vertex").get<std::uint64_t>(),
                       body.at("vertices").get<std::uint64_t>(), body.at("fixed").get<bool>()});
    }
    if (parts.empty()) {
      const std::uint64_t fixed = std::min<std::uint64_t>(count("fixed_first"), vertices);
      if (fixed > 0) parts.push_back({"fixed", 0, fixed, true});
      if (fixed < vertices) parts.push_back({"mesh", fixed, vertices - fixed, false});
    }
    parts.push_back({"as given", vertices, vertices, false, true});
    return parts;
  }

  /// The motion opens where most was changed.
  void put_focus(std::size_t vertices) {
    const Json most = most_changed();
    if (most.is_null()) return;
    const auto vertex = most.at("vertex").get<std::uint64_t>();
    report_.page["focus"] = {{"meets", false},
                             {"features", {{vertex}, {vertex + vertices}}},
                             {"time", most.at("step")},
                             {"name", "Moved most"},
                             {"words", words_of(most)}};
  }

  void put_result() {
    Json shown = result_;
    shown.erase("inputs");
    shown.erase("outputs");
    const std::string_view tone = name(tone_of(result_.at("verdict").get<std::string>()));
    report_.page["results"].push_back({{"name", page_name(path_)}, {"tone", tone}, {"result", std::move(shown)}});
  }

  const Json& result_;
  const fs::path& path_;
  const ReportLimits& limits_;
  ReportPage& report_;
};

}  // namespace

void report_repair(const Json& result, const fs::path& path, const ReportLimits& limits, ReportPage& report) {
  try {
    Repaired(result, path, limits, report).put();
  } catch (const Json::exception& error) {
    throw InputError(path.string(), "", fmt::format("is not a result of noli repair: {}", error.what()));
  }
}

}  // namespace noli::report
