// SPDX-License-Identifier: Apache-2.0
//
// Judges the queries of saved files again, as they are or made simpler: the kernel's answers by the oracle, or those of
// somebody else's library by the kernel.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "audit/fuzz/queries/fuzz_library.h"
#include "audit/fuzz/queries/fuzz_queries.h"
#include "audit/fuzz/queries/saved_query.h"
#include "certify/json.h"

namespace noli::audit {

/// The queries of a saved file, and the wrong answers to them.
class SavedQueryFile {
 public:
  /// Asks `library`, which has to outlive this, about all queries; nullptr: the kernel is asked later. Throws
  /// InputError, and what faults_of throws.
  SavedQueryFile(std::filesystem::path file, const LibraryUnderTest* library);

  const std::filesystem::path& path() const { return path_; }
  const std::vector<SavedQuery>& queries() const { return saved_; }

  /// How many queries have an answer.
  std::size_t asked() const { return library_ ? found_.asked : saved_.size(); }

  /// One line for each wrong answer; empty if all answers are right.
  std::vector<std::string> differences() const;

  /// Shrinks each query that fails; equal results are listed once. Fewer when `stop` is set.
  std::vector<Finding> minimised(const std::atomic<bool>& stop) const;

 private:
  std::filesystem::path path_;
  const LibraryUnderTest* library_;
  std::vector<SavedQuery> saved_;
  bool knows_times_ = false;
  FaultsFound found_;
};

/// The results of --replay and --minimise.
struct ReplayedQueries {
  bool undecided = false, finding = false;
  Json json;
  std::string text;
};

/// Decides the queries of files again. Throws as SavedQueryFile.
ReplayedQueries replay_files(const std::vector<std::string>& files, const LibraryUnderTest* library,
                             const std::atomic<bool>& stop);

/// "queries-edge-edge.csv" gives "queries-edge-edge-query3-minimised.csv" in the folder.
std::filesystem::path minimised_name(const std::filesystem::path& file, const std::filesystem::path& folder,
                                     std::size_t query);

/// Shrinks each query that fails, and saves it in the folder under minimised_name(), or the next name that is free.
/// `command`: gives the command that asks about a file again. Throws std::system_error.
ReplayedQueries minimise_file(const SavedQueryFile& file, const std::filesystem::path& folder,
                              const std::function<std::string(const std::filesystem::path&)>& command,
                              const std::atomic<bool>& stop);

}  // namespace noli::audit
