// SPDX-License-Identifier: Apache-2.0
#include "report/figures/contact_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include "certify/process/hdf5_frames.h"
#include "certify/result_file.h"
#include "certify/runs/run_log_facts.h"
#include "certify/runs/run_series_reader.h"
#include "report/figures/picture.h"
#include "report/figures/png.h"
#include "report/figures/run_frame.h"
#include "report/page/report_inputs.h"
#include "report/page/report_results.h"
#include "trajectory/cells.h"
#include "trajectory/formats/vtk/write_vtu.h"
#include "trajectory/sample.h"
#include "trajectory/write_file.h"

namespace noli::report {
namespace {

/// The part of a picture around the contact, in lengths of the longest edge that meets.
constexpr double around = 4;

struct Contact {
  std::size_t step = 0;  ///< from 1
  double time = 0;
  std::optional<Position> point;  ///< nothing: the middle of what meets
  /// Vertices of each feature, or of each of two cells that intersect where the step begins.
  std::array<std::vector<VertexId>, 2> vertices;
};

std::vector<VertexId> corners_of(const Mesh& mesh, std::uint32_t cell) {
  if (cell < mesh.faces.size()) return {mesh.faces[cell].begin(), mesh.faces[cell].end()};
  const std::size_t edge = cell - mesh.faces.size();
  if (edge < mesh.edges.size()) return {mesh.edges[edge].begin(), mesh.edges[edge].end()};
  return {mesh.points[edge - mesh.edges.size()]};
}

class ContactOf {
 public:
  /// `path`: how messages call the result. `given`: nothing where it names files.
  ContactOf(std::filesystem::path path, Json result, std::shared_ptr<const GivenFrames> given, std::size_t number)
      : path_(std::move(path)), result_(std::move(result)), given_(std::move(given)) {
    if (result_.is_object() && result_.contains("meshes")) result_ = of_first_mesh_that_touches();
    if (!is_of_verify(result_)) refuse("is not a result of noli verify; expected what noli verify --json wrote");
    try {
      contact_ = parsed(chosen(number));
    } catch (const Json::exception& error) {
      refuse(fmt::format("lists a contact in a form that noli verify does not write: {}", error.what()));
    }
  }

  const Contact& contact() const { return contact_; }

  /// Where everything is at the time of contact, and the vertices of cells that intersect.
  Frame frame() {
    const ResultInputs about(result_.value("inputs", Json::array()), path_);
    Frame frame = verified_steps(result_, path_).run ? frame_of_run(about) : frame_between(about);
    if (result_.at("statement").at("points").get<bool>()) add_particles(frame.mesh);
    if (!intersecting_) return frame;
    if (merged()) refuse("counts cells of a mesh with merged vertices; verify without --merge-identical");
    for (std::size_t side = 0; side < 2; ++side) {
      if ((*intersecting_)[side] >= frame.mesh.cell_count()) refuse("names a cell that the frames do not have");
      contact_.vertices[side] = corners_of(frame.mesh, (*intersecting_)[side]);
    }
    return frame;
  }

  /// Whether vertices of the result stand for others at the same place.
  bool merged() const { return result_.at("statement").at("merged_vertices").get<std::uint64_t>() > 0; }

 private:
  /// Of `noli verify --static` about files with different meshes.
  Json of_first_mesh_that_touches() const {
    static const Json::json_pointer verdict("/result/verdict");
    for (const Json& mesh : result_["meshes"]) {
      if (mesh.is_object() && mesh.value(verdict, Json()) == "contact") return mesh["result"];
    }
    refuse("is about meshes in which nothing touches");
  }

  [[noreturn]] void refuse(const std::string& what) const { throw InputError(path_.string(), "", what); }

  /// The contact that is asked for; null: the first cells that intersect, or come too near.
  const Json& chosen(std::size_t number) const {
    const Json& listed = result_.at("reports").at("contacts");
    if (number > listed.size()) {
      refuse(fmt::format("lists {} contacts; expected at most this many, found --contact {}", listed.size(), number));
    }
    if (number > 0) return listed.at(number - 1);
    const Json& intersections = result_.at("initial_reports").at("intersections");
    if (result_.at("first").is_null() && intersections.empty() && result_.at("near").is_null()) {
      refuse("lists no contact; expected a result with the verdict contact or too_near");
    }
    return result_.at("first");
  }

