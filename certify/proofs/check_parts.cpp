// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/check_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <fstream>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <utility>

#include <noli/errors.h>
#include "certify/proofs/asked_fields.h"
#include "kernel/parallel.h"
#include "trajectory/blocks/block_file.h"
#include "trajectory/blocks/bytes.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

/// Fewer bytes of tokens are checked in less time than a process takes to start and to read the frames.
constexpr std::uint64_t least_bytes = 1 << 20;

constexpr std::uint64_t bytes_of_step = 65;

bool is_regular(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// The bytes of tokens of each step; nothing if the file cannot be parted. Looks at the heads of blocks alone.
std::vector<std::uint64_t> bytes_of_steps(const fs::path& proof) {
  if (!is_regular(proof)) return {};
  std::ifstream file(proof, std::ios::binary);
  file.seekg(block_format::file_header_size);
  std::vector<std::uint64_t> bytes;
  std::array<char, block_format::block_header_size> head{};
  std::uint64_t at = block_format::file_header_size;
  const std::uint64_t size = fs::file_size(proof);
  while (file.read(head.data(), head.size())) {
    const auto kind = get<FourLetters>(head.data());
    const auto length = get<std::uint64_t>(head.data() + sizeof kind);
    const bool impossible = length > size - at || (kind == four_letters("STEP") && length != bytes_of_step);
    if (impossible || kind == four_letters("WITN") || stop_asked()) return {};
    if (kind == four_letters("STEP")) bytes.push_back(0);
    if (!bytes.empty()) bytes.back() += length;
    at += block_format::block_header_size + length + block_format::checksum_size;
    file.seekg(static_cast<std::streamoff>(at));
  }
  return file.gcount() == 0 && at == size ? bytes : std::vector<std::uint64_t>{};
}

/// The first step, from 1, of each part: cut where the sum is nearest to the next of so many equal shares.
std::vector<std::uint64_t> firsts_of_parts(const std::vector<std::uint64_t>& bytes, std::size_t parts) {
  std::vector<std::uint64_t> firsts;
  const auto total = static_cast<double>(std::reduce(bytes.begin(), bytes.end()));
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    const std::size_t left = bytes.size() - k, wanted = parts - firsts.size();
    const double share = total * static_cast<double>(firsts.size()) / static_cast<double>(parts);
    const bool due = static_cast<double>(sum) + 0.5 * static_cast<double>(bytes[k]) >= share || left == wanted;
    if (firsts.size() < parts && due) firsts.push_back(k + 1);
    sum += bytes[k];
  }
  return firsts;
}

/// What a checker says of a part, taken apart. `same()` is equal for all parts of one proof and one question.
struct PartOfAnswer {
  std::uint64_t first = 0, last = 0;
  std::string from, to;
  std::string verdict;                      ///< the first line, after "accepted: " and before the steps
  std::string fields_before, fields_after;  ///< of the line for programs: before and after the steps
  std::string proof;                        ///< its hash
  std::string motion, rest;                 ///< of the line for people: before the times; after them, with all lines

  auto same() const { return std::tie(verdict, fields_before, fields_after, proof, motion, rest); }
};

/// Takes a text apart from its front. After a mark that is not there, nothing is taken any more.
class TextParts {
 public:
  explicit TextParts(std::string_view text) : rest_(text) {}

  /// The text before the next `mark`; the mark is taken too.
  std::string before(std::string_view mark) {
    const std::size_t at = rest_.find(mark);
    good_ = good_ && at != std::string_view::npos;
    if (!good_) return "";
    std::string text(rest_.substr(0, at));
    rest_.remove_prefix(at + mark.size());
    return text;
  }
  bool good() const { return good_; }
  std::string rest() const { return std::string(rest_); }

 private:
  std::string_view rest_;
  bool good_ = true;
};

bool read_whole_number(std::string_view text, std::uint64_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

/// Nothing if it is not what a checker says of a part that it accepts.
std::optional<PartOfAnswer> part_of_answer(const std::string& words) {
  TextParts text(words);
  PartOfAnswer part;
  const bool accepted = text.before("accepted: ").empty();
  part.verdict = text.before("; steps ");
  const std::string steps = text.before("\n");
  part.fields_before = text.before(" steps=");
  const std::string first = text.before(".."), last = text.before(" ");
  part.fields_after = text.before(" from=");
  part.from = text.before(" to=");
  part.to = text.before(" proof=");
  part.proof = text.before("\n");
  const std::string steps_again = text.before(" of ");
  part.motion = text.before("; from ");
  const std::string extent = text.before("; ");
  part.rest = text.rest();
  const bool numbers = read_whole_number(first, part.first) && read_whole_number(last, part.last);
  const bool agrees =
      steps == first + ".." + last && steps_again == "Steps " + steps && extent == part.from + " to " + part.to;
  return text.good() && accepted && numbers && agrees ? std::optional(std::move(part)) : std::nullopt;
}

/// Reports the mean progress of all parts.
class PartsProgress {
 public:
  PartsProgress(std::function<void(double)> tell, std::size_t parts) : tell_(std::move(tell)), shares_(parts) {}

  std::function<void(double)> of(std::size_t part) {
    if (!tell_) return {};
    return [this, part](double share) {
      const std::lock_guard lock(mutex_);
      shares_[part] = share;
      tell_(std::reduce(shares_.begin(), shares_.end()) / static_cast<double>(shares_.size()));
    };
  }

 private:
  std::function<void(double)> tell_;
  std::vector<double> shares_;
  std::mutex mutex_;
};

}  // namespace

