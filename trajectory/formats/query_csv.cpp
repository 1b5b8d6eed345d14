// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/query_csv.h"

#include <fmt/format.h>

#include <gmpxx.h>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>

#include <noli/errors.h>
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli {
namespace {

struct KindName {
  std::string_view word;
  QueryKind kind;
};
constexpr std::array<KindName, 4> kind_names = {{{"vertex-face", QueryKind::vertex_face},
                                                 {"edge-edge", QueryKind::edge_edge},
                                                 {"vertex-edge", QueryKind::vertex_edge},
                                                 {"vertex-vertex", QueryKind::vertex_vertex}}};

std::string_view trimmed(std::string_view field) {
  const std::size_t begin = field.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return field.substr(begin, field.find_last_not_of(" \t") + 1 - begin);
}

class CsvParser {
 public:
  CsvParser(std::string_view text, const std::string& file, QueryKind kind)
      : lines_(text), file_(file), points_(point_count(kind)) {}

  std::vector<QueryRecord> parse() {
    std::string_view line;
    while (lines_.next(line)) {
      if (const auto text = trimmed(line); !text.empty() && text.front() != '#') parse_row(line);
    }
    if (rows_ == 0) throw InputError(file_, "", "holds no queries");
    if (row_of_query() != 0) {
      fail(fmt::format("the file ends within a query: {} rows, expected a multiple of {}", rows_, 2 * points_));
    }
    return std::move(records_);
  }

 private:
  static constexpr std::size_t coordinate_columns = 6;

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(file_, line_place(lines_.number()), problem);
  }

  std::size_t row_of_query() const { return rows_ % (2 * points_); }

  void parse_row(std::string_view line) {
    end_if_stopped();
    split(line);
    if (row_of_query() == 0) records_.emplace_back();
    QueryRecord& record = records_.back();
    Position& position = row_of_query() < points_ ? record.x_t0[row_of_query()] : record.x_t1[row_of_query() - points_];
    for (std::size_t axis = 0; axis < 3; ++axis) position[axis] = parse_coordinate(axis);
    const std::optional<bool> label = parse_label();
    if (row_of_query() == 0) record.label = label;
    if (label != record.label) fail("the label differs from that of the first row of this query");
    ++rows_;
  }

  /// Fills columns_; all rows of a file must have as many as the first.
  void split(std::string_view line) {
    columns_.clear();
    for (std::size_t comma = 0; comma != std::string_view::npos;) {
      comma = line.find(',');
      columns_.push_back(trimmed(line.substr(0, comma)));
      line.remove_prefix(comma == std::string_view::npos ? 0 : comma + 1);
    }
    if (columns_.size() != coordinate_columns && columns_.size() != coordinate_columns + 1) {
      fail(fmt::format("expected 6 columns, or 7 with a label, found {}", columns_.size()));
    }
    if (rows_ == 0) labelled_ = columns_.size() > coordinate_columns;
    if (labelled_ != (columns_.size() > coordinate_columns)) {
      fail(labelled_ ? "the label is missing, the rows before have one" : "a label, but the rows before have none");
    }
  }

  double parse_coordinate(std::size_t axis) const {
    double value = 0;
    const std::string problem = parse_exact_quotient(columns_[2 * axis], columns_[2 * axis + 1], value);
    if (!problem.empty()) fail(fmt::format("{}: {}", "xyz"[axis], problem));
    return value;
  }

  std::optional<bool> parse_label() const {
    if (!labelled_) return std::nullopt;
    const std::string_view word = columns_.back();
    if (word != "0" && word != "1") fail(fmt::format("expected the label 0 or 1, found {}", in_quotes(word)));
    return word == "1";
  }

  Lines lines_;
  const std::string& file_;
  std::size_t points_;
  std::vector<std::string_view> columns_;  ///< of the current row
  std::size_t rows_ = 0;                   ///< read so far
  bool labelled_ = false;
  std::vector<QueryRecord> records_;
};

std::string format_row(const Position& x, std::optional<bool> label) {
  std::string row = format_exact_quotient(x[0]);
  for (const double coordinate : {x[1], x[2]}) row += ',' + format_exact_quotient(coordinate);
  if (label) row += *label ? ",1" : ",0";
  return row + '\n';
}

// --- Quotients -------------------------------------------------------------------------------------------------------

constexpr int significand_bits = 53;
constexpr std::int64_t lowest_exponent = -1074;  ///< of the last bit of a subnormal
constexpr std::int64_t highest_exponent = 1024;  ///< every finite double is less than two to this power

/// Whether the word is a decimal integer: an optional sign and digits.
bool is_decimal_integer(std::string_view word) {
  if (!word.empty() && (word[0] == '-' || word[0] == '+')) word.remove_prefix(1);
  return !word.empty() && std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// The usual case: both fit a machine word, the denominator is a power of two, and the numerator has at most 53 bits.
bool parse_small(std::string_view numerator, std::string_view denominator, double& value) {
  std::int64_t n = 0, d = 0;
  if (parse_number(numerator, n) != std::errc{} || parse_number(denominator, d) != std::errc{}) return false;
  const bool exact = n != 0 && std::llabs(n / 2) < (std::int64_t{1} << (significand_bits - 1)) && d > 0 &&
                     std::has_single_bit(static_cast<std::uint64_t>(d));
  if (exact) value = static_cast<double>(n) / static_cast<double>(d);
  return exact;
}

mpz_class to_integer(std::string_view word) {
  if (word[0] == '+') word.remove_prefix(1);
  return mpz_class(std::string(word), 10);
}

/// Takes the factors of two out of z, which must not be zero, and returns how many there were.
std::int64_t make_odd(mpz_class& z) {
  const mp_bitcnt_t zeros = mpz_scan1(z.get_mpz_t(), 0);
  z >>= zeros;
  return static_cast<std::int64_t>(zeros);
}

/// Sets `value` to n 2^exponent, n odd, if that is a double.
bool scale_exactly(const mpz_class& n, std::int64_t exponent, double& value) {
  const auto bits = static_cast<std::int64_t>(mpz_sizeinbase(n.get_mpz_t(), 2));
  if (bits > significand_bits || exponent < lowest_exponent || bits + exponent > highest_exponent) return false;
  value = std::ldexp(n.get_d(), static_cast<int>(exponent));
  return true;
}

}  // namespace

std::size_t point_count(QueryKind kind) {
  switch (kind) {
    case QueryKind::vertex_face:
    case QueryKind::edge_edge: return 4;
    case QueryKind::vertex_edge: return 3;
    case QueryKind::vertex_vertex: return 2;
  }
  return 0;
}

std::optional<QueryKind> kind_from_file_name(const std::filesystem::path& path) {
  std::string file_name = path.filename().string();
  std::ranges::replace(file_name, '_', '-');
  std::optional<QueryKind> result;
  for (const auto& [word, kind] : kind_names) {
    if (file_name.find(word) == std::string::npos) continue;
    if (result) return std::nullopt;
    result = kind;
  }
  return result;
}

std::vector<QueryRecord> parse_query_csv(std::string_view text, const std::string& file, QueryKind kind) {
  if (text.empty()) throw InputError(file, "", "is empty");
  return CsvParser(text, file, kind).parse();
}

std::vector<QueryRecord> read_query_csv(const std::filesystem::path& path, QueryKind kind) {
  return parse_query_csv(read_whole_file(path), path.string(), kind);
}

std::string format_query_csv(QueryKind kind, std::span<const QueryRecord> records) {
  std::string text;
  for (const QueryRecord& record : records) {
    if (record.label.has_value() != records[0].label.has_value()) {
      throw std::invalid_argument("format_query_csv: some queries have a label and some have none");
    }
    for (const auto& positions : {record.x_t0, record.x_t1}) {
      for (std::size_t p = 0; p < point_count(kind); ++p) text += format_row(positions[p], record.label);
    }
  }
  return text;
}

std::string parse_exact_quotient(std::string_view numerator, std::string_view denominator, double& value) {
  if (parse_small(numerator, denominator, value)) return {};
  for (const std::string_view word : {numerator, denominator}) {
    if (!is_decimal_integer(word)) return fmt::format("expected a whole number, found {}", in_quotes(word));
  }
  mpz_class n = to_integer(numerator), d = to_integer(denominator);
  if (d == 0) return "the denominator is zero";
  if (n == 0) {
    value = numerator[0] == '-' ? -0.0 : 0.0;
    return {};
  }
  const std::int64_t exponent = make_odd(n) - make_odd(d);
  const bool is_dyadic = mpz_divisible_p(n.get_mpz_t(), d.get_mpz_t()) != 0;
  if (is_dyadic) mpz_divexact(n.get_mpz_t(), n.get_mpz_t(), d.get_mpz_t());
  if (is_dyadic && scale_exactly(n, exponent, value)) return {};
  return fmt::format("the quotient of {} and {} is not exactly a double", in_quotes(numerator), in_quotes(denominator));
}

std::string format_exact_quotient(double value) {
  if (value == 0) return std::signbit(value) ? "-0,1" : "0,1";
  int exponent = 0;
  mpz_class n(std::ldexp(std::frexp(value, &exponent), significand_bits)), d(1);
  const std::int64_t shift = exponent - significand_bits + make_odd(n);
  mpz_class& scaled = shift >= 0 ? n : d;
  scaled <<= static_cast<mp_bitcnt_t>(std::llabs(shift));
  return n.get_str() + ',' + d.get_str();
}

}  // namespace noli
