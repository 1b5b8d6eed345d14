// SPDX-License-Identifier: Apache-2.0
//
// noli_check PROOF FRAME... | noli_check PROOF TRAJECTORY
//
// Checks a proof that nothing touches, or that something does (proofs/FORMAT.md). What it says and its exit codes are in
// section 6 there.
//
// What this does not do: it trusts nobody but the C++ standard library and GMP, and finds nothing by itself.
#include <cstdio>
#include <exception>

#include "obligations.h"
#include "witness.h"

namespace noli::checker {
namespace {

class Check {
 public:
  Check(const std::string& proof, const std::vector<std::string>& paths) : proof_(proof, "PROF") {
    const Block block = proof_.expect("CLAM");
    Cursor c = cursor(block);
    claim_.source = c.u8();
    const int dimension = c.u8(), flags = c.u8();
    if (claim_.source > 2 || (dimension != 2 && dimension != 3) || flags > (claim_.source == 2 ? 1 : 3) || c.u8() != 0)
      c.fail("a field of the claim has an impossible value");
    claim_.strict = (flags & 1) != 0;
    claim_.ring = c.u32();
    claim_.eta = c.f64();
    if (std::signbit(claim_.eta) || claim_.ring < 1 || (claim_.eta == 0 && claim_.ring > 1))
      c.fail("an impossible distance or ring");
    const auto hash = c.raw<Sha256::Digest>();
    open(paths, c);
    read_scene((flags & 2) != 0, dimension, c);
    if (cells_hash() != hash) c.fail("the claim is about other cells than those of the trajectory");
    proof_.expect_commit();
  }

  /// Step after step. Whether a witness was among them.
  bool run() {
    for (std::uint64_t read = 0;; ++read) {
      const auto block = proof_.next();
      if (proof_.ended()) {
        if (!refuted_ && trajectory_->next(motion_))
          reject(proof_.name(),
                 "the proof ends after " + std::to_string(steps_) + " steps, but the trajectory goes on");
        return refuted_;
      }
      if (!block || block->kind != "STEP") reject(proof_.place(block ? block->offset : 0), "expected a block STEP");
      step(cursor(*block), read);
    }
  }

  const std::string& words() const { return words_; }
  const Claim& claim() const { return claim_; }
  std::uint64_t steps() const { return steps_; }

 private:
  Cursor cursor(const Block& block) const { return {block.payload, proof_.name(), block.offset}; }

  void open(const std::vector<std::string>& paths, const Cursor& c) {
    if (claim_.source == 2) {
      if (paths.size() != 1) c.fail("the proof is of a run: expected its trajectory.blocks, one file");
      trajectory_ = std::make_unique<Run>(paths[0]);
    } else {
      trajectory_ = std::make_unique<Frames>(paths, claim_.source == 1);
    }
  }

  void read_scene(bool points, int dimension, Cursor& c) {
    Scene scene = trajectory_->scene();
    dimension_ = dimension;
    if (claim_.source == 2 && dimension != scene.dimension) c.fail("the run has another dimension");
    read_merged(scene.mesh.vertices, c);
    read_excluded(scene, c);
    RawCells raw = raw_cells(scene.mesh.cells);
    if (points) {
      std::vector<bool> used(scene.mesh.vertices, false);
      for (const Cell& cell : scene.mesh.cells) {
        for (const auto v : cell) used[v] = true;
      }
      for (std::uint32_t v = 0; v < used.size(); ++v) {
        if (!used[v]) raw.points.push_back({v});
      }
    }
    for (auto* list : {&raw.faces, &raw.edges, &raw.points}) {
      for (Cell& cell : *list) {
        for (auto& v : cell) v = claim_.same[v];
      }
    }
    claim_.cells = claim_.source == 2 ? std::move(scene.mesh.cells) : raw.without_redundant(scene.mesh.vertices);
    claim_.labels = std::move(scene.labels);
    claim_.labels.resize(claim_.cells.size(), 0);
    if (claim_.cells.empty()) c.fail("a claim about no cells");
  }

  void read_merged(std::uint64_t vertices, Cursor& c) {
    claim_.same.resize(vertices);
    for (std::uint64_t v = 0; v < vertices; ++v) claim_.same[v] = static_cast<std::uint32_t>(v);
    const std::uint32_t n = c.u32();
    c.need(n, 8);
    if (claim_.source == 2 && n != 0) c.fail("a run has no merged vertices");
    std::int64_t before = -1;
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t v = c.u32(), s = c.u32();
      if (v <= before || v >= vertices || s >= v || claim_.same[s] != s) c.fail("merged vertices are not in order");
      claim_.same[v] = s;
      before = v;
    }
  }

  void read_excluded(const Scene& scene, Cursor& c) {
    const std::uint32_t n = c.u32();
    c.need(n, 8);
    std::vector<LabelPair> pairs;
    for (std::uint32_t i = 0; i < n; ++i) {
      pairs.push_back({c.u32(), c.u32()});
      if (pairs[i][0] > pairs[i][1] || (i > 0 && pairs[i] <= pairs[i - 1])) c.fail("excluded pairs are not in order");
    }
    c.end();
    if (scene.excluded && pairs != *scene.excluded) c.fail("other pairs are excluded than those of the run");
    claim_.excluded = {pairs.begin(), pairs.end()};
  }

