// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/arrays/npy.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <type_traits>

#include <noli/errors.h>
#include "trajectory/blocks/bytes.h"
#include "trajectory/text.h"

namespace noli {
namespace {

constexpr std::string_view magic{"\x93NUMPY", 6};
constexpr std::size_t most_header = std::size_t{1} << 20;
constexpr std::uint64_t most_numbers = std::uint64_t{1} << 60;

/// The header of an array: a dictionary as Python writes it, with three keys.
class HeaderText {
 public:
  HeaderText(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  void read(NpyHeader& header) {
    expect('{');
    bool descr = false, order = false, shape = false;
    while (!skip('}')) {
      const std::string key = quoted();
      expect(':');
      if (key == "descr" && !descr) {
        descr = true;
        skip_blanks();
        if (rest_.starts_with('[')) {
          skip_records();
          header.kind = NpyHeader::Kind::other;
          header.refusal = "is an array of records; expected one of numbers";
        } else {
          set_type(header, quoted());
        }
      } else if (key == "fortran_order" && !order) {
        order = true;
        header.fortran = truth();
      } else if (key == "shape" && !shape) {
        shape = true;
        header.shape = tuple();
      } else {
        fail("the header has the key " + in_quotes(key) + "; expected descr, fortran_order, shape, once each");
      }
      if (!skip(',')) {
        expect('}');
        break;
      }
    }
    if (!descr || !order || !shape) fail("the header lacks one of descr, fortran_order, shape");
    if (!rest_.empty() && rest_.find_first_not_of(" \n") != std::string_view::npos)
      fail("something follows the header");
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const { throw InputError(name_, "", problem); }

  void skip_blanks() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\n')) rest_.remove_prefix(1);
  }
  bool skip(char c) {
    skip_blanks();
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }
  void expect(char c) {
    if (!skip(c))
      fail(fmt::format("the header is not a dictionary of three keys; expected '{}' before {}", c, in_quotes(rest_)));
  }
  std::string quoted() {
    skip_blanks();
    const char quote = rest_.starts_with('"') ? '"' : '\'';
    expect(quote);
    const std::size_t end = rest_.find(quote);
    if (end == std::string_view::npos) fail("the header ends within a text");
    const std::string text(rest_.substr(0, end));
    rest_.remove_prefix(end + 1);
    return text;
  }
  /// Up to the bracket that closes this one. Names of fields with brackets in them are refused with the rest.
  void skip_records() {
    std::size_t depth = 0, at = 0;
    for (; at < rest_.size(); ++at) {
      if (rest_[at] == '[' || rest_[at] == '(') ++depth;
      if ((rest_[at] == ']' || rest_[at] == ')') && --depth == 0) break;
    }
    if (at == rest_.size()) fail("the header ends within a list of fields");
    rest_.remove_prefix(at + 1);
  }
  bool truth() {
    skip_blanks();
    for (const bool value : {true, false}) {
      const std::string_view word = value ? "True" : "False";
      if (!rest_.starts_with(word)) continue;
      rest_.remove_prefix(word.size());
      return value;
    }
    fail("fortran_order is neither True nor False");
  }
  std::vector<std::uint64_t> tuple() {
    constexpr std::size_t most_dimensions = 32;
    std::vector<std::uint64_t> numbers;
    expect('(');
    while (!skip(')')) {
      if (numbers.size() == most_dimensions) fail("has more than 32 dimensions");
      numbers.push_back(number());
      if (!skip(',')) {
        expect(')');
        break;
      }
    }
    return numbers;
  }
  std::uint64_t number() {
    skip_blanks();
    const std::size_t digits = std::min(rest_.find_first_not_of("0123456789"), rest_.size());
    std::uint64_t value = 0;
    if (parse_number(rest_.substr(0, digits), value) != std::errc{})
      fail("the shape has no number before " + in_quotes(rest_));
    rest_.remove_prefix(digits);
    if (rest_.starts_with('L')) rest_.remove_prefix(1);  // of Python 2
    return value;
  }

  /// Types that are not read keep their shape: float16 may be positions too.
  static void set_type(NpyHeader& header, const std::string& descr) {
    using Kind = NpyHeader::Kind;
    const bool known = descr.size() == 3 && std::string_view("<>|=").find(descr[0]) != std::string_view::npos;
    const char kind = known ? descr[1] : '?';
    header.kind = kind == 'f'   ? Kind::real
                  : kind == 'i' ? Kind::signed_integer
                  : kind == 'u' ? Kind::unsigned_integer
                                : Kind::other;
    const std::string_view sizes = kind == 'f' ? "48" : "1248";
    if (header.kind == Kind::other || sizes.find(descr[2]) == std::string_view::npos) {
      header.refusal = fmt::format("is an array of type {}; expected float32, float64 or integers", in_quotes(descr));
      return;
    }
    header.big_endian = descr[0] == '>';
    header.size = static_cast<std::size_t>(descr[2] - '0');
  }

  std::string_view rest_;
  const std::string& name_;
};

/// Numbers are read in parts, so that no length is believed before its bytes have come.
constexpr std::size_t part_bytes = std::size_t{1} << 16;

[[noreturn]] void fail_at_end(const std::string& name) {
  throw InputError(name, "", "ends before its last number; the file was cut off");
}

/// Calls `take` with the bytes of so many numbers and the index of the first, part by part.
template <class Take>
void read_parts(ByteStream& bytes, std::size_t size, std::uint64_t count, const std::string& name, const Take& take) {
  std::array<char, part_bytes> part;
  const std::uint64_t most = part_bytes / size;
  for (std::uint64_t done = 0; done < count;) {
    const auto now = static_cast<std::size_t>(std::min(most, count - done));
    if (bytes.read_all(part.data(), now * size) < now * size) fail_at_end(name);
    take(part.data(), done, now);
    done += now;
  }
}

template <class Number, class To>
void convert(ByteStream& bytes, const NpyHeader& header, const std::string& name, std::span<To> numbers) {
  read_parts(bytes, sizeof(Number), numbers.size(), name,
             [&](const char* part, std::uint64_t first, std::size_t count) {
               for (std::size_t i = 0; i < count; ++i) {
                 const auto number = number_from_bytes<Number>(part + i * sizeof(Number), header.big_endian);
                 if constexpr (std::is_same_v<Number, std::uint64_t>) {
                   if (number > std::uint64_t{INT64_MAX})
                     throw InputError(name, "", fmt::format("has the index {}", number));
                 }
                 numbers[first + i] = static_cast<To>(number);  // NOLINT(bugprone-signed-char-misuse): int8 is a number
               }
             });
}

}  // namespace

std::uint64_t NpyHeader::count() const {
  std::uint64_t product = 1;
  for (const std::uint64_t n : shape) product *= n;
  return product;
}

std::string NpyHeader::type() const {
  if (!refusal.empty()) return "(other type)";
  const char* const words = kind == Kind::real ? "float" : kind == Kind::signed_integer ? "int" : "uint";
  return fmt::format("{}{}", words, 8 * size);
}

std::string NpyHeader::text() const {
  return fmt::format("{} ({}{})", type(), fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
}

std::optional<NpyHeader> read_npy_header(ByteStream& bytes, const std::string& name) {
  std::array<char, 12> begin{};
  const std::size_t got = bytes.read_all(begin.data(), 8);
  if (got == 0) return std::nullopt;
  if (got < 8 || std::string_view(begin.data(), magic.size()) != magic) {
    throw InputError(name, "", "is not an array of numpy: it does not begin with \\x93NUMPY");
  }
  const auto version = static_cast<unsigned char>(begin[6]), minor = static_cast<unsigned char>(begin[7]);
  if (version < 1 || version > 3 || minor != 0) {
    throw InputError(name, "", fmt::format("has version {}.{} of the format; expected 1.0 to 3.0", version, minor));
  }
  const std::size_t length_bytes = version == 1 ? 2 : 4;
  if (bytes.read_all(begin.data() + 8, length_bytes) < length_bytes) fail_at_end(name);
  const std::size_t length = length_bytes == 2 ? number_from_bytes<std::uint16_t>(begin.data() + 8, false)
                                               : number_from_bytes<std::uint32_t>(begin.data() + 8, false);
  if (length > most_header) throw InputError(name, "", fmt::format("has a header of {} bytes", length));
  std::string text(length, 0);
  if (bytes.read_all(text.data(), length) < length) fail_at_end(name);
  NpyHeader header;
  HeaderText(text, name).read(header);
  header.header_bytes = 8 + length_bytes + length;
  std::uint64_t most = most_numbers;
  for (const std::uint64_t n : header.shape) {
    if (n > most) throw InputError(name, "", fmt::format("has the shape ({})", fmt::join(header.shape, ", ")));
    most /= std::max<std::uint64_t>(n, 1);
  }
  return header;
}

void read_numbers(ByteStream& bytes, const NpyHeader& header, const std::string& name, std::span<double> numbers) {
  if (header.size == 4) return convert<float>(bytes, header, name, numbers);
  if (header.big_endian != (std::endian::native == std::endian::big))
    return convert<double>(bytes, header, name, numbers);
  const std::size_t size = numbers.size_bytes();
  if (bytes.read_all(reinterpret_cast<char*>(numbers.data()), size) < size) fail_at_end(name);
}

void read_numbers(ByteStream& bytes, const NpyHeader& header, const std::string& name,
                  std::span<std::int64_t> numbers) {
  const bool is_signed = header.kind == NpyHeader::Kind::signed_integer;
  switch (header.size) {
    case 1:
      return is_signed ? convert<std::int8_t>(bytes, header, name, numbers)
                       : convert<std::uint8_t>(bytes, header, name, numbers);
    case 2:
      return is_signed ? convert<std::int16_t>(bytes, header, name, numbers)
                       : convert<std::uint16_t>(bytes, header, name, numbers);
    case 4:
      return is_signed ? convert<std::int32_t>(bytes, header, name, numbers)
                       : convert<std::uint32_t>(bytes, header, name, numbers);
    default:
      return is_signed ? convert<std::int64_t>(bytes, header, name, numbers)
                       : convert<std::uint64_t>(bytes, header, name, numbers);
  }
}

void require_end(ByteStream& bytes, const std::string& name) {
  char more = 0;
  if (bytes.read(&more, 1) > 0) throw InputError(name, "", "continues after its numbers");
}

void skip_numbers(ByteStream& bytes, const NpyHeader& header, const std::string& name, std::uint64_t count) {
  read_parts(bytes, header.size, count, name, [](const char*, std::uint64_t, std::size_t) {});
}

std::string npy_header(NpyHeader::Kind kind, std::size_t size, std::span<const std::uint64_t> shape) {
  const char order = std::endian::native == std::endian::big ? '>' : '<';
  std::string text = fmt::format("{{'descr': '{}{}{}', 'fortran_order': False, 'shape': ({}{}), }}", order,
                                 kind == NpyHeader::Kind::real ? 'f' : 'u', size, fmt::join(shape, ", "),
                                 shape.size() == 1 ? "," : "");
  constexpr std::size_t before = magic.size() + 4, alignment = 64;
  text.resize((before + text.size() + 1 + alignment - 1) / alignment * alignment - before - 1, ' ');
  text += '\n';
  const std::string begin{'\1', '\0', static_cast<char>(text.size() & 0xff), static_cast<char>(text.size() >> 8)};
  return std::string(magic) + begin + text;
}

}  // namespace noli
