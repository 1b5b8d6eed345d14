// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/saved_query.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <system_error>

#include <noli/errors.h>
#include "trajectory/formats/query_csv.h"
#include "trajectory/text.h"
#include "trajectory/write_file.h"

namespace noli::audit {

namespace {

/// The result of `parse` for the first line that it can parse.
template <class Parse>
auto first_parsed(std::string_view text, const Parse& parse) {
  Lines lines(text);
  std::string_view line;
  while (lines.next(line)) {
    if (const auto found = parse(line)) return found;
  }
  return decltype(parse(line))();
}

std::string type_line(const QueryType& type) { return fmt::format("# query {} {}d", name(type.pair), type.dimension); }

}  // namespace

std::optional<QueryType> saved_type(std::string_view text) {
  return first_parsed(text, [](std::string_view line) {
    const auto found = std::ranges::find(all_query_types, line, type_line);
    return found == all_query_types.end() ? std::nullopt : std::optional(*found);
  });
}

std::string file_suffix(const QueryType& type) {
  std::string pair(name(type.pair));
  std::replace(pair.begin(), pair.end(), '_', '-');
  return pair + (type.dimension == 2 ? "-2d" : "");
}

void save_query(const std::filesystem::path& file, const AnyQuery& query, bool contact,
                std::span<const std::string> comments) {
  const QueryRecord record{query.x_t0, query.x_t1, contact};
  std::string text = format_query_csv(file_kind(query.pair), std::span(&record, 1));
  text += type_line({query.pair, query.dimension}) + '\n';
  for (const std::string& comment : comments) text += comment + '\n';
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  try {
    write_file(file, text);
  } catch (...) {
    std::error_code ignored;  // part of it may be there
    std::filesystem::remove(file, ignored);
    throw;
  }
}

std::vector<SavedQuery> read_saved_queries(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) throw InputError(file.string(), "", "is not there");
  const auto kind = kind_from_file_name(file);
  if (!kind)
    throw InputError(file.string(), "", "its name must contain the kind of query: vertex-face, edge-edge, ...");
  const std::string text = read_whole_file(file);
  const auto saved = first_parsed(text, parse_probe_line);
  const auto type = saved_type(text);
  AnyQuery query{static_cast<FeaturePair>(*kind), saved ? saved->dimension : type ? type->dimension : 3, {}, {}};
  const bool fitting = !type || *type == QueryType{query.pair, query.dimension};
  if (!fitting) throw InputError(file.string(), "", "its name, its line query and its line noli-fuzz do not agree");
  if (saved && !fits(query, saved->probe)) {
    throw InputError(file.string(), "", "the line noli-fuzz asks for what a query of this kind does not have");
  }
  std::vector<SavedQuery> result;
  for (const QueryRecord& record : parse_query_csv(text, file.string(), *kind)) {
    query.x_t0 = record.x_t0;
    query.x_t1 = record.x_t1;
    result.push_back({query, saved ? std::optional(saved->probe) : std::nullopt});
  }
  return result;
}

std::string c_array(const AnyQuery& query) {
  // "-0" would be the integer 0.
  const auto number = [](double x) { return x == 0 && std::signbit(x) ? "-0.0" : fmt::format("{:.17g}", x); };
  const auto point = [&](const Point3& x) {
    return fmt::format("{{{}, {}, {}}}", number(x[0]), number(x[1]), number(x[2]));
  };
  const auto points = [&](const auto& x) {
    std::string text;
    for (std::size_t i = 0; i < query.size(); ++i) text += (i == 0 ? "" : ", ") + point(x[i]);
    return '{' + text + '}';
  };
  return fmt::format("double x[2][{}][3] = {{{}, {}}};", query.size(), points(query.x_t0), points(query.x_t1));
}

std::string quoted(const std::string& word) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=./,:@";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace noli::audit
