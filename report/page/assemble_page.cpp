// SPDX-License-Identifier: Apache-2.0
#include "report/page/assemble_page.h"

#include <fmt/format.h>

#include <cstddef>
#include <string_view>
#include <utility>

#include <noli/errors.h>
#include "certify/json.h"
#include "certify/process/hdf5_frames.h"
#include "report/page/report_inputs.h"
#include "report/page/report_repair.h"
#include "report/page/report_results.h"
#include "report/page/report_verdict.h"
#include "trajectory/formats/frame_names.h"
#include "trajectory/formats/frames.h"
#include "trajectory/formats/open_frames.h"
#include "trajectory/text.h"

namespace noli::report {
namespace {

/// Neutral where a result has no verdict.
std::string_view tone_of_result(const Json& result) {
  const Json word = result.value("verdict", Json("report"));
  return name(tone_of(word.is_string() ? word.get_ref<const std::string&>() : ""));
}

/// No window was committed where there is no scene.
std::size_t windows_of_scene(const Json& scene) { return scene.is_null() ? 0 : scene["steps"]["list"].size(); }

/// A page that is being made, step by step.
class PageAssembly {
 public:
  /// Sorts the inputs by kind, reads the results and orders the frames.
  explicit PageAssembly(const PageRequest& request);

  /// The run among the inputs.
  const std::optional<std::filesystem::path>& run() const { return run_; }

  /// Reads the motion of the run, of the repair or of the frames.
  void show_motion();

  /// Adds the verdicts, the pictures, and the source of each part.
  AssembledPage finish();

 private:
  /// A result about the motion that is shown.
  struct ResultFile {
    std::filesystem::path path;
    Json json;
  };

  void sort_inputs();
  void read_result_file(const std::filesystem::path& path);
  void put_frames_in_order();
  void put_repair();
  void put_frames();
  FrameReading reading() const;
  void put_verdict_of_verify();
  void put_pictures();
  void put_other_words();
  void put_sources();
  bool has_title() const;
  void put_title();

