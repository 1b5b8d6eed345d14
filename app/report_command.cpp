// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <noli/errors.h>
#include "app/commands.h"
#include "app/notes.h"
#include "app/options.h"
#include "app/output.h"
#include "app/output_files.h"
#include "app/progress.h"
#include "certify/process/hdf5_frames.h"
#include "certify/runs/run_folder.h"
#include "report/page/report_inputs.h"
#include "report/page/report_page.h"
#include "report/page/report_repair.h"
#include "report/page/report_results.h"
#include "report/page/report_run.h"
#include "report/page/report_verdict.h"
#include "trajectory/formats/frame_names.h"
#include "trajectory/formats/frames.h"
#include "trajectory/formats/open_frames.h"
#include "trajectory/text.h"
#include "trajectory/write_file.h"

namespace noli::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* report_footer =
    "Writes one self-contained page for any browser, also without a network: verdict, motion and contacts, statement, "
    "energies, steps and gaps over time, tables of audits, pictures. It decides nothing again.\n"
    "\n"
    "Inputs come in any order: one run; results that noli wrote with --json; the frames that a result of "
    "`noli verify` is about; pictures (.svg). A result of `noli repair` brings its frames, given and repaired.\n"
    "Examples:\n"
    "  noli verify a.ply b.ply --json ab.json; noli report ab.json a.ply b.ply -o ab.html\n"
    "  noli report runs/cloth -o cloth.html --open\n"
    "  noli verify runs/cloth --json cloth.json; noli report runs/cloth cloth.json -o cloth.html\n"
    "  noli report mended.json -o mended.html    both motions of noli repair --json mended.json\n"
    "  noli report audit.json audit.svg -o audit.html\n";

constexpr double most_rate = 1000;  ///< frames a second

struct ReportArguments {
  std::vector<fs::path> inputs;
  fs::path output;
  report::ReportLimits limits;
  bool force = false;
  bool open = false;  ///< in a browser, once it is written
  FrameOrder order = FrameOrder::checked;
  FrameReading reading;
  std::optional<std::string> title;
  std::string time_limit;
};

/// What was given, by kind.
struct Inputs {
  std::optional<fs::path> run;
  std::vector<fs::path> frames, results, pictures;
};

Inputs sorted(const std::vector<fs::path>& paths) {
  Inputs inputs;
  for (const fs::path& path : named_frames(paths)) {
    const std::string end = extension_of(path);
    if (fs::is_directory(path)) {
      if (inputs.run) throw UsageError(path.string() + ": expected one run at most");
      inputs.run = path;
    } else if (end == ".json") {
      inputs.results.push_back(path);
    } else if (end == ".svg") {
      inputs.pictures.push_back(path);
    } else if (holds_frames(path)) {
      inputs.frames.push_back(path);
    } else {
      const std::string advice = conversion_advice(path);
      throw UsageError(path.string() + ": expected the folder of a run, or a file .json, .svg, or of frames" +
                       (advice.empty() ? "" : "; " + advice));
    }
  }
  if (inputs.run && !inputs.frames.empty()) throw UsageError("expected a run or frames, and not both");
  return inputs;
}

/// A result about the motion that is shown.
struct ResultFile {
  fs::path path;
  Json json;
};

class Report {
 public:
  explicit Report(const ReportArguments& arguments) : arguments_(arguments), inputs_(sorted(arguments.inputs)) {
    report_.page = report::empty_page();
  }

  /// Whether it has a verdict about frames or a run without these.
  bool lacks_motion() const { return verified_ && report_.page["scene"].is_null(); }

  const report::ReportPage& operator()() {
    read_results();
    put_frames_in_order();
    if (inputs_.run) note_if_being_written(*inputs_.run);
    if (repaired_) put_repair();
    if (inputs_.run) put_run();
    if (!inputs_.frames.empty()) put_frames();
    if (verified_) put_verdict_of_verify();
    for (const fs::path& path : inputs_.pictures) {
      const std::string image = "data:image/svg+xml;base64," + base64(read_whole_file(path));
      report_.page["pictures"].push_back({{"name", report::page_name(path)}, {"image", image}});
    }
    put_other_words();
    put_sources();
    put_title();
    return report_;
  }

