// SPDX-License-Identifier: Apache-2.0
#include "certify/runs/run_folder.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include <noli/version.h>
#include "certify/result_file.h"
#include "certify/runs/run_log_facts.h"
#include "trajectory/blocks/block_sink.h"
#include "trajectory/blocks/frames_file.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/blocks/run_manifest.h"
#include "trajectory/formats/frame_look.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  return files;
}

bool is_scrap(const fs::path& file) { return file.filename().string().starts_with(".noli-"); }

/// Whether a folder holds a run, or nothing at all. A run begins with trajectory.blocks; a scene.json alone is just a
/// user's scene.
bool is_run(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return false;
  if (fs::is_regular_file(trajectory_path(folder), error)) return true;
  const std::vector<fs::path> files = files_in(folder);
  return std::all_of(files.begin(), files.end(), is_scrap);
}

/// The creator of the folder may have put a link where the run will write; its target may belong to somebody else.
void require_no_links(const fs::path& folder) {
  for (const fs::path& file : files_in(folder)) {
    if (!is_file_of_run(file.filename()) || !fs::is_symlink(fs::symlink_status(file))) continue;
    throw UsageError("--resume: " + file.string() + " is a link, which is not written to; expected a file of the run");
  }
}

/// A scene without the fields on which a run's bytes do not depend.
Json essential(Json scene) {
  for (const char* field : {"duration", "title", "about", "short"}) scene.erase(field);
  if (scene.value("record", "") != "frames") scene.erase("frame_rate");
  return scene;
}

/// A member of the run's scene, or null.
Json member_of_scene(const fs::path& run, const char* key) {
  const Json scene = Json::parse(read_scene(run, read_manifest(run)), nullptr, false);
  return scene.is_object() ? scene.value(key, Json()) : Json();
}

/// Whether something would be lost if this file were replaced: committed windows, or a file of frames.
/// A loss of power may leave anything else, zeros for example.
bool must_stay(const fs::path& trajectory) {
  if (!fs::exists(trajectory)) return false;
  try {
    return RunReader(trajectory.parent_path()).look().windows > 0;
  } catch (const InputError&) {
    return is_frames_file(trajectory);
  }
}

/// Removes the files of a run, but not the folder, which may be the current one. The file that makes it a run goes
/// last, so it is still a run if this is cut short. A link is removed, and its target stays.
void clear(const fs::path& folder) {
  const fs::path last = trajectory_path(folder);
  for (const fs::path& file : files_in(folder)) {
    if (file != last && is_file_of_run(file.filename()) && !fs::is_directory(fs::symlink_status(file)))
      fs::remove(file);
  }
  fs::remove(last);
}

}  // namespace

/// Drops a "." or a slash at the end, which some operations on folders do not accept.
RunFolder::RunFolder(const fs::path& path, std::string option)
    : path_(path.lexically_normal()), option_(std::move(option)) {
  if (!path_.has_filename() && path_.has_relative_path()) path_ = path_.parent_path();
}

void lock_folder(const fs::path& folder, const std::string& option, std::optional<FolderLock>& lock) {
  try {
    lock.emplace(folder);
  } catch (const FolderLocked& locked) {
    throw UsageError(option + " " + locked.what() + "; choose another folder, or wait for its end");
  } catch (const std::system_error& closed) {
    throw UsageError(option + " " + closed.what() + "; expected a readable and writable folder");
  }
}

void RunFolder::lock() {
  std::error_code error;
  if (!lock_ && fs::is_directory(path_, error)) lock_folder(path_, option_, lock_);
}

void RunFolder::claim(bool force) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path_, error))) make_writable_folder(path_, option_);
  lock();
  require_room(force);
  require_writable_folder(path_.string(), option_);
}

void RunFolder::make(bool force) {
  claim(force);
  clear(path_);
}

void RunFolder::require_room(bool force) const {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path_, error))) return;
  const bool empty = fs::is_directory(path_, error) && fs::is_empty(path_, error);
  if (!empty && !force) {
    throw UsageError(option_ + " " + path_.string() + ": exists already; expected a new folder, --resume or --force");
  }
  if (is_run(path_)) return;
  throw UsageError(option_ + " " + path_.string() + ": is not a run; expected a folder that may be replaced");
}

void RunFolder::begin(const Json& scene, const Sha256Digest& model, const Json& facts) {
  write_manifest(path_, scene.dump(2) + "\n", {{"noli", version_number()}}, model);
  log_.emplace(path_);
  log_begin(facts);
}

void RunFolder::log_begin(const Json& facts) {
  Json entry = {{"event", "begin"}, {"version", log_version}, {"manifest_sha256", hex(manifest_hash(path_))}};
  entry.update(facts);
  log(entry);
}

