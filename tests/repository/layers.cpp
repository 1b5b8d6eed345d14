// SPDX-License-Identifier: Apache-2.0
#include "layers.h"

#include <initializer_list>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "workspace.h"

namespace noli::repository {
namespace fs = std::filesystem;
namespace {

using Row = std::set<std::string>;

Row with(Row row, std::initializer_list<std::string> more) {
  row.insert(more);
  return row;
}

const std::map<std::string, Row>& table() {
  static const Row geometry = {"kernel", "trajectory"};
  static const Row dynamics = with(geometry, {"certificates"});
  static const Row both_wings = with(dynamics, {"integrator", "proofs"});
  static const Row questions = with(both_wings, {"certify"});
  static const Row answers = with(questions, {"report", "proofs/checker", "oracle", "include"});
  static const std::map<std::string, Row> rows = {
      {"include", {}},
      {"kernel", {}},
      {"trajectory", {}},
      {"certificates", geometry},
      {"integrator", dynamics},
      {"proofs", geometry},
      {"proofs/checker", {}},
      {"certify", both_wings},
      {"report", questions},
      {"oracle", {}},
      {"audit", answers},
      {"app", with(answers, {"audit"})},
      {"python", with(answers, {"audit"})},
      {"examples", {"include"}},  // installed headers
  };
  return rows;
}

/// Public headers belong to the layer that implements them. The others are header-only and belong to `include`.
std::string home_of_public(const std::string& target) {
  static const std::map<std::string, std::string> homes = {
      {"noli/query.h", "kernel"},      {"noli/contact.h", "kernel"},   {"noli/time_of_impact.h", "kernel"},
      {"noli/cgal.h", "kernel"},       {"noli/mesh.h", "trajectory"},  {"noli/errors.h", "trajectory"},
      {"noli/frames.h", "trajectory"}, {"noli/run.h", "certificates"}, {"noli/findings.h", "proofs"},
      {"noli/explain.h", "certify"},   {"noli/export.h", "certify"},   {"noli/proof.h", "certify"},
      {"noli/sequence.h", "certify"},  {"noli/simulate.h", "certify"}, {"noli/verify.h", "certify"},
      {"noli/version.h", "certify"},   {"noli/repair.h", "certify"},
  };
  const auto found = homes.find(target);
  return found == homes.end() ? "include" : found->second;
}

/// True for code that may use only the public headers.
bool sees_public_alone(const fs::path& file) {
  const std::string layer = layer_of(file);
  return layer == "include" || layer == "examples";
}

bool exists_in(const fs::path& root, const fs::path& relative) {
  return !relative.empty() && *relative.begin() != ".." && fs::exists(root / relative);
}

}  // namespace

std::vector<Include> includes(std::string_view text) {
  static const std::regex directive(R"re(^\s*#\s*include(?:_next)?\s*(?:"([^"]*)"|<([^>]*)>|([^\s"<].*)))re");
  std::vector<Include> found;
  std::istringstream lines{std::string(text)};
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::smatch match;
    if (std::regex_search(line, match, directive)) found.push_back({number, match[1].str() + match[2].str()});
  }
  return found;
}

std::string layer_of(const fs::path& relative) {
  auto part = relative.begin();
  const std::string first = part->string();
  const std::string second = ++part != relative.end() ? part->string() : "";
  const std::string two = first + "/" + second;
  return table().contains(two) ? two : first;
}

std::optional<std::string> included_layer(const fs::path& root, const fs::path& file, const std::string& target) {
  const fs::path path(target);
  if (target.starts_with("noli/") && exists_in(root, "include" / path))
    return sees_public_alone(file) ? "include" : home_of_public(target);
  if (target.starts_with("noli/")) return layer_of(path.lexically_normal().lexically_relative("noli"));
  if (path.is_absolute()) {
    const fs::path inside = path.lexically_normal().lexically_relative(root);
    return exists_in(root, inside) ? std::optional(layer_of(inside)) : std::nullopt;
  }
  for (const fs::path& candidate : {(file.parent_path() / path).lexically_normal(), path.lexically_normal()}) {
    if (exists_in(root, candidate)) return layer_of(candidate);
  }
  return std::nullopt;
}

bool may_include(const std::string& from, const std::string& to) {
  const auto row = table().find(from);
  return from == to || row == table().end() || row->second.contains(to);
}

std::vector<std::string> layering_violations(const fs::path& root) {
  std::vector<std::string> violations;
  for (const fs::path& path : files_below(root)) {
    const fs::path file = path.lexically_relative(root);
    const std::string from = layer_of(file);
    if (!is_cpp(path) || !table().contains(from)) continue;
    for (const Include& include : includes(read_text(path))) {
      const std::string place = file.string() + ":" + std::to_string(include.line) + ": ";
      if (include.target.empty()) violations.push_back(place + "includes what a macro names, which nobody can check");
      const auto to = included_layer(root, file, include.target);
      if (to && !may_include(from, *to))
        violations.push_back(place + from + " includes " + *to + " (" + include.target + ")");
    }
  }
  return violations;
}

}  // namespace noli::repository
