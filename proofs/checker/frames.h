// SPDX-License-Identifier: Apache-2.0
//
// Frames: PLY and OBJ, as proofs/FORMAT.md, section 8, says.
#pragma once

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <set>

#include "base.h"

namespace noli::checker {

using Cell = std::vector<std::uint32_t>;

/// Faces, loose edges, loose points.
struct Mesh {
  std::uint64_t vertices = 0;
  std::vector<Cell> cells;
};

struct Frame {
  Mesh mesh;
  std::vector<std::array<double, 3>> x;
};

/// Cells as a file lists them, and the rules that make them those of a mesh.
struct RawCells {
  std::vector<Cell> faces, edges, points;

  void add_polygon(const Cell& corners) {
    if (corners.size() == 1) points.push_back(corners);
    if (corners.size() == 2) edges.push_back(corners);
    for (std::size_t i = 2; i < corners.size(); ++i) faces.push_back({corners[0], corners[i - 1], corners[i]});
  }

  /// All of them in order, without those that are redundant.
  std::vector<Cell> without_redundant(std::uint64_t vertices) const {
    std::vector<Cell> cells = faces;
    std::set<std::pair<std::uint32_t, std::uint32_t>> known;
    std::vector<bool> used(points.empty() ? 0 : vertices, false);
    const auto add_edge = [&](std::uint32_t a, std::uint32_t b) { return known.insert(std::minmax({a, b})).second; };
    if (!edges.empty()) {
      for (const Cell& f : faces) add_edge(f[0], f[1]), add_edge(f[1], f[2]), add_edge(f[2], f[0]);
    }
    for (const Cell& e : edges) {
      if (add_edge(e[0], e[1])) cells.push_back(e);
    }
    if (points.empty()) return cells;
    for (const Cell& c : cells) {
      for (const std::uint32_t v : c) used[v] = true;
    }
    for (const Cell& p : points) {
      if (!used[p[0]]) cells.push_back(p);
      used[p[0]] = true;
    }
    return cells;
  }
};

/// The same from the cells of a mesh.
inline RawCells raw_cells(const std::vector<Cell>& cells) {
  RawCells raw;
  for (const Cell& c : cells) (c.size() == 3 ? raw.faces : c.size() == 2 ? raw.edges : raw.points).push_back(c);
  return raw;
}

/// Lines of a text, each with its words.
class Text {
 public:
  Text(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {}

  [[noreturn]] void fail(const std::string& why) const { reject(file_ + ", line " + std::to_string(number_), why); }

  bool line(std::string_view& line) {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    ++number_;
    return true;
  }
  static std::vector<std::string_view> words(std::string_view line) {
    std::vector<std::string_view> words;
    for (std::size_t at = line.find_first_not_of(" \t"); at != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
      words.push_back(line.substr(at, end - at));
      at = line.find_first_not_of(" \t", end);
    }
    return words;
  }
  std::string_view rest() const { return rest_; }

  template <class T>
  T number(std::string_view word) const {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) fail("expected a number of its type");
    if constexpr (std::is_floating_point_v<T>) {
      if (!std::isfinite(value)) fail("expected a finite number");
    }
    return value;
  }

