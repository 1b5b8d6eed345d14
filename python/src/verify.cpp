// SPDX-License-Identifier: Apache-2.0
#include <noli/verify.h>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include "certify/process/hdf5_frames.h"
#include "certify/proofs/claim.h"
#include "certify/proofs/proof_route.h"
#include "certify/verify_work.h"
#include "python/src/arrays.h"
#include "python/src/background.h"
#include "python/src/bindings.h"
#include "python/src/frames.h"
#include "python/src/options.h"
#include "python/src/pages.h"
#include "report/documents.h"
#include "report/figures/contact_export.h"
#include "report/page/report_page.h"
#include "report/page/report_results.h"
#include "report/page/report_run.h"
#include "report/verify_report.h"
#include "trajectory/formats/frame_names.h"

namespace noli::python {
namespace {

namespace py = pybind11;

void put_options(const py::dict& options, VerifyRequest& request) {
  put(options, "dimension", request.dimension);
  put(options, "threads", request.threads);
  put(options, "max_reports", request.max_reports);
  put(options, "keep_going", request.keep_going);
  put(options, "first_only", request.first_only);
  put(options, "strict", request.strict);
  put(options, "points", request.points);
  put(options, "at_rest", request.constant_motion);
  put(options, "merge_identical", request.merge_identical);
  put(options, "ignore", request.ignore);
  put(options, "only_new", request.only_new);
  put(options, "min_distance", request.min_distance);
  put(options, "ring", request.ring);
  put(options, "reproduce", request.reproduce);
  put(options, "scene_folder", request.scene_folder);
  put(options, "proof", request.proof);
  put(options, "check", request.check);
  put(options, "keys", request.reading.keys);
  if (options.contains("refuse_polygons")) request.reading.polygons = PolygonRule::refuse;
  request.order = order_of(options);
  request.reading.bodies = bodies_in_files(options, request.order_notes);
  request.deadline = deadline_of(options);
}

class Outcome {
 public:
  /// `frames`: names of files, or a noli._frames.Given. `progress`: None, or called with the work and the share done.
  Outcome(const py::object& frames, const py::object& mesh, const py::dict& options, const py::object& progress) {
    put_options(options, request_);
    if (py::hasattr(frames, "vertices")) {
      given_.emplace(frames);
      request_.frames = {frames.attr("name").cast<std::string>()};
      request_.reading.given = given_->given();
      request_.ordered = "as given, in memory";
      ignored_ = ignored_groups_of(mesh, given_->given()->mesh.vertex_count, true);
      if (ignored_) request_.ignore = ignored_->file;
    } else {
      name_files(frames.cast<std::vector<std::filesystem::path>>());
    }
    run(progress);
  }

  const VerifyOutcome& outcome() const { return outcome_; }
  std::string json() const { return to_text(report::document("verify", report::verify_json(request_, outcome_))); }
  std::string claim() const { return to_text(claim_file(outcome_.claim)); }
  std::string text(bool details) const {
    return text_of(report::verify_answer(request_, outcome_, {.result = "", .details = details}), details);
  }

  /// One row for each listed contact.
  py::dict contacts() const {
    const auto count = static_cast<py::ssize_t>(outcome_.reports.size());
    py::array_t<std::int64_t> step(count), kind(count), pair(count), vertices({count, py::ssize_t{4}});
    py::array_t<double> time(count), point({count, py::ssize_t{3}});
    for (py::ssize_t i = 0; i < count; ++i) {
      const ListedContact& listed = outcome_.reports[static_cast<std::size_t>(i)];
      step.mutable_at(i) = static_cast<std::int64_t>(listed.step);
      kind.mutable_at(i) = static_cast<std::int64_t>(listed.kind);
      pair.mutable_at(i) = static_cast<std::int64_t>(listed.contact.pair);
      time.mutable_at(i) = listed.time;
      for (int j = 0; j < 4; ++j) {
        const bool there = static_cast<std::size_t>(j) < point_count(listed.contact.pair);
        const auto vertex = listed.contact.vertices[static_cast<std::size_t>(j)];
        vertices.mutable_at(i, j) = there ? static_cast<std::int64_t>(vertex) : -1;
      }
      for (int j = 0; j < 3; ++j) point.mutable_at(i, j) = listed.point[static_cast<std::size_t>(j)];
    }
    py::dict columns;
    columns["step"] = step;
    columns["time"] = time;
    columns["kind"] = kind;
    columns["pair"] = pair;
    columns["vertices"] = vertices;
    columns["point"] = point;
    return columns;
  }

  /// Those of the listed contacts and intersections of a step.
  py::array_t<std::int64_t> faces_in_contact(std::size_t step) const {
    std::set<std::int64_t> faces;
    const auto add = [&](std::uint32_t cell) {
      if (cell < outcome_.faces) faces.insert(cell);
    };
    for (const ListedContact& listed : outcome_.reports) {
      if (listed.step != step) continue;
      for (const auto& cells : listed.cells) std::ranges::for_each(cells, add);
    }
    for (const ListedInitial& listed : outcome_.initial_reports) {
      if (listed.step != step) continue;
      add(listed.pair.first_cell);
      add(listed.pair.second_cell);
    }
    return array_of(std::vector<std::int64_t>(faces.begin(), faces.end()));
  }

