// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/check_parts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <utility>

#include "certify/proofs/asked_fields.h"
#include "kernel/parallel.h"
#include "trajectory/blocks/block_file.h"
#include "trajectory/blocks/bytes.h"
#include "trajectory/text.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

/// Fewer bytes of tokens are checked in less time than a process takes to start and to read the frames.
constexpr std::uint64_t least_bytes = 1 << 20;

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// The bytes of tokens of each step; nothing if the file cannot be parted. Looks at the heads of blocks alone.
std::vector<std::uint64_t> bytes_of_steps(const fs::path& proof) {
  if (!is_file(proof)) return {};
  std::ifstream file(proof, std::ios::binary);
  file.seekg(block_format::file_header_size);
  std::vector<std::uint64_t> bytes;
  std::array<char, block_format::block_header_size> head{};
  std::uint64_t at = block_format::file_header_size;
  const std::uint64_t size = fs::file_size(proof);
  while (file.read(head.data(), head.size())) {
    const auto kind = get<FourLetters>(head.data());
    const auto length = get<std::uint64_t>(head.data() + sizeof kind);
    if (kind == four_letters("WITN") || length > size - at) return {};
    if (kind == four_letters("STEP")) bytes.push_back(0);
    if (!bytes.empty()) bytes.back() += length;
    at += block_format::block_header_size + length + block_format::checksum_size;
    file.seekg(static_cast<std::streamoff>(at));
  }
  return file.gcount() == 0 && at == size ? bytes : std::vector<std::uint64_t>{};
}

/// Cuts where the sum is nearest to the next of so many equal shares.
std::vector<std::uint64_t> cut(const std::vector<std::uint64_t>& bytes, std::size_t parts) {
  std::vector<std::uint64_t> firsts;
  const auto total = static_cast<double>(std::reduce(bytes.begin(), bytes.end()));
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    const std::size_t left = bytes.size() - k, wanted = parts - firsts.size();
    const double share = total * static_cast<double>(firsts.size()) / static_cast<double>(parts);
    const bool due = static_cast<double>(sum + bytes[k] / 2) >= share || left == wanted;
    if (firsts.size() < parts && due) firsts.push_back(k + 1);
    sum += bytes[k];
  }
  return firsts;
}

/// The lines of a verdict on a part. `same` is in those of all parts of one proof.
struct PartWords {
  std::uint64_t first = 0, last = 0;
  std::string verdict, before, claim, from, to, proof, of, about;

  auto same() const { return std::tie(verdict, before, claim, proof, of, about); }
};

/// Takes the text before the next `mark`, and the mark, from the front. Nothing if it is not there.
std::optional<std::string> take(std::string_view& text, std::string_view mark) {
  const std::size_t at = text.find(mark);
  if (at == std::string_view::npos) return std::nullopt;
  std::string before(text.substr(0, at));
  text.remove_prefix(at + mark.size());
  return before;
}

bool read_number(std::string_view text, std::uint64_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

std::optional<PartWords> parse(const std::string& words) {
  std::string_view rest = words;
  const auto accepted = take(rest, "accepted: "), verdict = take(rest, "; steps "), steps = take(rest, "\n");
  const auto before = take(rest, " steps="), first = take(rest, ".."), last = take(rest, " ");
  const auto claim = take(rest, " from="), from = take(rest, " to="), to = take(rest, " proof="),
             proof = take(rest, "\n");
  const auto number = take(rest, " of "), of = take(rest, "; from "), extent = take(rest, "; ");
  if (!extent || accepted != "" || steps != *first + ".." + *last || number != "Steps " + *steps ||
      extent != *from + " to " + *to) {
    return std::nullopt;
  }
  PartWords part{.verdict = *verdict,
                 .before = *before,
                 .claim = *claim,
                 .from = *from,
                 .to = *to,
                 .proof = *proof,
                 .of = *of,
                 .about = std::string(rest)};
  if (!read_number(*first, part.first) || !read_number(*last, part.last)) return std::nullopt;
  return part;
}

/// How many steps are asked for by name; nothing if none are; 0 if something else is.
std::optional<std::uint64_t> asked_steps(const std::vector<std::string>& asked) {
  constexpr std::string_view field = "steps=";
  const auto word = std::ranges::find_if(asked, [&](const std::string& w) { return w.starts_with(field); });
  if (word == asked.end()) return std::nullopt;
  std::uint64_t steps = 0;
  return read_number(std::string_view(*word).substr(field.size()), steps) ? steps : 0;
}

/// Tells the mean of the shares that the parts have read.
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
  return cut(bytes, std::min(parts, bytes.size()));
}

