// SPDX-License-Identifier: Apache-2.0
#include <pybind11/pybind11.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <noli/proof.h>
#include "certify/groups.h"
#include "certify/process/hdf5_frames.h"
#include "certify/proofs/asked_fields.h"
#include "certify/proofs/check_frames.h"
#include "certify/proofs/check_parts.h"
#include "certify/proofs/checker.h"
#include "certify/proofs/claim.h"
#include "certify/proofs/prove_frames.h"
#include "integrator/scene/json_text.h"
#include "python/src/bindings.h"
#include "python/src/frames.h"
#include "python/src/options.h"
#include "report/check_report.h"
#include "report/documents.h"
#include "report/joined_check.h"
#include "trajectory/formats/frame_names.h"

namespace noli::python {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

/// A proof, and the frames or the run that it is about.
class Check {
 public:
  Check(fs::path proof, const py::object& frames, std::vector<std::string> asked, bool verified,
        const py::dict& options, const py::object& progress)
      : which_(verified ? Checker::verified : Checker::plain) {
    checked_.proof = std::move(proof);
    checked_.asked = std::move(asked);
    if (py::hasattr(frames, "vertices")) {
      given_.emplace(frames);
      ask_for_ignored(frames.attr("mesh"));
    } else {
      bodies_ = bodies_in_files(options, checked_.notes);
      name_files(frames.cast<std::vector<fs::path>>(), order_of(options));
    }
    put(options, "threads", checkers_);
    std::optional<std::string> part;
    put(options, "part", part);
    in_background([&](Background& background) {
      if (part) checked_.least_steps = ask_for_part(*part, checked_.proof, checked_.asked);
      if (given_) given_->call_through(&background);
      ask(background, progress_to(progress, background));
    });
  }

  /// (name, text of `json()`) of answers about parts.
  static Check joined(const std::vector<std::pair<std::string, std::string>>& answers) {
    std::vector<report::PartAnswer> parts;
    for (const auto& [name, text] : answers) parts.push_back({name, integrator::parse_json(text, name)});
    return Check(report::joined_check(parts));
  }

  std::string json() const { return to_text(report::document("check", report::check_json(checked_))); }
  std::string text() const { return text_of(report::check_answer(checked_)); }

 private:
  explicit Check(report::Checked checked) : checked_(std::move(checked)) {}

  /// What the mesh ignores is left out of the claim that is asked for, unless the words say what may be.
  void ask_for_ignored(const py::object& mesh) {
    const std::size_t vertices = given_->given()->mesh.vertex_count;
    const auto ignored = ignored_groups_of(mesh, vertices, true);
    if (!ignored || asks(checked_.asked, "excluded")) return;
    const Groups groups = read_groups(ignored->file, vertices, names_of_frames(given_->given()->bodies));
    const CellLabels labels = labels_of_frames(given_->given()->mesh, &groups.exclusions, {});
    Claim claim;
    claim.strict = asks(checked_.asked, "strict");
    set_cells(claim, given_->given()->mesh, labels.of, labels.excluded);
    for (const std::string& word : fields_beyond_default(claim)) {
      const bool wanted = field_of(word) == "excluded" || field_of(word) == "cells";
      if (wanted && (field_of(word) == "excluded" || !asks(checked_.asked, "cells"))) checked_.asked.push_back(word);
    }
  }

  void name_files(std::vector<fs::path> names, FrameOrder order) {
    if (!bodies_.empty()) {
      files_ = files_of(bodies_);
      return;
    }
    OrderedFrames ordered = order_frames(named_frames(std::move(names)), order);
    files_ = std::move(ordered.frames);
    checked_.notes = std::move(ordered.notes);
    if (files_.size() == 1 && fs::is_directory(files_[0])) {
      ask_for_all_windows(files_[0], checked_.asked, checked_.notes);
    }
  }

  void ask(Background& background, const std::function<void(std::string_view, double)>& progress) {
    CheckRequest request{.checker = which_,
                         .proof = checked_.proof,
                         .trajectory = trajectory_for_checker(files_),
                         .asked = checked_.asked,
                         .stop = background.stop(),
                         .checkers = checkers_};
    if (progress) request.progress = [&progress](double share) { progress("check", share); };
    FrameReading reading;
    reading.bodies = bodies_;
    if (given_) reading.given = given_->given();
    const std::vector<fs::path> names = given_ ? std::vector<fs::path>{"frames"} : request.trajectory;
    checked_.verdict = checkers_read(names, reading)
                           ? check_proof(request)
                           : verdict_or_stopped(check_frames(request, *open_all_frames(names, reading)), request);
    checked_.checker = version_of(which_);
  }

  Checker which_ = Checker::plain;
  int checkers_ = 0;
  std::vector<fs::path> files_;
  std::vector<BodyFrames> bodies_;
  std::optional<Frames> given_;
  report::Checked checked_;
};

}  // namespace

void bind_check(py::module_& core) {
  py::class_<Check>(core, "Check")
      .def(py::init<fs::path, const py::object&, std::vector<std::string>, bool, const py::dict&, const py::object&>())
      .def_static("joined", &Check::joined)
      .def("json", &Check::json)
      .def("text", &Check::text);
  core.def("read_claim_file", &read_claim_file);
}

}  // namespace noli::python