bool RunFolder::has_begun() const {
  if (!is_run(path_))
    throw UsageError("--resume: " + path_.string() + " is not the folder of a run; begin without --resume");
  require_writable_folder(path_.string(), "--resume");
  require_no_links(path_);
  const fs::path trajectory = trajectory_path(path_);
  if (fs::exists(trajectory)) require_writable_file(trajectory, "--resume");
  if (fs::exists(path_ / "manifest.json")) return true;
  // The log is created after the manifest, and windows are written after the log.
  if (!fs::exists(path_ / "log.jsonl") && !must_stay(trajectory)) return false;
  throw UsageError("--resume: " + path_.string() + " has lost its manifest.json; expected a whole run");
}

KnownWindows RunFolder::go_on(const Json& scene, const Sha256Digest& model) {
  const LogFacts told = read_log(path_);
  const RunManifest manifest = read_manifest(path_);
  const Json there = Json::parse(read_scene(path_, manifest), nullptr, false);
  if (!there.is_object() || essential(there) != essential(scene)) {
    throw InputError((path_ / "scene.json").string(), "",
                     "is another scene; expected the scene of the run (its duration may differ)");
  }
  if (manifest.model_sha256 && *manifest.model_sha256 != model) {
    throw InputError((path_ / "manifest.json").string(), "/model/sha256",
                     "the run began with other meshes or paths; expected the files that the scene names, unchanged");
  }
  try {
    log_.emplace(path_);
  } catch (const std::system_error& lock) {
    throw UsageError("--resume: " + std::string(lock.what()) + "; expected a writable run");
  }
  log_has_begun_ = told.parts > 0;
  KnownWindows known = told.known;
  known.made_again = true;
  return known;
}

void RunFolder::resumed(const CommittedWindows& committed, const Json& facts) {
  if (!log_has_begun_) log_begin(facts);
  Json entry = {{"event", "resume"}};
  committed.tell(entry);
  log(entry);
}

bool is_file_of_run(const fs::path& name) {
  static const std::set<std::string> names = {"manifest.json", "scene.json", "trajectory.blocks",
                                              "proof.blocks",  "log.jsonl",  "series.h5"};
  const std::string text = name.extension() == ".part" ? name.stem().string() : name.string();
  return names.count(text) > 0 || text.starts_with(".noli-");
}

std::vector<FrameFacts> run_facts(const fs::path& run, const std::function<bool()>& stop) {
  std::vector<FrameFacts> facts = {file_facts(trajectory_path(run), stop)};
  const fs::path manifest = run / "manifest.json";
  std::error_code error;
  if (fs::exists(manifest, error)) facts.push_back(file_facts(manifest, stop));
  return facts;
}

std::string title_of(const fs::path& run) {
  const Json title = member_of_scene(run, "title");
  return title.is_string() ? title.get<std::string>() : "";
}

namespace {

/// A number of the run's scene; nothing if the run has no scene, or the scene no such number.
std::optional<double> number_of_scene(const fs::path& run, const char* name) {
  for (const char* file : {"manifest.json", "scene.json"}) {
    std::error_code error;
    if (fs::status(run / file, error).type() == fs::file_type::not_found) return std::nullopt;
  }
  const Json number = member_of_scene(run, name);
  return number.is_number() ? std::optional(number.get<double>()) : std::nullopt;
}

/// Hash of a file that this process has just written. Ignores requests to stop: the run is already ending, and its end
/// must still be logged.
Sha256Digest hash_of_written(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<char> part(std::size_t{1} << 20);
  Sha256 hash;
  while (file.read(part.data(), static_cast<std::streamsize>(part.size())) || file.gcount() > 0) {
    hash.update({part.data(), static_cast<std::size_t>(file.gcount())});
  }
  if (!file.eof()) throw WriteError(path.string() + ": cannot be read back");
  return hash.digest();
}

}  // namespace

std::optional<double> duration_of(const fs::path& run) { return number_of_scene(run, "duration"); }
std::optional<double> window_of(const fs::path& run) { return number_of_scene(run, "window"); }

Sha256Digest RunFolder::keep_series() const {
  const fs::path series = path_ / "series.h5";
  FileSink(series, FileSink::Open::existing).sync();
  sync_folder(path_);
  return hash_of_written(series);
}

Json RunFolder::window_line(const CommittedWindows& committed, double time, std::uint64_t breakpoints) {
  return {{"event", "window"},       {"window", committed.count - 1}, {"time", time},
          {"verdict", "no_contact"}, {"breakpoints", breakpoints},    {"running", hex(committed.running)}};
}

void CommittedWindows::tell(Json& entry) const {
  entry["windows"] = count;
  entry["running"] = hex(running);
}

void RunFolder::log(const CommittedWindows& committed, const SeriesRow& row, std::uint32_t deepest) {
  Json entry = window_line(committed, row.time, row.breakpoints);
  entry["events"] = row.events_in_all();
  entry["timing"] = {{"deepest", deepest}};
  log(entry);
}

void RunFolder::log(const CommittedWindows& committed, double time, std::uint64_t breakpoints) {
  log(window_line(committed, time, breakpoints));
}

void RunFolder::log(const Json& entry) { log_->append(entry); }

}  // namespace noli
