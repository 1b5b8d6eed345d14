// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <unistd.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include <noli/export.h>
#include "certify/run_explanation.h"
#include "certify/runs/run_folder.h"
#include "certify/runs/run_log_facts.h"
#include "certify/runs/run_series_reader.h"
#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/bindings.h"
#include "python/src/options.h"
#include "python/src/pages.h"
#include "python/src/series.h"
#include "report/documents.h"
#include "report/figures/run_picture.h"
#include "report/page/report_run.h"
#include "report/run_explanation_report.h"
#include "trajectory/sample.h"
#include "trajectory/stop.h"

namespace noli::python {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

SeriesReader opened(const fs::path& run) {
  const py::gil_scoped_release unlocked;
  return open_run(run);
}

/// What does not change from window to window, as it is read.
struct RunFacts {
  explicit RunFacts(const fs::path& run)
      : log(read_log(run)), reader(open_run(run, log)), look(reader.look()), title(title_of(run)) {}
  LogFacts log;
  SeriesReader reader;
  RunLook look;
  std::string title;
};

/// The windows of a run, one after another.
class RunWindows {
 public:
  explicit RunWindows(const fs::path& run) : reader_(opened(run)) {}

  /// A dict, or None behind the last. Not in the child of a fork, which shares the place in the file with its parent.
  py::object next() {
    if (process_ != ::getpid()) throw UsageError("the run was opened before a fork; open it again in this process");
    const auto alone = one_at_a_time_.enter();
    std::optional<RunWindow> window;
    in_background([&](Background&) { window = reader_.next_window(); });
    if (!window) return py::none();
    return window_of(*window, row());
  }

 private:
  const SeriesRow* row() const {
    try {
      return &reader_.row();
    } catch (const InputError&) {
      return nullptr;
    }
  }

  OneAtATime one_at_a_time_;
  SeriesReader reader_;
  int process_ = ::getpid();
};

py::dict run_facts_of(const fs::path& run) {
  std::optional<RunFacts> found;
  in_background([&](Background&) { found.emplace(run); });
  const SeriesReader& reader = found->reader;
  const Mesh& mesh = reader.mesh();
  py::dict facts;
  facts["title"] = found->title;
  facts["dimension"] = reader.header().dimension;
  facts["record"] = reader.header().record == RecordMode::full ? "full" : "frames";
  facts["window"] = reader.header().window_length;
  facts["windows"] = found->look.windows;
  facts["end"] = found->look.end;
  facts["vertices"] = mesh.vertex_count;
  facts["faces"] = rows_of_cells(mesh.faces);
  facts["edges"] = rows_of_cells(mesh.edges);
  facts["points"] = array_of(std::vector<std::int64_t>(mesh.points.begin(), mesh.points.end()));
  py::list bodies;
  for (const auto& body : found->log.names.bodies()) {
    bodies.append(py::make_tuple(body.name, body.first, body.vertices));
  }
  facts["bodies"] = bodies;
  return facts;
}

/// (times, vertices, 3): the positions at each of these times, which ascend.
py::array_t<double> positions_of_run(const fs::path& run, const std::vector<double>& times) {
  SeriesReader reader = opened(run);
  if (reader.header().record != RecordMode::full) {
    throw InputError(run.string(), "",
                     "recorded only frames; expected a run with record \"full\" (its windows have the frames)");
  }
  const std::size_t vertices = reader.mesh().vertex_count;
  py::array_t<double> all({times.size(), vertices, std::size_t{3}});
  double* place = all.mutable_data();
  in_background([&](Background&) {
    std::size_t next = 0;
    double begin = 0, end = 0;
    for (bool first = true; next < times.size(); first = false) {
      const std::optional<RunWindow> window = reader.next_window();
      if (!window) break;
      if (first) begin = window->begin;
      end = window->end;
      for (; next < times.size() && times[next] <= window->end; ++next) {
        if (times[next] < begin) break;
        end_if_stopped();
        const std::vector<Position> x = sample(*window->lines, times[next]);
        for (const Position& p : x) place = std::copy(p.begin(), p.end(), place);
      }
    }
    if (next == times.size()) return;
    throw InputError(run.string(), "",
                     fmt::format("has the times from {} s to {} s; found {} s", begin, end, times[next]));
  });
  return all;
}

/// How many frames were written.
std::uint64_t export_run(const fs::path& run, const std::string& pattern, double fps, bool force,
                         const py::dict& options, const py::object& progress) {
  const report::PictureView view = picture_view(options);
  ExportOutcome outcome;
  in_background([&](Background& background) {
    ExportRequest request;
    request.run = run;
    request.pattern = pattern;
    request.fps = fps;
    request.force = force;
    const auto tell = progress_to(progress, background);
    if (tell) request.progress = [&](double share) { tell("export", share); };
    outcome = pattern.ends_with(".png") ? report::run_film({request, view}) : run_export(request);
  });
  return outcome.frames;
}

/// Width and height.
py::tuple picture_of_run(const fs::path& run, double time, const fs::path& file, const py::dict& options) {
  report::PictureRequest request;
  request.run = run;
  request.time = time;
  request.output = file;
  request.view = picture_view(options);
  report::PictureOutcome outcome;
  in_background([&](Background&) { outcome = report::run_picture(request); });
  return py::make_tuple(outcome.width, outcome.height);
}

std::string explanation_of_run(const fs::path& run) {
  std::string text;
  in_background(
      [&](Background&) { text = to_text(report::document("explain-run", report::to_json(explain_run(run)))); });
  return text;
}

void page_of_run(const fs::path& run, const fs::path& file, const std::optional<std::string>& title) {
  in_background([&](Background&) {
    write_page(file, title.value_or(title_of(run)),
               [&](report::ReportPage& page) { report::report_run(run, {}, page); });
  });
}

}  // namespace

void bind_run(py::module_& core) {
  py::class_<RunWindows>(core, "RunWindows").def(py::init<const fs::path&>()).def("next", &RunWindows::next);
  core.def("run_facts", &run_facts_of);
  core.def("run_positions", &positions_of_run);
  core.def("export_run", &export_run);
  core.def("run_picture", &picture_of_run);
  core.def("explain_run", &explanation_of_run);
  core.def("run_page", &page_of_run);
}

}  // namespace noli::python
