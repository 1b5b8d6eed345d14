// SPDX-License-Identifier: Apache-2.0
#include "report/page/report_statement.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "report/page/report_verdict.h"

namespace noli::report {
namespace {

/// Of members whose names say too little without the manual.
constexpr std::pair<std::string_view, std::string_view> names[] = {
    {"excluded", "not compared"},
    {"min_distance", "least distance"},
    {"min_distance_from_ring", "features fewer edges apart need only be disjoint"},
    {"strict", "features of one cell are compared too"},
    {"points", "unreferenced vertices count as points"},
    {"static", "each frame by itself, at rest"},
    {"keep_going", "checks all steps instead of stopping at the first contact"},
    {"first_only", "stops at any contact, which need not be the earliest"},
    {"merge_identical", "vertices that are always in one place are merged"},
    {"merged_vertices", "vertices that were merged"},
    {"unreferenced_vertices_left_out", "unreferenced vertices that are ignored"},
};

std::string name_of(const std::string& key) {
  const auto* const found = std::ranges::find(names, key, &std::pair<std::string_view, std::string_view>::first);
  return found == std::end(names) ? spoken(key) : std::string(found->second);
}

std::string list_words(const Json& list) {
  std::string text;
  for (const Json& item : list) text += (text.empty() ? "" : "; ") + value_in_words(item);
  return text.empty() ? "nothing" : text;
}

/// What these members are unless an option or the input says otherwise. Members that are not here never differ.
const Json& defaults() {
  static const Json values = {{"excluded", Json::array()},
                              {"min_distance", 0},
                              {"min_distance_from_ring", 1},
                              {"strict", false},
                              {"points", false},
                              {"static", false},
                              {"keep_going", false},
                              {"first_only", false},
                              {"merge_identical", false},
                              {"merged_vertices", 0},
                              {"unreferenced_vertices_left_out", 0},
                              {"reproduced", false},
                              {"notes", Json::array()}};
  return values;
}

bool differs(const std::string& key, const Json& value) {
  return defaults().contains(key) && defaults().at(key) != value;
}

}  // namespace

std::string value_in_words(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return fmt::format("{}", value.get<double>());
  if (value.is_array()) return list_words(value);
  return value.is_null() ? "none" : value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json statement_in_words(const Json& statement) {
  Json rows = Json::array();
  for (const auto& [key, value] : statement.items()) {
    rows.push_back({name_of(key), value_in_words(value), key == "claim" || differs(key, value)});
  }
  return rows;
}

}  // namespace noli::report
