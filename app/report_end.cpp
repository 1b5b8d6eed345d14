// SPDX-License-Identifier: Apache-2.0
#include "noli/app/report_end.h"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <system_error>
#include <vector>

#include "noli/app/json.h"

namespace noli::app {
namespace {

bool is_end(const Json& entry) {
  return entry.is_object() && entry.contains("event") && entry["event"] == "end" && entry.contains("end");
}

/// Lines that are no end of a part, or no JSON, are passed over.
Json last_end(const std::filesystem::path& log) {
  Json last;
  if (!std::filesystem::exists(log)) return last;
  std::ifstream in(log, std::ios::binary);
  for (std::string line; std::getline(in, line);) {
    if (line.find("\"end\"") == std::string::npos) continue;
    Json entry = Json::parse(line, nullptr, false);
    if (is_end(entry)) last = std::move(entry);
  }
  if (in.bad() || !in.eof()) throw std::system_error(errno, std::generic_category(), log.string());
  return last;
}

std::string feature(const Json& vertices, const BodyNames& names) {
  const auto list = vertices.get<std::vector<VertexId>>();
  return list.empty() || list.size() > 3 ? "something" : names.feature(list);
}

std::string words_of(const Json& end, const BodyNames& names) {
  if (end.at("end") == "contact") {
    const Json& features = end.at("first").at("features");
    return fmt::format("{} meets {}, {}, at {} s", feature(features.at(0), names), feature(features.at(1), names),
                       end.at("first").at("kind").get<std::string>(), digits17(end.at("first_time").get<double>()));
  }
  if (end.at("end") != "too_near") return "";
  const Json& near = end.at("too_near");
  return fmt::format("{}, at {} s", near.at("names").get<std::string>(), digits17(near.at("time").get<double>()));
}

}  // namespace

std::string what_ended(const std::filesystem::path& run, const BodyNames& names) {
  const Json end = last_end(run / "log.jsonl");
  try {
    return end.is_null() ? "" : words_of(end, names);
  } catch (const Json::exception&) {
    return "";
  }
}

}  // namespace noli::app
