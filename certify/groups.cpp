// SPDX-License-Identifier: Apache-2.0
#include "certify/groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include <noli/errors.h>
#include "certify/json.h"
#include "integrator/scene/json_text.h"
#include "trajectory/cell_features.h"
#include "trajectory/text.h"

namespace noli {
namespace {

class GroupsReader {
 public:
  GroupsReader(const std::filesystem::path& file, std::size_t vertices, const BodyNames& bodies)
      : file_(file.string()), vertices_(vertices), bodies_(bodies) {}

  Groups read() {
    const Json json = integrator::parse_json(text(), file_);
    require(json.is_object(), "", "expected an object with \"groups\" and \"ignore\"");
    for (const auto& [key, value] : json.items()) {
      require(key == "groups" || key == "ignore", "/" + key, "expected only \"groups\" and \"ignore\"");
    }
    const bool groups = json.contains("groups");
    require(groups ? json["groups"].is_object() : bodies_.known(), "/groups", "expected an object: names and vertices");
    require(!groups || !bodies_.known(), "/groups", "expected no groups: the bodies are the groups");
    require(json.contains("ignore") && json["ignore"].is_array(), "/ignore", "expected an array of pairs of groups");
    groups_.names = {""};
    groups_.exclusions.groups.assign(vertices_, 0);
    if (groups) {
      for (const auto& [name, list] : json["groups"].items()) group(name, list);
    } else {
      group_by_bodies();
    }
    for (std::size_t i = 0; i < json["ignore"].size(); ++i) pair(json["ignore"][i], fmt::format("/ignore/{}", i));
    auto& pairs = groups_.exclusions.pairs;
    require(!pairs.empty(), "/ignore", "expected at least one pair of groups");
    std::ranges::sort(pairs);
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return std::move(groups_);
  }

 private:
  void require(bool condition, const std::string& pointer, const std::string& message) const {
    if (!condition) throw InputError(file_, pointer, message);
  }

  std::string text() const {
    std::error_code error;
    require(std::filesystem::is_regular_file(file_, error), "", "cannot be opened; expected a JSON file");
    return read_whole_file(file_);
  }

  void group(const std::string& name, const Json& list) {
    const std::string at = "/groups/" + name;
    require(!name.empty(), at, "expected a group with a name");
    require(groups_.names.size() <= std::numeric_limits<std::uint16_t>::max(), at, "expected at most 65,535 groups");
    require(list.is_array() && !list.empty(), at, "expected an array of vertices, or of [first, last]");
    const auto number = static_cast<std::uint16_t>(groups_.names.size());
    groups_.names.push_back(name);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string place = fmt::format("{}/{}", at, i);
      const bool range = list[i].is_array() && list[i].size() == 2;
      require(range || list[i].is_number_unsigned(), place, "expected a vertex, or [first, last]");
      const std::size_t first = vertex(range ? list[i][0] : list[i], place);
      const std::size_t last = vertex(range ? list[i][1] : list[i], place);
      require(first <= last, place, "expected the first vertex before the last");
      for (std::size_t v = first; v <= last; ++v) {
        auto& mine = groups_.exclusions.groups[v];
        require(mine == 0, place, fmt::format("vertex {} is in group {} already", v, groups_.names[mine]));
        mine = number;
      }
    }
  }

  void group_by_bodies() {
    for (const BodyNames::Body& body : bodies_.bodies()) {
      const auto number = static_cast<std::uint16_t>(groups_.names.size());
      groups_.names.push_back(body.name);
      const auto first = groups_.exclusions.groups.begin() + static_cast<std::ptrdiff_t>(body.first);
      std::fill_n(first, body.vertices, number);
    }
  }

  std::size_t vertex(const Json& json, const std::string& place) const {
    require(json.is_number_unsigned(), place, "expected the number of a vertex");
    const auto v = json.get<std::uint64_t>();
    require(v < vertices_, place, fmt::format("there is no vertex {}; expected one below {}", v, vertices_));
    return v;
  }

  void pair(const Json& json, const std::string& place) {
    const bool two = json.is_array() && json.size() == 2 && json[0].is_string() && json[1].is_string();
    require(two, place, "expected the names of two groups, or of one twice");
    const auto [a, b] = std::minmax({number_of(json[0], place), number_of(json[1], place)});
    groups_.exclusions.pairs.push_back({a, b});
  }

  std::uint16_t number_of(const Json& json, const std::string& place) const {
    const auto name = json.get<std::string>();
    const auto found = std::find(groups_.names.begin() + 1, groups_.names.end(), name);
    require(found != groups_.names.end(), place, "there is no group " + name);
    return static_cast<std::uint16_t>(found - groups_.names.begin());
  }

  std::string file_;
  std::size_t vertices_;
  const BodyNames& bodies_;
  Groups groups_;
};

}  // namespace

Groups read_groups(const std::filesystem::path& file, std::size_t vertices, const BodyNames& bodies) {
  return GroupsReader(file, vertices, bodies).read();
}

void require_whole_cells(const std::filesystem::path& file, const Groups& groups, const Mesh& mesh) {
  for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
    const auto vertices = corners(mesh, c);
    const auto group = [&](int i) { return groups.exclusions.groups[vertices[static_cast<std::size_t>(i)]]; };
    for (int i = 1; i < corner_count(mesh, c); ++i) {
      if (group(i) == group(0)) continue;
      throw InputError(file.string(), "",
                       fmt::format("vertices {} and {} of cell {} are in two groups; expected one", vertices[0],
                                   vertices[static_cast<std::size_t>(i)], c));
    }
  }
}

}  // namespace noli