  /// A page, as `noli report` writes it.
  void report(const std::filesystem::path& file, const std::string& title) {
    const auto alone = one_at_a_time_.enter();
    in_background([&](Background& background) {
      if (given_) given_->read_again_through(&background);
      write_page(file, title, [this](report::ReportPage& page) { fill(page); });
    });
  }

  /// {positions, faces, edges, points, marks of cells: 1, 2, else 0, point, time, step}: everything at the time of the
  /// contact with this number from 1 among those listed, or of the first.
  py::dict contact_frame(std::size_t number) {
    const report::ShownContact shown = contact_shown(number);
    const Mesh& mesh = shown.frame.mesh;
    std::vector<std::int64_t> marks(mesh.cell_count(), 0);
    for (const report::Mark& mark : shown.marks) {
      if (marks[mark.cell] == 0) marks[mark.cell] = mark.side + 1;
    }
    py::dict found;
    found["positions"] = array_of(shown.frame.positions);
    found["faces"] = rows_of_cells(mesh.faces);
    found["edges"] = rows_of_cells(mesh.edges);
    found["points"] = array_of(std::vector<std::int64_t>(mesh.points.begin(), mesh.points.end()));
    found["marks"] = array_of(marks);
    found["point"] = shown.point;
    found["step"] = shown.step;
    found["time"] = shown.time;
    return found;
  }

  /// A grid or a picture of a contact, as `noli export` writes them, by the ending of the name.
  void write_contact(const std::filesystem::path& file, std::size_t number) {
    const report::ShownContact shown = contact_shown(number);
    in_background([&](Background&) { report::write_contact(shown, file, {}); });
  }

 private:
  report::ShownContact contact_shown(std::size_t number) {
    const auto alone = one_at_a_time_.enter();
    std::optional<report::ShownContact> shown;
    in_background([&](Background& background) {
      if (given_) given_->read_again_through(&background);
      shown = report::contact_in(Json::parse(json()), given_ ? given_->given() : nullptr, number);
    });
    return *std::move(shown);
  }

  void name_files(std::vector<std::filesystem::path> names) {
    if (!request_.reading.bodies.empty()) {
      request_.frames = files_of(request_.reading.bodies);
      request_.ordered = "each body's as given";
      return;
    }
    request_.frames = named_frames(std::move(names));
    require_there(request_.frames);
    request_.run = request_.frames.size() == 1 && std::filesystem::is_directory(request_.frames[0]);
    if (!request_.run) request_.put_in_order();
  }

  void run(const py::object& progress) {
    in_background([&](Background& background) {
      if (request_.reproduce) request_.prepare_to_reproduce();
      if (given_) given_->call_through(&background);
      request_.stop = background.stop();
      request_.progress = progress_to(progress, background);
      ProofRoute route(request_);
      outcome_ = run_verify(request_);
      route.check(outcome_);
    });
    request_.stop = nullptr;
    request_.progress = {};
  }

  void fill(report::ReportPage& page) const {
    if (request_.run) {
      report::report_run(request_.frames[0], {}, page);
    } else {
      const auto frames = open_all_frames(request_.frames, request_.reading);
      for (std::size_t k = 0; k < frames->count().value_or(0); ++k) frames->look_at(k);
      report::report_frames(*frames, {request_.constant_motion, outcome_.dimension == 2}, {}, page);
      require_same(frames->take_facts());
    }
    report::put_verdict(Json::parse(json()), "result", page);
  }

  void require_same(const std::vector<FrameFacts>& shown) const {
    for (std::size_t i = 0; i < shown.size(); ++i) {
      if (i < outcome_.inputs.size() && shown[i].sha256 == outcome_.inputs[i].sha256) continue;
      throw InputError(shown[i].file, "", "has changed since it was verified; expected the frames of this result");
    }
  }

  OneAtATime one_at_a_time_;
  VerifyWork request_;
  VerifyOutcome outcome_;
  std::optional<Frames> given_;
  std::shared_ptr<const IgnoredGroups> ignored_;
};

}  // namespace

void bind_verify(py::module_& core) {
  py::class_<Outcome>(core, "Outcome")
      .def(py::init<const py::object&, const py::object&, const py::dict&, const py::object&>())
      .def_property_readonly("verdict", [](const Outcome& self) { return std::string(name(self.outcome().verdict)); })
      .def("json", &Outcome::json)
      .def("claim", &Outcome::claim)
      .def("text", &Outcome::text)
      .def("contacts", &Outcome::contacts)
      .def("faces_in_contact", &Outcome::faces_in_contact)
      .def("report", &Outcome::report)
      .def("contact_frame", &Outcome::contact_frame)
      .def("write_contact", &Outcome::write_contact);
}

}  // namespace noli::python
