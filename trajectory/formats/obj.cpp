// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include <noli/errors.h>
#include "trajectory/cells.h"
#include "trajectory/stop.h"
#include "trajectory/text.h"

namespace noli {
namespace {

constexpr std::array<std::string_view, 17> ignored_statements = {
    "vt",     "vn",     "vp",  "g",     "o",        "s",        "mg",         "usemtl",   "mtllib",
    "usemap", "maplib", "lod", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};

class ObjParser {
 public:
  ObjParser(std::string_view text, const std::string& file, Polygons* polygons)
      : lines_(text), file_(file), polygons_(polygons) {}

  Frame parse() {
    std::string_view statement;
    while (next_statement(statement)) {
      end_if_stopped();
      parse_statement(statement);
    }
    frame_.mesh.vertex_count = frame_.positions.size();
    check_largest_index();
    drop_redundant_cells(frame_.mesh);
    return std::move(frame_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const { throw InputError(file_, line_place(line_), problem); }

  /// A line, joined with the next ones as long as it ends with a backslash. A comment is not continued: it may end in a
  /// Windows path.
  bool next_statement(std::string_view& statement) {
    if (!lines_.next(statement)) return false;
    line_ = lines_.number();
    if (!statement.ends_with('\\') || statement.find('#') != std::string_view::npos) return true;
    joined_.clear();
    do {
      joined_ += statement.substr(0, statement.size() - statement.ends_with('\\'));
      joined_ += ' ';
      if (statement.find('#') != std::string_view::npos) break;
    } while (statement.ends_with('\\') && lines_.next(statement));
    statement = joined_;
    return true;
  }

  void parse_statement(std::string_view statement) {
    words_.clear();
    Words words(statement);
    for (auto word = words.next(); !word.empty() && word[0] != '#'; word = words.next()) words_.push_back(word);
    if (words_.empty()) return;
    const std::string_view keyword = words_[0];
    if (keyword == "v") return parse_vertex();
    if (keyword == "f") return parse_face();
    if (keyword == "l") return parse_line();
    if (keyword == "p") return parse_points();
    if (std::find(ignored_statements.begin(), ignored_statements.end(), keyword) == ignored_statements.end()) {
      fail(fmt::format("expected a statement of a mesh (v, f, l, p, ...), found {}", in_quotes(keyword)));
    }
  }

  void parse_vertex() {
    const std::size_t numbers = words_.size() - 1;
    if (numbers < 2 || numbers == 5 || numbers > 7) {
      fail(fmt::format("a vertex has 2, 3 or 4 coordinates, and a colour of 3 numbers or none; found {} numbers",
                       numbers));
    }
    const bool in_plane = numbers == 2;
    if (frame_.positions.empty()) in_plane_ = in_plane;
    if (in_plane != in_plane_) {
      fail(fmt::format("a vertex with {} coordinates; the vertices before it have {}", in_plane ? "2" : "3 or more",
                       in_plane ? "3 or more" : "2"));
    }
    if (frame_.positions.size() == std::numeric_limits<VertexId>::max()) fail("more than 2^32 - 1 vertices");
    Position position{};
    for (std::size_t i = 0; i < numbers; ++i) {
      double value = 0;
      if (const std::string problem = parse_finite(words_[i + 1], value); !problem.empty()) fail(problem);
      if (i < 3) position[i] = value;
    }
    frame_.positions.push_back(position);
  }

  void parse_face() {
    if (words_.size() < 4) fail(fmt::format("a face has at least 3 corners, found {}", words_.size() - 1));
    parse_corners();
    if (corners_.size() > 3) note_polygon();
    add_polygon(frame_.mesh, corners_);
  }

  void note_polygon() {
    if (polygons_ == nullptr) return;
    if (polygons_->rule == PolygonRule::refuse) fail(refused_polygon(corners_.size()));
    polygons_->fans.push_back({frame_.mesh.faces.size(), corners_.size() - 2});
  }

  void parse_line() {
    if (words_.size() < 3) fail(fmt::format("a line has at least 2 vertices, found {}", words_.size() - 1));
    parse_corners();
    for (std::size_t i = 1; i < corners_.size(); ++i) frame_.mesh.edges.push_back({corners_[i - 1], corners_[i]});
  }

  void parse_points() {
    if (words_.size() < 2) fail("expected at least one vertex after 'p'");
    parse_corners();
    frame_.mesh.points.insert(frame_.mesh.points.end(), corners_.begin(), corners_.end());
  }

  /// All words after the keyword. Whatever follows a '/' is ignored: texture and normal do not move a vertex, and some
  /// programs write "3/" or "3//" when they have none.
  void parse_corners() {
    corners_.clear();
    for (std::size_t i = 1; i < words_.size(); ++i) {
      corners_.push_back(resolve(words_[i], parse_index(words_[i], words_[i].substr(0, words_[i].find('/')))));
    }
  }

  std::int64_t parse_index(std::string_view word, std::string_view part) const {
    std::int64_t index = 0;
    if (parse_number(part, index) != std::errc{}) fail(fmt::format("expected an index, found {}", in_quotes(word)));
    if (index == 0) fail(fmt::format("index 0 in {}, expected indices from 1, or from -1 backwards", in_quotes(word)));
    return index;
  }

  VertexId resolve(std::string_view word, std::int64_t index) {
    const auto known = static_cast<std::int64_t>(frame_.positions.size());
    if (index < -known)
      fail(fmt::format("{} points back beyond the first vertex, {} are known here", in_quotes(word), known));
    if (index > std::numeric_limits<VertexId>::max())
      fail(fmt::format("vertex index {} is out of range", in_quotes(word)));
    const std::int64_t resolved = index > 0 ? index : known + index + 1;
    if (resolved > largest_index_) {
      largest_index_ = resolved;
      largest_index_line_ = line_;
    }
    return static_cast<VertexId>(resolved - 1);
  }

  /// Indices may refer to vertices further down, so they can be checked only at the end; the largest stands for all.
  void check_largest_index() {
    if (largest_index_ <= static_cast<std::int64_t>(frame_.positions.size())) return;
    line_ = largest_index_line_;
    fail(fmt::format("vertex index {} is out of range, the file has {} vertices, counted from 1", largest_index_,
                     frame_.positions.size()));
  }

  Lines lines_;
  const std::string& file_;
  Polygons* polygons_;
  std::size_t line_ = 0;                 ///< first line of the statement
  std::string joined_;                   ///< the statement, if it spans several lines
  std::vector<std::string_view> words_;  ///< of the statement, without comment
  std::vector<VertexId> corners_;        ///< of the statement, counted from 0
  std::int64_t largest_index_ = 0;       ///< of all, counted from 1
  std::size_t largest_index_line_ = 0;
  bool in_plane_ = false;  ///< vertices have two coordinates
  Frame frame_;
};

}  // namespace

Frame parse_obj(std::string_view text, const std::string& file, Polygons* polygons) {
  if (text.empty()) throw InputError(file, "", "is empty");
  return ObjParser(text, file, polygons).parse();
}

}  // namespace noli