std::string steps_of_part(const std::vector<std::uint64_t>& firsts, std::size_t part) {
  const bool last = part + 1 == firsts.size();
  return std::to_string(firsts.at(part)) + ".." + (last ? "" : std::to_string(firsts[part + 1] - 1));
}

std::optional<std::string> joined_words(const std::vector<std::string>& words) {
  std::vector<PartWords> parts;
  for (const std::string& text : words) {
    auto part = parse(text);
    const std::uint64_t next = parts.empty() ? 1 : parts.back().last + 1;
    if (!part || part->first != next || part->last < part->first) return std::nullopt;
    if (!parts.empty() && part->same() != parts[0].same()) return std::nullopt;
    parts.push_back(*std::move(part));
  }
  if (parts.empty()) return std::nullopt;
  const PartWords &all = parts.front(), &end = parts.back();
  const std::string steps = std::to_string(end.last);
  return "accepted: " + all.verdict + '\n' + all.before + " steps=" + steps + ' ' + all.claim + " from=" + all.from +
         " to=" + end.to + '\n' + steps + " steps of " + all.of + "; from " + all.from + " to " + end.to + "; " +
         all.about;
}

std::vector<std::uint64_t> parts_of_check(const CheckRequest& request, int checkers) {
  const auto asked = asked_steps(request.asked);
  if (checkers <= 1 || asked == 0 || !std::ranges::all_of(request.trajectory, is_file)) return {};
  const std::vector<std::uint64_t> bytes = bytes_of_steps(*request.proof);
  if (asked && *asked > bytes.size()) return {};
  const std::uint64_t worthwhile = std::reduce(bytes.begin(), bytes.end()) / least_bytes;
  const std::uint64_t parts = std::min({std::uint64_t{bytes.size()}, worthwhile, static_cast<std::uint64_t>(checkers)});
  return parts < 2 ? std::vector<std::uint64_t>{} : cut(bytes, parts);
}

std::vector<std::string> words_of_parts(const CheckRequest& request, const std::vector<std::uint64_t>& firsts,
                                        std::size_t begin, std::size_t end, int threads) {
  std::vector<std::string> words(end - begin);
  PartsProgress progress(request.progress, words.size());
  parallel_for(words.size(), threads, [&](std::size_t i) {
    CheckRequest one = request;
    std::erase_if(one.asked, [](const std::string& word) { return field_of(word) == "steps"; });
    one.asked.push_back("steps=" + steps_of_part(firsts, begin + i));
    one.progress = progress.of(i);
    try {
      const auto verdict = CheckerProcess(one).finish();
      if (verdict && verdict->code == 0) words[i] = verdict->words;
    } catch (const std::runtime_error&) {
      // One checker alone may have enough of what these lacked; if not, it says so.
    }
  });
  return words;
}

std::optional<CheckerVerdict> accepted_in_parts(const CheckRequest& request) {
  const int checkers = request.checkers > 0 ? request.checkers : hardware_threads();
  const std::vector<std::uint64_t> firsts = parts_of_check(request, checkers);
  auto joined = joined_words(words_of_parts(request, firsts, 0, firsts.size(), checkers));
  return joined ? std::optional(CheckerVerdict{0, *std::move(joined)}) : std::nullopt;
}

}  // namespace noli
