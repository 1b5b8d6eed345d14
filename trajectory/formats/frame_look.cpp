// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/frame_look.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <vector>

#include "trajectory/formats/frames.h"
#include "trajectory/formats/ply_header.h"
#include "trajectory/formats/vtk/vtu.h"
#include "trajectory/input_file.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli {
namespace {

/// A hash of the spelling of cells; valid only within this process.
class Spelling {
 public:
  void add(std::string_view text) { add(static_cast<std::uint64_t>(std::hash<std::string_view>{}(text))); }
  void add(std::uint64_t number) { hash_ = (std::rotl(hash_, 23) ^ number) * 0x9e3779b97f4a7c15; }
  std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = 0;
};

/// Notes the digits of the text in `facts`, and whether it may have been rounded: it has fewer digits than `enough`.
void take_digits(const TextDigits& digits, std::size_t enough, FrameFacts& facts) {
  facts.numbers = digits.text();
  facts.decimals = digits.decimals();
  if (digits.digits() < enough) facts.rounded_at = digits.unit();
}

/// The cells of an OBJ file. The meaning of negative indices depends on how many vertices came before.
std::optional<std::uint64_t> look_at_obj(std::string_view bytes, FrameFacts& facts) {
  TextDigits digits;
  Spelling cells;
  std::uint64_t vertices_told = 0;
  bool continued = false;
  Lines lines(bytes);
  for (std::string_view line; lines.next(line);) {
    end_if_stopped();
    continued |= line.ends_with('\\');
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    if (line.size() < 2 || !is_blank(line[1])) continue;
    if (line[0] == 'v') {
      ++facts.vertices;
      Words words(line.substr(1));
      for (int k = 0; k < 3; ++k) digits.add(words.next());
    } else if (line[0] == 'f' || line[0] == 'l' || line[0] == 'p') {
      if (vertices_told != facts.vertices) cells.add(vertices_told = facts.vertices);
      cells.add(line);
    }
  }
  take_digits(digits, digits_of_float64, facts);
  if (continued) return std::nullopt;
  cells.add(facts.vertices);
  return cells.hash();
}

/// There is no short way to the cells: it is parsed.
std::optional<std::uint64_t> look_at_vtk(std::string_view bytes, const std::string& file, FrameFacts& facts) {
  VtkNumbers numbers;
  const Mesh mesh = parse_vtk(bytes, file, nullptr, &numbers).mesh;
  facts.vertices = mesh.vertex_count;
  facts.numbers = numbers.type == "Float32" ? "float32" : "float64";
  if (!numbers.text.empty()) {
    TextDigits digits;
    Lines lines(numbers.text);
    for (std::string_view line; lines.next(line);) {
      end_if_stopped();
      for (Words words(line); !words.at_end();) digits.add(words.next());
    }
    take_digits(digits, numbers.type == "Float32" ? digits_of_float32 : digits_of_float64, facts);
    if (numbers.type == "Float32") facts.numbers += ", read as float32";
  }
  Spelling cells;
  cells.add(mesh.vertex_count);
  for (const auto& face : mesh.faces) {
    for (const VertexId v : face) cells.add(v);
  }
  cells.add(mesh.faces.size());
  for (const auto& edge : mesh.edges) {
    for (const VertexId v : edge) cells.add(v);
  }
  cells.add(mesh.edges.size());
  for (const VertexId v : mesh.points) cells.add(v);
  return cells.hash();
}

class PlyLook {
 public:
  PlyLook(std::string_view bytes, const std::string& file, FrameFacts& facts)
      : body_(bytes), header_(parse_ply_header(bytes, file)), facts_(facts) {
    body_.remove_prefix(header_.body_offset);
  }

  std::optional<std::uint64_t> cells() {
    const PlyElement* const vertex = header_.find("vertex");
    if (vertex == nullptr) return std::nullopt;
    facts_.vertices = vertex->count;
    facts_.numbers = number_type(*vertex);
    add_header(*vertex);
    const bool whole = header_.format == PlyFormat::ascii ? skip_lines(*vertex) : skip_bytes(*vertex);
    if (!whole || vertex->find("x") == nullptr || vertex->find("y") == nullptr) return std::nullopt;
    return cells_.hash();
  }

 private:
  /// All of the header except the types of the vertices' properties.
  void add_header(const PlyElement& vertex) {
    cells_.add(static_cast<std::uint64_t>(header_.format));
    for (const PlyElement& element : header_.elements) {
      cells_.add(element.name);
      cells_.add(element.count);
      if (&element == &vertex) continue;
      for (const PlyProperty& property : element.properties) {
        cells_.add(property.name);
        cells_.add(static_cast<std::uint64_t>(property.type));
        cells_.add(property.count_type ? static_cast<std::uint64_t>(*property.count_type) : 99);
      }
    }
  }

  static bool has_list(const PlyElement& element) {
    return std::ranges::any_of(element.properties, [](const PlyProperty& p) { return p.count_type.has_value(); });
  }

  /// False if the vertices cannot be found without parsing what precedes them, or the file has too few bytes for them.
  bool skip_bytes(const PlyElement& vertex) {
    std::uint64_t before = 0;
    for (const PlyElement& element : header_.elements) {
      if (has_list(element)) return false;
      std::uint64_t entry = 0;
      for (const PlyProperty& property : element.properties) entry += size_of(property.type);
      if (entry > 0 && element.count > (body_.size() - before) / entry) return false;
      if (&element == &vertex) {
        cells_.add(body_.substr(0, before));
        cells_.add(body_.substr(before + element.count * entry));
        return true;
      }
      before += element.count * entry;
    }
    return false;
  }

