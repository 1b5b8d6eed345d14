// SPDX-License-Identifier: Apache-2.0
//
// Compares the claim of a proof, or a witness, with the claim that is asked for: proofs/FORMAT.md, section 6.
//
// Notation
//   source    as in CLAM: 0 frames in motion, 1 frames at rest, 2 a run
//   flat      a step in which all vertices have one z at its first time, and one at its last
#pragma once

#include "trajectory.h"

namespace noli::checker {

inline constexpr std::array<const char*, 3> motions = {"linear", "rest", "run"};

/// Both checkers write these texts alike.
inline std::string text_of(double number) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.17g", number + 0.0);
  return text.data();
}
inline std::string text_of(const std::set<LabelPair>& pairs) {
  std::string text;
  for (const auto& [a, b] : pairs) text += (text.empty() ? "" : ",") + std::to_string(a) + "-" + std::to_string(b);
  return text;
}
inline std::string text_of(const Sha256::Digest& hash) {
  std::string text;
  for (const std::uint8_t byte : hash) {
    for (const int digit : {byte / 16, byte % 16}) text += "0123456789abcdef"[digit];
  }
  return text;
}

/// Whether the claim compares two cells with vertices u != v, one in each, or, if `strict`, one cell with both.
inline bool compares_any(const Claim& claim, bool strict) {
  struct Label {
    std::size_t cells = 0;
    std::set<std::uint32_t> vertices;  ///< at most two of them
  };
  std::map<std::uint32_t, Label> labels;
  for (const Cell& cell : claim.cells) {
    Label& label = labels[cell.label];
    ++label.cells;
    for (const std::uint32_t v : cell) {
      if (label.vertices.size() < 2) label.vertices.insert(v);
    }
    const bool several = std::ranges::any_of(cell, [&](auto v) { return v != cell.v[0]; });
    if (strict && several && !claim.is_excluded(cell.label, cell.label)) return true;
  }
  for (auto a = labels.begin(); a != labels.end(); ++a) {
    for (auto b = a; b != labels.end(); ++b) {
      std::set<std::uint32_t> both = a->second.vertices;
      both.insert(b->second.vertices.begin(), b->second.vertices.end());
      const bool two = a != b || a->second.cells > 1;
      if (two && both.size() > 1 && !claim.is_excluded(a->first, b->first)) return true;
    }
  }
  return false;
}

/// What a witness shows: points that meet, or come too near.
struct Shown {
  std::uint64_t step = 0;  ///< from 0
  bool one_cell = false, of_points = false, near = false, flat = false;
  LabelPair labels{};

  /// Assumptions of the witness that go beyond what is asked for by default.
  std::string rests_on(const Claim& claim) const {
    std::string text;
    if (near) text += "; least distance " + text_of(claim.eta) + ", ring " + std::to_string(claim.ring);
    if (one_cell) text += "; features of one cell count";
    if (of_points) text += "; vertices without a cell count";
    if (claim.dimension == 2 && !flat) text += "; z does not count";
    return text;
  }
};

/// The claim that is asked for. Section 6 has the defaults of the fields that are not named.
class Asked {
 public:
  Asked() = default;
  /// Takes fields as they follow --require.
  explicit Asked(const std::vector<std::string>& fields) {
    for (const std::string& field : fields) take(field);
    const bool any_excluded = excluded_ && !excluded_->empty();
    require_word(cells_ || !any_excluded, "excluded", "only the cells say what labels are: expected cells=HASH too");
    require_word(cells_ || merged_ == 0, "merged", "only the cells say which are merged: expected cells=HASH too");
    require_word(eta_ > 0 || ring_ == 1, "ring", "says who may be nearer than a distance: expected distance=ETA too");
  }

  /// Whether a part of the steps is asked for: steps=A..B or steps=A... The others are then passed over.
  bool part() const { return part_; }
  /// The first step that is asked for, from 0.
  std::uint64_t first() const { return first_ - 1; }
  /// Whether the step with this number, from 0, is looked at.
  bool counts(const Claim& claim, std::uint64_t number) const {
    const std::uint64_t ends = claim.source == 1 && source(claim) == 0 ? 1 : 0;  // frame k ends step k - 1
    return !part_ || (first() <= number && (!last_ || number < *last_ + ends));
  }
  /// Whether a last step is asked for by name, and a claim up to step `steps`, counted from 1, reaches it. 0: no step.
  bool enough_steps(const Claim& claim, std::uint64_t steps) const {
    const std::uint64_t ends = claim.source == 0 && source(claim) == 1 ? 1 : 0;  // frame k ends step k - 1
    return last_ && steps > 0 && steps + ends >= *last_;
  }

