// SPDX-License-Identifier: Apache-2.0
//
// Reads frames in PLY and OBJ, as defined in proofs/FORMAT.md, section 9.
#pragma once

#include "base.h"

namespace noli::checker {

using Position = std::array<double, 3>;

/// A face, a loose edge or a loose point; entries of v from `size` on are 0.
struct Cell {
  std::array<std::uint32_t, 3> v{};
  std::uint8_t size = 0;
  std::uint32_t label = 0;

  auto begin() const { return v.begin(); }
  auto end() const { return v.begin() + size; }
  bool has(std::uint64_t vertex) const { return std::find(begin(), end(), vertex) != end(); }
  friend bool operator==(const Cell&, const Cell&) = default;
};

struct Frame {
  std::vector<Position> x;
  std::vector<Cell> cells;

  /// p0 p1 ... pn as faces around p0; two vertices are a loose edge, one is a loose point.
  void add_polygon(std::span<const std::uint32_t> p) {
    if (p.size() == 1) cells.push_back({{p[0]}, 1});
    if (p.size() == 2) cells.push_back({{p[0], p[1]}, 2});
    for (std::size_t i = 2; i < p.size(); ++i) cells.push_back({{p[0], p[i - 1], p[i]}, 3});
  }
};

/// Faces, then loose edges, then loose points, each in their order, without those that are redundant.
inline void tidy(std::vector<Cell>& cells) {
  std::ranges::stable_sort(cells, std::greater<>{}, &Cell::size);
  if (cells.empty() || cells.back().size == 3) return;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::set<std::uint32_t> used;
  std::erase_if(cells, [&](const Cell& c) {
    bool redundant = c.size == 1 && used.contains(c.v[0]);
    for (std::size_t i = 0; c.size > 1 && i < c.size; ++i) {
      const bool known = !edges.insert(std::minmax({c.v[i], c.v[(i + 1) % c.size]})).second;
      redundant = redundant || (c.size == 2 && i == 0 && known);
    }
    used.insert(c.begin(), c.end());
    return redundant;
  });
}

inline std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(" \t"); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(" \t", end);
  }
  return words;
}

inline Frame read_obj(Reader text) {
  static const std::map<std::string_view, std::size_t> shapes = {{"p", 1}, {"l", 2}, {"f", 3}};  // least corners
  static constexpr std::string_view skipped =
      "  vt vn vp g o s mg usemtl mtllib usemap maplib lod bevel c_interp d_interp shadow_obj trace_obj ";
  Frame frame;
  bool flat = false;  // vertices have no z
  while (auto line = text.line()) {
    std::string statement(*line);
    while (line && statement.ends_with('\\') && line->find('#') == std::string_view::npos) {
      statement.back() = ' ';
      line = text.line();
      statement += line.value_or("");
    }
    auto words = words_of(statement);
    words.erase(std::ranges::find(words, '#', [](std::string_view word) { return word[0]; }), words.end());
    const std::string keyword(words.empty() ? "" : words[0]);
    if (skipped.find(" " + keyword + " ") != std::string_view::npos) continue;
    if (keyword == "v") {
      Position x{};
      for (std::size_t i = 1; i < words.size(); ++i) {
        const auto value = text.number<double>(words[i]);
        text.require(std::isfinite(value), "expected a finite number");
        if (i <= 3) x[i - 1] = value;
      }
      text.require(words.size() >= 3 && words.size() != 6 && words.size() <= 8, "expected 2, 3, 4, 6 or 7 numbers");
      if (frame.x.empty()) flat = words.size() == 3;
      text.require((words.size() == 3) == flat, "some vertices have 2 coordinates, and others have 3");
      text.require(frame.x.size() < 0xffffffff, "too many vertices");
      frame.x.push_back(x);
      continue;
    }
    const auto shape = shapes.find(keyword);
    text.require(shape != shapes.end(), "expected a statement of a mesh");
    std::vector<std::uint32_t> corners;
    for (std::size_t i = 1; i < words.size(); ++i) {
      const auto index = text.number<std::int64_t>(words[i].substr(0, words[i].find('/')));
      const auto known = static_cast<std::int64_t>(frame.x.size());
      text.require(index != 0 && -known <= index && index <= 0xffffffff, "an index is out of range");
      corners.push_back(static_cast<std::uint32_t>(index > 0 ? index - 1 : known + index));
    }
    const std::size_t least = shape->second, size = keyword == "f" ? corners.size() : least;
    text.require(corners.size() >= least, "too few vertices");
    for (std::size_t i = 0; i + size <= corners.size(); ++i) frame.add_polygon(std::span(corners).subspan(i, size));
  }
  for (const Cell& c : frame.cells)
    text.require(std::ranges::max(c.v) < frame.x.size(), "a vertex that is not there is named");
  return frame;
}

