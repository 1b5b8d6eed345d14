// SPDX-License-Identifier: Apache-2.0
#include "report/check_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "certify/proofs/asked_fields.h"
#include "certify/proofs/checker.h"
#include "certify/proofs/claim.h"
#include "report/input_report.h"
#include "trajectory/text.h"

namespace noli::report {
namespace {

Json asked_json(const std::vector<std::string>& words) {
  Json json = Json::object();
  for (const std::string& word : words) {
    const std::string field = field_of(word);
    json[field] = field == word ? "1" : word.substr(field.size() + 1);  // a bare word means 1
  }
  return json;
}

/// What follows the first "; " of the checker's first line: what weakens the claim, or on what the witness rests.
Json weaker_json(const std::string& words) {
  Json list = Json::array();
  const std::string line = first_line(words);
  for (std::size_t at = line.find("; "); at != std::string::npos;) {
    const std::size_t end = line.find("; ", at + 2);
    list.push_back(line.substr(at + 2, end == std::string::npos ? end : end - at - 2));
    at = end;
  }
  return list;
}

Json checked_claim(const Claim& claim) {
  Json json = claim_json(claim);
  if (!claim.part) return json;
  json["part"] = {{"first", claim.part->first}, {"last", claim.part->last}, {"proof", claim.part->proof}};
  return json;
}

const char* word_of(const CheckerVerdict& verdict) {
  return verdict.code == 0 ? "accepted" : verdict.code == 1 ? "refuted" : "rejected";
}

std::string after_rejection(const std::string& line, RunState run) {
  const bool names_remedy = line.find("asks for that") != std::string::npos,
             asks_too_far = line.find("has none of the steps") != std::string::npos;
  if (names_remedy) return "";
  if (asks_too_far) return "ask for steps that the proof has.";
  switch (run) {
    case RunState::only_frames:
      return "the run recorded only frames, so no proof of it can be checked; noli verify RUN --reproduce verifies it.";
    case RunState::open_window: return "the run ends within a window; resume it first (noli simulate ... --resume).";
    case RunState::being_written: return "the run is being written; check it again when it has ended.";
    case RunState::complete: break;
  }
  return "check that these are the frames of the proof, or make it again: noli verify ... --proof OUT.";
}

std::string next_step(const CheckerVerdict& verdict, RunState run, bool can_be_verified) {
  switch (verdict.code) {
    case 0: return can_be_verified ? "--verified asks the checker whose soundness is proved in Coq." : "";
    case 1: return "noli verify with the same frames or run shows where and when.";
    default: return after_rejection(first_line(verdict.words), run);
  }
}

}  // namespace

Json check_json(const Checked& checked) {
  const auto& [checker, proof, asked, verdict, notes, least_steps, joined, run] = checked;
  const auto claim = verdict.code == 3 ? std::nullopt : claim_of_words(verdict.words);
  Json json = {{"verdict", word_of(verdict)},
               {"checker", checker_json(checker)},
               {"proof", proof.string()},
               {"asked", asked_json(asked)},
               {"claim", claim ? checked_claim(*claim) : Json(nullptr)},
               {"weaker", verdict.code == 3 ? Json::array() : weaker_json(verdict.words)},
               {"words", verdict.words},
               {"notes", notes}};
  if (least_steps > 0) json["least_steps"] = least_steps;
  if (joined > 0) json["joined"] = joined;
  return json;
}

/// The checker's first line without its verdict is the place; the line for programs is among the details.
Answer check_answer(const Checked& checked) {
  const auto& [checker, proof, asked, verdict, notes, least_steps, joined, run] = checked;
  const std::string line = first_line(verdict.words);
  const std::string rest = verdict.words.substr(std::min(line.size() + 1, verdict.words.size()));
  const auto claim = verdict.code == 3 ? std::nullopt : claim_of_words(verdict.words);
  std::vector<std::string> members = {"checker=checker/name", "version=checker/version"};
  if (claim) members.insert(members.end(), {"excluded=claim/excluded", "empty=claim/empty"});
  if (claim && claim->part) {
    members.insert(members.end(), {"first=claim/part/first", "last=claim/part/last", "proof=claim/part/proof"});
  }
  if (joined > 0) members.emplace_back("joined=joined");
  Answer answer(check_json(checked), members);
  answer.text = rest.starts_with("claim ") ? rest.substr(std::min(rest.find('\n') + 1, rest.size())) : rest;
  answer.text += notes_text(notes);
  answer.details = rest.starts_with("claim ") ? first_line(rest) + '\n' : "";
  std::string what = line.substr(std::min(line.find(": ") + 2, line.size()));
  constexpr std::string_view touches = "touches";
  const std::size_t at = what.find(touches);
  if (claim && verdict.code == 0 && at != std::string::npos) what.insert(at + touches.size(), distance_phrase(*claim));
  answer.place = fmt::format("{} ({} {})", what, checker.name, checker.version);
  answer.next = next_step(verdict, run, checker.name == "noli_check" && joined == 0 && has_checker(Checker::verified));
  return answer;
}

}  // namespace noli::report