  /// Rejects a claim that is weaker than asked. `flat`: each of its steps is flat.
  void require_claimed(const Claim& claim, bool flat) const {
    const Says proof{"the proof"};
    const std::uint32_t motion = source(claim), space = dimension(claim);
    proof.require(claim.source == motion || (claim.source == 0 && motion == 1), "motion", motions[claim.source],
                  motions[motion]);
    proof.require(claim.dimension == space || flat || (claim.dimension == 2 && claim.merged == 0), "dimension",
                  std::to_string(claim.dimension), std::to_string(space));
    proof.require(claim.strict || !strict_, "strict", "0", "1");
    proof.require(claim.points || !points_, "points", "0", "1");
    proof.require(claim.eta >= eta_, "distance", text_of(claim.eta), text_of(eta_));
    proof.require(claim.ring <= ring_ || eta_ == 0, "ring", std::to_string(claim.ring), std::to_string(ring_));
    const std::string cells = " --require cells=" + text_of(claim.hash);
    proof.require(claim.merged <= merged_, "merged", std::to_string(claim.merged), std::to_string(merged_),
                  "merged=" + std::to_string(claim.merged) + cells);
    require_cells(proof, claim);
    const std::set<LabelPair> by_default = claim.source == 2 ? claim.excluded : std::set<LabelPair>{};
    const std::set<LabelPair>& pairs = excluded_ ? *excluded_ : by_default;
    proof.require(std::ranges::includes(pairs, claim.excluded), "excluded", text_of(claim.excluded), text_of(pairs),
                  "excluded=" + text_of(claim.excluded) + cells);
    const char* const would_do = claim.strict && compares_any(claim, true) ? "strict=1" : "empty=1";
    proof.require(empty_ || compares_any(claim, strict_), "empty", "1", "0", would_do);
  }
  /// Rejects a claim of too few steps. `more`: the trajectory has more.
  void require_steps(const Claim& claim, std::uint64_t steps, bool more) const {
    const std::string wanted = last_ ? text_of_steps(*last_) : "all of them, and the trajectory goes on";
    Says{"the proof"}.require(last_ ? enough_steps(claim, steps) : !more, "steps", text_of_steps(steps), wanted);
  }
  /// How many steps, or from which to which.
  std::string text_of_steps(std::uint64_t last) const {
    return (part_ ? std::to_string(first_) + ".." : "") + std::to_string(last);
  }
  /// Rejects a witness that refutes only a stronger claim than the one asked for.
  void require_refuted(const Claim& claim, const Shown& shown) const {
    const Says witness{"the witness in step " + std::to_string(shown.step + 1)};
    const std::uint32_t motion = source(claim), space = dimension(claim);
    witness.require(claim.source == motion || (claim.source == 1 && motion == 0), "motion", motions[claim.source],
                    motions[motion]);
    const std::uint64_t step = shown.step + (claim.source == motion ? 1 : 0);  // frame k is in steps k - 1 and k
    witness.require(!last_ || step <= *last_, "steps", std::to_string(step), text_of_steps(last_.value_or(0)));
    witness.require(claim.dimension >= space || shown.flat, "dimension", std::to_string(claim.dimension),
                    std::to_string(space));
    witness.require(!shown.one_cell || strict_, "strict", "1", "0");
    witness.require(!shown.of_points || points_, "points", "1", "0");
    witness.require(!shown.near || claim.eta <= eta_, "distance", text_of(claim.eta), text_of(eta_));
    witness.require(!shown.near || claim.ring >= ring_, "ring", std::to_string(claim.ring), std::to_string(ring_));
    witness.require(claim.merged >= merged_, "merged", std::to_string(claim.merged), std::to_string(merged_));
    require_cells(witness, claim);
    const std::set<LabelPair> pairs = excluded_.value_or(std::set<LabelPair>{});
    witness.require(!pairs.contains(shown.labels), "excluded", text_of(claim.excluded), text_of(pairs));
  }

 private:
  /// The part of the proof that is compared with what is asked for, for messages.
  struct Says {
    std::string who;

    void require(bool condition, const std::string& field, const std::string& says, const std::string& wanted) const {
      require(condition, field, says, wanted, field + "=" + says);
    }
    void require(bool condition, const std::string& field, const std::string& says, const std::string& wanted,
                 const std::string& would_do) const {
      if (condition) return;
      const auto named = [](const std::string& value) { return value.empty() ? "nothing" : value; };
      const std::string both = " says " + named(says) + ", asked was " + named(wanted);
      throw Rejected{"the claim", field + ": " + who + both + "; --require " + would_do + " asks for that"};
    }
  };
  void require_cells(const Says& who, const Claim& claim) const {
    who.require(!cells_ || *cells_ == text_of(claim.hash), "cells", text_of(claim.hash), cells_.value_or(""));
  }
  static void require_word(bool condition, const std::string& word, const char* why) {
    checker::require(condition, "the command line, --require " + word, why);
  }

