// SPDX-License-Identifier: Apache-2.0
#include "noli/app/run_folder.h"

#include <set>
#include <string>

#include "noli/app/exit_code.h"
#include "noli/app/output.h"
#include "noli/app/version.h"
#include "noli/trajectory/error.h"
#include "noli/trajectory/run_file.h"
#include "noli/trajectory/run_manifest.h"

namespace noli::app {
namespace {

namespace fs = std::filesystem;

std::string text_of(const Json& scene) { return scene.dump(2) + "\n"; }

/// Whether a folder holds nothing but what a run is made of, or nothing at all: what may be removed with --force. What
/// a run begins with is trajectory.blocks; a lonely scene.json is somebody's scene.
bool is_run(const fs::path& folder) {
  static const std::set<std::string> names = {"manifest.json", "scene.json", "trajectory.blocks",
                                              "proof.blocks",  "log.jsonl",  "series.h5"};
  std::error_code error;
  fs::directory_iterator entries(folder, error);
  if (error) return false;
  bool begun = false, other = false;
  for (const auto& entry : entries) {
    const fs::path name = entry.path().filename();
    if (name.string().starts_with(".noli-")) continue;  // left by a kill while it was tried whether one may write
    if (names.count((name.extension() == ".part" ? name.stem() : name).string()) == 0) return false;
    (name == "trajectory.blocks" ? begun : other) = true;
  }
  return begun || !other;
}

/// A scene without what a run's bytes do not depend on.
Json essential(Json scene) {
  for (const char* field : {"duration", "title", "about", "short"}) scene.erase(field);
  if (scene.value("record", "") != "frames") scene.erase("frame_rate");
  return scene;
}

/// Nobody else may be writing to a run that is replaced.
void require_idle(const fs::path& folder) {
  if (!fs::exists(folder / "log.jsonl")) return;
  try {
    const RunLog log(folder);
  } catch (const std::system_error& error) {
    throw UsageError("--force: " + folder.string() + " cannot be replaced: " + error.what());
  }
}

/// What is in a folder, but not the folder: it may be the current one. What tells that it is a run goes last, so it
/// is one still if this is cut short.
void clear(const fs::path& folder) {
  const fs::path last = trajectory_path(folder);
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
  for (const fs::path& entry : entries) {
    if (entry != last) fs::remove_all(entry);
  }
  fs::remove_all(last);
}

}  // namespace

/// Without a "." or a slash at its end, which some operations on folders do not take.
RunFolder::RunFolder(const fs::path& path) : path_(path.lexically_normal()) {
  if (!path_.has_filename() && path_.has_relative_path()) path_ = path_.parent_path();
}

void RunFolder::make(bool force) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(path_, error))) {
    const bool empty = fs::is_directory(path_, error) && fs::is_empty(path_, error);
    if (!empty && !force) {
      throw UsageError("-o " + path_.string() + ": is there already; expected a new folder, --resume or --force");
    }
    if (!is_run(path_))
      throw UsageError("-o " + path_.string() + ": is no run; expected a folder that may be replaced");
    require_writable_folder(path_.string(), "-o");
    require_idle(path_);
    clear(path_);
  }
  make_writable_folder(path_, "-o");
}

void RunFolder::begin(const Json& scene, const Sha256Digest& model, const Json& facts) {
  write_manifest(path_, text_of(scene), {{"noli", version_number()}}, model);
  log_.emplace(path_);
  Json entry = {{"event", "begin"}};
  entry.update(facts);
  log(entry);
}

bool RunFolder::has_begun() const {
  if (!is_run(path_)) throw UsageError("--resume: " + path_.string() + " is no run; expected the folder of one");
  require_writable_folder(path_.string(), "--resume");
  const fs::path trajectory = trajectory_path(path_);
  if (fs::exists(trajectory)) require_writable_file(trajectory, "--resume");
  if (fs::exists(path_ / "manifest.json")) return true;
  // The log comes after the manifest.
  if (!fs::exists(path_ / "log.jsonl")) return false;
  throw UsageError("--resume: " + path_.string() + " has lost its manifest.json; expected a whole run");
}

void RunFolder::go_on(const Json& scene, const Sha256Digest& model) {
  const RunManifest manifest = read_manifest(path_);
  const Json there = Json::parse(read_scene(path_, manifest), nullptr, false);
  if (!there.is_object() || essential(there) != essential(scene)) {
    throw InputError((path_ / "scene.json").string(), "",
                     "is another scene; expected the one to go on with (its duration may differ)");
  }
  if (manifest.model_sha256 && *manifest.model_sha256 != model) {
    throw InputError((path_ / "manifest.json").string(), "/model/sha256",
                     "the run began with other meshes or paths; expected those files that the scene names unchanged");
  }
  try {
    log_.emplace(path_);
  } catch (const std::system_error& lock) {
    throw UsageError("--resume: " + std::string(lock.what()) + "; expected a run that may be written to");
  }
  log({{"event", "resume"}});
}

std::string title_of(const fs::path& run) {
  const Json scene = Json::parse(read_scene(run, read_manifest(run)), nullptr, false);
  return scene.is_object() && scene.contains("title") && scene["title"].is_string() ? scene["title"].get<std::string>()
                                                                                    : "";
}

std::optional<double> duration_of(const fs::path& run) {
  try {
    const Json scene = Json::parse(read_scene(run, read_manifest(run)), nullptr, false);
    if (scene.is_object() && scene.contains("duration") && scene["duration"].is_number()) return scene["duration"];
  } catch (const InputError&) {
    return std::nullopt;
  }
  return std::nullopt;
}

void RunFolder::log(std::uint64_t window, const SeriesRow& row, std::uint32_t deepest) {
  log({{"event", "window"},
       {"window", window},
       {"time", row.time},
       {"verdict", "no_contact"},
       {"events", row.events_in_all()},
       {"breakpoints", row.breakpoints},
       {"timing", {{"deepest", deepest}}}});
}

void RunFolder::log(const Json& entry) { log_->append(entry); }

}  // namespace noli::app
