// SPDX-License-Identifier: Apache-2.0
#include "noli/app/run_folder.h"

#include <set>
#include <string>

#include "noli/app/exit_code.h"
#include "noli/app/version.h"
#include "noli/trajectory/error.h"
#include "noli/trajectory/run_manifest.h"

namespace noli::app {
namespace {

namespace fs = std::filesystem;

std::string text_of(const Json& scene) { return scene.dump(2) + "\n"; }

/// Whether a folder holds nothing but what a run is made of: what may be removed with --force.
bool is_run(const fs::path& folder) {
  static const std::set<std::string> names = {"manifest.json", "scene.json", "trajectory.blocks", "log.jsonl",
                                              "series.h5"};
  if (!fs::is_directory(folder)) return false;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path name = entry.path().filename();
    if (names.count((name.extension() == ".part" ? name.stem() : name).string()) == 0) return false;
  }
  return true;
}

/// What a run's bytes do not depend on.
Json essential(Json scene) {
  for (const char* field : {"duration", "title", "about", "frame_rate", "short"}) scene.erase(field);
  return scene;
}

}  // namespace

void RunFolder::make(bool force) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(path_, error))) {
    const bool empty = fs::is_directory(path_, error) && fs::is_empty(path_, error);
    if (!empty && !force) {
      throw UsageError("-o " + path_.string() + ": is there already; expected a new folder, --resume or --force");
    }
    if (!is_run(path_))
      throw UsageError("-o " + path_.string() + ": is no run; expected a folder that may be replaced");
    fs::remove_all(path_);
  }
  fs::create_directories(path_, error);
  if (error) throw UsageError("-o " + path_.string() + ": cannot be made: " + error.message());
}

void RunFolder::begin(const Json& scene) {
  write_manifest(path_, text_of(scene), {{"noli", version_number()}});
  log_.emplace(path_);
  log({{"event", "begin"}});
}

bool RunFolder::has_begun() const {
  if (!is_run(path_)) throw UsageError("--resume: " + path_.string() + " is no run; expected the folder of one");
  return fs::exists(path_ / "manifest.json");
}

void RunFolder::go_on(const Json& scene) {
  const Json there = Json::parse(read_scene(path_, read_manifest(path_)));
  if (essential(there) != essential(scene)) {
    throw InputError((path_ / "scene.json").string(), "",
                     "is another scene; expected the one to go on with (its duration may differ)");
  }
  log_.emplace(path_);
  log({{"event", "resume"}});
}

void RunFolder::log(std::uint64_t window, const SeriesRow& row) {
  log({{"event", "window"},
       {"window", window},
       {"time", row.time},
       {"verdict", "no_contact"},
       {"events", row.events},
       {"breakpoints", row.breakpoints}});
}

void RunFolder::log(const Json& entry) { log_->append(entry); }

}  // namespace noli::app
