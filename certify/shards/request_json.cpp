// SPDX-License-Identifier: Apache-2.0
#include "certify/shards/request_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <stdexcept>

#include <noli/version.h>
#include "trajectory/blocks/run_manifest.h"
#include "trajectory/blocks/sha256.h"
#include "trajectory/input_file.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

/// Names of files may have any bytes, and JSON has text: what is not ASCII is written as %XX.
std::string escaped(const fs::path& path) {
  std::string text;
  for (const char c : path.string()) {
    const auto byte = static_cast<unsigned char>(c);
    text += byte == '%' || byte >= 0x80 || byte < 0x20 ? fmt::format("%{:02x}", byte) : std::string(1, c);
  }
  return text;
}

fs::path unescaped(const std::string& text) {
  std::string name;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      name += text[i];
      continue;
    }
    unsigned char byte = 0;
    const char *const digits = text.data() + i + 1, *const end = text.data() + std::min(i + 3, text.size());
    if (std::from_chars(digits, end, byte, 16).ptr != digits + 2) throw std::invalid_argument("a name with a lone %");
    name += static_cast<char>(byte);
    i += 2;
  }
  return name;
}

template <class Number>
Number between(const Json& json, Number least, Number greatest) {
  const auto number = json.get<double>();
  if (!(number >= static_cast<double>(least) && number <= static_cast<double>(greatest))) {
    throw std::invalid_argument("a number out of range");
  }
  return json.get<Number>();
}

Json names_json(const std::vector<fs::path>& files) {
  Json names = Json::array();
  for (const fs::path& file : files) names.push_back(escaped(file));
  return names;
}

std::vector<fs::path> names_of(const Json& json) {
  std::vector<fs::path> files;
  for (const Json& name : json) files.push_back(unescaped(name.get<std::string>()));
  return files;
}

Json bodies_json(const std::vector<BodyFrames>& bodies) {
  Json list = Json::array();
  for (const BodyFrames& body : bodies) {
    list.push_back({{"name", escaped(body.name)}, {"frames", names_json(body.frames)}, {"still", body.still}});
  }
  return list;
}

Json ignore_json(const VerifyWork& request) {
  if (!request.ignore) return nullptr;
  return {{"file", escaped(*request.ignore)}, {"sha256", hex(sha256(InputFile(*request.ignore).read_to_end()))}};
}

/// From which scene the windows are integrated again.
Json reproduce_json(const VerifyWork& request) {
  if (!request.reproduce) return nullptr;
  const fs::path& run = request.frames.at(0);
  return {{"manifest", hex(manifest_hash(run))}, {"scene", hex(sha256(read_scene(run, read_manifest(run))))}};
}

}  // namespace

bool are_proved(const VerifyWork& request) { return request.check || request.needs_proof(); }

Json request_json(const VerifyWork& request) {
  return {{"format", "noli shards"},
          {"version", 1},
          {"noli", {{"version", version_number()}, {"commit", version_commit()}}},
          {"proved", are_proved(request)},
          {"check", request.check},
          {"dimension", or_null(request.dimension)},
          {"max_reports", request.max_reports},
          {"keep_going", request.keep_going},
          {"first_only", request.first_only},
          {"strict", request.strict},
          {"points", request.points},
          {"static", request.constant_motion},
          {"merge_identical", request.merge_identical},
          {"only_new", request.only_new},
          {"divide", request.divide},
          {"min_distance", request.min_distance},
          {"ring", request.ring},
          {"ignore", ignore_json(request)},
          {"polygons", request.reading.polygons == PolygonRule::fan ? "fan" : "refuse"},
          {"keys", request.reading.keys},
          {"bodies", bodies_json(request.reading.bodies)},
          {"run", request.run},
          {"reproduce", reproduce_json(request)},
          {"scene_folder", request.scene_folder ? Json(escaped(*request.scene_folder)) : Json()},
          {"ordered", request.ordered},
          {"order_notes", request.order_notes},
          {"frames", names_json(request.frames)}};
}

VerifyWork request_of_json(const Json& json) {
  VerifyWork request;
  if (!json.at("dimension").is_null()) request.dimension = between(json.at("dimension"), 2, 3);
  request.max_reports = json.at("max_reports").get<std::size_t>();
  request.keep_going = json.at("keep_going").get<bool>();
  request.first_only = json.at("first_only").get<bool>();
  request.strict = json.at("strict").get<bool>();
  request.points = json.at("points").get<bool>();
  request.constant_motion = json.at("static").get<bool>();
  request.merge_identical = json.at("merge_identical").get<bool>();
  request.only_new = json.at("only_new").get<bool>();
  request.divide = json.at("divide").get<bool>();
  request.min_distance = between(json.at("min_distance"), 0.0, std::numeric_limits<double>::max());
  request.ring = between(json.at("ring"), std::uint32_t{1}, std::uint32_t{255});
  if (!json.at("ignore").is_null()) request.ignore = unescaped(json.at("ignore").at("file").get<std::string>());
  const auto polygons = json.at("polygons").get<std::string>();
  if (polygons != "fan" && polygons != "refuse") throw std::invalid_argument("an unknown rule for polygons");
  request.reading.polygons = polygons == "fan" ? PolygonRule::fan : PolygonRule::refuse;
  request.reading.keys = json.at("keys").get<std::vector<std::string>>();
  for (const Json& body : json.at("bodies")) {
    request.reading.bodies.push_back({unescaped(body.at("name").get<std::string>()).string(),
                                      names_of(body.at("frames")), body.at("still").get<bool>()});
  }
  request.run = json.at("run").get<bool>();
  request.reproduce = !json.at("reproduce").is_null();
  if (!json.at("scene_folder").is_null()) request.scene_folder = unescaped(json.at("scene_folder").get<std::string>());
  request.ordered = json.at("ordered").get<std::string>();
  request.order_notes = json.at("order_notes").get<std::vector<std::string>>();
  request.frames = names_of(json.at("frames"));
  request.check = json.at("check").get<bool>();
  return request;
}

}  // namespace noli
