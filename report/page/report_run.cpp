// SPDX-License-Identifier: Apache-2.0
#include "report/page/report_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include "certify/json.h"
#include "certify/not_compared.h"
#include "certify/proofs/prove_run.h"
#include "certify/runs/frame_times.h"
#include "certify/runs/run_folder.h"
#include "certify/runs/run_log_facts.h"
#include "certify/runs/run_series_reader.h"
#include "report/page/report_plots.h"
#include "report/page/report_scene.h"
#include "report/page/report_verdict.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/formats/frame_sequence.h"
#include "trajectory/sample.h"
#include "trajectory/stop.h"

namespace noli::report {
namespace {

/// Of a window: more than that are a question of patience, and not of looking.
constexpr double most_samples = 1e6;

void stop_if_interrupted(const std::filesystem::path& what) {
  if (stop_asked()) throw ReadInterrupted(what.string());
}

// --- What ended a run ------------------------------------------------------------------------------------------------
// As its log tells it; a log that does not say it, or is damaged, gives no words.

std::string feature(const Json& vertices, const BodyNames& names) {
  const auto list = vertices.get<std::vector<VertexId>>();
  return list.empty() || list.size() > 3 ? "something" : names.feature(list);
}

std::string words_of(const Json& end, const BodyNames& names) {
  if (end.at("end") == "contact") {
    const Json& features = end.at("first").at("features");
    return fmt::format("{} meets {}, {}, at {} s", feature(features.at(0), names), feature(features.at(1), names),
                       end.at("first").at("kind").get<std::string>(), digits17(end.at("first_time").get<double>()));
  }
  if (end.at("end") == "unstable") {
    const Json& energy = end.at("energy");
    return fmt::format("from {:.3g} J to {:.3g} J at {} s", energy.at("begin").get<double>(),
                       energy.at("there").get<double>(), digits17(energy.at("time").get<double>()));
  }
  if (end.at("end") != "too_near") return "";
  const Json& near = end.at("too_near");
  return fmt::format("{}, at {} s", near.at("names").get<std::string>(), digits17(near.at("time").get<double>()));
}

/// Of the part that ended last: "edge a[1]-a[2] meets edge b[6]-b[7], crossing, at 0.25 s" or "vertex a[0] and vertex
/// b[1], at 0.25 s", of energy "from 1 J to 3 J at 0.25 s"; or nothing.
std::string what_ended(const LogFacts& log) {
  try {
    return words_of(log.last_end_line, log.names);
  } catch (const Json::exception&) {
    return "";
  }
}

/// The features that met and when, as a page's member `focus` (report_page.h); null unless a contact ended the run.
Json pair_that_ended(const LogFacts& log) {
  if (log.going_on || log.last_end != "contact") return nullptr;
  try {
    const Json& first = log.last_end_line.at("first");
    const auto features = first.at("features").get<std::array<std::vector<VertexId>, 2>>();
    for (const auto& feature : features) {
      if (feature.empty() || feature.size() > 3) return nullptr;
    }
    return {{"meets", true},
            {"features", features},
            {"time", log.last_end_line.at("first_time").get<double>()},
            {"words", "The run ends before this contact: " + words_of(log.last_end_line, log.names) + "."}};
  } catch (const Json::exception&) {
    return nullptr;
  }
}

// --- Its page --------------------------------------------------------------------------------------------------------

class Run {
 public:
  Run(const std::filesystem::path& path, const ReportLimits& limits)
      : path_(path),
        limits_(limits),
        log_(read_log(path)),
        reader_(open_run(path, log_)),
        packer_(reader_.mesh().vertex_count, limits.most_bytes) {}

  void put(ReportPage& report) {
    const auto windows = static_cast<double>(std::max<std::uint64_t>(reader_.look().windows, 1));
    while (const auto window = reader_.next_window()) {
      add(*window);
      if (limits_.progress) limits_.progress(std::min(1.0, static_cast<double>(ends_.size()) / windows));
      stop_if_interrupted(path_);
    }
    report.page["title"] = title_of(path_);
    // Without a window nothing was decided, however the run ended.
    const bool nothing = ends_.empty() && log_.last_end == "done";
    take_word(nothing ? "undecided" : word_of_end(log_.last_end, log_.going_on), report);
    add_lines(report.page["verdict"]["lines"]);
    if (log_.going_on) add_caveat("The run has not ended, or was killed.", report);
    if (reader_.open_window()) add_caveat("A window that was never committed follows; it is left out.", report);
    report.page["facts"] = facts();
    if (ends_.empty()) return;  // nothing moves
    if (!rows_.empty()) report.page["plots"] = report_plots(rows_);
    report.page["focus"] = focus();
    PackedFrames frames = packer_.pack();  // before scene(), which tells how many frames are left
    put_scene(scene(), std::move(frames), report);
  }

