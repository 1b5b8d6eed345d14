// SPDX-License-Identifier: Apache-2.0
#include <noli/repair.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include "certify/process/hdf5_frames.h"
#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/bindings.h"
#include "python/src/frames.h"
#include "python/src/options.h"
#include "python/src/pages.h"
#include "report/documents.h"
#include "report/figures/repair_picture.h"
#include "report/page/report_repair.h"
#include "report/repair_report.h"
#include "trajectory/blocks/frames_file.h"
#include "trajectory/formats/frame_look.h"
#include "trajectory/formats/frame_names.h"
#include "trajectory/formats/frame_sequence.h"

namespace noli::python {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

void put_options(const py::dict& options, RepairRequest& request) {
  put(options, "dimension", request.dimension);
  put(options, "threads", request.threads);
  put(options, "points", request.points);
  put(options, "only_new", request.only_new);
  put(options, "fixed", request.fixed_listed);
  put(options, "fixed_bodies", request.fixed_bodies);
  put(options, "ignore", request.ignore);
  put(options, "thickness", request.thickness);
  put(options, "masses", request.masses);
  put(options, "restitution", request.restitution);
  put(options, "friction", request.friction);
  put(options, "spread", request.spread);
  put(options, "run", request.run);
  put(options, "proof", request.proof);
  put(options, "check", request.check);
  put(options, "force", request.force);
  put(options, "resume", request.resume);
  request.deadline = deadline_of(options);
}

/// Frames in memory go through a block file, which keeps every bit. `kept`: what is written stays for report().
class Repair {
 public:
  Repair(const py::object& frames, const py::object& mesh, std::string pattern, const py::dict& options, bool kept,
         const py::object& progress) {
    put_options(options, request_);
    request_.pattern = std::move(pattern);
    std::shared_ptr<const IgnoredGroups> ignored;
    if (py::hasattr(frames, "vertices")) {
      given_.emplace(frames);
      ignored = ignored_groups_of(mesh, given_->given()->mesh.vertex_count, false);
      if (ignored) request_.ignore = ignored->file;
    } else {
      request_.order = order_of(options);
      std::vector<std::string> notes;
      request_.reading.bodies = bodies_in_files(options, notes);
      request_.frames = request_.reading.bodies.empty() ? named_frames(frames.cast<std::vector<fs::path>>())
                                                        : files_of(request_.reading.bodies);
    }
    in_background([&](Background& background) {
      const ScratchFolder folder;
      if (given_) {
        given_->call_through(&background);
        request_.frames = {write_given_frames(folder)};
      }
      request_.stop = background.stop();
      request_.progress = progress_to(progress, background);
      outcome_ = run_repair(request_);
      for (FrameFacts& facts : outcome_.inputs) {
        if (given_) facts.file = "frames";
      }
    });
    request_.stop = nullptr;
    request_.progress = {};
    if (!kept) given_.reset();
  }

  std::string json() const { return to_text(report::document("repair", report::repair_json(request_, outcome_))); }
  std::string text() const { return text_of(report::repair_answer(request_, outcome_)); }

  /// A page with both motions, as `noli report` makes it of a result with the name `title`. All frames have to be as
  /// they were.
  void report(const fs::path& file, const std::string& title) {
    with_result([&](const Json& result) {
      write_page(file, title, [&](report::ReportPage& page) { report::report_repair(result, title, {}, page); });
    });
  }

  /// A picture of the repaired motion, or of the given one, at a time in steps.
  void picture(const fs::path& file, double time, bool given, const py::dict& options) {
    report::RepairPictureRequest request;
    request.time = time;
    request.given = given;
    request.view = picture_view(options);
    request.output = file;
    with_result([&](const Json& result) {
      const ScratchFolder folder;
      request.result = folder.path() / "result.json";
      replace_file(request.result, to_text(result));
      report::repair_picture(request);
    });
  }

 private:
  /// Calls `use` with the result, which names files: frames in memory are one for as long as it works.
  void with_result(const std::function<void(const Json&)>& use) {
    const auto alone = one_at_a_time_.enter();
    in_background([&](Background& background) {
      const ScratchFolder folder;
      Json result = Json::parse(json());
      if (given_) {
        given_->read_again_through(&background);
        const fs::path frames_file = write_given_frames(folder);
        if (file_facts(frames_file).sha256 != outcome_.inputs.at(0).sha256) {
          throw InputError("frames", "", "have changed since they were repaired; expected the frames of this result");
        }
        result["inputs"][0]["file"] = frames_file.string();
      }
      use(result);
    });
  }

  /// Frames in memory as a file, for as long as the folder is there.
  fs::path write_given_frames(const ScratchFolder& folder) const {
    fs::path file = folder.path() / "frames.blocks";
    FrameReading reading;
    reading.given = given_->given();
    const auto source = open_all_frames({"frames"}, reading);
    std::optional<FramesWriter> writer;
    FrameSequence sequence(*source, Motion::constant);
    while (sequence.next()) {
      if (!writer) {
        writer.emplace(std::make_unique<FileSink>(file, FileSink::Open::create), sequence.mesh());
      }
      writer->append(sequence.x_t0());
    }
    if (writer) writer->finish();
    return file;
  }

  OneAtATime one_at_a_time_;
  RepairRequest request_;
  RepairOutcome outcome_;
  std::optional<Frames> given_;
};

/// (positions of each frame, faces, edges, points) of frames in files.
py::tuple read_frames(const std::vector<fs::path>& names) {
  std::vector<std::vector<Position>> frames;
  Mesh mesh;
  in_background([&](Background& background) {
    const OrderedFrames ordered = order_frames(named_frames(names));
    const auto source = open_all_frames(ordered.frames);
    FrameSequence sequence(*source, Motion::constant);
    while (!background.stop()->load() && sequence.next()) {
      frames.emplace_back(sequence.x_t0().begin(), sequence.x_t0().end());
    }
    mesh = sequence.mesh();
  });
  py::list positions;
  for (const auto& frame : frames) positions.append(array_of(frame));
  return py::make_tuple(positions, rows_of_cells(mesh.faces), rows_of_cells(mesh.edges),
                        array_of(std::vector<std::int64_t>(mesh.points.begin(), mesh.points.end())));
}

}  // namespace

void bind_repair(py::module_& core) {
  py::class_<Repair>(core, "Repair")
      .def(py::init<const py::object&, const py::object&, std::string, const py::dict&, bool, const py::object&>())
      .def("json", &Repair::json)
      .def("report", &Repair::report)
      .def("picture", &Repair::picture)
      .def("text", &Repair::text);
  core.def("read_frames", &read_frames);
}

}  // namespace noli::python
