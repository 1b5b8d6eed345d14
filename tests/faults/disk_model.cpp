// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/disk_model.h"

#include <fcntl.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace noli::app_tests {
namespace {

using What = DiskAction::What;

[[noreturn]] void fail(const std::string& why) { throw std::runtime_error("a record of a disk: " + why); }

What what_of(const std::string& word) {
  static const std::map<std::string, What> words = {
      {"open", What::open},         {"write", What::write},   {"seek", What::seek},
      {"truncate", What::truncate}, {"sync", What::sync},     {"close", What::close},
      {"rename", What::rename},     {"unlink", What::unlink}, {"mkdir", What::make_folder}};
  const auto found = words.find(word);
  if (found == words.end()) fail("'" + word + "' is no action");
  return found->second;
}

std::string rest_of(std::istringstream& line) {
  std::string rest;
  line.get();
  std::getline(line, rest);
  return rest;
}

DiskAction action_of(const std::string& text) {
  std::istringstream line(text);
  std::string word;
  line >> word;
  DiskAction action;
  action.what = what_of(word);
  if (action.what == What::rename || action.what == What::unlink || action.what == What::make_folder) {
    const std::string paths = rest_of(line);
    const std::size_t tab = std::min(paths.find('\t'), paths.size());
    action.path = paths.substr(0, tab);
    action.to = paths.substr(std::min(tab + 1, paths.size()));
    return action;
  }
  line >> action.file;
  if (action.what != What::sync && action.what != What::close) line >> action.number;
  if (!line) fail("'" + text + "'");
  if (action.what == What::open) action.path = rest_of(line);
  return action;
}

bool coin(std::mt19937_64& random) { return (random() >> 32 & 1) != 0; }

std::size_t below(std::size_t end, std::mt19937_64& random) { return end == 0 ? 0 : random() % end; }

}  // namespace

std::vector<DiskAction> read_actions(std::string_view record) {
  std::vector<DiskAction> actions;
  while (!record.empty()) {
    const std::size_t end = record.find('\n');
    if (end == std::string_view::npos) fail("a line without an end");
    actions.push_back(action_of(std::string(record.substr(0, end))));
    record.remove_prefix(end + 1);
    DiskAction& action = actions.back();
    if (action.what != What::write) continue;
    const auto size = static_cast<std::size_t>(action.number);
    if (size > record.size()) fail("a write without its bytes");
    action.bytes = record.substr(0, size);
    record.remove_prefix(size);
  }
  return actions;
}

std::string DiskModel::name_of(const std::string& path) const {
  if (std::filesystem::path(path).parent_path() != folder_) fail(path + " is not in the folder");
  return std::filesystem::path(path).filename();
}

void DiskModel::carry_out(const Naming& naming, std::map<std::string, File>& names) {
  if (!naming.gone.empty()) names.erase(naming.gone);
  if (naming.file) {
    names[naming.name] = naming.file;
  } else {
    names.erase(naming.name);
  }
}

void DiskModel::carry_out(const Change& change, std::string& bytes) {
  if (change.cut) bytes.resize(change.offset);
  if (change.bytes.empty()) return;
  if (bytes.size() < change.offset + change.bytes.size()) bytes.resize(change.offset + change.bytes.size());
  bytes.replace(change.offset, change.bytes.size(), change.bytes);
}

void DiskModel::name(Naming naming) {
  carry_out(naming, now_);
  pending_.push_back(std::move(naming));
}

void DiskModel::open(const DiskAction& action) {
  if (is_folder(action.path)) {
    open_[action.file] = {};
    return;
  }
  const std::string file_name = name_of(action.path);
  if (now_.count(file_name) == 0) name({file_name, std::make_shared<Content>(), ""});
  const File file = now_.at(file_name);
  open_[action.file] = {file, 0};
  if ((action.number & O_TRUNC) == 0) return;
  file->pending.push_back({0, "", true});
  file->now.clear();
}

void DiskModel::write(const DiskAction& action) {
  Open& open = open_.at(action.file);
  const Change change{open.offset, action.bytes, false};
  carry_out(change, open.file->now);
  open.file->pending.push_back(change);
  open.offset += action.bytes.size();
}

void DiskModel::truncate(const DiskAction& action) {
  const Change change{static_cast<std::size_t>(action.number), "", true};
  Content& content = *open_.at(action.file).file;
  carry_out(change, content.now);
  content.pending.push_back(change);
}

void DiskModel::sync(const DiskAction& action) {
  if (const File& file = open_.at(action.file).file) {
    file->synced = file->now;
    file->pending.clear();
  } else {
    synced_ = now_;
    pending_.clear();
  }
}

void DiskModel::apply(const DiskAction& action) {
  switch (action.what) {
    case What::open: return open(action);
    case What::write: return write(action);
    case What::seek: open_.at(action.file).offset = static_cast<std::size_t>(action.number); return;
    case What::truncate: return truncate(action);
    case What::sync: return sync(action);
    case What::close: open_.erase(action.file); return;
    case What::rename: return name({name_of(action.to), now_.at(name_of(action.path)), name_of(action.path)});
    case What::unlink: return name({name_of(action.path), nullptr, ""});
    case What::make_folder: return;
  }
}

/// The synced bytes, with some of the pending changes.
std::string DiskModel::left_of(const Content& content, std::mt19937_64& random) {
  std::string bytes = content.synced;
  std::vector<Change> pending = content.pending;
  if (coin(random)) std::shuffle(pending.begin(), pending.end(), random);
  for (Change& change : pending) {
    if (coin(random)) continue;
    if (coin(random)) {
      const std::size_t from = below(change.bytes.size(), random);
      change.bytes = change.bytes.substr(from, 1 + below(change.bytes.size() - from, random));
      change.offset += from;
    }
    if (!change.cut || change.offset <= bytes.size()) carry_out(change, bytes);
  }
  return bytes;
}

void DiskModel::leave(const std::filesystem::path& target, std::mt19937_64& random) const {
  std::map<std::string, File> names = synced_;
  for (const Naming& naming : pending_) {
    if (coin(random)) carry_out(naming, names);
  }
  std::filesystem::create_directories(target);
  for (const auto& [file_name, file] : names) {
    const std::string bytes = left_of(*file, random);
    std::ofstream(target / file_name, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
}

}  // namespace noli::app_tests
