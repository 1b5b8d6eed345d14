// SPDX-License-Identifier: Apache-2.0
//
// The hashes are those that the prover writes: a proof file of the changed claim and frames is begun in memory, and
// they are taken from there.
#include "audit/fuzz/proofs/mutating.h"
#include "certify/proofs/parsed_claim.h"
#include "proofs/prover/tokens/proof_file.h"

namespace noli::audit {

namespace {

class MemorySink : public Sink {
 public:
  explicit MemorySink(std::string& bytes) : bytes_(bytes) {}
  void write(std::string_view bytes) override { bytes_ += bytes; }
  void sync() override {}
  void truncate(std::uint64_t size) override { bytes_.resize(size); }

 private:
  std::string& bytes_;
};

/// The beginnings of all steps, in a proof file of their own.
ProofGroups written_anew(const ParsedClaim& claim, const Mesh& mesh, const FrameMotion& motion) {
  ProofHeader header;
  header.source = static_cast<ProofSource>(claim.source);
  header.dimension = claim.dimension;
  header.strict = claim.strict;
  header.points = claim.points;
  header.vertices = mesh.vertex_count;
  header.mesh = &mesh;
  std::vector<std::uint32_t> labels(mesh.cell_count());
  for (std::size_t cell = 0; cell < labels.size(); ++cell) labels[cell] = claim.label(cell);
  header.labels = labels;
  header.merged = claim.merged;
  header.excluded = claim.excluded;
  header.eta = claim.eta;
  header.ring = claim.ring;
  std::string bytes;
  ProofFile file(std::make_unique<MemorySink>(bytes), header);
  const bool rest = claim.source == 1;
  const std::size_t steps = rest ? motion.frames.size() : motion.frames.size() - 1;
  for (std::size_t k = 0; k < steps; ++k) {
    const auto lines = WorldLines::from_frames(motion.frames[k], motion.frames[rest ? k : k + 1]);
    file.begin_step(k, ProofFile::Kind::proof, lines, rest ? 0 : static_cast<double>(k));
    file.commit();
  }
  return parse_proof(bytes, "a proof in memory");
}

}  // namespace

void mutating::fit_hashes(Mutating& m) {
  const auto claim = parse_claim(m.groups);
  if (!claim || m.from.extension == "blocks" || (claim->source != 0 && claim->source != 1)) return;
  if (claim->dimension != 2 && claim->dimension != 3) return;
  if (!std::isfinite(claim->eta)) return;
  const FrameMotion motion = m.frames ? *m.frames : frames_of(m.from);
  const auto mesh = claimed_mesh(*claim, motion.mesh);
  if (!mesh || motion.frames.empty() || motion.frames[0].empty()) return;
  const ProofGroups anew = written_anew(*claim, *mesh, motion);
  m.groups[0][0].payload.replace(16, 32, anew[0][0].payload, 16, 32);
  for (ProofBlock* const block : whole_steps(m)) {
    const auto k = get<std::uint64_t>(block->payload.data());
    if (k + 1 < anew.size()) block->payload.replace(33, 32, anew[k + 1][0].payload, 33, 32);
  }
}

}  // namespace noli::audit