  Sha256::Digest cells_hash() const {
    Sha256 hash;
    hash.add_raw(std::uint64_t{claim_.same.size()});
    hash.add_raw(std::uint64_t{claim_.cells.size()});
    for (std::size_t i = 0; i < claim_.cells.size(); ++i) {
      hash.add_raw(static_cast<std::uint8_t>(claim_.cells[i].size()));
      for (const std::uint32_t v : claim_.cells[i]) hash.add_raw(v);
      hash.add_raw(claim_.labels[i]);
    }
    return hash.digest();
  }

  void step(Cursor c, std::uint64_t read) {
    const std::uint64_t number = c.u64();
    if (number < steps_ || (!refuted_ && number != read)) c.fail("a step has the wrong number");
    for (; steps_ <= number; ++steps_) {
      if (!trajectory_->next(motion_)) c.fail("the trajectory has no such step");
    }
    const double t0 = c.f64(), t1 = c.f64();
    const std::int32_t p = c.i32(), q = c.i32();
    const std::uint8_t kind = c.u8();
    if (t0 != motion_.t0 || t1 != motion_.t1) c.fail("the trajectory's step has another time");
    if (p < -1200 || p > 1200 || q < -1200 || q > 1200 || kind > 1)
      c.fail("a field of the step has an impossible value");
    const auto hash = c.raw<Sha256::Digest>();
    c.end();
    if (dimension_ == 2) {
      for (auto& x : motion_.x) x[2] = 0;
    }
    if (motion_.hash() != hash) c.fail("the step is about another motion than that of the trajectory");
    require_merged(c);
    const Integers motion(motion_, p, q, claim_.eta, c);
    kind == 0 ? prove(motion, c) : refute(motion);
  }

  /// Merged vertices are at the same place at all times.
  void require_merged(const Cursor& c) const {
    for (std::uint32_t v = 0; v < claim_.same.size(); ++v) {
      const std::uint64_t i = motion_.begin[v], j = motion_.begin[claim_.same[v]], n = motion_.begin[v + 1] - i;
      for (std::uint64_t k = 0; k < n && claim_.same[v] != v; ++k) {
        if (motion_.x[i + k] != motion_.x[j + k])
          c.fail("vertex " + std::to_string(v) + " is not where the one is that it was merged with");
      }
    }
  }

  void prove(const Integers& motion, const Cursor& c) {
    auto block = proof_.next();
    if (block && block->kind == "TREE") {
      tree_.emplace(cursor(*block), claim_);
      block = proof_.next();
    }
    if (!tree_) c.fail("the first step has no tree");
    Obligations obligations(claim_, motion, *tree_);
    for (; block; block = proof_.next()) {
      if (block->kind != "TOKS" || block->payload.size() > 1 << 20)
        reject(proof_.place(block->offset), "expected a block TOKS of at most 2^20 bytes");
      Cursor tokens = cursor(*block);
      obligations.take(tokens);
    }
    if (proof_.ended() || !obligations.done()) c.fail("the proof of this step is not complete");
  }

  void refute(const Integers& motion) {
    const Block block = proof_.expect("WITN");
    const Witness witness(cursor(block), claim_, motion);
    witness.check();
    proof_.expect_commit();
    if (words_.empty()) words_ = "in step " + std::to_string(steps_) + ", " + witness.words();
    refuted_ = true;
  }

  BlockFile proof_;
  std::unique_ptr<Trajectory> trajectory_;
  Claim claim_;
  int dimension_ = 3;
  std::optional<Tree> tree_;
  Motion motion_;
  std::uint64_t steps_ = 0;
  bool refuted_ = false;
  std::string words_;
};

void print_claim(const Check& check) {
  const Claim& claim = check.claim();
  std::printf("%llu steps; %zu cells of %zu vertices; %s.\n", static_cast<unsigned long long>(check.steps()),
              claim.cells.size(), claim.same.size(),
              claim.strict ? "features of one cell are compared too" : "features of two different cells are compared");
  if (claim.eta > 0) std::printf("Least distance %.17g, ring %u.\n", claim.eta, claim.ring);
  if (claim.excluded.empty()) return;
  std::printf("Not compared, pairs of labels:");
  for (const auto& [a, b] : claim.excluded) std::printf(" %u-%u", a, b);
  std::printf("\n");
}

int run(const std::vector<std::string>& arguments) {
  Check check(arguments[0], {arguments.begin() + 1, arguments.end()});
  const bool refuted = check.run();
  if (refuted) {
    std::printf("refuted: %s\n", check.words().c_str());
  } else {
    std::printf("accepted: nothing touches\n");
  }
  print_claim(check);
  if (std::fflush(stdout) != 0) reject("standard output", "cannot be written");
  return refuted ? 1 : 0;
}

}  // namespace
}  // namespace noli::checker

int main(int argc, char** argv) {
  try {
    if (argc < 3) noli::checker::reject("the command line", "expected a proof, and frames or a trajectory.blocks");
    return noli::checker::run({argv + 1, argv + argc});
  } catch (const noli::checker::Rejected& r) {
    std::printf("rejected: %s: %s\n", r.where.c_str(), r.why.c_str());
  } catch (const std::exception& e) {
    std::printf("rejected: %s\n", e.what());
  }
  return 3;
}