std::vector<std::uint64_t> parts_of_proof(const fs::path& proof, std::size_t parts) {
  const std::vector<std::uint64_t> bytes = bytes_of_steps(proof);
  return firsts_of_parts(bytes, std::min(parts, bytes.size()));
}

std::uint64_t steps_of_proof(const fs::path& proof) { return bytes_of_steps(proof).size(); }

std::string steps_of_part(const std::vector<std::uint64_t>& firsts, std::size_t part) {
  const bool last = part + 1 == firsts.size();
  return std::to_string(firsts.at(part)) + ".." + (last ? "" : std::to_string(firsts[part + 1] - 1));
}

std::optional<std::uint64_t> asked_steps(const std::vector<std::string>& asked) {
  std::optional<std::uint64_t> steps = 0;
  for (const std::string& word : asked) {
    if (field_of(word) != "steps") continue;
    std::uint64_t number = 0;
    const bool plain = word.starts_with("steps=") && read_whole_number(std::string_view(word).substr(6), number);
    steps = plain && number > 0 && steps == 0 ? std::optional(number) : std::nullopt;
  }
  return steps;
}

std::optional<std::string> take_part(std::vector<std::string>& asked) {
  const auto is_of_steps = [](const std::string& word) { return field_of(word) == "steps"; };
  const auto part = std::ranges::find_if(asked, is_of_steps);
  if (part == asked.end() || part->find("..") == std::string::npos) return std::nullopt;
  if (std::ranges::count_if(asked, is_of_steps) > 1) return std::nullopt;
  std::string steps = part->substr(part->find('=') + 1);
  asked.erase(part);
  return steps;
}

std::uint64_t ask_for_part(const std::string& steps, const fs::path& proof, std::vector<std::string>& asked) {
  const std::uint64_t least = asked_steps(asked).value_or(0);
  const std::uint64_t there = least > 0 && steps.ends_with("..") ? steps_of_proof(proof) : least;
  if (there < least) {
    throw InputError(proof.string(), "",
                     there == 0 ? std::string(proof_cannot_be_cut)
                                : fmt::format("{} steps are asked for, but the proof has {}", least, there));
  }
  if (least > 0) std::erase_if(asked, [](const std::string& word) { return field_of(word) == "steps"; });
  asked.push_back("steps=" + steps);
  return least;
}

std::optional<std::string> joined_words(const std::vector<std::string>& words, std::uint64_t least_steps) {
  std::vector<PartOfAnswer> parts;
  for (const std::string& text : words) {
    auto part = part_of_answer(text);
    const std::uint64_t next = parts.empty() ? 1 : parts.back().last + 1;
    if (!part || part->first != next || part->last < part->first) return std::nullopt;
    if (!parts.empty() && part->same() != parts[0].same()) return std::nullopt;
    parts.push_back(*std::move(part));
  }
  if (parts.empty() || parts.back().last < least_steps) return std::nullopt;
  const PartOfAnswer &all = parts.front(), &end = parts.back();
  return fmt::format(
      "accepted: {}\n"
      "{} steps={} {} from={} to={}\n"
      "{} steps of {}; from {} to {}; {}",
      all.verdict, all.fields_before, end.last, all.fields_after, all.from, end.to, end.last, all.motion, all.from,
      end.to, all.rest);
}

std::vector<std::uint64_t> parts_of_check(const CheckRequest& request, int checkers) {
  const auto asked = asked_steps(request.asked);
  if (checkers <= 1 || !asked || !std::ranges::all_of(request.trajectory, is_regular)) return {};
  const std::vector<std::uint64_t> bytes = bytes_of_steps(*request.proof);
  const std::uint64_t worthwhile = std::reduce(bytes.begin(), bytes.end()) / least_bytes;
  const std::uint64_t parts = std::min({std::uint64_t{bytes.size()}, worthwhile, static_cast<std::uint64_t>(checkers)});
  return parts < 2 || *asked > bytes.size() ? std::vector<std::uint64_t>{} : firsts_of_parts(bytes, parts);
}

std::vector<std::string> words_of_parts(const CheckRequest& request, const std::vector<std::uint64_t>& firsts,
                                        std::size_t begin, std::size_t end, int threads) {
  std::vector<std::string> words(end - begin);
  PartsProgress progress(request.progress, words.size());
  std::atomic<bool> not_accepted = false;
  parallel_for(words.size(), threads, [&](std::size_t i) {
    if (not_accepted) return;
    CheckRequest one = request;
    std::erase_if(one.asked, [](const std::string& word) { return field_of(word) == "steps"; });
    one.asked.push_back("steps=" + steps_of_part(firsts, begin + i));
    one.progress = progress.of(i);
    const StopOfThread after_another_part(not_accepted);
    try {
      const auto verdict = CheckerProcess(one).finish();
      if (verdict && verdict->code == 0) words[i] = verdict->words;
    } catch (const std::runtime_error&) {
      // The single checker that follows says what went wrong, or has enough of what several lacked.
    }
    if (words[i].empty()) not_accepted = true;
  });
  return words;
}

std::optional<CheckerVerdict> accepted_in_parts(const CheckRequest& request) {
  const int checkers = request.checkers > 0 ? request.checkers : hardware_threads();
  const std::vector<std::uint64_t> firsts = parts_of_check(request, checkers);
  if (firsts.empty()) return std::nullopt;
  const auto words = words_of_parts(request, firsts, 0, firsts.size(), checkers);
  auto joined = joined_words(words, *asked_steps(request.asked));
  return joined ? std::optional(CheckerVerdict{0, *std::move(joined)}) : std::nullopt;
}

}  // namespace noli
