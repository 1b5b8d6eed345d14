// SPDX-License-Identifier: Apache-2.0
#include "report/meshes_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include <noli/errors.h>

namespace noli::report {
namespace {

constexpr std::array<Verdict, 5> worst_first = {Verdict::contact, Verdict::too_near, Verdict::undecided,
                                                Verdict::no_contact, Verdict::proved};

std::size_t count_of(const std::vector<MeshVerdict>& meshes, Verdict verdict) {
  return static_cast<std::size_t>(std::ranges::count(meshes, verdict, &MeshVerdict::verdict));
}

/// "in 2 of 5 meshes something touches; the first is b.ply".
std::string place_of_all(const std::vector<MeshVerdict>& meshes) {
  const Verdict verdict = verdict_of(meshes);
  const auto first = std::ranges::find(meshes, verdict, &MeshVerdict::verdict);
  const std::string some = fmt::format("{} of {} meshes", count_of(meshes, verdict), meshes.size());
  const std::string name = on_one_line(first->file);
  const auto empty = std::ranges::count(meshes, true, &MeshVerdict::empty);
  const std::string untouched = fmt::format("{} meshes at rest: nothing touches in any{}", meshes.size(),
                                            empty == 0 ? "" : fmt::format("; in {} nothing can be compared", empty));
  switch (verdict) {
    case Verdict::contact: return fmt::format("in {} something touches; the first is {}", some, name);
    case Verdict::too_near: return fmt::format("in {} something is too near; the first is {}", some, name);
    case Verdict::undecided: return fmt::format("{} are not settled; the first is {}", some, name);
    case Verdict::no_contact: return untouched + " (decided exactly, not checked)";
    case Verdict::proved: return untouched + " (each accepted by the checker)";
  }
  return "";
}

}  // namespace

Verdict verdict_of(const std::vector<MeshVerdict>& meshes) {
  return *std::ranges::find_if(worst_first, [&](Verdict verdict) { return count_of(meshes, verdict) > 0; });
}

Json meshes_json(const std::vector<MeshVerdict>& meshes) {
  Json json = {{"verdict", name(verdict_of(meshes))}, {"meshes", Json::array()}};
  for (const MeshVerdict& mesh : meshes) json["meshes"].push_back({{"file", mesh.file}, {"result", mesh.json}});
  return json;
}

Answer meshes_answer(const std::vector<MeshVerdict>& meshes, bool details) {
  Answer answer(name(verdict_of(meshes)), {{"meshes", meshes.size()}});
  for (const Verdict verdict : worst_first) answer.add({name(verdict), count_of(meshes, verdict)});
  for (const MeshVerdict& mesh : meshes) {
    answer.text += fmt::format("{}\n  {}\n", on_one_line(mesh.file), mesh.answer.last_line());
    for (const std::string& note : mesh.notes) answer.text += fmt::format("  Note: {}.\n", on_one_line(note));
    if (details) answer.details += fmt::format("{}\n{}", on_one_line(mesh.file), mesh.answer.text_above(true));
  }
  answer.place = place_of_all(meshes);
  return answer;
}

}  // namespace noli::report