  Contact parsed(const Json& json) {
    const Json& intersections = result_.at("initial_reports").at("intersections");
    if (json.is_null()) return intersections.empty() ? near() : intersection(intersections.at(0));
    if (!json.contains("point")) refuse("was written by an older noli, which lists no points; verify again");
    Contact contact{json.at("step").get<std::size_t>(), json.at("time").get<double>(), std::nullopt, {}};
    contact.point = json.at("point").get<Position>();
    contact.vertices = json.at("features").get<std::array<std::vector<VertexId>, 2>>();
    return contact;
  }

  Contact intersection(const Json& json) {
    intersecting_ = json.at("cells").get<std::array<std::uint32_t, 2>>();
    return {json.at("step").get<std::size_t>(), 0, std::nullopt, {}};
  }

  Contact near() {
    const Json& json = result_.at("near");
    if (!json.value("witnessed", true)) refuse("is undecided about what may be too near");
    Contact contact = intersection(json);
    contact.time = json.at("part_of_step").get<double>();
    if (verified_steps(result_, path_).run) refuse("does not say at which time of the run something is too near");
    return contact;
  }

  std::filesystem::path file(std::size_t k) const {
    const Json& inputs = result_.at("inputs");
    if (k >= inputs.size()) refuse("names no input");
    const auto name = inputs.at(k).at("file").get<std::string>();
    if (name == "-")
      refuse("is about standard input, which cannot be read again; verify with --trajectory, and use its file");
    return name;
  }

  Frame frame_of_run(const ResultInputs& about) const {
    const std::filesystem::path run = file(0).parent_path();
    about.require_run(run);
    SeriesReader reader = open_run(run);
    const RunFrame frame = run_frame_at(reader, run, contact_.time);
    return {reader.mesh(), frame.positions};
  }

  Frame frame_between(const ResultInputs& about) {
    if (contact_.step == 0) refuse("lists a contact in step 0");
    const std::size_t before = contact_.step - 1;
    const bool at_rest = verified_steps(result_, path_).at_rest;
    Frame frame = frame_number(before, about);
    if (at_rest) return frame;
    const Frame after = frame_number(contact_.step, about);
    if (after.mesh != frame.mesh) refuse("names two frames of different meshes");
    const double s = std::clamp(contact_.time, 0.0, 1.0);
    for (std::size_t v = 0; v < frame.positions.size(); ++v) {
      frame.positions[v] = sample_between(frame.positions[v], after.positions[v], s);
    }
    return frame;
  }

  Frame frame_number(std::size_t k, const ResultInputs& about) {
    if (!frames_) open();
    frames_->look_at(k);
    std::optional<Frame> frame = frames_->read(k);
    if (!frame) refuse(fmt::format("has a contact in step {}, but there are fewer frames", contact_.step));
    about.require_files(given_ ? frames_->take_facts() : frames_->facts());
    return std::move(*frame);
  }

  void open() {
    std::vector<std::filesystem::path> files;
    for (std::size_t i = 0; i < result_.at("inputs").size(); ++i) files.push_back(file(i));
    FrameReading reading;
    if (given_) {
      reading.given = given_;
    } else {
      reading =
          reading_of(result_.value("inputs", Json::array()), result_.at("statement").value("bodies", Json::array()));
    }
    frames_ = open_all_frames(files, std::move(reading));
  }

