// SPDX-License-Identifier: Apache-2.0
//
// The motion, step by step, from frames or from the block file of a run.
#pragma once

#include <memory>

#include "blocks.h"
#include "frames.h"

namespace noli::checker {

/// The breakpoints of all vertices in one step: those of vertex v are [begin[v], begin[v + 1]).
struct Motion {
  double t0 = 0, t1 = 0;
  std::vector<std::uint64_t> begin;
  std::vector<double> times;
  std::vector<std::array<double, 3>> x;
  std::optional<Sha256::Digest> group_hash;  ///< of a window in its file

  Sha256::Digest hash() const {
    if (group_hash) return *group_hash;
    Sha256 hash;
    std::string buffer;
    const auto put = [&](const auto& value) { buffer.append(reinterpret_cast<const char*>(&value), sizeof value); };
    for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
      put(begin[v + 1] - begin[v]);
      for (std::uint64_t i = begin[v]; i < begin[v + 1]; ++i) {
        put(times[i] + 0.0);  // -0 becomes +0
        for (const double coordinate : x[i]) put(coordinate + 0.0);
      }
      if (buffer.size() < 1 << 16) continue;
      hash.add(buffer);
      buffer.clear();
    }
    hash.add(buffer);
    return hash.digest();
  }
};

/// a <= b.
using LabelPair = std::array<std::uint32_t, 2>;

/// What does not change. Labels: one for each cell.
struct Scene {
  int dimension = 3;
  Mesh mesh;
  std::vector<std::uint32_t> labels;
  /// For a run: the pairs of labels that have to be excluded, just these.
  std::optional<std::vector<LabelPair>> excluded;
};

class Trajectory {
 public:
  virtual ~Trajectory() = default;
  virtual Scene scene() = 0;
  /// The next step, if there is one.
  virtual bool next(Motion& motion) = 0;
};

/// Frames, moving or at rest.
class Frames : public Trajectory {
 public:
  Frames(std::vector<std::string> paths, bool rest) : paths_(std::move(paths)), rest_(rest) {
    if (paths_.size() < (rest ? 1 : 2)) reject("the command line", "expected more frames");
  }
  Scene scene() override {
    read();
    return {3, now_.mesh, std::vector<std::uint32_t>(now_.mesh.cells.size(), 0), {}};
  }
  bool next(Motion& motion) override {
    if (step_ + (rest_ ? 0 : 1) == paths_.size()) return false;
    if (!rest_ || step_ > 0) {
      before_ = std::move(now_.x);
      read();
    }
    const std::size_t n = now_.x.size();
    motion.t0 = rest_ ? 0 : static_cast<double>(step_);
    motion.t1 = motion.t0 + 1;
    motion.begin.resize(n + 1);
    motion.times.resize(2 * n);
    motion.x.resize(2 * n);
    for (std::size_t v = 0; v <= n; ++v) motion.begin[v] = 2 * v;
    for (std::size_t v = 0; v < n; ++v) {
      motion.times[2 * v] = motion.t0;
      motion.times[2 * v + 1] = motion.t1;
      motion.x[2 * v] = rest_ ? now_.x[v] : before_[v];
      motion.x[2 * v + 1] = now_.x[v];
    }
    ++step_;
    return true;
  }

 private:
  void read() {
    Frame frame = read_frame(paths_[read_]);
    if (read_ > 0 && (frame.mesh.vertices != now_.mesh.vertices || frame.mesh.cells != now_.mesh.cells))
      reject(paths_[read_], "has another mesh than the frame before");
    now_ = std::move(frame);
    ++read_;
  }
  std::vector<std::string> paths_;
  bool rest_;
  std::size_t step_ = 0, read_ = 0;
  Frame now_;
  std::vector<std::array<double, 3>> before_;
};

/// The block file of a run, recorded in full.
class Run : public Trajectory {
 public:
  explicit Run(const std::string& path) : file_(path, "TRAJ") {}

  Scene scene() override {
    Block head = file_.expect("HEAD");
    Cursor c = cursor(head);
    dimension_ = c.u32();
    if (dimension_ != 2 && dimension_ != 3) c.fail("expected dimension 2 or 3");
    if (c.u32() != 0) c.fail("the run has recorded frames alone, which are not its motion");
    if (!(c.f64() > 0)) c.fail("expected a window length above 0");
    c.end();
    Scene scene{static_cast<int>(dimension_), mesh(), {}, std::vector<LabelPair>{}};
    label(scene);
    return scene;
  }

  bool next(Motion& motion) override {
    const auto window = file_.next();
    if (file_.ended()) return false;
    if (!window || window->kind != "WIND") reject(file_.place(window ? window->offset : 0), "expected a block WIND");
    Cursor c = cursor(*window);
    if (c.u64() != windows_) c.fail("a window has the wrong number");
    motion.t0 = c.f64();
    motion.t1 = c.f64();
    c.end();
    if (!(motion.t0 < motion.t1)) c.fail("a window ends before it begins");
    if (windows_ > 0 && std::bit_cast<std::uint64_t>(motion.t0) != std::bit_cast<std::uint64_t>(end_))
      c.fail("a window does not begin where the one before ends");
    lines(motion);
    end_ = motion.t1;
    ++windows_;
    file_.expect("VELO");
    file_.expect("STAT");
    file_.expect_commit();
    motion.group_hash = file_.group_hash();
    return true;
  }