 private:
  std::string_view rest_;
  std::string file_;
  std::size_t number_ = 0;
};

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& file) : text_(bytes, file) {}

  Frame read() {
    for (std::string statement; next(statement);) take(Text::words(statement));
    for (const auto* list : {&raw_.faces, &raw_.edges, &raw_.points}) {
      for (const Cell& c : *list) {
        if (*std::max_element(c.begin(), c.end()) >= frame_.x.size()) text_.fail("a vertex that is not there is named");
      }
    }
    frame_.mesh = {frame_.x.size(), raw_.without_redundant(frame_.x.size())};
    return std::move(frame_);
  }

 private:
  /// A line, joined with the next as long as it ends with a backslash and has no comment.
  bool next(std::string& statement) {
    std::string_view line;
    if (!text_.line(line)) return false;
    statement = line;
    while (statement.ends_with('\\') && line.find('#') == std::string_view::npos) {
      statement.back() = ' ';
      if (!text_.line(line)) break;
      statement += line;
    }
    return true;
  }

  void take(std::vector<std::string_view> words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (words[i][0] == '#') words.resize(i);
    }
    if (words.empty()) return;
    const std::string_view keyword = words[0];
    static const std::set<std::string_view> skipped = {"vt",    "vn",       "vp",       "g",          "o",        "s",
                                                       "mg",    "usemtl",   "mtllib",   "usemap",     "maplib",   "lod",
                                                       "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};
    words.erase(words.begin());
    if (keyword == "v") return vertex(words);
    if (keyword == "f" || keyword == "l" || keyword == "p") return cells(keyword[0], words);
    if (skipped.count(keyword) == 0) text_.fail("expected a statement of a mesh");
  }

  void vertex(const std::vector<std::string_view>& words) {
    if (words.size() < 2 || words.size() == 5 || words.size() > 7)
      text_.fail("a vertex has the wrong number of numbers");
    if (frame_.x.size() == 0xffffffff) text_.fail("too many vertices");
    std::array<double, 3> x{};
    for (std::size_t i = 0; i < words.size(); ++i) {
      const auto value = text_.number<double>(words[i]);
      if (i < 3) x[i] = value;
    }
    frame_.x.push_back(x);
  }

  void cells(char keyword, const std::vector<std::string_view>& words) {
    const std::size_t parts = keyword == 'f' ? 3 : keyword == 'l' ? 2 : 1;
    if (words.size() < parts) text_.fail("too few vertices");
    Cell corners;
    for (const auto word : words) corners.push_back(corner(word, parts));
    if (keyword == 'f') raw_.add_polygon(corners);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (keyword == 'p') raw_.points.push_back({corners[i]});
      if (keyword == 'l' && i > 0) raw_.edges.push_back({corners[i - 1], corners[i]});
    }
  }

  /// v, v/vt, v//vn, v/vt/vn: at most so many parts.
  std::uint32_t corner(std::string_view word, std::size_t most) const {
    std::int64_t first = 0;
    std::size_t parts = 0;
    for (std::size_t at = 0; at <= word.size(); ++parts) {
      const std::size_t end = std::min(word.find('/', at), word.size());
      const bool left_out = parts == 1 && end == at && end < word.size();
      const std::int64_t index = left_out ? 1 : text_.number<std::int64_t>(word.substr(at, end - at));
      if (index == 0) text_.fail("an index is 0");
      if (parts == 0) first = index;
      at = end + 1;
    }
    if (parts > most) text_.fail("an index has too many parts");
    const auto known = static_cast<std::int64_t>(frame_.x.size());
    if (first < -known || first > 0xffffffff) text_.fail("an index is out of range");
    return static_cast<std::uint32_t>(first > 0 ? first - 1 : known + first);
  }

  Text text_;
  RawCells raw_;
  Frame frame_;
};

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& file) : text_(bytes, file), file_(file), size_(bytes.size()) {}

  Frame read() {
    header();
    body_.emplace(text_.rest(), file_, size_ - text_.rest().size());
    bool vertices = false;
    for (const Element& e : elements_) {
      if (e.name == "vertex") vertices = true, frame_.mesh.vertices = e.count;
    }
    if (!vertices || frame_.mesh.vertices > 0xffffffff)
      text_.fail("expected an element vertex, of below 2^32 vertices");
    for (const Element& e : elements_) element(e);
    std::string_view line;
    if (!ascii_) body_->end();
    while (ascii_ && text_.line(line)) {
      if (!Text::words(line).empty()) text_.fail("expected the end of the file");
    }
    frame_.mesh.cells = raw_.without_redundant(frame_.mesh.vertices);
    return std::move(frame_);
  }

 private:
  enum class Use { nothing, x, y, z, corners, first, second };
  struct Property {
    char type = 0, count = 0;  ///< a lower case letter for a signed integer, f d for real ones; count: 0 if no list
    std::string name;
    Use use = Use::nothing;
  };
  struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
  };

  /// b h i q for integers of 1 2 4 8 bytes, upper case for unsigned ones.
  char type(std::string_view word) const {
    constexpr std::array<std::string_view, 18> names = {"char",  "uchar",  "short", "ushort", "int",     "uint",
                                                        "float", "double", "int8",  "uint8",  "int16",   "uint16",
                                                        "int32", "uint32", "int64", "uint64", "float32", "float64"};
    const auto* found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) text_.fail("expected the name of a type");
    return "bBhHiIfdbBhHiIqQfd"[found - names.begin()];
  }
  static std::size_t size(char type) {
    return type == 'd' || type == 'q' || type == 'Q'   ? 8
           : type == 'f' || type == 'i' || type == 'I' ? 4
           : type == 'h' || type == 'H'                ? 2
                                                       : 1;
  }

  void header() {
    std::string_view line;
    if (!text_.line(line) || line != "ply") text_.fail("expected ply");
    bool format = false;
    while (text_.line(line) && line != "end_header") {
      const auto w = Text::words(line);
      if (w.empty()) text_.fail("an empty line in the header");
      if (w[0] == "comment" || w[0] == "obj_info") continue;
      if (w[0] == "format" && w.size() == 3 && !format && w[2] == "1.0") {
        format = true;
        ascii_ = w[1] == "ascii";
        big_ = w[1] == "binary_big_endian";
        if (!ascii_ && !big_ && w[1] != "binary_little_endian") text_.fail("expected a format");
      } else if (w[0] == "element" && w.size() == 3) {
        for (const Element& e : elements_) {
          if (e.name == w[1]) text_.fail("an element is there twice");
        }
        elements_.push_back({std::string(w[1]), text_.number<std::uint64_t>(w[2]), {}});
      } else if (w[0] == "property" && !elements_.empty() && w.size() == (w.size() > 1 && w[1] == "list" ? 5 : 3)) {
        add_property(w);
      } else {
        text_.fail("expected a line of a header");
      }
    }
    if (line != "end_header" || !format) text_.fail("expected format and end_header");
    for (Element& e : elements_) choose(e);
  }

  void add_property(const std::vector<std::string_view>& w) {
    Property p;
    if (w[1] == "list") p.count = type(w[2]);
    if (p.count == 'f' || p.count == 'd') text_.fail("expected an integer type for a length");
    p.type = type(w[w.size() - 2]);
    p.name = w.back();
    for (const Property& other : elements_.back().properties) {
      if (other.name == p.name) text_.fail("a property is there twice");
    }
    elements_.back().properties.push_back(p);
  }

  void choose(Element& e) {
    if (e.count > 0 && e.properties.empty()) text_.fail("an element without properties");
    if (e.count > 0 && e.name == "tristrips") text_.fail("triangle strips are not read");
    static const std::vector<std::tuple<std::string, std::string, Use>> uses = {
        {"vertex", "x", Use::x},
        {"vertex", "y", Use::y},
        {"vertex", "z", Use::z},
        {"face", "vertex_indices", Use::corners},
        {"face", "vertex_index", Use::corners},
        {"edge", "vertex1", Use::first},
        {"edge", "vertex2", Use::second}};
    std::size_t used = 0;
    bool z = false;
    for (Property& p : e.properties) {
      for (const auto& [element, property, use] : uses) {
        if (e.name != element || p.name != property) continue;
        p.use = use;
        z = z || use == Use::z;
        ++used;
        if ((p.count != 0) != (use == Use::corners)) text_.fail("a property is a list, or is none");
        if (e.name != "vertex" && (p.type == 'f' || p.type == 'd')) text_.fail("expected an integer type for a vertex");
      }
    }
    const std::size_t wanted = e.name == "vertex" ? (z ? 3 : 2) : e.name == "face" ? 1 : e.name == "edge" ? 2 : 0;
    if (e.count > 0 && used != wanted) text_.fail("element " + e.name + " has not just the properties that it needs");
  }

  void element(const Element& e) {
    std::uint64_t least = 0;  // bytes of an entry
    for (const Property& p : e.properties) least += size(p.count != 0 ? p.count : p.type);
    if (e.count > 0 && (ascii_ ? e.count > (text_.rest().size() + 1) / 2 : e.count > body_->left() / least))
      text_.fail("the file is too short for its element " + e.name);
    for (std::uint64_t i = 0; i < e.count; ++i) entry(e);
  }

  void entry(const Element& e) {
    if (ascii_) {
      std::string_view line;
      do {
        if (!text_.line(line)) text_.fail("the file ends within element " + e.name);
        words_ = Text::words(line);
      } while (words_.empty());
      word_ = 0;
    }
    std::array<double, 3> x{};
    Cell corners;
    for (const Property& p : e.properties) {
      std::uint64_t n = 1;
      if (p.count != 0) {
        const std::int64_t length = integer(p.count);
        if (length < 0 || static_cast<std::uint64_t>(length) > size_) text_.fail("a list has an impossible length");
        n = static_cast<std::uint64_t>(length);
      }
      for (std::uint64_t i = 0; i < n; ++i) {
        switch (p.use) {
          case Use::nothing: skip(p.type); break;
          case Use::x: x[0] = real(p.type); break;
          case Use::y: x[1] = real(p.type); break;
          case Use::z: x[2] = real(p.type); break;
          case Use::corners: corners.push_back(vertex(p.type)); break;
          case Use::first: corners.insert(corners.begin(), vertex(p.type)); break;
          case Use::second: corners.push_back(vertex(p.type)); break;
        }
      }
    }
    if (ascii_ && word_ != words_.size()) text_.fail("expected the end of the line");
    if (e.name == "vertex") frame_.x.push_back(x);
    if (e.name == "face" && corners.empty()) text_.fail("a face without vertices");
    if (e.name == "face") raw_.add_polygon(corners);
    if (e.name == "edge") raw_.edges.push_back(corners);
  }

  std::string_view word() {
    if (word_ == words_.size()) text_.fail("the line ends within an entry");
    return words_[word_++];
  }
  template <class T>
  T value() {
    if (ascii_) return text_.number<T>(word());
    std::array<char, sizeof(T)> raw;
    std::copy_n(body_->take(sizeof(T)).begin(), sizeof(T), raw.begin());
    if (big_) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
  }
  void skip(char type) {
    if (ascii_) {
      word();
    } else {
      body_->take(size(type));
    }
  }
  double real(char type) {
    const double value = type == 'f'   ? static_cast<double>(this->value<float>())
                         : type == 'd' ? this->value<double>()
                                       : real_integer(type);
    if (!std::isfinite(value)) text_.fail("expected a finite number");
    return value;
  }
  double real_integer(char type) {
    const Wide n = type == 'Q' ? static_cast<Wide>(value<std::uint64_t>()) : integer(type);
    if (static_cast<Wide>(static_cast<double>(n)) != n) text_.fail("an integer is no double");
    return static_cast<double>(n);
  }
  std::int64_t integer(char type) {
    switch (type) {
      case 'b': return value<std::int8_t>();
      case 'B': return value<std::uint8_t>();
      case 'h': return value<std::int16_t>();
      case 'H': return value<std::uint16_t>();
      case 'i': return value<std::int32_t>();
      case 'I': return value<std::uint32_t>();
      case 'q': return value<std::int64_t>();
      default: {
        const auto n = value<std::uint64_t>();
        if (n >> 63 != 0) text_.fail("a number is too large");
        return static_cast<std::int64_t>(n);
      }
    }
  }
  std::uint32_t vertex(char type) {
    const std::int64_t v = integer(type);
    if (v < 0 || static_cast<std::uint64_t>(v) >= frame_.mesh.vertices)
      text_.fail("a vertex that is not there is named");
    return static_cast<std::uint32_t>(v);
  }

  Text text_;
  std::string file_;
  std::size_t size_;
  std::optional<Cursor> body_;
  bool ascii_ = false, big_ = false;
  std::vector<Element> elements_;
  std::vector<std::string_view> words_;
  std::size_t word_ = 0;
  RawCells raw_;
  Frame frame_;
};

inline Frame read_frame(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) reject(path, "cannot be opened");
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (file.bad() || bytes.empty()) reject(path, "cannot be read, or is empty");
  std::string end = path.size() < 4 ? path : path.substr(path.size() - 4);
  for (char& c : end) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (end == ".ply") return PlyReader(bytes, path).read();
  if (end == ".obj") return ObjReader(bytes, path).read();
  reject(path, "expected a name that ends in .ply or .obj");
}

}  // namespace noli::checker
