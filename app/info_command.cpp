// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include <noli/errors.h>
#include <noli/proof.h>
#include "app/commands.h"
#include "app/notes.h"
#include "app/options.h"
#include "app/output.h"
#include "certify/process/hdf5_frames.h"
#include "certify/queries/any_query.h"
#include "certify/queries/ccd_run.h"
#include "certify/runs/run_folder.h"
#include "certify/runs/run_info.h"
#include "report/proof_report.h"
#include "trajectory/formats/arrays/array_frames.h"
#include "trajectory/formats/arrays/converted_frames.h"
#include "trajectory/formats/file_info.h"
#include "trajectory/formats/frames.h"
#include "trajectory/formats/open_frames.h"
#include "trajectory/formats/query_csv.h"

namespace noli::app {
namespace {

constexpr const char* info_footer =
    "Meshes: format, counts, extent, what is degenerate; for files with many frames (.npz, .vtkhdf), those of the "
    "first and the number of frames. Queries (CSV): how many, and how many have labels. Runs: windows, times, "
    "breakpoints, bytes, and whether the files are whole. Proofs: what they claim, steps, times, bytes.\n"
    "Examples:\n"
    "  noli info frame.ply\n"
    "  noli info frames/*.obj --json info.json\n"
    "  noli info unit-tests-edge-edge-0.csv\n"
    "  noli info runs/cloth runs/cloth/proof.blocks\n";

struct InfoArguments {
  std::vector<std::filesystem::path> files;
  std::string time_limit;
  OutputOptions results;
};

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

Json info_of(const std::filesystem::path& path) {
  if (extension_of(path) == ".json") {
    throw InputError(path.string(), "",
                     "is JSON; `noli explain` describes a scene, `noli report` shows a result, `noli export` draws its "
                     "first contact");
  }
  if (std::filesystem::is_directory(path)) return run_info(path);
  if (is_proof(path)) return report::proof_info_json(path, inspect_proof(path));
  if (extension_of(path) == ".csv") return query_info(path);
  return holds_frames(path) && !is_frame_name(path) ? motion_info(path) : mesh_info(path);
}

std::string as_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return digits17(value.get<double>());
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const Json& item : value) text += (text.empty() ? "" : ", ") + digits17(item.get<double>());
  return text;
}

report::Answer info_answer(const Json& json) {
  report::Answer answer(json, {"files"});
  for (const Json& file : json["files"]) {
    answer.text += on_one_line(as_text(file["file"])) + '\n';
    for (const auto& [key, value] : file.items()) {
      if (key != "file") answer.text += fmt::format("  {} {}\n", key, as_text(value));
    }
  }
  return answer;
}

ExitCode run(const InfoArguments& arguments) {
  begin_work(arguments.time_limit);
  const Output output(arguments.results, arguments.files);
  Json json = {{"verdict", "described"}, {"files", Json::array()}};
  for (const auto& path : arguments.files) {
    if (!arguments.results.quiet) note_if_being_written(path);
    json["files"].push_back(info_of(path));
  }
  output.write("info", info_answer(json), json);
  return ExitCode::holds;
}

}  // namespace

Command add_info(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("info", "What is in a file or a run?");
  command->footer(info_footer);
  const auto arguments = std::make_shared<InfoArguments>();
  command->add_option("files", arguments->files, "Files of frames or of queries, proofs, or folders of runs")
      ->required()
      ->type_name("FILE");
  add_time_limit_option(*command, arguments->time_limit);
  add_output_options(*command, arguments->results);
  return {command, [arguments] { return run(*arguments); }};
}

}  // namespace noli::app
