// SPDX-License-Identifier: Apache-2.0
//
// Reads the motion, step by step, from frames or from the block file of a run; and the claim about it.
#pragma once

#include "blocks.h"
#include "frames.h"

namespace noli::checker {

/// a <= b.
using LabelPair = std::array<std::uint32_t, 2>;

/// The part of a trajectory that does not change from step to step.
struct Scene {
  std::uint32_t dimension = 3;
  std::uint64_t vertices = 0;
  std::vector<Cell> cells;
  std::set<std::uint32_t> labels;  ///< of a run: those of its cells
  std::set<LabelPair> groups;      ///< of a run: pairs that its scene excludes

  /// Of a run: exactly the pairs of labels that must be excluded; stops once there are more than `most`.
  std::set<LabelPair> excluded(std::size_t most) const {
    std::set<LabelPair> pairs;
    const auto add = [&](std::uint32_t a, std::uint32_t b) {
      if (labels.contains(a) && labels.contains(b)) pairs.insert({std::min(a, b), std::max(a, b)});
    };
    for (const auto& [g, h] : groups) {
      for (std::uint32_t k = 0; k < 4; ++k) add(2 * g + k % 2, 2 * h + k / 2);
    }
    for (auto a = labels.begin(); a != labels.end(); ++a) {
      for (auto b = a; b != labels.end() && pairs.size() <= most; ++b) {
        if (*a % 2 == 1 && *b % 2 == 1) pairs.insert({*a, *b});  // both scripted
      }
    }
    return pairs;
  }
};

/// The common part of the claims of all steps. Its cells are those after merging.
struct Claim {
  std::uint32_t source = 0, dimension = 3;
  bool strict = false, points = false;
  std::uint32_t ring = 1, merged = 0;
  double eta = 0;
  std::vector<std::uint32_t> same;  ///< by vertex: the one that represents it
  std::vector<Cell> cells;
  std::size_t listed = 0;  ///< number of cells that a file lists; vertices without a cell follow them
  Sha256::Digest hash{};   ///< of the cells
  std::set<LabelPair> excluded;

  bool is_excluded(std::uint32_t a, std::uint32_t b) const {
    return excluded.contains({std::min(a, b), std::max(a, b)});
  }
};

/// The breakpoints of all vertices in one step: those of vertex v are [begin[v], begin[v + 1]).
struct Motion {
  double t0 = 0, t1 = 0;
  std::vector<std::uint64_t> begin;
  std::vector<double> times;
  std::vector<Position> x;
  std::optional<Sha256::Digest> group_hash;  ///< of a window in its file

  /// The first breakpoint of a vertex, after its first one, for which `holds` is false; its last if there is none.
  template <class Holds>
  std::uint64_t segment_end(std::size_t v, const Holds& holds) const {
    std::uint64_t low = begin[v], high = begin[v + 1] - 1;
    while (high - low > 1) {
      const std::uint64_t middle = (low + high) / 2;
      (holds(middle) ? low : high) = middle;
    }
    return high;
  }
  Sha256::Digest hash() const {
    if (group_hash) return *group_hash;
    Sha256 hash;
    for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
      hash.add_raw(begin[v + 1] - begin[v]);
      for (std::uint64_t i = begin[v]; i < begin[v + 1]; ++i)
        hash.add_raw(std::array{times[i] + 0.0, x[i][0] + 0.0, x[i][1] + 0.0, x[i][2] + 0.0});  // -0 becomes +0
    }
    return hash.digest();
  }
};

class Trajectory {
 public:
  virtual ~Trajectory() = default;
  /// The next step, if there is one.
  virtual bool next(Motion& motion) = 0;
  /// Skips the first `steps` steps. To be called before next(); if the trajectory is shorter, next() returns false.
  virtual void pass(std::uint64_t steps) = 0;
  /// Whether something follows. It is not read.
  virtual bool more() = 0;

  Scene scene;
};

/// MESH: the number of vertices, and the cells.
inline void read_mesh(Reader c, std::uint64_t& vertices, std::vector<Cell>& cells) {
  vertices = c.u64();
  c.require(vertices >= 1 && vertices <= std::uint64_t{1} << 32, "an impossible number of vertices");
  const std::array<std::uint64_t, 3> counts = {c.u64(), c.u64(), c.u64()};
  for (std::uint8_t k = 0; k < 3; ++k) {
    Cell cell{{}, static_cast<std::uint8_t>(3 - k)};
    c.need(counts[k], 4u * cell.size);
    for (std::uint64_t i = 0; i < counts[k]; ++i) {
      for (std::size_t j = 0; j < cell.size; ++j) cell.v[j] = c.u32();
      c.require(std::ranges::max(cell.v) < vertices, "a vertex that is not there is named");
      cells.push_back(cell);
    }
  }
  c.end();
}

