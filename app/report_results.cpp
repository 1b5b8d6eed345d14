// SPDX-License-Identifier: Apache-2.0
#include "noli/app/report_results.h"

#include <fmt/format.h>

#include "noli/trajectory/error.h"
#include "noli/trajectory/text.h"

namespace noli::app {
namespace {

constexpr std::size_t most_listed = 1000;

/// Calls f, which takes members as they should be.
template <class F>
auto as_written(const std::filesystem::path& path, F&& f) {
  try {
    return f();
  } catch (const Json::exception& error) {
    throw InputError(path.string(), "", fmt::format("is no result of noli verify: {}", error.what()));
  }
}

std::string words(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

void require_vertices(const Json& feature, std::optional<std::uint64_t> vertices, const std::filesystem::path& path) {
  const bool of_three = feature.size() >= 1 && feature.size() <= 3;
  if (!of_three) throw InputError(path.string(), "", "names a feature that has not one to three vertices");
  for (const Json& v : feature) {
    const auto number = v.get<std::uint64_t>();
    if (vertices && number >= *vertices) {
      throw InputError(path.string(), "",
                       fmt::format("names vertex {}, but the mesh that is shown has {}", number, *vertices));
    }
  }
}

Json contacts(const Json& result, std::optional<std::uint64_t> vertices, const std::filesystem::path& path) {
  std::uint64_t total = 0;
  for (const auto& [kind, count] : result.at("contacts").items()) total += count.get<std::uint64_t>();
  Json listed = Json::array();
  for (const Json& contact : result.at("reports").at("contacts")) {
    if (listed.size() == most_listed) break;
    for (const Json& feature : contact.at("features")) require_vertices(feature, vertices, path);
    listed.push_back({{"step", contact.at("step").get<std::uint64_t>()},
                      {"pair", contact.at("pair").get<std::string>()},
                      {"features", contact.at("features")}});
  }
  return {{"counts", result.at("contacts")},
          {"total", total},
          {"initial", result.at("initial_intersections").get<std::uint64_t>()},
          {"listed", listed}};
}

Json lines(const Json& result, const Json& contacts) {
  Json lines = Json::array();
  lines.push_back(fmt::format("{} of {} step(s) were looked at; {} pair(s) of features meet.",
                              result.at("steps").get<std::uint64_t>(), result.at("steps_total").get<std::uint64_t>(),
                              contacts.at("total").get<std::uint64_t>()));
  if (!result.at("complete").get<bool>()) lines.push_back("Not all that was asked for was decided.");
  if (const Json& first = result.at("first"); !first.is_null()) {
    lines.push_back(fmt::format("The first is a {}, in step {} at time {}.", words(first.at("kind")),
                                first.at("step").get<std::uint64_t>(), digits17(first.at("time").get<double>())));
  }
  if (const Json proof = result.value("proof", Json::object()); !proof.value("checked", Json()).is_null()) {
    lines.push_back(fmt::format("The checker of proofs said: {}.", words(proof.at("checked"))));
  }
  return lines;
}

}  // namespace

Json read_result(const std::filesystem::path& path) {
  const std::string text = read_whole_file(path);
  Json result;
  try {
    result = Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw InputError(path.string(), byte_place(error.byte), "is no JSON: expected a result of noli");
  }
  if (!result.is_object()) throw InputError(path.string(), "", "expected an object, a result of noli");
  return result;
}

bool is_of_verify(const Json& result) { return result.contains("statement") && result.contains("reports"); }

VerifiedSteps verified_steps(const Json& result, const std::filesystem::path& path) {
  return as_written(path, [&] {
    const Json& statement = result.at("statement");
    const bool run = statement.contains("windows");
    return VerifiedSteps{run, statement.at(run ? "windows" : "frames").get<std::uint64_t>(),
                         statement.at("static").get<bool>()};
  });
}

void put_verdict(const Json& result, const std::filesystem::path& path, std::optional<std::uint64_t> vertices,
                 ReportPage& report) {
  as_written(path, [&] {
    Json& page = report.page;
    page["contacts"] = contacts(result, vertices, path);
    page["verdict"] = {{"word", result.at("verdict").get<std::string>()}, {"lines", lines(result, page["contacts"])}};
    page["statement"] = Json::array();
    for (const auto& [key, value] : result.at("statement").items()) {
      if (value.is_string() || (value.is_array() && !value.empty())) page["statement"].push_back({key, words(value)});
    }
  });
}

}  // namespace noli::app
