// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/claim.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <utility>

#include <noli/errors.h>
#include "certify/process/child.h"
#include "integrator/scene/json_text.h"
#include "proofs/prover/tokens/proof_file.h"
#include "trajectory/blocks/block_sink.h"
#include "trajectory/cell_features.h"
#include "trajectory/text.h"

namespace noli {
namespace {

constexpr const char* schema = "noli-claim";
constexpr int schema_version = 1;
constexpr std::size_t longest_word = 100'000;  // of a command line
/// Of all pairs: a checker repeats them, and of its output `most_output` are kept.
constexpr std::size_t longest_list = most_output - 100'000;

bool is_excluded(const LabelPairs& pairs, std::uint32_t a, std::uint32_t b) {
  return pairs.contains({std::min(a, b), std::max(a, b)});
}

/// The cells with one label: how many, and one or two of their vertices.
struct CellsOfLabel {
  std::size_t cells = 0;
  std::set<VertexId> vertices;
};

bool compares_any(const Mesh& mesh, std::span<const std::uint32_t> labels, const LabelPairs& excluded, bool strict) {
  std::map<std::uint32_t, CellsOfLabel> known;
  for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
    const auto all = corners(mesh, c);
    const auto vertices = std::span(all).first(corner_count(mesh, c));
    CellsOfLabel& label = known[labels[c]];
    ++label.cells;
    for (const VertexId v : vertices) {
      if (label.vertices.size() < 2) label.vertices.insert(v);
    }
    const bool several = std::ranges::any_of(vertices, [&](VertexId v) { return v != vertices[0]; });
    if (strict && several && !is_excluded(excluded, labels[c], labels[c])) return true;
  }
  for (auto a = known.begin(); a != known.end(); ++a) {
    for (auto b = a; b != known.end(); ++b) {
      std::set<VertexId> both = a->second.vertices;
      both.insert(b->second.vertices.begin(), b->second.vertices.end());
      const bool two = a != b || a->second.cells > 1;
      if (two && both.size() > 1 && !is_excluded(excluded, a->first, b->first)) return true;
    }
  }
  return false;
}

std::string pairs_text(const LabelPairs& pairs) {
  std::string text;
  for (const auto& [a, b] : pairs) text += fmt::format("{}{}-{}", text.empty() ? "" : ",", a, b);
  return text;
}

/// Reads the text after `key=`, up to the next blank, as a number.
template <class T>
bool read_number(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

bool read_flag(std::string_view text, bool& value) {
  value = text == "1";
  return text == "0" || text == "1";
}

bool read_pairs(std::string_view text, LabelPairs& pairs) {
  while (!text.empty()) {
    const std::string_view pair = text.substr(0, text.find(','));
    const std::size_t minus = std::min(pair.find('-'), pair.size() - 1);
    std::array<std::uint32_t, 2> labels{};
    if (!read_number(pair.substr(0, minus), labels[0]) || !read_number(pair.substr(minus + 1), labels[1])) return false;
    pairs.insert(labels);
    text.remove_prefix(std::min(pair.size() + 1, text.size()));
  }
  return true;
}

/// "11", or "40..60" of a part.
bool read_steps(std::string_view text, Claim& claim) {
  const std::size_t dots = text.find("..");
  if (dots == std::string_view::npos) return read_number(text, claim.steps);
  ClaimPart& part = claim.part.emplace();
  if (!read_number(text.substr(0, dots), part.first) || !read_number(text.substr(dots + 2), part.last)) return false;
  claim.steps = part.last - part.first + 1;
  return part.first >= 1 && part.first <= part.last;
}

bool read_field(std::string_view key, std::string_view value, Claim& claim) {
  if (key == "motion") return claim.motion = value, true;
  if (key == "dimension") return read_number(value, claim.dimension);
  if (key == "steps") return read_steps(value, claim);
  if (key == "strict") return read_flag(value, claim.strict);
  if (key == "points") return read_flag(value, claim.points);
  if (key == "distance") return read_number(value, claim.distance);
  if (key == "ring") return read_number(value, claim.ring);
  if (key == "merged") return read_number(value, claim.merged);
  if (key == "excluded") return read_pairs(value, claim.excluded);
  if (key == "cells") return claim.cells = value, true;
  if (key == "empty") return read_flag(value, claim.empty);
  if (key == "from") return read_number(value, claim.from);
  return key == "to" && read_number(value, claim.to);
}

/// A value in the form of the line of a claim.
std::string word_of(const Json& value) {
  if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
  if (value.is_number_float()) return digits17(value.get<double>());
  if (value.is_string()) return value.get<std::string>();
  return value.is_array() ? pairs_text(value.get<LabelPairs>()) : value.dump();
}

/// The values of a claim in the order of its line.
std::vector<std::pair<std::string, std::string>> values(const Claim& claim) {
  std::vector<std::pair<std::string, std::string>> words;
  const Json members = claim_json(claim);  // items() only refers to it
  for (const auto& [key, value] : members.items()) words.emplace_back(key, word_of(value));
  return words;
}

/// Appends excluded=A-B,C-D: a list that is too long for one word as several.
void append_pairs(const std::string& pairs, std::vector<std::string>& fields) {
  std::size_t begin = 0;
  while (pairs.size() - begin > longest_word) {
    const std::size_t comma = pairs.rfind(',', begin + longest_word);
    fields.push_back("excluded=" + pairs.substr(begin, comma - begin));
    begin = comma + 1;
  }
  fields.push_back("excluded=" + pairs.substr(begin));
}

/// Reads the members of a claim file one by one.
class ClaimFile {
 public:
  explicit ClaimFile(const std::filesystem::path& file) : file_(file.string()) {}

  std::vector<std::string> fields() const {
    if (!std::filesystem::is_regular_file(file_)) fail("", "cannot be opened; expected a JSON file");
    const Json json = integrator::parse_json(read_whole_file(file_), file_);
    if (!json.is_object()) fail("", "expected an object, as `noli verify --claim-out` writes it");
    if (!json.contains("schema") || json["schema"] != schema) fail("/schema", fmt::format("expected \"{}\"", schema));
    if (!json.contains("version") || json["version"] != schema_version) {
      fail("/version", fmt::format("expected {}; this noli knows no other version", schema_version));
    }
    std::vector<std::string> fields;
    for (const auto& [key, value] : json.items()) {
      if (key == "schema" || key == "version") continue;
      // For a run the pairs are always those of its scene.
      if (key == "excluded" && json.value("motion", Json()) == "run") continue;
      const std::string text = word(key, value);
      const bool pairs = key == "excluded";
      if (text.size() > (pairs ? longest_list : longest_word)) fail("/" + key, "is longer than a checker accepts");
      if (pairs)
        append_pairs(text, fields);
      else
        fields.push_back(key + "=" + text);
    }
    return fields;
  }

 private:
  [[noreturn]] void fail(const std::string& pointer, const std::string& message) const {
    throw InputError(file_, pointer, message);
  }

  /// Does not check numbers, as the checker does.
  std::string word(const std::string& key, const Json& value) const {
    const Json members = claim_file({});
    if (!members.contains(key)) fail("/" + key, "unknown member; `noli schema claim` lists those of a claim");
    const Json& like = members[key];
    if (like.is_boolean() && !value.is_boolean()) fail("/" + key, "expected true or false");
    if (like.is_number_integer() && !value.is_number_unsigned()) fail("/" + key, "expected a whole number");
    if (like.is_number_float() && !value.is_number()) fail("/" + key, "expected a number");
    if (like.is_string() && !value.is_string()) fail("/" + key, "expected a string");
    if (like.is_array()) require_pairs(value);
    return word_of(like.is_number_float() ? Json(value.get<double>()) : value);
  }

  void require_pairs(const Json& list) const {
    if (!list.is_array()) fail("/excluded", "expected an array of pairs of labels");
    for (const Json& pair : list) {
      const bool two =
          pair.is_array() && pair.size() == 2 && pair[0].is_number_unsigned() && pair[1].is_number_unsigned();
      if (!two || pair[0].get<std::uint64_t>() > pair[1].get<std::uint64_t>() ||
          pair[1].get<std::uint64_t>() > 0xffffffff) {
        fail("/excluded", "expected pairs [a, b] of labels, a <= b");
      }
    }
  }

  std::string file_;
};

}  // namespace

void set_cells(Claim& claim, const Mesh& mesh, std::span<const std::uint32_t> labels, const LabelPairs& excluded) {
  ProofHeader header;
  header.vertices = mesh.vertex_count;
  header.mesh = &mesh;
  header.labels = labels;
  claim.cells = hex(cells_hash(header));
  claim.excluded = excluded;
  claim.empty = !compares_any(mesh, labels, excluded, claim.strict);
}

std::optional<Claim> claim_of_words(const std::string& words) {
  const std::size_t begin = words.find('\n');
  if (begin == std::string::npos) return std::nullopt;
  std::string_view line = std::string_view(words).substr(begin + 1);
  line = line.substr(0, line.find('\n'));
  if (!line.starts_with("claim ")) return std::nullopt;
  line.remove_prefix(6);
  Claim claim;
  for (const auto& [key, plain] : values(claim)) {
    const std::string_view field = line.substr(0, line.find(' '));
    const std::size_t equal = std::min(field.find('='), field.size());
    if (field.substr(0, equal) != key || equal == field.size()) return std::nullopt;
    if (!read_field(key, field.substr(equal + 1), claim)) return std::nullopt;
    line.remove_prefix(std::min(field.size() + 1, line.size()));
  }
  constexpr std::string_view proof = "proof=";
  if (claim.part && line.starts_with(proof)) claim.part->proof = line.substr(proof.size());
  const bool complete = claim.part ? claim.part->proof.size() == 64 : line.empty();
  return complete ? std::optional(std::move(claim)) : std::nullopt;
}

bool can_be_asked(const Claim& claim) {
  return claim.motion == "run" || pairs_text(claim.excluded).size() <= longest_list;
}

std::vector<std::string> fields_of(const Claim& claim) {
  std::vector<std::string> fields;
  for (const auto& [key, value] : values(claim)) {
    if (key == "from" || key == "to") continue;
    if (key == "steps" && claim.steps == 0) continue;  // not known yet: all that the motion has
    if (key == "ring" && claim.distance == 0) continue;
    // For a run the pairs are those of its scene by default; they may be too many for a command line.
    if (key == "excluded" && claim.motion == "run") continue;
    if (key == "excluded")
      append_pairs(value, fields);
    else
      fields.push_back(fmt::format("{}={}", key, value));
  }
  return fields;
}

std::vector<std::string> fields_beyond_default(const Claim& claim) {
  Claim plain;
  plain.motion = claim.motion == "run" ? "run" : "linear";
  plain.dimension = claim.motion == "run" ? claim.dimension : 3;
  plain.steps = claim.steps;
  const bool told_by_cells = claim.merged > 0 || (!claim.excluded.empty() && claim.motion != "run");
  plain.cells = told_by_cells ? "" : claim.cells;
  const std::vector<std::string> own = fields_of(claim), by_default = fields_of(plain);
  std::vector<std::string> fields;
  std::ranges::copy_if(own, std::back_inserter(fields),
                       [&](const std::string& field) { return std::ranges::count(by_default, field) == 0; });
  return fields;
}

std::optional<std::string> difference(const Claim& asked, const Claim& checked, bool refuted) {
  if (asked.part != checked.part) return "steps: one claim covers all steps, the other only a part of them";
  const auto one = values(asked), other = values(checked);
  for (std::size_t i = 0; i < one.size(); ++i) {
    const std::string& key = one[i].first;
    const bool extent = key == "steps" || key == "to";
    if (one[i].second == other[i].second || (refuted && extent)) continue;
    return fmt::format("{}: asked for {}, but the checker's is {}", key, one[i].second, other[i].second);
  }
  return std::nullopt;
}

std::vector<std::string> weakenings(const Claim& claim) {
  constexpr std::size_t most_listed = 8;
  std::vector<std::string> phrases;
  if (claim.motion == "rest") phrases.emplace_back("frames at rest");
  if (claim.merged > 0) phrases.push_back(fmt::format("{} merged vertices", claim.merged));
  if (claim.motion != "run" && !claim.excluded.empty()) {
    const std::size_t pairs = claim.excluded.size();
    phrases.push_back("not compared: " +
                      (pairs > most_listed ? fmt::format("{} pairs", pairs) : pairs_text(claim.excluded)));
  }
  if (claim.empty) phrases.emplace_back("the claim is empty");
  return phrases;
}

std::string distance_phrase(const Claim& claim) {
  if (claim.distance <= 0) return "";
  std::string which = claim.excluded.empty() ? "all" : "all that is compared";
  if (claim.ring > 1) which = fmt::format("what is {} mesh edges or more away", claim.ring);
  return fmt::format(", and {} is more than {} apart", which, claim.distance);
}

Json claim_json(const Claim& claim) {
  return {{"motion", claim.motion}, {"dimension", claim.dimension}, {"steps", claim.steps},
          {"strict", claim.strict}, {"points", claim.points},       {"distance", claim.distance},
          {"ring", claim.ring},     {"merged", claim.merged},       {"excluded", claim.excluded},
          {"cells", claim.cells},   {"empty", claim.empty},         {"from", claim.from},
          {"to", claim.to}};
}

Json checker_json(const CheckerVersion& checker) {
  return {{"name", checker.name}, {"version", checker.version}, {"commit", checker.commit}};
}

Json claim_file(const Claim& claim) {
  Json json = {{"schema", schema}, {"version", schema_version}};
  const Json fields = claim_json(claim);  // items() only refers to it
  for (const auto& [key, value] : fields.items()) {
    if (key != "from" && key != "to") json[key] = value;
  }
  return json;
}

std::vector<std::string> read_claim_file(const std::filesystem::path& file) { return ClaimFile(file).fields(); }

std::function<std::unique_ptr<Sink>(const Claim&)> proof_to_file(std::filesystem::path file) {
  return [file = std::move(file)](const Claim&) { return std::make_unique<FileSink>(file, FileSink::Open::create); };
}

}  // namespace noli