/// Frames one after another: of PLY and OBJ files, or of one block file of frames.
class FrameReader {
 public:
  explicit FrameReader(std::vector<std::string> paths) : paths_(std::move(paths)) {
    if (paths_.size() != 1 || is_frame(paths_[0])) return;
    file_.emplace(paths_[0], "FRMS");
    read_mesh(file_->expect("MESH"), vertices_, mesh_.cells);
    file_->expect_commit();
    tidy(mesh_.cells);
  }

  /// The next frame, if there is one. Its mesh is that of the first.
  std::optional<Frame> next() { return file_ ? of_file() : of_paths(); }
  bool more() { return file_ ? file_->more() : read_ < paths_.size(); }
  /// Skips so many frames. Those in files of their own are not opened.
  void pass(std::uint64_t frames) {
    if (!file_) read_ += std::min(frames, paths_.size() - read_);
    for (std::uint64_t i = 0; file_ && i < frames && next(); ++i) {
    }
  }

 private:
  std::optional<Frame> of_paths() {
    if (read_ == paths_.size()) return std::nullopt;
    Frame frame = read_frame(paths_[read_]);
    if (read_ == 0) {
      vertices_ = frame.x.size();
      mesh_.cells = frame.cells;
    }
    const bool same = frame.x.size() == vertices_ && frame.cells == mesh_.cells;
    require(same, paths_[read_], "has another mesh than the frame before");
    ++read_;
    return frame;
  }
  std::optional<Frame> of_file() {
    auto block = file_->next();
    if (file_->ended()) return std::nullopt;
    Reader c = file_->as("FRAM", std::move(block));
    c.require(c.f64() == static_cast<double>(read_), "a frame has the wrong number");
    c.need(vertices_, sizeof(Position));
    Frame frame = mesh_;
    frame.x.resize(vertices_);
    for (Position& x : frame.x) x = {c.f64(), c.f64(), c.f64()};
    c.end();
    file_->expect_commit();
    ++read_;
    return frame;
  }

  std::vector<std::string> paths_;
  std::optional<BlockFile> file_;
  std::uint64_t vertices_ = 0;
  Frame mesh_;  ///< has cells alone
  std::size_t read_ = 0;
};

/// Frames, moving or at rest.
class Frames : public Trajectory {
 public:
  Frames(std::vector<std::string> paths, bool rest) : reader_(std::move(paths)), rest_(rest) {
    auto first = reader_.next();
    require(first && (rest || reader_.more()), "the command line", "expected more frames");
    now_ = std::move(*first);
    scene = {3, now_.x.size(), now_.cells, {}, {}};
  }
  bool next(Motion& motion) override {
    const std::vector<Position> before = now_.x;
    if (!rest_ || step_ > 0) {
      auto frame = reader_.next();
      if (!frame) return false;
      now_ = std::move(*frame);
    }
    motion.t0 = rest_ ? 0 : static_cast<double>(step_);
    motion.t1 = motion.t0 + 1;
    motion.begin = {0};
    motion.times.clear();
    motion.x.clear();
    for (std::size_t v = 0; v < now_.x.size(); ++v) {
      motion.begin.push_back(2 * v + 2);
      motion.times.insert(motion.times.end(), {motion.t0, motion.t1});
      motion.x.insert(motion.x.end(), {rest_ ? now_.x[v] : before[v], now_.x[v]});
    }
    ++step_;
    return true;
  }
  void pass(std::uint64_t steps) override {
    if (steps == 0) return;
    reader_.pass(steps - 1);
    step_ = steps;
    if (rest_) return;
    if (auto frame = reader_.next()) now_ = std::move(*frame);
  }
  bool more() override { return (rest_ && step_ == 0) || reader_.more(); }

 private:
  FrameReader reader_;
  bool rest_;
  std::size_t step_ = 0;
  Frame now_;
};

/// Reads strictly ascending pairs of integers of this type, each with a <= b.
template <class T>
std::set<LabelPair> read_pairs(Reader& c, std::uint32_t count, const char* wrong) {
  std::set<LabelPair> pairs;
  for (std::uint32_t i = 0; i < count; ++i) {
    const LabelPair pair = {c.raw<T>(), c.raw<T>()};
    c.require(pair[0] <= pair[1] && (i == 0 || pair > *pairs.rbegin()), wrong);
    pairs.insert(pair);
  }
  return pairs;
}

