// SPDX-License-Identifier: Apache-2.0
//
// `manifest.json` in the folder of a run: what the folder is, of which scene and by which versions. Beside it is the
// scene. FORMAT.md lists the members.
//
// Times of day, names of machines and numbers of threads go to the log (run_log.h) instead.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "trajectory/blocks/sha256.h"

namespace noli {

struct RunManifest {
  Sha256Digest scene_sha256{};
  std::map<std::string, std::string> versions;  ///< of the program and its libraries, by name
  std::optional<Sha256Digest> model_sha256;     ///< of the model made from the scene and the files that it names

  friend bool operator==(const RunManifest&, const RunManifest&) = default;
};

/// Writes scene.json and then manifest.json, each whole or not at all. Returns the hash of the manifest. Throws
/// std::system_error.
Sha256Digest write_manifest(const std::filesystem::path& folder, std::string_view scene,
                            const std::map<std::string, std::string>& versions,
                            const std::optional<Sha256Digest>& model = std::nullopt);

/// The hash of the bytes of manifest.json. Throws InputError when it cannot be read.
Sha256Digest manifest_hash(const std::filesystem::path& folder);

/// Throws InputError: no manifest, not JSON, of another format or version, a member that is missing or of another type.
/// Unknown members are ignored.
RunManifest read_manifest(const std::filesystem::path& folder);

/// The copy of the scene file. Throws InputError when it is missing or has another hash than the manifest says.
std::string read_scene(const std::filesystem::path& folder, const RunManifest& manifest);

}  // namespace noli
