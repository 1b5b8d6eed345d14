// SPDX-License-Identifier: Apache-2.0
#include "bench/data.h"

#include <algorithm>
#include <array>

#include "tests/support/real_data.h"
#include "trajectory/formats/query_csv.h"

namespace noli::bench {
namespace {

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

std::vector<QueryFile> read_query_files() {
  std::vector<QueryFile> files;
  const auto folder = test::real_data("queries");
  if (!folder) return files;
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
    if (is_measured(entry.path())) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  files.reserve(paths.size());
  for (const auto& path : paths) files.push_back(read(path, *kind_from_file_name(path)));
  return files;
}

std::optional<QueryFile> read_query_file(const std::string& name) {
  const auto path = test::real_data("queries/" + name + ".csv");
  if (!path) return std::nullopt;
  return read(*path, kind_from_file_name(*path).value());
}

std::vector<FramePair> frame_pairs() {
  constexpr std::array<std::array<const char*, 3>, 4> known = {{{"cloth-funnel", "227.ply", "228.ply"},
                                                                {"armadillo-rollers", "326.ply", "327.ply"},
                                                                {"cloth-ball", "cloth_ball92.ply", "cloth_ball93.ply"},
                                                                {"rod-twist-clean", "0.ply", "1.ply"}}};
  std::vector<FramePair> pairs;
  for (const auto& [name, t0, t1] : known) {
    const std::string folder = std::string("frames/") + name + "/";
    const auto path_t0 = test::real_data(folder + t0), path_t1 = test::real_data(folder + t1);
    if (path_t0 && path_t1) pairs.push_back({name, *path_t0, *path_t1});
  }
  return pairs;
}

}  // namespace noli::bench