 private:
  void read_results() {
    for (const fs::path& path : inputs_.results) {
      Json result = report::read_result(path);
      if (report::is_of_verify(result)) {
        if (verified_) throw UsageError(path.string() + ": expected at most one result of noli verify");
        verified_ = ResultFile{path, std::move(result)};
        continue;
      }
      if (report::is_of_repair(result)) {
        if (repaired_) throw UsageError(path.string() + ": expected at most one result of noli repair");
        repaired_ = ResultFile{path, std::move(result)};
        continue;
      }
      report_.page["results"].push_back(
          {{"name", report::page_name(path)}, {"tone", tone_of(result)}, {"result", std::move(result)}});
    }
  }

  /// Neutral where a result has no verdict.
  static std::string_view tone_of(const Json& result) {
    const Json word = result.value("verdict", Json("report"));
    return report::name(report::tone_of(word.is_string() ? word.get_ref<const std::string&>() : ""));
  }

  /// A result that was asked for with --order natural is shown so too.
  void put_frames_in_order() {
    FrameOrder order = arguments_.order;
    if (verified_ && order == FrameOrder::checked) {
      const Json how = verified_->json.at("statement").value("order", Json());
      if (how.is_string() && how.get<std::string>().find("(--order natural)") != std::string::npos) {
        order = FrameOrder::natural;
      }
    }
    inputs_.frames = order_frames(std::move(inputs_.frames), order).frames;
  }

  /// After those of the run and of verify: of equals the first is at the head.
  void put_other_words() {
    for (const Json& other : report_.page["results"]) {
      const Json& result = other["result"];
      if (report::is_of_repair(result)) continue;  // is at the head already
      if (!result.contains("verdict") || !result["verdict"].is_string()) continue;
      const auto word = result["verdict"].get<std::string>();
      report::take_word(word, report_);
      report_.page["verdict"]["lines"].push_back(
          fmt::format("{} says {}.", other["name"].get<std::string>(), report::spoken(word)));
    }
  }

  /// Which file each part comes from; tables and pictures have the names of theirs above them.
  void put_sources() {
    const auto add = [&](const char* what, const std::string& from) { report_.page["facts"].push_back({what, from}); };
    if (inputs_.run)
      add("From", fmt::format("the run {}: how it ended, motion, series", report::page_name(*inputs_.run)));
    if (!inputs_.frames.empty()) {
      const std::string first = report::page_name(inputs_.frames.front()),
                        last = report::page_name(inputs_.frames.back());
      add("From", inputs_.frames.size() == 1
                      ? fmt::format("{}: the frame that is shown", first)
                      : fmt::format("{} to {}: the {} frames that are shown", first, last, inputs_.frames.size()));
    }
    if (verified_) {
      add("From",
          fmt::format("{}: what noli verify says, its statement and its contacts", report::page_name(verified_->path)));
    }
  }

  void put_run() {
    ProgressBars bars;
    report::ReportLimits limits = arguments_.limits;
    limits.progress = [&](double share) { bars.show("report", share); };
    report_run(*inputs_.run, limits, report_);
  }

  void put_repair() {
    const auto& [path, result] = *repaired_;
    if (verified_ || inputs_.run || !inputs_.frames.empty()) {
      throw UsageError(path.string() + ": a page about a repair shows the frames that it names; expected no others");
    }
    ProgressBars bars;
    report::ReportLimits limits = arguments_.limits;
    limits.progress = [&](double share) { bars.show("report", share); };
    report::report_repair(result, path, limits, report_);
    if (!has_title()) report_.page["title"] = path.stem().string();
  }

  void put_frames() {
    if (!verified_) throw UsageError("frames need their result: noli verify FRAMES --json RESULT.json");
    const report::VerifiedSteps steps = report::verified_steps(verified_->json, verified_->path);
    const auto frames = open_all_frames(inputs_.frames, reading());
    const std::size_t count = frames->count().value_or(0);
    if (steps.run || steps.count != count) {
      throw InputError(verified_->path.string(), "",
                       fmt::format("is about {} {}, but {} frames were given", steps.count,
                                   steps.run ? "windows of a run" : "frames", count));
    }
    const report::ResultInputs about(verified_->json.value("inputs", Json::array()), verified_->path);
    for (std::size_t k = 0; k < count; ++k) frames->look_at(k);
    about.require_files(frames->facts());
    report::report_frames(*frames, {steps.at_rest, steps.flat}, arguments_.limits, report_);
    about.require_files(frames->facts());  // pipes are known now
  }

  /// As the result says, unless told otherwise.
  FrameReading reading() const {
    try {
      FrameReading reading = report::reading_of(verified_->json.value("inputs", Json::array()),
                                                verified_->json.at("statement").value("bodies", Json::array()));
      if (!arguments_.reading.keys.empty()) reading.keys = arguments_.reading.keys;
      return reading;
    } catch (const Json::exception&) {
      throw InputError(verified_->path.string(), "", "is not a result of `noli verify --json`");
    }
  }

