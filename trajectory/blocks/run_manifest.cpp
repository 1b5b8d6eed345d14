// SPDX-License-Identifier: Apache-2.0
#include "trajectory/blocks/run_manifest.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include <noli/errors.h>
#include "trajectory/input_file.h"
#include "trajectory/text.h"
#include "trajectory/write_file.h"

namespace noli {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* manifest_name = "manifest.json";
constexpr const char* scene_name = "scene.json";
constexpr const char* manifest_format = "noli run";
constexpr int format_version = 1;

Json parse(const std::string& text, const std::string& file) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw InputError(file, byte_place(error.byte > 0 ? error.byte - 1 : 0), "expected JSON");
  }
}

/// The member at a JSON pointer. Throws InputError when it is absent.
const Json& member(const Json& json, const std::string& pointer, const std::string& file) {
  const Json::json_pointer place(pointer);
  if (!json.contains(place)) throw InputError(file, pointer, "is missing");
  return json.at(place);
}

std::string text_at(const Json& json, const std::string& pointer, const std::string& file) {
  const Json& value = member(json, pointer, file);
  if (!value.is_string()) throw InputError(file, pointer, "expected a string");
  return value.get<std::string>();
}

void check_format(const Json& json, const std::string& file) {
  const std::string format = text_at(json, "/format", file);
  if (format != manifest_format) {
    throw InputError(file, "/format", fmt::format("expected '{}', found {}", manifest_format, in_quotes(format)));
  }
  const Json& version = member(json, "/version", file);
  if (version != format_version) {
    throw InputError(file, "/version", fmt::format("expected {}, found {}", format_version, in_quotes(version.dump())));
  }
}

Sha256Digest digest_at(const Json& json, const std::string& pointer, const std::string& file) {
  const auto digest = digest_of_hex(text_at(json, pointer, file));
  if (!digest) throw InputError(file, pointer, "expected 64 hexadecimal digits in lower case");
  return *digest;
}

std::string read_file_of_run(const std::filesystem::path& path) {
  require_regular_file(path);
  return read_whole_file(path);
}

}  // namespace

Sha256Digest write_manifest(const std::filesystem::path& folder, std::string_view scene,
                            const std::map<std::string, std::string>& versions,
                            const std::optional<Sha256Digest>& model) {
  Json manifest = {{"format", manifest_format},
                   {"version", format_version},
                   {"scene", {{"file", scene_name}, {"sha256", hex(sha256(scene))}}},
                   {"versions", versions}};
  if (model) manifest["model"] = {{"sha256", hex(*model)}};
  replace_file(folder / scene_name, scene);
  const std::string text = manifest.dump(2) + "\n";
  replace_file(folder / manifest_name, text);
  return sha256(text);
}

Sha256Digest manifest_hash(const std::filesystem::path& folder) {
  return sha256(read_file_of_run(folder / manifest_name));
}

RunManifest read_manifest(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / manifest_name;
  const std::string file = path.string();
  const Json json = parse(read_file_of_run(path), file);
  check_format(json, file);
  RunManifest manifest;
  manifest.scene_sha256 = digest_at(json, "/scene/sha256", file);
  if (json.contains("model")) manifest.model_sha256 = digest_at(json, "/model/sha256", file);
  const Json& versions = member(json, "/versions", file);
  if (!versions.is_object()) throw InputError(file, "/versions", "expected an object");
  for (const auto& [name, version] : versions.items()) {
    if (!version.is_string()) throw InputError(file, "/versions/" + name, "expected a string");
    manifest.versions[name] = version.get<std::string>();
  }
  return manifest;
}

std::string read_scene(const std::filesystem::path& folder, const RunManifest& manifest) {
  std::string scene = read_file_of_run(folder / scene_name);
  if (sha256(scene) == manifest.scene_sha256) return scene;
  throw InputError((folder / scene_name).string(), "",
                   "is not the scene of this run: its SHA-256 is not that in the manifest");
}

}  // namespace noli
