// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/check_ranks.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include "certify/json.h"
#include "certify/proofs/check_frames.h"
#include "certify/proofs/check_parts.h"

namespace noli {
namespace {

/// The joined verdict, in the first rank. Nothing in other ranks, for a proof that cannot be cut, or unless all ranks
/// were asked the same and accept their parts. Each rank checks a contiguous range of parts.
std::optional<CheckerVerdict> accepted_in_ranks(const CheckRequest& request, Ranks& ranks,
                                                const std::function<void(const std::string&)>& note) {
  const int threads = request.checkers > 0 ? request.checkers : ranks.threads();
  const std::vector<std::uint64_t> firsts = parts_of_check(request, threads * ranks.size());
  const auto begin_of = [&](int rank) {
    return firsts.size() * static_cast<std::size_t>(rank) / static_cast<std::size_t>(ranks.size());
  };
  const auto own = words_of_parts(request, firsts, begin_of(ranks.rank()), begin_of(ranks.rank() + 1), threads);
  Json question = Json::array();
  for (const std::string& word : request.asked) question.push_back(on_one_line(word));
  for (const std::filesystem::path& frame : request.trajectory) question.push_back(on_one_line(frame.string()));
  std::vector<std::string> words;
  bool alike = true;
  for (const std::string& text : ranks.gather(Json{{"question", question}, {"words", own}}.dump())) {
    const Json of_rank = Json::parse(text);
    alike = alike && of_rank["question"] == question;
    for (const Json& part : of_rank["words"]) words.push_back(part);
  }
  if (firsts.empty() || !ranks.is_first()) return std::nullopt;
  auto joined = alike ? joined_words(words, asked_steps(request.asked).value_or(0)) : std::nullopt;
  if (joined) return CheckerVerdict{0, *std::move(joined)};
  note(alike ? "not all ranks accept their part, so the first one checks the whole proof"
             : "not all ranks were asked about the same frames, so the first one checks the whole proof");
  return std::nullopt;
}

}  // namespace

std::optional<CheckerVerdict> check_in_ranks(CheckRequest request, const FrameReading& reading, Ranks& ranks,
                                             const std::function<void(const std::string&)>& note) {
  if (left_to_checkers(request.trajectory, reading)) {
    if (auto accepted = accepted_in_ranks(request, ranks, note)) return accepted;
  }
  if (!ranks.is_first()) return std::nullopt;
  request.checkers = 1;
  return check_motion(request, reading);
}

}  // namespace noli
