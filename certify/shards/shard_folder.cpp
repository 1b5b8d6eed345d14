// SPDX-License-Identifier: Apache-2.0
#include "certify/shards/shard_folder.h"

#include <fmt/format.h>

#include <utility>

#include <noli/errors.h>
#include <noli/version.h>
#include "trajectory/blocks/sha256.h"
#include "trajectory/input_file.h"
#include "trajectory/write_file.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

/// Throws InputError when this program did not write it: another version may have found other things.
Json parse_request(const std::string& text, const std::string& name) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || json.value("format", "") != "noli shards" || json.value("version", 0) != 1) {
    throw InputError(name, "", "is no request of shards; expected the folder that `noli verify --shard` wrote");
  }
  const Json noli = json.value("noli", Json::object());
  const std::string version = noli.value("version", ""), commit = noli.value("commit", "");
  if (version != version_number() || commit != version_commit()) {
    throw InputError(name, "",
                     fmt::format("the shards are of Noli {} ({}), and this is {} ({}); expected the same program",
                                 version, commit, version_number(), version_commit()));
  }
  return json;
}

/// The first member in which two requests differ.
std::string difference(const Json& asked, const Json& found) {
  for (const auto& [key, value] : asked.items()) {
    if (!found.contains(key) || found[key] != value) return key;
  }
  return "nothing that is known";
}

}  // namespace

ShardFolder::ShardFolder(fs::path folder, const Json& request) : folder_(std::move(folder)), request_(request) {
  fs::create_directories(folder_);
  const std::string text = to_text(request);
  if (!fs::exists(request_file())) replace_file(request_file(), text);
  const std::string there = InputFile(request_file()).read_to_end();
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
  const std::string text = InputFile(request_file()).read_to_end();
  request_ = parse_request(text, request_file().string());
  request_hash_ = hex(sha256(text));
}

fs::path ShardFolder::shard(std::uint64_t task) const { return folder_ / fmt::format("task_{:06}.shard", task + 1); }

bool ShardFolder::has(std::uint64_t task) const { return fs::exists(shard(task)); }

}  // namespace noli