  std::filesystem::path path_;
  Json result_;
  std::shared_ptr<const GivenFrames> given_;
  Contact contact_;
  std::unique_ptr<FrameSource> frames_;                       ///< open as soon as one is wanted
  std::optional<std::array<std::uint32_t, 2>> intersecting_;  ///< two cells, where no pair of features is chosen
};

/// Cells that have all vertices of a feature. With merged vertices one at the same place will do.
std::vector<Mark> marks_of(const Contact& contact, const Frame& frame, bool merged) {
  const auto is_at = [&](VertexId v, VertexId corner) {
    return v == corner || (merged && frame.positions[v] == frame.positions[corner]);
  };
  std::vector<Mark> marks;
  for (std::uint32_t cell = 0; cell < frame.mesh.cell_count(); ++cell) {
    const std::vector<VertexId> corners = corners_of(frame.mesh, cell);
    for (int side = 0; side < 2; ++side) {
      const auto has = [&](VertexId v) {
        return std::ranges::any_of(corners, [&](VertexId c) { return is_at(v, c); });
      };
      if (std::ranges::all_of(contact.vertices[static_cast<std::size_t>(side)], has)) marks.push_back({cell, side});
    }
  }
  return marks;
}

/// Where they meet; of cells that intersect, the middle of their corners.
Position point_of(const Contact& contact, const Frame& frame) {
  if (contact.point) return *contact.point;
  Position sum{};
  double count = 0;
  for (const auto& vertices : contact.vertices) {
    for (const VertexId v : vertices) {
      for (std::size_t d = 0; d < 3; ++d) sum[d] += frame.positions[v][d];
      ++count;
    }
  }
  return {sum[0] / count, sum[1] / count, sum[2] / count};
}

double radius_around(const Frame& frame, const std::vector<Mark>& marks) {
  double longest = 0;
  for (const Mark& mark : marks) {
    const std::vector<VertexId> corners = corners_of(frame.mesh, mark.cell);
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      const Position &a = frame.positions[corners[i]], &b = frame.positions[corners[i + 1]];
      longest = std::max(longest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
    }
  }
  return longest > 0 ? around * longest : 1;
}

CellData cell_data(const Mesh& mesh, const std::vector<Mark>& marks) {
  CellData data{"contact", std::vector<std::uint8_t>(mesh.cell_count(), 0)};
  for (const Mark& mark : marks) {
    if (data.values[mark.cell] == 0) data.values[mark.cell] = static_cast<std::uint8_t>(mark.side + 1);
  }
  return data;
}

bool in_plane(const Frame& frame) {
  return std::ranges::all_of(frame.positions, [&](const Position& x) { return x[2] == frame.positions[0][2]; });
}

void paint(const ShownContact& shown, const std::filesystem::path& output, const PictureView& asked) {
  View view = view_from(asked, in_plane(shown.frame) ? 2 : 3);
  if (view.height == 0) view.height = view.width * 3 / 4;
  view.focus = Focus{shown.point, radius_around(shown.frame, shown.marks)};
  view.marks = shown.marks;
  const std::vector<bool> none(shown.frame.mesh.vertex_count, false);
  with_asked_view([&] { replace_file(output, png(draw(shown.frame, none, view))); });
}

bool is_picture(const std::filesystem::path& output) { return output.extension() == ".png"; }

void check(const std::filesystem::path& output) {
  const bool picture = is_picture(output);
  if (!picture && output.extension() != ".vtu") {
    throw UsageError("-o " + output.string() + ": expected a name that ends in .vtu or .png for a contact");
  }
  if (picture) require_pictures();
  make_writable_folder(output.parent_path(), "-o");
}

ShownContact shown(ContactOf result, const std::filesystem::path& path) {
  Frame frame = result.frame();
  const Contact& contact = result.contact();
  for (const auto& vertices : contact.vertices) {
    for (const VertexId v : vertices) {
      if (v >= frame.mesh.vertex_count) throw InputError(path.string(), "", "names a vertex that is not there");
    }
  }
  std::vector<Mark> marks = marks_of(contact, frame, result.merged());
  const Position point = point_of(contact, frame);
  return {contact.step, contact.time, std::move(frame), std::move(marks), point};
}

}  // namespace

ShownContact contact_in(const Json& result, std::shared_ptr<const GivenFrames> given, std::size_t number) {
  return shown(ContactOf("result", result, std::move(given), number), "result");
}

ShownContact contact_in(const std::filesystem::path& result, std::size_t number) {
  return shown(ContactOf(result, read_result(result), nullptr, number), result);
}

void write_contact(const ShownContact& shown, const std::filesystem::path& output, const PictureView& view) {
  check(output);
  if (is_picture(output)) return paint(shown, output, view);
  replace_file(output, format_vtu(shown.frame, cell_data(shown.frame.mesh, shown.marks)));
}

ContactExport export_contact(const ContactExportRequest& request) {
  check(request.output);
  const ShownContact shown = contact_in(request.result, request.number);
  write_contact(shown, request.output, request.view);
  return {shown.step, shown.time, shown.marks.size(), is_picture(request.output)};
}

}  // namespace noli::report