  /// The columns of those of x, y and z that are decimal.
  std::vector<std::size_t> columns(const PlyElement& vertex) const {
    std::vector<std::size_t> found;
    for (std::size_t p = 0; p < vertex.properties.size(); ++p) {
      const PlyProperty& property = vertex.properties[p];
      const bool axis = property.name == "x" || property.name == "y" || property.name == "z";
      if (axis && !is_integer(property.type)) found.push_back(p);
    }
    return found;
  }

  /// An entry is a line that is not blank.
  bool skip_lines(const PlyElement& vertex) {
    std::uint64_t first = 0;  // line of the first vertex
    for (const PlyElement& element : header_.elements) {
      if (&element == &vertex) break;
      first += element.count;
    }
    if (has_list(vertex)) return false;
    const std::vector<std::size_t> wanted = columns(vertex);
    TextDigits digits;
    std::uint64_t entry = 0;
    Lines lines(body_);
    for (std::string_view line; lines.next(line);) {
      end_if_stopped();
      if (Words(line).at_end()) continue;
      if (entry >= first && entry - first < vertex.count) {
        add_digits(line, wanted, digits);
      } else {
        cells_.add(line);
      }
      ++entry;
    }
    take_text(vertex, wanted, digits);
    return true;
  }

  static void add_digits(std::string_view line, const std::vector<std::size_t>& wanted, TextDigits& digits) {
    Words words(line);
    std::size_t column = 0;
    for (const std::size_t next : wanted) {
      for (; column < next; ++column) words.next();
      digits.add(words.next());
      ++column;
    }
  }

  void take_text(const PlyElement& vertex, const std::vector<std::size_t>& wanted, const TextDigits& digits) {
    if (wanted.empty()) return;  // integers are not rounded
    const bool all_single =
        std::ranges::all_of(wanted, [&](std::size_t p) { return vertex.properties[p].type == PlyType::float32; });
    take_digits(digits, all_single ? digits_of_float32 : digits_of_float64, facts_);
    if (all_single) facts_.numbers += ", read as float32";
  }

  std::string_view body_;
  PlyHeader header_;
  FrameFacts& facts_;
  Spelling cells_;
};

}  // namespace

Sha256Digest frame_hash(std::string_view bytes) {
  constexpr std::size_t part = std::size_t{1} << 24;
  Sha256 hash;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(part, bytes.size()))) {
    end_if_stopped();
    hash.update(bytes.substr(0, part));
  }
  return hash.digest();
}

FrameLook look_at_frame(std::string_view bytes, const std::filesystem::path& path) {
  FrameLook look;
  look.facts.file = path.string();
  look.facts.looked_at = true;
  look.facts.bytes = bytes.size();
  look.facts.sha256 = frame_hash(bytes);
  switch (mesh_format(path)) {
    case MeshFormat::ply: look.cells = PlyLook(bytes, path.string(), look.facts).cells(); break;
    case MeshFormat::obj: look.cells = look_at_obj(bytes, look.facts); break;
    case MeshFormat::vtk: look.cells = look_at_vtk(bytes, path.string(), look.facts); break;
  }
  return look;
}

FrameFacts file_facts(const std::filesystem::path& path, const std::function<bool()>& stop) {
  FrameFacts facts;
  InputFile file(path);
  Sha256 hash;
  std::vector<char> part(std::size_t{1} << 20);
  while (const std::size_t got = file.read(part.data(), part.size())) {
    if (stop && stop()) throw ReadInterrupted(path.string());
    hash.update({part.data(), got});
    facts.bytes += got;
  }
  facts.file = path.string();
  facts.looked_at = true;
  facts.sha256 = hash.digest();
  return facts;
}

void TextDigits::add(std::string_view word) {
  std::size_t whole = 0, fraction = 0, zeros = 0, significant = 0;
  bool point = false;
  std::size_t at = !word.empty() && (word[0] == '-' || word[0] == '+') ? 1 : 0;
  for (; at < word.size(); ++at) {
    const char c = word[at];
    if (c == '.' && !point) {
      point = true;
    } else if (c >= '0' && c <= '9') {
      ++(point ? fraction : whole);
      ++(significant > 0 || c != '0' ? significant : zeros);
    } else {
      break;
    }
  }
  if (whole + fraction == 0) return;
  int exponent = 0;
  if (at < word.size() && ((word[at] | 0x20) != 'e' || parse_number(word.substr(at + 1), exponent) != std::errc{}))
    return;
  any_ = true;
  const int behind = static_cast<int>(fraction) - exponent;
  decimals_ = std::max(decimals_, static_cast<std::size_t>(std::max(behind, 0)));
  if (behind > 0) least_decimals_ = std::min(least_decimals_.value_or(decimals_), static_cast<std::size_t>(behind));
  if (significant == 0) return;
  digits_ = std::max(digits_, significant);
  const int first = static_cast<int>(whole) - static_cast<int>(zeros) - 1 + exponent;
  largest_ = std::max(largest_.value_or(first), first);
}

std::optional<int> TextDigits::unit() const {
  if (!any_) return std::nullopt;
  // 0.000001 next to 4: only a fixed number of decimals writes both with so few digits.
  const bool fixed = least_decimals_ && *least_decimals_ == decimals_ && digits_ < decimals_;
  if (!largest_ || fixed) return -static_cast<int>(decimals_);
  return *largest_ - static_cast<int>(digits_) + 1;
}

std::string TextDigits::text() const {
  return fmt::format("text with {} digit{}, {} decimal{}", digits_, digits_ == 1 ? "" : "s", decimals_,
                     decimals_ == 1 ? "" : "s");
}

}  // namespace noli
