// SPDX-License-Identifier: Apache-2.0
//
// The folder of shards: request.json, which all of them answer, and a file for each finished task.
//
// Processes on any machine may work in it at once: every file appears under its name when it is complete, and whoever
// does a task twice writes the same bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "certify/json.h"

namespace noli {

class ShardFolder {
 public:
  /// Makes the folder if it is not there, for the shards of this request. Throws UsageError when it has shards of
  /// another one, std::system_error.
  ShardFolder(std::filesystem::path folder, const Json& request);
  /// A folder that is there. Throws InputError when it has no request.json of this version of Noli.
  explicit ShardFolder(std::filesystem::path folder);

  const Json& request() const { return request_; }
  /// The SHA-256 of request.json, by which each shard names it.
  const std::string& request_hash() const { return request_hash_; }
  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path shard(std::uint64_t task) const;
  bool has(std::uint64_t task) const;

 private:
  std::filesystem::path request_file() const { return folder_ / "request.json"; }

  std::filesystem::path folder_;
  Json request_;
  std::string request_hash_;
};

}  // namespace noli
