// SPDX-License-Identifier: Apache-2.0
#include "report/input_report.h"

#include <fmt/format.h>

#include <noli/errors.h>

namespace noli::report {
namespace {

Json input_json(const FrameFacts& facts) {
  // Field by field: lists of fields are copied, and there may be 10,000 frames. An object from the start: one that
  // nlohmann makes of null crashes when it is destroyed, if there was no memory to make it.
  Json json = Json::object();
  json["file"] = facts.file;
  json["bytes"] = nullptr;
  json["sha256"] = nullptr;
  if (facts.looked_at) {
    json["bytes"] = facts.bytes;
    json["sha256"] = hex(facts.sha256);
    if (facts.numbers.empty()) return json;  // of a run
  }
  json["numbers"] = facts.looked_at ? Json(facts.numbers) : Json(nullptr);
  json["vertices"] = facts.looked_at ? Json(facts.vertices) : Json(nullptr);
  json["cells"] = or_null(facts.cells);
  if (!facts.arrays.empty()) json["arrays"] = facts.arrays;
  if (!facts.body.empty()) json["body"] = facts.body;
  if (facts.frames != 1) json["frames"] = facts.frames;
  return json;
}

}  // namespace

Json inputs_json(const std::vector<FrameFacts>& inputs) {
  Json list = Json::array();
  for (const FrameFacts& facts : inputs) list.push_back(input_json(facts));
  return list;
}

std::string polygons_text(PolygonRule rule) {
  if (rule == PolygonRule::refuse) return "a face of more than three corners is an error (--polygons refuse)";
  return "p0 p1 ... pn is cut into the triangles (p0, p1, p2), (p0, p2, p3), ..., (p0, pn-1, pn)";
}

std::string notes_text(const std::vector<std::string>& notes) {
  std::string text;
  for (const std::string& note : notes) text += fmt::format("Note: {}.\n", on_one_line(note));
  return text;
}

}  // namespace noli::report
