// SPDX-License-Identifier: Apache-2.0
#include "report/info_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include <noli/errors.h>
#include <noli/proof.h>
#include "certify/process/hdf5_frames.h"
#include "certify/queries/any_query.h"
#include "certify/queries/ccd_run.h"
#include "certify/runs/run_info.h"
#include "trajectory/formats/arrays/array_frames.h"
#include "trajectory/formats/arrays/converted_frames.h"
#include "trajectory/formats/file_info.h"
#include "trajectory/formats/frames.h"
#include "trajectory/formats/open_frames.h"
#include "trajectory/formats/query_csv.h"

namespace noli::report {
namespace {

Json query_info(const std::filesystem::path& path) {
  const std::optional<FeaturePair> pair = query_kind(path);
  if (!pair) {
    throw InputError(path.string(), "",
                     "the name does not say what the queries are; expected one of vertex-face, edge-edge, vertex-edge, "
                     "vertex-vertex in it");
  }
  const auto records = read_query_csv(path, file_kind(*pair));
  const auto count_label = [&](bool label) {
    return std::count_if(records.begin(), records.end(),
                         [=](const QueryRecord& record) { return record.label == label; });
  };
  return {{"file", path.string()},
          {"format", "CSV of queries"},
          {"kind", name(*pair)},
          {"queries", records.size()},
          {"labelled", count_label(false) + count_label(true)},
          {"labelled_contact", count_label(true)}};
}

Json mesh_json(const std::filesystem::path& path, const FileInfo& info) {
  Json json = {{"file", path.string()},
               {"format", info.format},
               {"number_type", info.number_type},
               {"vertices", info.vertices},
               {"faces", info.faces},
               {"mesh_edges", info.mesh_edges},
               {"loose_edges", info.loose_edges},
               {"loose_points", info.loose_points},
               {"unreferenced_vertices", info.unreferenced_vertices},
               {"degenerate_faces", info.degenerate_faces},
               {"coincident_vertices", info.coincident_vertices},
               {"planar", info.planar}};
  json["lower"] = info.box ? Json(info.box->lower) : Json(nullptr);
  json["upper"] = info.box ? Json(info.box->upper) : Json(nullptr);
  return json;
}

Json mesh_info(const std::filesystem::path& path) { return mesh_json(path, describe_file(path)); }

/// Of a file that has many frames: what the first one is, and how many there are.
Json motion_info(const std::filesystem::path& path) {
  const auto source = open_all_frames({path});
  const auto first = source->read(0);
  if (!first) throw InputError(path.string(), "", "has no frame");
  FileInfo info = describe_frame(*first);
  info.format = is_hdf5_name(path) ? "HDF5" : is_array_name(path) ? "numpy" : "block file of frames";
  info.number_type = source->facts()[0].numbers;
  Json json = mesh_json(path, info);
  json["frames"] = source->count().value();
  return json;
}

const char* what_moves(const std::string& motion) {
  if (motion == "linear") return "frames";
  if (motion == "rest") return "frames at rest";
  return motion == "run" ? "a run" : "something unknown";
}

Json proof_info(const std::filesystem::path& file) {
  const ProofInfo info = inspect_proof(file);
  return {{"file", file.string()},
          {"format", "Noli proof"},
          {"about", what_moves(info.motion)},
          {"dimension", info.dimension},
          {"strict", info.strict},
          {"unreferenced_vertices_count", info.points},
          {"least_distance", info.distance},
          {"ring", info.ring},
          {"merged_vertices", info.merged},
          {"excluded_pairs_of_labels", info.excluded},
          {"steps", info.steps},
          {"steps_with_a_witness_of_contact", info.contacts},
          {"token_bytes", info.token_bytes},
          {"open_group", info.open_group},
          {"bytes", info.bytes},
          {"begin", info.steps > 0 ? Json(info.from) : Json()},
          {"end", info.steps > 0 ? Json(info.to) : Json()}};
}

std::string as_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return digits17(value.get<double>());
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const Json& item : value) text += (text.empty() ? "" : ", ") + digits17(item.get<double>());
  return text;
}

}  // namespace

Json file_info_json(const std::filesystem::path& path) {
  if (extension_of(path) == ".json") {
    throw InputError(path.string(), "",
                     "is JSON; `noli explain` describes a scene, `noli report` shows a result, `noli export` draws its "
                     "first contact");
  }
  if (std::filesystem::is_directory(path)) return run_info(path);
  if (is_proof(path)) return proof_info(path);
  if (extension_of(path) == ".csv") return query_info(path);
  return holds_frames(path) && !is_frame_name(path) ? motion_info(path) : mesh_info(path);
}

Answer info_answer(const Json& json) {
  Answer answer(json, {"files"});
  for (const Json& file : json["files"]) {
    answer.text += on_one_line(as_text(file["file"])) + '\n';
    for (const auto& [key, value] : file.items()) {
      if (key != "file") answer.text += fmt::format("  {} {}\n", key, as_text(value));
    }
  }
  return answer;
}

}  // namespace noli::report
