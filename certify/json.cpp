// SPDX-License-Identifier: Apache-2.0
#include "certify/json.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace noli {
namespace {

void write(const Json& value, std::size_t depth, std::string& out);

void new_line(std::size_t depth, std::string& out) { out.append(1, '\n').append(2 * depth, ' '); }

std::string json_string(const std::string& text) {
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

void write_array(const Json& array, std::size_t depth, std::string& out) {
  const bool flat = std::none_of(array.begin(), array.end(), [](const Json& item) { return item.is_structured(); });
  out += '[';
  bool first = true;
  for (const Json& item : array) {
    if (!first) out += flat ? ", " : ",";
    if (!flat) new_line(depth + 1, out);
    write(item, depth + 1, out);
    first = false;
  }
  if (!flat) new_line(depth, out);
  out += ']';
}

void write_object(const Json& object, std::size_t depth, std::string& out) {
  out += '{';
  bool first = true;
  for (const auto& [key, item] : object.items()) {
    if (!first) out += ',';
    new_line(depth + 1, out);
    out += json_string(key) + ": ";
    write(item, depth + 1, out);
    first = false;
  }
  if (!object.empty()) new_line(depth, out);
  out += '}';
}

void write(const Json& value, std::size_t depth, std::string& out) {
  if (value.is_object()) {
    write_object(value, depth, out);
  } else if (value.is_array()) {
    write_array(value, depth, out);
  } else if (value.is_number_float()) {
    out += std::isfinite(value.get<double>()) ? digits17(value.get<double>()) : "null";
  } else if (value.is_string()) {
    out += json_string(value.get<std::string>());
  } else {
    out += value.dump();
  }
}

}  // namespace

std::string digits4(double number) {
  const std::string rounded = fmt::format("{:.4g}", number);
  const bool as_late_as_the_end = number < 1 && std::strtod(rounded.c_str(), nullptr) >= 1;
  return as_late_as_the_end ? "0.9999" : rounded;
}

std::string digits17(double number) {
  std::string text = fmt::format("{:.17g}", number);
  if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
  return text;
}

std::string to_text(const Json& document) {
  std::string out;
  write(document, 0, out);
  return out += '\n';
}

Json stages_json(const StageCounters& stages) {
  Json json = Json::object();
  for (const Stage stage : all_stages) json[std::string(name(stage))] = stages[stage];
  return json;
}

}  // namespace noli