class PlyReader {
 public:
  explicit PlyReader(Reader text) : text_(std::move(text)) {}

  Frame read() {
    header();
    for (const Element& e : elements_) {
      for (std::uint64_t i = 0; i < e.count; ++i) entry(e);
    }
    while (const auto line = ascii_ ? text_.line() : std::nullopt)
      text_.require(words_of(*line).empty(), "expected the end of the file");
    text_.end();
    return std::move(frame_);
  }

 private:
  struct Type {
    std::string_view name, other;
    bool integer;
    long double (PlyReader::*read)();  ///< the next number
  };
  struct Property {
    const Type *count, *type;  ///< no count: not a list
    std::size_t use;           ///< index in `uses`; their number if it is not used
  };
  struct Element {
    std::string name;
    std::uint64_t count;
    std::vector<Property> properties;
  };
  static constexpr std::array<std::string_view, 7> uses = {
      "vertex x", "vertex y", "vertex z", "edge vertex1", "edge vertex2", "face vertex_indices", "face vertex_index"};

  const Type* type(std::string_view word) const {
    static const std::array<Type, 10> types = {{{"char", "int8", true, &PlyReader::number<std::int8_t>},
                                                {"uchar", "uint8", true, &PlyReader::number<std::uint8_t>},
                                                {"short", "int16", true, &PlyReader::number<std::int16_t>},
                                                {"ushort", "uint16", true, &PlyReader::number<std::uint16_t>},
                                                {"int", "int32", true, &PlyReader::number<std::int32_t>},
                                                {"uint", "uint32", true, &PlyReader::number<std::uint32_t>},
                                                {"int64", "int64", true, &PlyReader::number<std::int64_t>},
                                                {"uint64", "uint64", true, &PlyReader::number<std::uint64_t>},
                                                {"float", "float32", false, &PlyReader::number<float>},
                                                {"double", "float64", false, &PlyReader::number<double>}}};
    const auto* row = std::ranges::find_if(types, [&](const Type& t) { return t.name == word || t.other == word; });
    text_.require(row != types.end(), "expected the name of a type");
    return row;
  }
  bool has(std::string_view name) const { return names_.contains(name); }

  void header() {
    text_.require(text_.line() == "ply", "expected ply");
    std::string format;
    auto line = text_.line();
    for (; line && *line != "end_header"; line = text_.line()) {
      const auto w = words_of(*line);
      text_.require(!w.empty(), "an empty line in the header");
      if (w[0] == "comment" || w[0] == "obj_info") continue;
      if (w[0] == "format" && w.size() == 3 && format.empty() && w[2] == "1.0") {
        format = w[1];
      } else if (w[0] == "element" && w.size() == 3) {
        text_.require(names_.insert(std::string(w[1])).second, "an element is there twice");
        elements_.push_back({std::string(w[1]), text_.number<std::uint64_t>(w[2]), {}});
        if (w[1] == "vertex") vertices_ = elements_.back().count;
      } else {
        text_.require(w[0] == "property" && !elements_.empty(), "expected a line of a header");
        property(elements_.back(), w);
      }
    }
    text_.require(line.has_value(), "expected end_header");
    ascii_ = format == "ascii";
    big_ = format == "binary_big_endian";
    text_.require(ascii_ || big_ || format == "binary_little_endian", "expected a format");
    text_.require(has("vertex"), "expected an element vertex");
    text_.require(vertices_ <= 0xffffffff, "too many vertices");
    for (const Element& e : elements_) {
      if (e.count == 0) continue;
      text_.require(!e.properties.empty(), "an element without properties");
      text_.require(e.name != "tristrips", "triangle strips are not read");
      text_.require(e.name != "vertex" || (has(uses[0]) && has(uses[1])), "expected x and y of a vertex");
      text_.require(e.name != "edge" || (has(uses[3]) && has(uses[4])), "expected vertex1 and vertex2 of an edge");
      text_.require(e.name != "face" || has(uses[5]) != has(uses[6]), "expected one list of vertices of a face");
    }
    if (!ascii_) text_.no_more_lines();
  }

