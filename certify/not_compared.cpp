// SPDX-License-Identifier: Apache-2.0
#include "certify/not_compared.h"

#include <fmt/format.h>

#include <algorithm>

#include <noli/errors.h>
#include "trajectory/cells.h"

namespace noli {
namespace {

constexpr std::size_t most_named = 8;

/// The body of a group's vertices, or the number of the group if no body is known.
std::string group_name(std::uint16_t group, const Exclusions& exclusions, const BodyNames& names) {
  const auto found = std::find(exclusions.groups.begin(), exclusions.groups.end(), group);
  const VertexId vertex[] = {static_cast<VertexId>(found - exclusions.groups.begin())};
  const std::vector<std::string> body = names.bodies_of(vertex);
  return body.empty() ? fmt::format("group {}", group) : body[0];
}

/// "a, b and c", or the first of many.
std::string list_text(const std::vector<std::string>& names) {
  const std::size_t shown = std::min(names.size(), most_named);
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) {
    const char* const before = i + 1 == names.size() ? " and " : ", ";
    text += (i == 0 ? "" : before) + on_one_line(names[i]);
  }
  return shown < names.size() ? fmt::format("{} and {} more bodies", text, names.size() - shown) : text;
}

std::string excluded_text(const NotCompared& left_out) {
  const auto& pairs = left_out.excluded;
  const std::size_t shown = std::min(pairs.size(), most_named);
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) text += (i == 0 ? "two cells of " : "; of ") + pair_text(pairs[i]);
  if (shown < pairs.size()) text += fmt::format("; of {} more pairs of bodies", pairs.size() - shown);
  return text + " (excluded)";
}

std::string what_is_not_compared(const NotCompared& left_out) {
  std::string what;
  if (left_out.any_held) what = held_text(left_out);
  if (!left_out.excluded.empty()) what += (what.empty() ? "" : "; ") + excluded_text(left_out);
  if (left_out.baseline > 0) what += (what.empty() ? "" : "; ") + baseline_text(left_out);
  return what;
}

}  // namespace

std::string baseline_text(const NotCompared& left_out) {
  const bool one = left_out.baseline == 1;
  return fmt::format("{} of cells that {} in the first frame",
                     one ? "1 pair" : fmt::format("{} pairs", left_out.baseline), one ? "intersects" : "intersect");
}

NotCompared not_compared(const Mesh& mesh, std::span<const std::uint8_t> held, const Exclusions& exclusions,
                         const BodyNames& names) {
  NotCompared result;
  const std::vector<VertexId> cells = held_cells(mesh, held);
  result.held = names.bodies_of(cells);
  result.any_held = cells.size() > 1;
  if (!result.any_held) result.held.clear();
  for (const auto& [a, b] : exclusions.pairs) {
    result.excluded.push_back({group_name(a, exclusions, names), group_name(b, exclusions, names)});
  }
  return result;
}

std::string held_text(const NotCompared& left_out) {
  const std::string of = left_out.held.empty() ? "" : " of " + list_text(left_out.held);
  return fmt::format("two cells{} whose vertices are all scripted or pinned", of);
}

std::string pair_text(const std::array<std::string, 2>& pair) {
  const std::string a = on_one_line(pair[0]);
  return pair[0] == pair[1] ? a : a + " and " + on_one_line(pair[1]);
}

std::string nothing_touches(const NotCompared& left_out, const std::string& where) {
  if (!left_out.any()) return fmt::format("Nothing touches {}.", where);
  return fmt::format("Nothing that is compared touches {}. Not compared: {}.", where, what_is_not_compared(left_out));
}

std::string nothing_touches_in_short(const NotCompared& left_out) {
  if (!left_out.any()) return "nothing touches";
  return fmt::format("nothing that is compared touches; not compared: {}", what_is_not_compared(left_out));
}

}  // namespace noli
