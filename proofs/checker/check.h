// SPDX-License-Identifier: Apache-2.0
//
// Checks a proof while reading it and its trajectory from beginning to end: proofs/FORMAT.md, section 2.
#pragma once

#include "obligations.h"
#include "witness.h"

namespace noli::checker {

class Check {
 public:
  Check(const std::string& proof, const std::vector<std::string>& paths, Asked asked = {})
      : asked_(std::move(asked)), proof_(proof, "PROF") {
    Reader c = proof_.expect("CLAM");
    claim_.source = c.u8();
    claim_.dimension = c.u8();
    const int flags = c.u8();
    c.require(claim_.source <= 2, "expected source 0, 1 or 2");
    c.require(claim_.dimension == 2 || claim_.dimension == 3, "expected dimension 2 or 3");
    c.require(flags <= (run() ? 1 : 3), "an impossible flag");
    c.require(c.u8() == 0, "expected 0");
    claim_.strict = (flags & 1) != 0;
    claim_.points = (flags & 2) != 0;
    claim_.ring = c.u32();
    claim_.eta = c.f64();
    c.require(!std::signbit(claim_.eta), "the least distance is negative");
    c.require(claim_.ring >= 1 && (claim_.eta > 0 || claim_.ring == 1), "an impossible ring");
    claim_.hash = c.raw<Sha256::Digest>();
    c.require(!run() || paths.size() == 1, "the proof is of a run: expected its trajectory.blocks, one file");
    if (run()) trajectory_ = std::make_unique<Run>(paths[0]);
    if (!run()) trajectory_ = std::make_unique<Frames>(paths, claim_.source == 1);
    Scene& scene = trajectory_->scene;
    c.require(!run() || claim_.dimension == scene.dimension, "the run has another dimension");
    read_merged(scene.vertices, c);
    const std::uint32_t pairs = c.u32();
    claim_.excluded = read_pairs<std::uint32_t>(c, pairs, "excluded pairs are not in order");
    c.require(!run() || claim_.excluded == scene.excluded(pairs), "other pairs are excluded than those of the run");
    c.end();
    make_cells(scene);
    c.require(!claim_.cells.empty(), "a claim about no cells");
    if (auto block = proof_.next()) read_labels(proof_.as("LABL", std::move(block)));
    c.require(cells_hash() == claim_.hash, "the claim is about other cells than those of the trajectory");
  }

  /// Checks step after step. Returns the text of the first witness that refutes the claim that is asked for. Without
  /// such a witness the claim of the file holds, and is at least as strong as the one asked for.
  std::optional<std::string> go() {
    for (std::uint64_t read = 0;; ++read) {
      auto block = proof_.next();
      if (proof_.ended()) break;
      step(proof_.as("STEP", std::move(block)), read);
    }
    require(trajectory_steps_ > 0, "the proof", "a claim about no steps");
    require(checked_ > 0, "the proof", "has none of the steps that are asked for");
    if (refuted_) return refuted_;
    if (in_vain_ && !asked_.enough_steps(claim_, proved_)) throw Rejected(*in_vain_);
    asked_.require_claimed(claim_, flat_);
    const bool all = in_vain_ || asked_.enough_steps(claim_, proved_) || !trajectory_->next(motion_);
    asked_.require_steps(claim_, proved_, !all);
    first_steps_ = in_vain_ || trajectory_->more();
    trajectory_steps_ = proved_;
    times_[1] = proved_until_;
    return std::nullopt;
  }

  const Claim& claim() const { return claim_; }
  /// What makes the accepted claim weaker than the one asked for by default, for the line of the verdict.
  std::string weaker() const {
    std::string text;
    if (claim_.source == 1) text += "; frames at rest";
    if (claim_.merged > 0) text += "; " + std::to_string(claim_.merged) + " merged vertices";
    const std::size_t pairs = run() ? 0 : claim_.excluded.size();
    const std::string list = pairs > 8 ? std::to_string(pairs) + " pairs" : text_of(claim_.excluded);
    if (pairs > 0) text += "; not compared: " + list;
    if (!compares_any(claim_, claim_.strict)) text += "; the claim is empty";
    if (asked_.part()) text += "; steps " + steps();
    if (first_steps_ && !asked_.part()) text += "; the first " + steps() + " steps";
    return text;
  }
  /// How many steps a proof or witness is about; of a part, which.
  bool part() const { return asked_.part(); }
  std::string steps() const { return asked_.text_of_steps(trajectory_steps_); }
  /// The last running hash of the proof. Parts of the same proof have the same one.
  const Sha256::Digest& proof() const { return proof_.hash(); }
  /// The first T0 and the last T1 of these steps.
  std::array<double, 2> times() const { return times_; }