  std::uint32_t source(const Claim& claim) const { return source_.value_or(claim.source == 2 ? 2 : 0); }
  std::uint32_t dimension(const Claim& claim) const {
    return dimension_.value_or(claim.source == 2 ? claim.dimension : 3);
  }

  void take(const std::string& word) {
    const std::string field = word.substr(0, word.find('='));
    std::string value = word.substr(std::min(field.size() + 1, word.size()));
    const bool bare = field == word;
    require_word(field == "excluded" || given_.insert(field).second, word, "the field is asked twice");
    if (bare && (field == "strict" || field == "points" || field == "empty")) value = "1";
    if (field == "motion") {
      const auto found = std::ranges::find(motions, value);
      require_word(found != motions.end(), word, "expected linear, rest or run");
      source_ = static_cast<std::uint32_t>(found - motions.begin());
    } else if (field == "dimension") {
      dimension_ = number(word, value, std::uint32_t{2}, std::uint32_t{3});
    } else if (field == "steps") {
      take_steps(word, value);
    } else if (field == "strict") {
      strict_ = flag(word, value);
    } else if (field == "points") {
      points_ = flag(word, value);
    } else if (field == "empty") {
      empty_ = flag(word, value);
    } else if (field == "distance") {
      eta_ = number(word, value, 0.0);
    } else if (field == "ring") {
      ring_ = number(word, value, std::uint32_t{1});
    } else if (field == "merged") {
      merged_ = number(word, value, std::uint32_t{0});
    } else if (field == "excluded") {
      require_word(!bare, word, "expected excluded=A-B,C-D, or excluded= for none");
      if (!excluded_) excluded_.emplace();
      add_pairs(word, value);
    } else {
      require_word(field == "cells", word,
                   "expected motion, dimension, steps, strict, points, distance, ring, merged, excluded, cells or "
                   "empty");
      const bool hash = value.size() == 64 && value.find_first_not_of("0123456789abcdef") == std::string::npos;
      require_word(hash, word, "expected the hash of the cells: 64 digits 0-9, a-f");
      cells_ = value;
    }
  }
  /// N, A..B or A..
  void take_steps(const std::string& word, const std::string& value) {
    const std::size_t dots = value.find("..");
    part_ = dots != std::string::npos;
    if (part_) first_ = number(word, value.substr(0, dots), std::uint32_t{1});
    const std::string last = part_ ? value.substr(dots + 2) : value;
    if (!part_ || !last.empty()) last_ = number(word, last, first_);
  }
  /// A number that begins with a digit, so without a sign.
  template <class T>
  static T number(const std::string& word, const std::string& text, T least, T most = std::numeric_limits<T>::max()) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool complete = error == std::errc{} && end == text.data() + text.size();
    const bool digit = !text.empty() && text[0] >= '0' && text[0] <= '9';
    const bool within = least <= value && value <= most;
    require_word(complete && digit && within, word, "expected a number that is possible there");
    return value;
  }
  static bool flag(const std::string& word, const std::string& text) {
    return number(word, text, std::uint32_t{0}, std::uint32_t{1}) == 1;
  }
  /// Pairs as in A-B,C-D, with A <= B, strictly ascending, from one word to the next too.
  void add_pairs(const std::string& word, const std::string& text) {
    for (std::size_t at = 0; !text.empty() && at <= text.size();) {
      const std::size_t end = std::min(text.find(',', at), text.size()), minus = std::min(text.find('-', at), end);
      const LabelPair pair = {
          number(word, text.substr(at, minus - at), std::uint32_t{0}),
          number(word, text.substr(std::min(minus + 1, end), end - std::min(minus + 1, end)), std::uint32_t{0})};
      require_word(pair[0] <= pair[1] && (excluded_->empty() || *excluded_->rbegin() < pair), word,
                   "expected pairs A-B with A <= B, in ascending order");
      excluded_->insert(excluded_->end(), pair);
      at = end + 1;
    }
  }

  std::set<std::string> given_;
  std::optional<std::uint32_t> source_, dimension_;
  std::uint32_t first_ = 1;            ///< the first step, from 1
  std::optional<std::uint64_t> last_;  ///< the last one; nothing: to the end of the trajectory
  bool part_ = false;
  bool strict_ = false, points_ = false, empty_ = false;
  double eta_ = 0;
  std::uint32_t ring_ = 1, merged_ = 0;
  std::optional<std::set<LabelPair>> excluded_;
  std::optional<std::string> cells_;
};

}  // namespace noli::checker