 private:
  Cursor cursor(const Block& block) const { return {block.payload, file_.name(), block.offset}; }

  Mesh mesh() {
    const Block block = file_.expect("MESH");
    Cursor c = cursor(block);
    Mesh mesh{c.u64(), {}};
    if (mesh.vertices < 1 || mesh.vertices > std::uint64_t{1} << 32) c.fail("an impossible number of vertices");
    vertices_ = mesh.vertices;
    const std::array<std::uint64_t, 3> counts = {c.u64(), c.u64(), c.u64()};
    for (std::size_t k = 0; k < 3; ++k) {
      c.need(counts[k], 4 * (3 - k));
      for (std::uint64_t i = 0; i < counts[k]; ++i) {
        Cell cell(3 - k);
        for (auto& v : cell) v = c.u32();
        for (const auto v : cell) {
          if (v >= mesh.vertices) c.fail("a vertex that is not there is named");
        }
        mesh.cells.push_back(cell);
      }
    }
    c.end();
    return mesh;
  }

  void label(Scene& scene) {
    const Block block = file_.expect("LABL");
    if (block.payload.size() != scene.mesh.vertices) cursor(block).fail("expected a label for each vertex");
    for (const char l : block.payload) {
      if (l != 0 && l != 1) cursor(block).fail("a label is not 0 or 1");
    }
    std::vector<std::uint16_t> groups(scene.mesh.vertices, 0);
    std::set<std::array<std::uint16_t, 2>> pairs;
    if (const auto exclusions = file_.next()) {
      if (exclusions->kind != "EXCL") reject(file_.place(exclusions->offset), "expected a block EXCL");
      Cursor c = cursor(*exclusions);
      const std::uint32_t n = c.u32();
      c.need(n, 4);
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::array<std::uint16_t, 2> pair = {c.u16(), c.u16()};
        if (pair[0] > pair[1] || (!pairs.empty() && pair <= *pairs.rbegin())) c.fail("pairs are not in order");
        pairs.insert(pair);
      }
      for (auto& g : groups) g = c.u16();
      c.end();
      if (n == 0) c.fail("expected a pair");
      file_.expect_commit();
    }
    std::set<std::uint32_t> labels;
    for (const Cell& cell : scene.mesh.cells) {
      bool scripted = true;
      for (const auto v : cell) {
        scripted = scripted && block.payload[v] == 1;
        if (groups[v] != groups[cell[0]]) cursor(block).fail("a cell is of two groups");
      }
      scene.labels.push_back(2u * groups[cell[0]] + (scripted ? 1 : 0));
      labels.insert(scene.labels.back());
    }
    for (const std::uint32_t a : labels) {
      for (const std::uint32_t b : labels) {
        const std::array<std::uint16_t, 2> g = {static_cast<std::uint16_t>(a / 2), static_cast<std::uint16_t>(b / 2)};
        if (a <= b && ((a % 2 == 1 && b % 2 == 1) || pairs.count(g) != 0)) scene.excluded->push_back({a, b});
      }
    }
  }

  void lines(Motion& motion) {
    const Block block = file_.expect("LINE");
    Cursor c = cursor(block);
    motion.begin.assign(1, 0);
    for (std::size_t v = 0; v < vertices_; ++v) {
      const std::uint32_t count = c.u32();
      if (count < 2) c.fail("a vertex has fewer than two breakpoints");
      motion.begin.push_back(motion.begin.back() + count);
    }
    const std::uint64_t all = motion.begin.back();
    c.need(all, 8 * (1 + std::uint64_t{dimension_}));
    motion.times.resize(all);
    motion.x.assign(all, {});
    for (double& t : motion.times) t = c.f64();
    for (auto& x : motion.x) {
      for (std::size_t k = 0; k < dimension_; ++k) x[k] = c.f64();
    }
    c.end();
    last_.resize(vertices_);
    for (std::size_t v = 0; v < vertices_; ++v) {
      const std::uint64_t first = motion.begin[v], end = motion.begin[v + 1];
      for (std::uint64_t i = first + 1; i < end; ++i) {
        if (!(motion.times[i - 1] < motion.times[i])) c.fail("times do not ascend");
      }
      if (std::bit_cast<std::uint64_t>(motion.times[first]) != std::bit_cast<std::uint64_t>(motion.t0) ||
          std::bit_cast<std::uint64_t>(motion.times[end - 1]) != std::bit_cast<std::uint64_t>(motion.t1))
        c.fail("a world line does not begin and end with its window");
      if (windows_ > 0 && std::memcmp(last_[v].data(), motion.x[first].data(), sizeof last_[v]) != 0)
        c.fail("vertex " + std::to_string(v) + " does not begin where it was at the end of the window before");
      last_[v] = motion.x[end - 1];
    }
  }

  BlockFile file_;
  std::uint32_t dimension_ = 3;
  std::size_t vertices_ = 0;
  std::uint64_t windows_ = 0;
  double end_ = 0;
  std::vector<std::array<double, 3>> last_;
};

}  // namespace noli::checker