  const PageRequest& request_;
  std::optional<std::filesystem::path> run_;
  std::vector<std::filesystem::path> frames_, results_, pictures_;
  std::optional<ResultFile> verified_, repaired_;
  ReportPage report_;
};

PageAssembly::PageAssembly(const PageRequest& request) : request_(request) {
  sort_inputs();
  report_.page = empty_page();
  for (const std::filesystem::path& path : results_) read_result_file(path);
  put_frames_in_order();
}

void PageAssembly::sort_inputs() {
  for (const std::filesystem::path& path : named_frames(request_.inputs)) {
    const std::string end = extension_of(path);
    if (std::filesystem::is_directory(path)) {
      if (run_) throw UsageError(path.string() + ": expected one run at most");
      run_ = path;
    } else if (end == ".json") {
      results_.push_back(path);
    } else if (end == ".svg") {
      pictures_.push_back(path);
    } else if (holds_frames(path)) {
      frames_.push_back(path);
    } else {
      const std::string advice = conversion_advice(path);
      throw UsageError(path.string() + ": expected the folder of a run, or a file .json, .svg, or of frames" +
                       (advice.empty() ? "" : "; " + advice));
    }
  }
  if (run_ && !frames_.empty()) throw UsageError("expected a run or frames, and not both");
}

void PageAssembly::read_result_file(const std::filesystem::path& path) {
  Json result = read_result(path);
  if (is_of_verify(result)) {
    if (verified_) throw UsageError(path.string() + ": expected at most one result of noli verify");
    verified_ = ResultFile{path, std::move(result)};
  } else if (is_of_repair(result)) {
    if (repaired_) throw UsageError(path.string() + ": expected at most one result of noli repair");
    repaired_ = ResultFile{path, std::move(result)};
  } else {
    report_.page["results"].push_back(
        {{"name", page_name(path)}, {"tone", tone_of_result(result)}, {"result", std::move(result)}});
  }
}

/// A result that was asked for with --order natural is shown so too.
void PageAssembly::put_frames_in_order() {
  FrameOrder order = request_.order;
  if (verified_ && order == FrameOrder::checked) {
    const Json how =
        as_written(verified_->path, [&] { return verified_->json.at("statement").value("order", Json()); });
    if (how.is_string() && how.get<std::string>().find("(--order natural)") != std::string::npos) {
      order = FrameOrder::natural;
    }
  }
  frames_ = order_frames(std::move(frames_), order).frames;
}

void PageAssembly::show_motion() {
  if (repaired_) put_repair();
  if (run_) report_run(*run_, request_.limits, report_);
  if (!frames_.empty()) put_frames();
}

void PageAssembly::put_repair() {
  const auto& [path, result] = *repaired_;
  if (verified_ || run_ || !frames_.empty()) {
    throw UsageError(path.string() + ": a page about a repair shows the frames that it names; expected no others");
  }
  report_repair(result, path, request_.limits, report_);
  if (!has_title()) report_.page["title"] = path.stem().string();
}

void PageAssembly::put_frames() {
  if (!verified_) throw UsageError("frames need their result: noli verify FRAMES --json RESULT.json");
  const VerifiedSteps steps = verified_steps(verified_->json, verified_->path);
  const auto frames = open_all_frames(frames_, reading());
  const std::size_t count = frames->count().value_or(0);
  if (steps.run || steps.count != count) {
    throw InputError(verified_->path.string(), "",
                     fmt::format("is about {} {}, but {} frames were given", steps.count,
                                 steps.run ? "windows of a run" : "frames", count));
  }
  const ResultInputs about(verified_->json.value("inputs", Json::array()), verified_->path);
  for (std::size_t k = 0; k < count; ++k) frames->look_at(k);
  about.require_files(frames->facts());
  report_frames(*frames, {steps.at_rest, steps.flat}, request_.limits, report_);
  about.require_files(frames->facts());  // pipes are known now
}

/// As the result says, unless told otherwise.
FrameReading PageAssembly::reading() const {
  FrameReading reading = as_written(verified_->path, [&] {
    return reading_of(verified_->json.value("inputs", Json::array()),
                      verified_->json.at("statement").value("bodies", Json::array()));
  });
  if (!request_.keys.empty()) reading.keys = request_.keys;
  return reading;
}

AssembledPage PageAssembly::finish() {
  if (verified_) put_verdict_of_verify();
  put_pictures();
  put_other_words();
  put_sources();
  put_title();
  const bool lacks_motion = verified_ && report_.page["scene"].is_null();
  return {std::move(report_), lacks_motion};
}

void PageAssembly::put_verdict_of_verify() {
  const auto& [path, json] = *verified_;
  if (run_) {
    const VerifiedSteps steps = verified_steps(json, path);
    const std::size_t windows = windows_of_scene(report_.page["scene"]);
    if (!steps.run || steps.count != windows) {
      throw InputError(path.string(), "",
                       fmt::format("is about {} {}, but the run has {} windows", steps.count,
                                   steps.run ? "windows" : "frames", windows));
    }
    ResultInputs(json.value("inputs", Json::array()), path).require_run(*run_);
  }
  put_verdict(json, path, report_);
  if (!has_title()) report_.page["title"] = path.stem().string();
}

void PageAssembly::put_pictures() {
  for (const std::filesystem::path& path : pictures_) {
    const std::string image = "data:image/svg+xml;base64," + base64(read_whole_file(path));
    report_.page["pictures"].push_back({{"name", page_name(path)}, {"image", image}});
  }
}

/// After those of the run and of verify: of equals the first is at the head.
void PageAssembly::put_other_words() {
  for (const Json& other : report_.page["results"]) {
    const Json& result = other["result"];
    if (is_of_repair(result)) continue;  // is at the head already
    if (!result.contains("verdict") || !result["verdict"].is_string()) continue;
    const auto word = result["verdict"].get<std::string>();
    take_word(word, report_);
    report_.page["verdict"]["lines"].push_back(
        fmt::format("{} says {}.", other["name"].get<std::string>(), spoken(word)));
  }
}

/// Which file each part comes from; tables and pictures have the names of theirs above them.
void PageAssembly::put_sources() {
  const auto add = [&](const char* what, const std::string& from) { report_.page["facts"].push_back({what, from}); };
  if (run_) add("From", fmt::format("the run {}: how it ended, motion, series", page_name(*run_)));
  if (!frames_.empty()) {
    const std::string first = page_name(frames_.front()), last = page_name(frames_.back());
    add("From", frames_.size() == 1
                    ? fmt::format("{}: the frame that is shown", first)
                    : fmt::format("{} to {}: the {} frames that are shown", first, last, frames_.size()));
  }
  if (verified_) {
    add("From", fmt::format("{}: what noli verify says, its statement and its contacts", page_name(verified_->path)));
  }
}

bool PageAssembly::has_title() const { return !report_.page.at("title").get_ref<const std::string&>().empty(); }

void PageAssembly::put_title() {
  if (request_.title) report_.page["title"] = *request_.title;
  if (!has_title()) report_.page["title"] = request_.inputs.front().stem().string();
}

}  // namespace

AssembledPage assemble_page(const PageRequest& request,
                            const std::function<void(const std::filesystem::path& run)>& begins,
                            const std::function<void()>& after_motion) {
  PageAssembly assembly(request);
  if (assembly.run()) begins(*assembly.run());
  assembly.show_motion();
  after_motion();
  return assembly.finish();
}

}  // namespace noli::report