 private:
  bool full() const { return reader_.header().record == RecordMode::full; }

  void add(const RunWindow& window) {
    breakpoints_ += window.breakpoints;
    if (!window.state.empty()) rows_.push_back(reader_.row());
    ends_.push_back(window.end);
    if (window.index == 0) begin_ = window.begin;
    for (const RunFrame& frame : window.frames) {
      if (!packer_.skip()) packer_.add(frame.time, frame.positions);
    }
    if (window.lines) add_samples(window);
  }

  void add_samples(const RunWindow& window) {
    const double rate = std::min(limits_.fps, most_samples / reader_.header().window_length);
    for_each_frame_time(window.index, window.begin, window.end, rate, [&](double t) {
      if (!packer_.skip()) packer_.add(t, sample(*window.lines, t));
      return !stop_asked();
    });
  }

  void add_lines(Json& lines) const {
    lines.push_back(ends_.empty() ? "No window was committed: nothing is claimed." : claim());
    if (const std::string end = end_line(); !end.empty()) lines.push_back(end);
    if (ends_.empty()) return;
    lines.push_back(full() ? "The motion is recorded whole: noli verify decides it again" + proof_clause()
                           : "The run recorded frames and the hash of its motion: noli verify --reproduce integrates "
                             "and decides it again.");
  }

  std::string proof_clause() const {
    return std::filesystem::exists(proof_path(path_)) ? ", noli check checks its proof." : ".";
  }

  std::string claim() const {
    const std::string where =
        fmt::format("in the {} windows of this run, from {} s to {} s", ends_.size(), begin_, ends_.back());
    const NotCompared left_out =
        not_compared(reader_.mesh(), reader_.scene().labels, reader_.scene().exclusions, log_.names);
    return nothing_touches(left_out, where) + " Each window was decided in exact arithmetic before it was written.";
  }

  /// Why the window after the last is not in the run, as its log has it.
  std::string end_line() const {
    const std::string what = what_ended(log_);
    const std::string named = what.empty() ? "" : ": " + on_one_line(what);
    const std::string in_it = ends_.empty() ? "In the first window " : "In the window after them ";
    if (log_.last_end == "contact") return in_it + "something touches, so it is not in the run" + named + ".";
    if (log_.last_end == "too_near") {
      return in_it + "a pair comes nearer than the scene's layers of contact allow" + named + ".";
    }
    if (log_.last_end == "unstable") return "The energy drifts" + named + ". Steps are too long, or resonate.";
    if (log_.last_end != "not_finite") return "";
    return in_it + "a velocity or position is not finite. That window is not in the run.";
  }

  Json facts() const {
    std::uint64_t events = 0;
    for (const SeriesRow& row : rows_) events += row.events_in_all();
    const Mesh& mesh = reader_.mesh();
    Json facts = Json::array();
    const auto add = [&](const std::string& name, const std::string& text) { facts.push_back({name, text}); };
    add("Mesh", fmt::format("{} vertices, {} faces, {} loose edges, {} loose points", mesh.vertex_count,
                            mesh.faces.size(), mesh.edges.size(), mesh.points.size()));
    add("Windows", ends_.empty() ? "none" : fmt::format("{}, up to {} s", ends_.size(), ends_.back()));
    if (!rows_.empty()) add("Events", fmt::format("{}", events));
    add("Breakpoints", fmt::format("{}", breakpoints_));
    add("Ended", log_.end().empty() ? "its log does not say how" : log_.end());
    if (!log_.roll_backs.empty()) add("Windows that were run again", fmt::format("{}", log_.roll_backs.size()));
    if (const ActingLayer nearest = nearest_layer(); nearest.layer > 0) {
      const std::string pair = log_.names.pair(nearest.pair, nearest.vertices, "and");
      add("Nearest at an impulse",
          fmt::format("{}: {} m, at {} s", pair, digits17(nearest.distance), digits17(nearest.time)));
    }
    return facts;
  }