 private:
  bool run() const { return claim_.source == 2; }

  void read_labels(Reader c) {
    c.require(!run(), "the labels of a run are those of its trajectory");
    std::uint32_t all = 0;
    for (Cell& cell : claim_.cells) all |= cell.label = c.u32();
    c.require(all != 0, "all labels are 0");
    c.end();
    proof_.expect_commit();
  }

  void read_merged(std::uint64_t vertices, Reader& c) {
    claim_.same.resize(vertices);
    std::iota(claim_.same.begin(), claim_.same.end(), 0);
    claim_.merged = c.u32();
    c.require(!run() || claim_.merged == 0, "a run has no merged vertices");
    std::int64_t before = -1;
    for (std::uint32_t i = 0; i < claim_.merged; ++i) {
      const std::uint32_t v = c.u32(), s = c.u32();
      c.require(v > before && v < vertices, "merged vertices do not ascend, or are not there");
      c.require(s < v && claim_.same[s] == s, "a vertex is merged with a later or a merged one");
      claim_.same[v] = s;
      before = v;
    }
  }

  void make_cells(Scene& scene) {
    claim_.cells = std::move(scene.cells);
    claim_.listed = claim_.cells.size();
    if (run()) return;
    std::vector<bool> used(scene.vertices, !claim_.points);
    for (Cell& cell : claim_.cells) {
      for (std::size_t i = 0; i < cell.size; ++i) {
        used[cell.v[i]] = true;
        cell.v[i] = claim_.same[cell.v[i]];
      }
    }
    tidy(claim_.cells);
    claim_.listed = claim_.cells.size();
    for (std::uint32_t v = 0; v < used.size(); ++v) {
      if (!used[v]) claim_.cells.push_back({{claim_.same[v]}, 1});
    }
    tidy(claim_.cells);
  }

  Sha256::Digest cells_hash() const {
    Sha256 hash;
    hash.add_raw(std::array<std::uint64_t, 2>{claim_.same.size(), claim_.cells.size()});
    for (const Cell& cell : claim_.cells) {
      hash.add_raw(cell.size);
      for (const std::uint32_t v : cell) hash.add_raw(v);
      hash.add_raw(cell.label);
    }
    return hash.digest();
  }

  /// The payload of STEP.
  struct Head {
    std::uint64_t number;
    double t0, t1;
    std::int32_t p, q;
    std::uint8_t kind;
    Sha256::Digest hash;
  };

  Head read_head(Reader& c, std::uint64_t read) {
    Head s{};
    s.number = c.u64();
    c.require(s.number < std::uint64_t{1} << 53, "a number is too large");
    c.require(s.number >= proof_steps_ && (gaps_ || s.number == read), "a step has the wrong number");
    proof_steps_ = s.number + 1;
    s.t0 = c.f64();
    s.t1 = c.f64();
    s.p = c.raw<std::int32_t>();
    s.q = c.raw<std::int32_t>();
    c.require(-1200 <= s.p && s.p <= 1200 && -1200 <= s.q && s.q <= 1200, "an impossible unit");
    s.kind = c.u8();
    c.require(s.kind <= 1, "expected a proof or a witness");
    gaps_ = gaps_ || s.kind == 1;
    s.hash = c.raw<Sha256::Digest>();
    return s;
  }

  /// Reads the trajectory up to this step, which has to be about what is there. Returns whether it is flat.
  bool find_motion(const Head& s, Reader& c) {
    if (asked_.part() && trajectory_steps_ == 0) {
      trajectory_steps_ = s.number;
      trajectory_->pass(trajectory_steps_);
    }
    for (; trajectory_steps_ <= s.number; ++trajectory_steps_) {
      c.require(trajectory_->next(motion_), "the trajectory has no such step");
    }
    c.require(s.t0 == motion_.t0 && s.t1 == motion_.t1, "the trajectory's step has another time");
    c.end();
    const bool flat = is_flat();
    for (auto& x : motion_.x) x[2] = claim_.dimension == 2 ? 0 : x[2];
    c.require(motion_.hash() == s.hash, "the step is about another motion than that of the trajectory");
    return flat;
  }

