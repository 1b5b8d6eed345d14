// SPDX-License-Identifier: Apache-2.0
#include "report/page/report_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include <noli/version.h>

namespace noli::report {
namespace {

constexpr std::string_view good[] = {"no_contact", "proved",   "no_difference", "no_finding", "nothing_fails",
                                     "agreement",  "accepted", "same",          "holds"};
constexpr std::string_view bad[] = {"contact",      "cannot_be", "too_near", "not_finite", "unstable", "finding",
                                    "disagreement", "refuted",   "rejected", "differs",    "different"};
constexpr std::string_view neutral[] = {"measured", "decided", "explained", "described", "report", "written", "done"};

bool among(const auto& words, std::string_view word) { return std::ranges::find(words, word) != std::end(words); }

}  // namespace

Tone tone_of(std::string_view word) {
  if (among(bad, word)) return Tone::bad;
  if (among(good, word)) return Tone::good;
  return among(neutral, word) ? Tone::neutral : Tone::open;
}

std::string_view name(Tone tone) {
  switch (tone) {
    case Tone::neutral: return "neutral";
    case Tone::good: return "good";
    case Tone::open: return "open";
    case Tone::bad: return "bad";
  }
  return "";
}

Json empty_page() {
  const Json none = Json::array();
  Json page = Json::object();
  page["title"] = "";
  page["made"] = fmt::format("Made by noli {}. Nothing on this page is fetched from elsewhere.", version_number());
  page["verdict"] = {{"word", "report"}, {"tone", name(Tone::neutral)}, {"lines", none}, {"caveats", none}};
  for (const char* const list : {"facts", "statement"}) page[list] = none;
  for (const char* const part : {"scene", "contacts", "focus"}) page[part] = nullptr;
  for (const char* const list : {"plots", "pictures", "results"}) page[list] = none;
  return page;
}

void add_caveat(const std::string& line, ReportPage& report) {
  for (const char* const list : {"lines", "caveats"}) report.page["verdict"][list].push_back(line);
}

void take_word(const std::string& word, ReportPage& report) {
  Json& verdict = report.page["verdict"];
  const auto there = verdict["word"].get<std::string>();
  const bool more = there == "report" || (there == "no_contact" && word == "proved");
  if (!more && tone_of(word) <= tone_of(there)) return;
  verdict["word"] = word;
  verdict["tone"] = name(tone_of(word));
}

std::string word_of_end(std::string_view end, bool going_on) {
  if (end == "contact" || end == "too_near" || end == "not_finite" || end == "unstable") return std::string(end);
  return end == "done" && !going_on ? "no_contact" : "undecided";
}

std::string spoken(std::string word) {
  std::ranges::replace(word, '_', ' ');
  return word;
}

}  // namespace noli::report