  ActingLayer nearest_layer() const {
    ActingLayer nearest;
    for (const SeriesRow& row : rows_) {
      if (row.nearest.layer == 0) continue;
      if (nearest.layer == 0 || row.nearest.distance < nearest.distance) nearest = row.nearest;
    }
    return nearest;
  }

  /// The pair that the motion opens with: the one that ended the run, else the nearest at an impulse of contact.
  Json focus() const {
    if (const Json pair = pair_that_ended(log_); !pair.is_null()) return pair;
    const ActingLayer nearest = nearest_layer();
    if (nearest.layer == 0) return nullptr;
    const auto first = nearest.vertices.begin();
    const auto between = first + static_cast<std::ptrdiff_t>(first_size(nearest.pair));
    const auto end = first + static_cast<std::ptrdiff_t>(point_count(nearest.pair));
    return {
        {"meets", false},
        {"features", {std::vector<VertexId>(first, between), std::vector<VertexId>(between, end)}},
        {"time", nearest.time},
        {"words", fmt::format("Nearest at an impulse of contact: {}, {:.4g} m apart, at {:.6g} s.",
                              log_.names.pair(nearest.pair, nearest.vertices, "and"), nearest.distance, nearest.time)}};
  }

  ReportScene scene() const {
    std::string note = full() ? fmt::format("Frames are samples of the motion, at most {} a second.", limits_.fps)
                              : "Frames are those that the run recorded.";
    if (packer_.stride() > 1) note += fmt::format(" One in {} is shown.", packer_.stride());
    note += " Straight lines between them are not the motion that was verified; positions are rounded for the picture.";
    return {static_cast<int>(reader_.header().dimension), reader_.mesh(), parts(), "s", begin_, ends_, note};
  }

  std::vector<ReportPart> parts() const {
    std::vector<ReportPart> parts;
    const std::vector<std::uint8_t>& labels = reader_.scene().labels;
    for (const auto& body : log_.names.bodies()) {
      if (body.first > labels.size() || body.vertices > labels.size() - body.first) continue;  // no body of this mesh
      const auto begin = labels.begin() + static_cast<std::ptrdiff_t>(body.first);
      const bool fixed = std::all_of(begin, begin + static_cast<std::ptrdiff_t>(body.vertices),
                                     [](std::uint8_t label) { return label == scripted_vertex; });
      parts.push_back({body.name, body.first, body.vertices, fixed});
    }
    if (parts.empty()) parts.push_back({"mesh", 0, reader_.mesh().vertex_count, false});
    return parts;
  }

  const std::filesystem::path& path_;
  const ReportLimits& limits_;
  LogFacts log_;
  SeriesReader reader_;
  MotionPacker packer_;
  std::vector<SeriesRow> rows_;  ///< none of a repair
  std::vector<double> ends_;
  double begin_ = 0;
  std::uint64_t breakpoints_ = 0;
};

}  // namespace

void report_run(const std::filesystem::path& run, const ReportLimits& limits, ReportPage& report) {
  Run(run, limits).put(report);
}

void report_frames(FrameSource& frames, const ReportedFrames& how, const ReportLimits& limits, ReportPage& report) {
  const bool at_rest = how.at_rest;
  FrameSequence sequence(frames, Motion::constant);
  if (!sequence.next()) throw InputError("frames", "", "there are none");
  const Mesh mesh = sequence.mesh();
  MotionPacker packer(mesh.vertex_count, limits.most_bytes);
  std::vector<double> ends;
  do {
    stop_if_interrupted(sequence.name_t0());
    const auto k = static_cast<double>(sequence.step());
    if (!packer.skip()) packer.add(k, sequence.x_t0());
    if (at_rest || k > 0) ends.push_back(k + (at_rest ? 0.5 : 0));
  } while (sequence.next());
  PackedFrames packed = packer.pack();
  std::string note = at_rest ? "Each frame was decided by itself, at rest."
                             : "Between these frames every vertex moves on a straight line: that motion was decided.";
  if (packer.stride() > 1) note += fmt::format(" One frame in {} is shown.", packer.stride());
  note += " Positions are rounded for the picture.";
  const bool flat = how.flat || packed.least[2] == packed.greatest[2];
  put_scene({flat ? 2 : 3,
             mesh,
             {{"mesh", 0, mesh.vertex_count, false}},
             at_rest ? "(frame)" : "steps",
             at_rest ? -0.5 : 0,
             ends,
             note},
            std::move(packed), report);
}

}  // namespace noli::report
