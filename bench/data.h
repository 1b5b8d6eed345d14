// SPDX-License-Identifier: Apache-2.0
//
// Real data (tests/support/real_data.h) for the benchmarks, and how queries are laid out in memory before they are
// timed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <noli/mesh.h>
#include <noli/query.h>

namespace noli::bench {

/// The queries of a file, of the kind that its name says.
struct QueryFile {
  std::string name;  ///< of the file, without extension
  std::variant<std::vector<VertexFace3>, std::vector<EdgeEdge3>> queries;
  std::vector<bool> labels;  ///< the truth, one per query

  std::size_t size() const { return labels.size(); }
};

/// All labelled vertex-face and edge-edge files among the real queries, by name. Says on standard error when they are
/// not there.
std::vector<QueryFile> read_query_files();

/// One of them; nothing when it is not there.
std::optional<QueryFile> read_query_file(const std::string& name);

/// Two successive frames of a simulation.
struct FramePair {
  std::string name;
  std::filesystem::path path_t0, path_t1;
};

/// The real pairs of frames that are there; those that are not are named on standard error.
std::vector<FramePair> frame_pairs();

/// Puts items in an order that depends on the seed alone.
template <class T>
void shuffle(std::vector<T>& items, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random() % i]);
}

/// The queries, over and over until there are at least `count`, shuffled: neither cache nor branch predictor can learn
/// a short file.
template <class Query>
std::vector<Query> workload(const std::vector<Query>& queries, std::size_t count = 100'000) {
  std::vector<Query> work;
  while (work.size() < count) work.insert(work.end(), queries.begin(), queries.end());
  shuffle(work, 1);
  return work;
}

}  // namespace noli::bench
