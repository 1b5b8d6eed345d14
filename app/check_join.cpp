// SPDX-License-Identifier: Apache-2.0
#include "app/check_join.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include <noli/errors.h>
#include "certify/json.h"
#include "certify/proofs/check_parts.h"
#include "integrator/scene/json_text.h"
#include "trajectory/input_file.h"
#include "trajectory/text.h"

namespace noli::app {
namespace {

namespace fs = std::filesystem;

/// One file, taken apart.
struct PartAnswer {
  std::string file;
  std::uint64_t first = 0, last = 0;
  bool open = false;  ///< asked for to the end of the trajectory
  std::string proof;  ///< its hash
  std::string verdict, words;
  CheckerVersion checker;
  Json asked;  ///< without the steps
  fs::path proof_file;
};

[[noreturn]] void refuse(const PartAnswer& part, const std::string& why) { throw InputError(part.file, "", why); }

PartAnswer read_answer(const fs::path& file) {
  PartAnswer part;
  part.file = file.string();
  const Json json = integrator::parse_json(read_whole_file(file), part.file);
  try {
    if (json.at("schema") != "noli-check" || json.at("version") != 1) throw Json::other_error::create(501, "", &json);
    part.verdict = json.at("verdict").get<std::string>();
    part.words = json.at("words").get<std::string>();
    if (part.verdict != "accepted") refuse(part, fmt::format("is {}", first_line(part.words)));
    const Json& claim = json.at("claim");
    if (claim.is_object() && !claim.contains("part"))
      refuse(part, "is about all steps of a proof; expected a part (--shard, --steps)");
    part.first = claim.at("part").at("first").get<std::uint64_t>();
    part.last = claim.at("part").at("last").get<std::uint64_t>();
    part.proof = claim.at("part").at("proof").get<std::string>();
    const Json& checker = json.at("checker");
    part.checker = {checker.at("name").get<std::string>(), checker.at("version").get<std::string>(),
                    checker.at("commit").get<std::string>()};
    part.asked = json.at("asked");
    part.open = part.asked.at("steps").get<std::string>().ends_with("..");
    part.asked.erase("steps");
    part.proof_file = json.at("proof").get<std::string>();
  } catch (const Json::exception&) {
    refuse(part, "is not what noli check --json writes about a part of a proof");
  }
  return part;
}

void require_alike(const PartAnswer& one, const PartAnswer& other) {
  const auto differ = [&](const char* what, const std::string& a, const std::string& b) {
    if (a != b) refuse(other, fmt::format("{} {}, but {} {} {}", what, b, one.file, what, a));
  };
  differ("is about the proof with the hash", one.proof, other.proof);
  differ("was checked by", fmt::format("{} {} {}", one.checker.name, one.checker.version, one.checker.commit),
         fmt::format("{} {} {}", other.checker.name, other.checker.version, other.checker.commit));
  differ("asked for", one.asked.dump(), other.asked.dump());
}

/// That all steps are there, once each.
void require_cover(const std::vector<PartAnswer>& parts) {
  std::uint64_t next = 1;
  for (const PartAnswer& part : parts) {
    if (part.first > next)
      refuse(part, fmt::format("begins with step {}; steps {}..{} are missing", part.first, next, part.first - 1));
    if (part.first < next || part.last < part.first)
      refuse(part, fmt::format("has the steps {}..{}, of which others have some; expected each step once", part.first,
                               part.last));
    next = part.last + 1;
  }
  if (!parts.back().open) {
    refuse(parts.back(), fmt::format("ends with step {}, and nothing says that this is the last one; expected a part "
                                     "with an open end (--shard N/N, --steps A..)",
                                     parts.back().last));
  }
}

}  // namespace

report::Checked joined_answers(const std::vector<fs::path>& files) {
  std::vector<PartAnswer> parts;
  for (const fs::path& file : files) parts.push_back(read_answer(file));
  std::ranges::stable_sort(parts, {}, &PartAnswer::first);
  std::vector<std::string> words, asked;
  for (const PartAnswer& part : parts) {
    require_alike(parts.front(), part);
    words.push_back(part.words);
  }
  require_cover(parts);
  auto joined = joined_words(words, 0);
  if (!joined) refuse(parts.front(), "and the others do not fit together: what their checkers say differs");
  for (const auto& [field, value] : parts.front().asked.items())
    asked.push_back(field + "=" + value.get<std::string>());
  const std::string note =
      fmt::format("joined from the answers about {} parts; nothing was checked again", parts.size());
  return {parts.front().checker, parts.front().proof_file, asked, {0, *std::move(joined)}, {note}};
}

}  // namespace noli::app