  void put_verdict_of_verify() {
    const auto& [path, json] = *verified_;
    if (inputs_.run) {
      const report::VerifiedSteps steps = report::verified_steps(json, path);
      const std::size_t windows = report_.page["scene"]["steps"]["list"].size();
      if (!steps.run || steps.count != windows) {
        throw InputError(path.string(), "",
                         fmt::format("is about {} {}, but the run has {} windows", steps.count,
                                     steps.run ? "windows" : "frames", windows));
      }
      report::ResultInputs(json.value("inputs", Json::array()), path).require_run(*inputs_.run);
    }
    report::put_verdict(json, path, report_);
    if (!has_title()) report_.page["title"] = path.stem().string();
  }

  bool has_title() const { return !report_.page.at("title").get_ref<const std::string&>().empty(); }

  void put_title() {
    if (arguments_.title) report_.page["title"] = *arguments_.title;
    if (!has_title()) report_.page["title"] = arguments_.inputs.front().stem().string();
  }

  const ReportArguments& arguments_;
  Inputs inputs_;
  std::optional<ResultFile> verified_, repaired_;
  report::ReportPage report_;
};

CLI::Validator is_rate() {
  return CLI::Validator(
      [](const std::string& text) {
        const double rate = std::strtod(text.c_str(), nullptr);  // is_positive() has seen that it is a number
        return rate <= most_rate ? "" : fmt::format("{}: expected at most {}", text, most_rate);
      },
      "");
}

/// By the program that the desktop, or $BROWSER, has for it. A machine without one gets a note.
void open_in_browser(const fs::path& page) {
  const char* const chosen = std::getenv("BROWSER");
  const std::string browser = chosen != nullptr && *chosen != '\0' ? chosen : "xdg-open";
  const std::string path = fs::absolute(page).string();
  std::vector<char*> words = {const_cast<char*>(browser.c_str()), const_cast<char*>(path.c_str()), nullptr};
  pid_t child = 0;
  if (::posix_spawnp(&child, browser.c_str(), nullptr, nullptr, words.data(), environ) != 0) {
    tell_note(fmt::format("{} cannot be started; open {} in a browser", browser, path));
  }
}

ExitCode run(const ReportArguments& arguments) {
  begin_work(arguments.time_limit);
  if (!report::has_report_page())
    throw UsageError("this noli was built without reports; build it with NOLI_WITH_REPORT=ON");
  require_output_files({{"-o", arguments.output, true}}, arguments.inputs, arguments.force);
  Report report(arguments);
  const report::ReportPage& page = report();
  const std::string html = report::report_html(page);
  replace_file(arguments.output, html);
  const Json& scene = page.page["scene"];
  if (arguments.open) open_in_browser(arguments.output);
  report::Answer answer("written");
  answer.place = fmt::format("{}  {} frames, {} bytes", on_one_line(arguments.output.string()),
                             scene.is_null() ? 0 : scene["frames"].get<std::uint64_t>(), html.size());
  if (report.lacks_motion()) answer.next = "name the frames or the run with the result, and the page shows the motion.";
  write_words(answer);
  return ExitCode::holds;
}

}  // namespace

Command add_report(CLI::App& app) {
  CLI::App* const command =
      app.add_subcommand("report", "Write a page about a run, a verdict or an audit, for a browser");
  command->footer(report_footer);
  const auto arguments = std::make_shared<ReportArguments>();
  command->add_option("inputs", arguments->inputs, "A run; results (--json); frames; pictures")
      ->required()
      ->type_name("RUN | RESULT.json");
  command->add_option("-o,--output", arguments->output, "The page")->required()->type_name("OUT.html");
  command->add_option("--title", arguments->title, "Its heading")->type_name("TEXT");
  add_order_option(*command, arguments->order);
  add_keys_option(*command, arguments->reading.keys);
  command->add_option("--fps", arguments->limits.fps, "At most this many frames per simulated second")
      ->check(is_positive())
      ->check(is_rate())
      ->capture_default_str();
  command->add_flag("--open", arguments->open, "Open the page in a browser");
  command->add_flag("--force", arguments->force, "Replace an existing page");
  add_time_limit_option(*command, arguments->time_limit, "Stop after this time, without a page: 500ms, 60s, 5m, 1h");
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
