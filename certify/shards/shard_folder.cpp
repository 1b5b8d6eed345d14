// SPDX-License-Identifier: Apache-2.0
#include "certify/shards/shard_folder.h"

#include <fmt/format.h>

#include <utility>

#include <noli/errors.h>
#include <noli/version.h>
#include "certify/shards/shard_file.h"
#include "trajectory/blocks/sha256.h"
#include "trajectory/input_file.h"
#include "trajectory/replaced_file.h"
#include "trajectory/write_file.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

/// Throws InputError when this program did not write it: another version may have found other things.
Json parse_request(const std::string& text, const std::string& name) {
  Json json = Json::parse(text, nullptr, false);
  const auto has = [&](const char* member, const Json& value) {
    return json.is_object() && json.contains(member) && json[member] == value;
  };
  if (!has("format", "noli shards") || !has("version", 1)) {
    throw InputError(name, "", "is not a request of shards; expected the folder that `noli verify --shard` wrote");
  }
  const auto word = [&](const char* member) { return json.at("noli").at(member).get<std::string>(); };
  const auto [version, commit] = reading(name, [&] { return std::pair(word("version"), word("commit")); });
  if (version != version_number() || commit != version_commit()) {
    throw InputError(name, "",
                     fmt::format("the shards are from Noli {} ({}), this is {} ({}); expected the same version",
                                 version, commit, version_number(), version_commit()));
  }
  return json;
}

void make(const fs::path& folder) {
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (folder.empty() || error || !fs::is_directory(folder, error)) {
    throw UsageError(fmt::format("\"{}\" cannot be made{}; expected a folder for shards", on_one_line(folder.string()),
                                 error ? ": " + error.message() : ""));
  }
}

void require_regular(const fs::path& file) {
  std::error_code error;
  if (fs::exists(file, error) && !fs::is_regular_file(file, error)) {
    throw InputError(file.string(), "", "is not a regular file; expected one that `noli verify --shard` wrote");
  }
}

std::string read_request(const fs::path& file) {
  require_regular(file);
  return InputFile(file).read_to_end();
}

/// Writes the file, unless another process has done so meanwhile.
void publish(const std::string& text, const fs::path& file) {
  const ReplacedFile part(file, {.name = ScratchName::random});
  write_file(part.path(), text);
  std::error_code error;
  fs::create_hard_link(part.path(), file, error);
  if (!fs::exists(file)) replace_file(file, text);  // no hard links in this file system
}

/// The first member in which two requests differ.
std::string difference(const Json& asked, const Json& found) {
  if (asked.at("frames") != found.value("frames", Json())) return "frames";
  for (const auto& [key, value] : asked.items()) {
    if (!found.contains(key) || found[key] != value) return key;
  }
  return "an unknown member";
}

}  // namespace

ShardFolder::ShardFolder(fs::path folder, const Json& request) : folder_(std::move(folder)), request_(request) {
  make(folder_);
  const std::string text = to_text(request);
  if (!fs::exists(request_file())) publish(text, request_file());
  const std::string there = read_request(request_file());
  if (there != text) {
    const Json other = parse_request(there, request_file().string());
    throw UsageError(
        fmt::format("{}: has the shards of another request, which differs in \"{}\"; expected a new folder",
                    on_one_line(folder_.string()), difference(request, other)));
  }
  request_hash_ = hex(sha256(text));
}

ShardFolder::ShardFolder(fs::path folder) : folder_(std::move(folder)) {
  if (!fs::exists(request_file())) {
    throw InputError(folder_.string(), "", "has no request.json; expected the folder that `noli verify --shard` wrote");
  }
  const std::string text = read_request(request_file());
  request_ = parse_request(text, request_file().string());
  request_hash_ = hex(sha256(text));
}

fs::path ShardFolder::shard(std::uint64_t task) const { return folder_ / fmt::format("task_{:06}.shard", task + 1); }

bool ShardFolder::has(std::uint64_t task) const {
  require_regular(shard(task));
  return fs::exists(shard(task));
}

}  // namespace noli
