// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/proofs/proof_mutations.h"

#include <algorithm>
#include <exception>
#include <numeric>
#include <utility>

#include "audit/fuzz/proofs/mutating.h"
#include "trajectory/formats/frames.h"

namespace noli::audit {

namespace {

std::vector<ProofMutation> all_mutations() {
  std::vector<ProofMutation> all;
  for (const auto& some :
       {mutations_of_tokens(), mutations_of_witnesses(), mutations_of_claims(), mutations_of_frames()}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

const ProofMutation& some_mutation(Random& random) {
  const auto all = proof_mutations();
  static const std::uint64_t total =
      std::accumulate(all.begin(), all.end(), std::uint64_t{0},
                      [](std::uint64_t sum, const ProofMutation& m) { return sum + m.weight; });
  std::uint64_t at = random.below(total);
  for (const ProofMutation& mutation : all) {
    if (at < mutation.weight) return mutation;
    at -= mutation.weight;
  }
  return all.back();
}

/// Plain bytes, of the proof or of a file of its trajectory.
ProofMutant change_plain_bytes(const ProofCase& from, Random& random) {
  ProofMutant mutant{"bytes", from.proof, {}};
  if (random.one_in(8)) {
    mutant.mutations = "bytes of the trajectory";
    mutant.files = from.files;
    mutating::change_bytes(random, (*mutant.files)[random.below(from.files.size())]);
    return mutant;
  }
  mutating::change_bytes(random, mutant.proof);
  // A proof of no bytes could not be read again when it is saved.
  if (random.one_in(5)) mutant.proof.resize(std::max<std::size_t>(random.below(mutant.proof.size() + 1), 1));
  return mutant;
}

std::vector<std::string> files_of(const FrameMotion& motion) {
  std::vector<std::string> files;
  for (std::size_t frame = 0; frame < motion.frames.size(); ++frame) files.push_back(file_bytes(motion, frame));
  return files;
}

/// Its bytes; one in some has a hash that is wrong.
std::string bytes_of(const Mutating& m, std::string& names) {
  if (!m.random.one_in(8)) return proof_bytes(m.groups);
  names += "+hash";
  const auto what = static_cast<Spoiled::What>(1 + m.random.below(4));
  std::string bytes = proof_bytes(m.groups, {what, m.random.below(m.groups.size())});
  if (m.random.one_in(4)) bytes.back() = static_cast<char>(bytes.back() ^ 1);
  return bytes;
}

}  // namespace

namespace mutating {

FrameMotion frames_of(const ProofCase& from) {
  FrameMotion motion;
  motion.format = from.extension == "obj" ? FrameFormat::obj : FrameFormat::ply_ascii;
  for (const std::string& bytes : from.files) {
    Frame frame = parse_frame(bytes, "frame." + from.extension);
    motion.mesh = frame.mesh;
    motion.frames.push_back(std::move(frame.positions));
  }
  return motion;
}

void change_bytes(Random& random, std::string& bytes, std::size_t low) {
  constexpr std::array<int, 5> times = {1, 1, 1, 2, 4};
  constexpr std::array<int, 6> values = {0, 1, 2, 127, 128, 255};
  constexpr std::array<std::size_t, 4> lengths = {1, 1, 4, 16};
  for (int i = random.one_of(times); i > 0; --i) {
    const std::size_t left = bytes.size() > low ? bytes.size() - low : 0;
    const std::size_t at = low + (left == 0 ? 0 : random.below(left)), length = random.one_of(lengths);
    switch (left == 0 ? 3 : random.below(6)) {
      case 0:
      case 1: bytes[at] = static_cast<char>(bytes[at] ^ 1 << random.below(8)); break;
      case 2: bytes[at] = static_cast<char>(random.one_of(values)); break;
      case 3: bytes.insert(std::min(at, bytes.size()), length, static_cast<char>(random.below(256))); break;
      case 4: bytes.erase(at, length); break;
      default: bytes.insert(at, bytes.substr(low + random.below(left), length));
    }
  }
}

}  // namespace mutating

std::span<const ProofMutation> proof_mutations() {
  static const std::vector<ProofMutation> all = all_mutations();
  return all;
}

ProofMutant make_mutant(const ProofCase& from, std::span<const ProofCase> others, Random& random) {
  if (random.one_in(5)) return change_plain_bytes(from, random);
  Mutating m{from, others, random, from.groups, {}, false};
  ProofMutant mutant;
  constexpr std::array<int, 7> times = {1, 1, 1, 1, 2, 2, 3};
  for (int left = random.one_of(times); left > 0 && !m.groups.empty();) {
    const ProofMutation& mutation = some_mutation(random);
    if (!mutation.apply(m)) continue;
    mutant.mutations += (mutant.mutations.empty() ? "" : "+") + std::string(mutation.name);
    --left;
  }
  if (m.fits) mutating::fit_hashes(m);
  if (m.groups.empty()) m.groups.emplace_back();
  if (m.frames) mutant.files = files_of(*m.frames);
  mutant.proof = bytes_of(m, mutant.mutations);
  return mutant;
}

}  // namespace noli::audit