/// The block file of a run, recorded in full.
class Run : public Trajectory {
 public:
  explicit Run(const std::string& path) : file_(path, "TRAJ") {
    Reader c = file_.expect("HEAD");
    scene.dimension = c.u32();
    c.require(scene.dimension == 2 || scene.dimension == 3, "expected dimension 2 or 3");
    c.require(c.u32() == 0, "the run has recorded frames alone, which are not its motion");
    c.require(c.f64() > 0, "expected a window length above 0");
    c.end();
    read_mesh(file_.expect("MESH"), scene.vertices, scene.cells);
    label();
  }

  bool next(Motion& motion) override {
    auto window = file_.next();
    if (file_.ended()) return false;
    Reader c = file_.as("WIND", std::move(window));
    c.require(c.u64() == windows_, "a window has the wrong number");
    motion.t0 = c.f64();
    motion.t1 = c.f64();
    c.end();
    c.require(motion.t0 < motion.t1, "a window ends before it begins");
    c.require(windows_ == 0 || same_bits(motion.t0, end_), "a window does not begin where the one before ends");
    lines(motion);
    end_ = motion.t1;
    ++windows_;
    file_.expect("VELO");
    file_.expect("STAT");
    file_.expect_commit();
    motion.group_hash = file_.group_hash();
    return true;
  }
  void pass(std::uint64_t steps) override {
    Motion motion;
    while (windows_ < steps && next(motion)) {
    }
  }
  bool more() override { return file_.more(); }

 private:
  template <class T>
  static bool same_bits(const T& a, const T& b) {
    return std::bit_cast<std::array<char, sizeof a>>(a) == std::bit_cast<std::array<char, sizeof b>>(b);
  }

  void label() {
    Reader c = file_.expect("LABL");
    c.require(c.left() == scene.vertices, "expected a label for each vertex");
    const std::string scripted(c.take(scene.vertices));
    c.require(std::ranges::all_of(scripted, [](char l) { return l == 0 || l == 1; }), "a label is not 0 or 1");
    std::vector<std::uint16_t> group(scene.vertices, 0);
    if (auto block = file_.next()) {
      Reader e = file_.as("EXCL", std::move(block));
      const std::uint32_t n = e.u32();
      e.require(n > 0, "expected a pair");
      scene.groups = read_pairs<std::uint16_t>(e, n, "pairs are not in order");
      for (auto& g : group) g = e.raw<std::uint16_t>();
      e.end();
      file_.expect_commit();
    }
    for (Cell& cell : scene.cells) {
      const std::uint16_t g = group[cell.v[0]];
      c.require(std::ranges::all_of(cell, [&](auto v) { return group[v] == g; }), "a cell is of two groups");
      cell.label = 2u * g + (std::ranges::all_of(cell, [&](auto v) { return scripted[v] == 1; }) ? 1 : 0);
      scene.labels.insert(cell.label);
    }
  }

  void lines(Motion& motion) {
    Reader c = file_.expect("LINE");
    motion.begin = {0};
    for (std::size_t v = 0; v < scene.vertices; ++v) {
      const std::uint32_t count = c.u32();
      c.require(count >= 2, "a vertex has fewer than two breakpoints");
      motion.begin.push_back(motion.begin.back() + count);
    }
    c.need(motion.begin.back(), 8 * (1 + std::uint64_t{scene.dimension}));
    motion.times.resize(motion.begin.back());
    motion.x.assign(motion.begin.back(), {});
    for (double& t : motion.times) t = c.f64();
    for (auto& x : motion.x) {
      for (std::size_t k = 0; k < scene.dimension; ++k) x[k] = c.f64();
    }
    c.end();
    last_.resize(scene.vertices);
    for (std::size_t v = 0; v < scene.vertices; ++v) {
      const std::uint64_t first = motion.begin[v], last = motion.begin[v + 1] - 1;
      for (std::uint64_t i = first; i < last; ++i)
        c.require(motion.times[i] < motion.times[i + 1], "times do not ascend");
      const bool covers = same_bits(motion.times[first], motion.t0) && same_bits(motion.times[last], motion.t1);
      c.require(covers, "a world line does not begin and end with its window");
      c.require(windows_ == 0 || same_bits(last_[v], motion.x[first]),
                "a vertex does not begin where it was at the end of the window before");
      last_[v] = motion.x[last];
    }
  }

  BlockFile file_;
  std::uint64_t windows_ = 0;
  double end_ = 0;
  std::vector<Position> last_;
};

}  // namespace noli::checker
