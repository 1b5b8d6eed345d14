// SPDX-License-Identifier: Apache-2.0
#include "report/page/report_end.h"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "certify/json.h"

namespace noli::report {
namespace {

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
  if (end.at("end") == "unstable") {
    const Json& energy = end.at("energy");
    return fmt::format("from {:.3g} J to {:.3g} J at {} s", energy.at("begin").get<double>(),
                       energy.at("there").get<double>(), digits17(energy.at("time").get<double>()));
  }
  if (end.at("end") != "too_near") return "";
  const Json& near = end.at("too_near");
  return fmt::format("{}, at {} s", near.at("names").get<std::string>(), digits17(near.at("time").get<double>()));
}

}  // namespace

std::string what_ended(const LogFacts& log) {
  try {
    return words_of(log.last_end_line, log.names);
  } catch (const Json::exception&) {
    return "";
  }
}

Json pair_that_ended(const LogFacts& log) {
  if (log.going_on || log.last_end != "contact") return nullptr;
  try {
    const Json& first = log.last_end_line.at("first");
    const auto features = first.at("features").get<std::array<std::vector<VertexId>, 2>>();
    for (const auto& feature : features) {
      if (feature.empty() || feature.size() > 3) return nullptr;
    }
    return {{"meets", true},
            {"features", features},
            {"time", log.last_end_line.at("first_time").get<double>()},
            {"words", "The run ends before this contact: " + words_of(log.last_end_line, log.names) + "."}};
  } catch (const Json::exception&) {
    return nullptr;
  }
}

}  // namespace noli::report
