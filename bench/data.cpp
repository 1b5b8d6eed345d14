// SPDX-License-Identifier: Apache-2.0
#include "noli/bench/data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "noli/trajectory/query_csv.h"

namespace noli::bench {
namespace {

void say_skipped(const std::filesystem::path& what) {
  std::fputs(fmt::format("skipped: {} is not there (see NOLI_DATA)\n", what.string()).c_str(), stderr);
}

template <class Query>
std::vector<Query> typed(const std::vector<QueryRecord>& records) {
  std::vector<Query> queries;
  queries.reserve(records.size());
  for (const QueryRecord& record : records) queries.push_back({record.x_t0, record.x_t1});
  return queries;
}

QueryFile read(const std::filesystem::path& path, QueryKind kind) {
  const auto records = read_query_csv(path, kind);
  QueryFile file;
  file.name = path.stem().string();
  file.labels.reserve(records.size());
  for (const QueryRecord& record : records) file.labels.push_back(record.label.value());
  if (kind == QueryKind::vertex_face) {
    file.queries = typed<VertexFace3>(records);
  } else {
    file.queries = typed<EdgeEdge3>(records);
  }
  return file;
}

bool is_measured(const std::filesystem::path& path) {
  const auto kind = kind_from_file_name(path);
  return path.extension() == ".csv" && (kind == QueryKind::vertex_face || kind == QueryKind::edge_edge);
}

}  // namespace

std::filesystem::path data_root() {
  const char* const given = std::getenv("NOLI_DATA");
  return given != nullptr ? std::filesystem::path(given) : std::filesystem::path(NOLI_SOURCE_DIR) / "../shared/data";
}

std::vector<QueryFile> read_query_files() {
  const auto folder = data_root() / "queries";
  std::vector<std::filesystem::path> paths;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (is_measured(entry.path())) paths.push_back(entry.path());
  }
  if (paths.empty()) say_skipped(folder);
  std::sort(paths.begin(), paths.end());
  std::vector<QueryFile> files;
  files.reserve(paths.size());
  for (const auto& path : paths) files.push_back(read(path, *kind_from_file_name(path)));
  return files;
}

std::optional<QueryFile> read_query_file(const std::string& name) {
  const auto path = data_root() / "queries" / (name + ".csv");
  if (std::filesystem::exists(path)) return read(path, kind_from_file_name(path).value());
  say_skipped(path);
  return std::nullopt;
}

std::vector<FramePair> frame_pairs() {
  const auto root = data_root() / "frames";
  std::vector<FramePair> pairs = {{"cloth-funnel", "227.ply", "228.ply"},
                                  {"armadillo-rollers", "326.ply", "327.ply"},
                                  {"cloth-ball", "cloth_ball92.ply", "cloth_ball93.ply"},
                                  {"rod-twist-clean", "0.ply", "1.ply"}};
  for (FramePair& pair : pairs) {
    pair.path_t0 = root / pair.name / pair.path_t0;
    pair.path_t1 = root / pair.name / pair.path_t1;
  }
  std::erase_if(pairs, [](const FramePair& pair) {
    const bool there = std::filesystem::exists(pair.path_t0) && std::filesystem::exists(pair.path_t1);
    if (!there) say_skipped(pair.path_t0.parent_path());
    return !there;
  });
  return pairs;
}

}  // namespace noli::bench