  /// The motion of the step before a part is compared too, so that parts that follow each other have the same positions
  /// between them.
  void step(Reader c, std::uint64_t read) {
    const Head s = read_head(c, read);
    const bool counts = asked_.counts(claim_, s.number), before = s.number + 1 == asked_.first();
    const std::uint64_t next = std::max(trajectory_steps_, asked_.first());
    c.require(!counts || witnessed() || s.number == next, "a step that is asked for is missing before this one");
    const bool flat = (counts || before) && find_motion(s, c);
    c.end();
    if (!counts) return pass_over(s);
    times_ = {checked_ == 0 ? s.t0 : times_[0], s.t1};
    ++checked_;
    // Merged vertices are at the same place at all times; they have the breakpoints of frames.
    for (std::size_t v = 0; v < claim_.same.size(); ++v) {
      const std::uint64_t i = motion_.begin[v], j = motion_.begin[claim_.same[v]];
      const bool merged = claim_.same[v] != v;
      const bool together = motion_.x[i] == motion_.x[j] && motion_.x[i + 1] == motion_.x[j + 1];
      c.require(!merged || together, "a merged vertex is not where the one is that stands for it");
    }
    const Integers motion(motion_, s.p, s.q, claim_.eta, c);
    if (s.kind == 1) return refute(motion, s.number, flat);
    prove(motion, c);
    if (witnessed()) return;
    flat_ = flat_ && flat;
    proved_ = trajectory_steps_;
    proved_until_ = s.t1;
  }

  /// The next block of a proof step, after TREE if there is one. That is kept: a later step may need it.
  std::optional<Block> after_tree() {
    auto block = proof_.next();
    if (!block || block->kind != "TREE") return block;
    new_tree_ = std::move(block->data);
    return proof_.next();
  }

  void pass_over(const Head& s) {
    if (s.kind == 1) {
      proof_.expect("WITN");
      return proof_.expect_commit();
    }
    for (auto block = after_tree(); block; block = proof_.next()) proof_.as("TOKS", std::move(block));
  }

  bool witnessed() const { return refuted_ || in_vain_; }
  /// All vertices have the same z at the beginning of the step, and the same z at its end.
  bool is_flat() const {
    if (run()) return claim_.dimension == 2;
    for (std::size_t i = 0; i < motion_.x.size(); ++i) {
      if (motion_.x[i][2] != motion_.x[i % 2][2]) return false;
    }
    return true;
  }

  void prove(const Integers& motion, const Reader& c) {
    auto block = after_tree();
    if (new_tree_) tree_.emplace(std::move(*new_tree_), claim_.cells);
    new_tree_.reset();
    c.require(tree_.has_value(), "the first step has no tree");
    Obligations obligations(claim_, motion, *tree_);
    for (; block; block = proof_.next()) {
      Reader tokens = proof_.as("TOKS", std::move(block));
      tokens.require(tokens.left() <= 1 << 20, "expected at most 2^20 bytes");
      obligations.take(tokens);
    }
    c.require(obligations.done(), "the proof of this step is not complete");
  }

  void refute(const Integers& motion, std::uint64_t number, bool flat) {
    const Witness witness(proof_.expect("WITN"), claim_, motion);
    proof_.expect_commit();
    if (refuted_) return;
    Shown shown = witness.shown();
    shown.step = number;
    shown.flat = flat;
    try {
      asked_.require_refuted(claim_, shown);
      refuted_ = "in step " + std::to_string(number + 1) + ", " + witness.words() + shown.rests_on(claim_);
    } catch (const Rejected& less) {
      if (!in_vain_) in_vain_ = less;
    }
  }

  Asked asked_;
  BlockFile proof_;
  std::unique_ptr<Trajectory> trajectory_;
  Claim claim_;
  std::optional<Tree> tree_;
  std::optional<Reader> new_tree_;  ///< that replaces it, not read yet
  Motion motion_;
  std::uint64_t proof_steps_ = 0;       ///< up to the last step that was read of the proof
  std::uint64_t trajectory_steps_ = 0;  ///< the same of the trajectory
  std::uint64_t checked_ = 0;           ///< how many steps were looked at
  std::uint64_t proved_ = 0;            ///< up to the last step that is proved before a witness
  bool gaps_ = false;                   ///< a witness was there, after which steps may be missing
  std::array<double, 2> times_{};
  double proved_until_ = 0;
  bool flat_ = true;          ///< the proved steps are flat
  bool first_steps_ = false;  ///< the trajectory goes on after them
  std::optional<std::string> refuted_;
  std::optional<Rejected> in_vain_;  ///< why the first witness that refutes only another claim does not count
};

}  // namespace noli::checker
