// SPDX-License-Identifier: Apache-2.0
//
// Models what a loss of power may leave of the files in one folder, given a program's actions on them
// (preload/record.cpp).
//
// Notation
//   action    of the program: a write, a sync, a rename, ...
//   synced    survives: a file's bytes after fsync() of the file, its name after fsync() of its folder
//   pending   done, but not synced: each such action may survive or not, independently of the others. Any part of a
//             write may survive; missing bytes before that part read as zeros
//
// The folder must have no subfolders.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace noli::app_tests {

struct DiskAction {
  enum class What { open, write, seek, truncate, sync, close, rename, unlink, make_folder };
  What what{};
  int file = -1;
  std::int64_t number = 0;  ///< flags, offset or size
  std::string path, to;
  std::string bytes;
};

/// Throws std::runtime_error if the record does not follow the format in preload/record.cpp.
std::vector<DiskAction> read_actions(std::string_view record);

/// The state of a disk after some of a program's actions.
class DiskModel {
 public:
  explicit DiskModel(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Applies the next action. Throws std::runtime_error if it does not fit the previous ones.
  void apply(const DiskAction& action);

  /// Writes to a new folder a state that a loss of power may leave now.
  void leave(const std::filesystem::path& target, std::mt19937_64& random) const;

 private:
  /// Writes bytes at an offset; with `cut`, first truncates the file there.
  struct Change {
    std::size_t offset = 0;
    std::string bytes;
    bool cut = false;
  };
  struct Content {
    std::string synced;
    std::string now;
    std::vector<Change> pending;
  };
  using File = std::shared_ptr<Content>;
  struct Open {
    File file;  ///< null: the folder
    std::size_t offset = 0;
  };
  /// Gives a name another file, or none, and removes the name `gone`.
  struct Naming {
    std::string name;
    File file;
    std::string gone;
  };

  void open(const DiskAction& action);
  void write(const DiskAction& action);
  void truncate(const DiskAction& action);
  void sync(const DiskAction& action);
  void name(Naming naming);
  static void carry_out(const Naming& naming, std::map<std::string, File>& names);
  static void carry_out(const Change& change, std::string& bytes);
  std::string name_of(const std::string& path) const;
  bool is_folder(const std::string& path) const { return std::filesystem::path(path) == folder_; }

  static std::string left_of(const Content& content, std::mt19937_64& random);

  std::filesystem::path folder_;
  std::map<std::string, File> now_, synced_;
  std::vector<Naming> pending_;
  std::map<int, Open> open_;
};

}  // namespace noli::app_tests
