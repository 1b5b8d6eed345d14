// SPDX-License-Identifier: Apache-2.0
#include "report/joined_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include <noli/errors.h>
#include "certify/proofs/check_parts.h"
#include "report/documents.h"
#include "trajectory/text.h"

namespace noli::report {
namespace {

/// An answer, taken apart.
struct Part {
  std::string name;
  std::uint64_t first = 0, last = 0;
  bool open = false;               ///< asked for to the end of the trajectory
  std::string hash;                ///< of the proof
  std::vector<std::string> asked;  ///< without the steps
  std::uint64_t least_steps = 0;
  std::string words;
  std::vector<std::string> notes;
  std::filesystem::path proof;
  CheckerVersion checker;
};

[[noreturn]] void refuse(const std::string& name, const std::string& why) { throw InputError(name, "", why); }

std::uint64_t whole_number(const Json& json) {
  return json.is_number_unsigned() ? json.get<std::uint64_t>() : throw std::out_of_range("no whole number");
}

void put_asked(const Json& asked, Part& part) {
  for (const auto& [field, value] : asked.items()) {
    const auto word = value.get<std::string>();
    if (field == "steps") {
      part.open = word.ends_with("..");
    } else {
      part.asked.push_back(field + "=" + word);
    }
  }
}

/// Throws Json::exception, std::out_of_range where members are missing or of another kind.
Part part_of(const Json& json, const std::string& name) {
  Part part;
  part.name = name;
  part.words = json.at("words").get<std::string>();
  if (json.at("verdict") != "accepted") refuse(name, "is not an acceptance: " + first_line(part.words));
  const Json& claim = json.at("claim");
  if (claim.is_object() && !claim.contains("part")) {
    refuse(name, "is about all steps of a proof; expected a part (--shard, --steps)");
  }
  part.first = whole_number(claim.at("part").at("first"));
  part.last = whole_number(claim.at("part").at("last"));
  part.hash = claim.at("part").at("proof").get<std::string>();
  put_asked(json.at("asked"), part);
  if (json.contains("least_steps")) part.least_steps = whole_number(json.at("least_steps"));
  part.notes = json.at("notes").get<std::vector<std::string>>();
  part.proof = json.at("proof").get<std::string>();
  const Json& checker = json.at("checker");
  part.checker = {checker.at("name").get<std::string>(), checker.at("version").get<std::string>(),
                  checker.at("commit").get<std::string>()};
  return part;
}

Part read_part(const PartAnswer& answer) {
  try {
    const Json expected = document("check", Json::object());
    for (const char* const member : {"schema", "version"}) {
      if (answer.json.at(member) != expected.at(member)) throw std::out_of_range(member);
    }
    return part_of(answer.json, answer.name);
  } catch (const Json::exception&) {
  } catch (const std::out_of_range&) {
  }
  refuse(answer.name, "is not what noli check --json writes about a part of a proof");
}

void require_same_question(const Part& one, const Part& other) {
  const auto differ = [&](const char* what, const std::string& a, const std::string& b) {
    if (a != b) refuse(other.name, fmt::format("{} {}, but {} {} {}", what, b, one.name, what, a));
  };
  const auto checker = [](const Part& part) {
    return fmt::format("{} {} ({})", part.checker.name, part.checker.version, part.checker.commit);
  };
  const auto asked = [](const Part& part) {
    std::vector<std::string> sorted = part.asked;
    std::ranges::sort(sorted);
    const std::string fields = sorted.empty() ? "the default" : fmt::format("{}", fmt::join(sorted, " "));
    return part.least_steps == 0 ? fields : fmt::format("{} and at least {} steps", fields, part.least_steps);
  };
  differ("is about the proof with the hash", one.hash, other.hash);
  differ("was checked by", checker(one), checker(other));
  differ("asked for", asked(one), asked(other));
}

/// Throws unless the parts, in order, cover each step once.
void require_cover(const std::vector<Part>& parts) {
  std::uint64_t next = 1;
  for (const Part& part : parts) {
    if (part.first > next) {
      refuse(part.name, fmt::format("begins with step {}, and no answer is about {}", part.first,
                                    next + 1 == part.first ? fmt::format("step {}", next)
                                                           : fmt::format("steps {} to {}", next, part.first - 1)));
    }
    if (part.first < next || part.last < part.first) {
      refuse(part.name,
             fmt::format("has the steps {} to {}, and another answer has some of them too; expected each step once",
                         part.first, part.last));
    }
    next = part.last + 1;
  }
  const Part& end = parts.back();
  if (end.open) return;
  refuse(end.name, fmt::format("ends with step {}, and nothing says that this is the last one; expected a part with an "
                               "open end (--shard N/N, --steps A..)",
                               end.last));
}

}  // namespace

Checked joined_check(const std::vector<PartAnswer>& answers) {
  std::vector<Part> parts;
  for (const PartAnswer& answer : answers) parts.push_back(read_part(answer));
  std::ranges::stable_sort(parts, {}, &Part::first);
  std::vector<std::string> words, notes;
  for (const Part& part : parts) {
    require_same_question(parts.front(), part);
    words.push_back(part.words);
    for (const std::string& note : part.notes) {
      if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
    }
  }
  require_cover(parts);
  const Part& first = parts.front();
  if (parts.back().last < first.least_steps) {
    refuse(parts.back().name,
           fmt::format("ends with step {}, and {} steps were asked for", parts.back().last, first.least_steps));
  }
  auto joined = joined_words(words, first.least_steps);
  if (!joined) refuse(first.name, "does not fit the other answers: the checkers' words differ");
  notes.push_back(fmt::format("joined from the answers about {} part{}; nothing was checked again", parts.size(),
                              parts.size() == 1 ? "" : "s"));
  std::vector<std::string> asked = first.asked;
  if (first.least_steps > 0) asked.push_back(fmt::format("steps={}", first.least_steps));
  return {first.checker, first.proof, asked, {0, *std::move(joined)}, notes, 0, parts.size()};
}

}  // namespace noli::report