  void property(Element& e, const std::vector<std::string_view>& w) {
    const bool list = w.size() > 1 && w[1] == "list";
    text_.require(w.size() == (list ? 5 : 3), "expected a property");
    const std::string name = e.name + " " + std::string(w.back());
    text_.require(names_.insert(name).second, "a property is there twice");
    const auto use = static_cast<std::size_t>(std::ranges::find(uses, name) - uses.begin());
    const Property p{list ? type(w[2]) : nullptr, type(w[w.size() - 2]), use};
    text_.require(!list || p.count->integer, "expected an integer type for a length");
    text_.require(use == uses.size() || list == (use > 4), "a property is a list, or is none");
    text_.require(use < 3 || use == uses.size() || p.type->integer, "expected an integer type for a vertex");
    e.properties.push_back(p);
  }

  void entry(const Element& e) {
    for (words_.clear(), word_ = 0; ascii_ && words_.empty();) {
      const auto line = text_.line();
      text_.require(line.has_value(), "the file ends within an element");
      words_ = words_of(*line);
    }
    std::array<long double, 5> x{};  // by use
    std::vector<std::uint32_t> corners;
    for (const Property& p : e.properties) {
      const long double n = p.count == nullptr ? 1 : (this->*p.count->read)();
      text_.require(n >= 0, "a list has an impossible length");
      for (long double i = 0; i < n; ++i) {
        // A value that is skipped need not be a number.
        const long double value = p.use == uses.size() && ascii_ ? (word(), 0) : (this->*p.type->read)();
        if (p.use < x.size()) x[p.use] = value;
        if (p.use == 5 || p.use == 6) corners.push_back(vertex(value));
      }
    }
    text_.require(word_ == words_.size(), "expected the end of the line");
    if (e.name == "vertex") frame_.x.push_back({real(x[0]), real(x[1]), real(x[2])});
    if (e.name == "edge") corners = {vertex(x[3]), vertex(x[4])};
    text_.require(e.name != "face" || !corners.empty(), "a face without vertices");
    frame_.add_polygon(corners);
  }

  std::string_view word() {
    text_.require(word_ < words_.size(), "the line ends within an entry");
    return words_[word_++];
  }
  template <class T>
  long double number() {
    static_assert(std::numeric_limits<long double>::digits >= 64, "all types fit, exactly");
    if (ascii_) return static_cast<long double>(text_.number<T>(word()));
    auto raw = text_.raw<std::array<char, sizeof(T)>>();
    if (big_) std::ranges::reverse(raw);
    return static_cast<long double>(std::bit_cast<T>(raw));
  }
  double real(long double value) const {
    text_.require(std::isfinite(value) && static_cast<double>(value) == value, "expected a finite double");
    return static_cast<double>(value);
  }
  std::uint32_t vertex(long double v) const {
    text_.require(v >= 0 && v < static_cast<long double>(vertices_), "a vertex that is not there is named");
    return static_cast<std::uint32_t>(v);
  }

  Reader text_;
  bool ascii_ = false, big_ = false;
  std::set<std::string, std::less<>> names_;  ///< of elements, and of elements with a property
  std::vector<Element> elements_;
  std::vector<std::string_view> words_;
  std::size_t word_ = 0;
  std::uint64_t vertices_ = 0;
  Frame frame_;
};

/// The last four letters of a name, in lower case.
inline std::string ending(const std::string& path) {
  std::string end = path.substr(std::max<std::size_t>(path.size(), 4) - 4);
  for (char& c : end) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return end;
}

/// Whether a file is one frame, by its name.
inline bool is_frame(const std::string& path) { return ending(path) == ".ply" || ending(path) == ".obj"; }

inline Frame read_frame(const std::string& path) {
  require(is_frame(path), path, "expected a name that ends in .ply or .obj");
  Reader text(Input(path).read(std::numeric_limits<std::uint64_t>::max()), path);
  text.require(text.left() > 0, "expected a file that is not empty");
  Frame frame = ending(path) == ".ply" ? PlyReader(std::move(text)).read() : read_obj(std::move(text));
  tidy(frame.cells);
  return frame;
}

}  // namespace noli::checker
