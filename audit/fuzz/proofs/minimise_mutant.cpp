// SPDX-License-Identifier: Apache-2.0
//
// Makes a mutant that fails as like the good proof as possible.
#include <algorithm>
#include <string>
#include <utility>

#include <noli/errors.h>
#include "audit/fuzz/proofs/fuzz_proofs.h"

namespace noli::audit {

namespace {

class MutantMinimiser {
 public:
  MutantMinimiser(const ProofCase& from, ProofMutant mutant, std::function<bool(const ProofMutant&)> fails)
      : from_(from), mutant_(std::move(mutant)), fails_(std::move(fails)) {}

  ProofMutant run() {
    put_back_files();
    try {
      ProofGroups groups = parse_proof(mutant_.proof, "mutant");
      put_back_blocks(groups);
    } catch (const InputError&) {  // its bytes are no blocks
      put_back_bytes(mutant_.proof, from_.proof,
                     [](ProofMutant& candidate, const std::string& bytes) { candidate.proof = bytes; });
    }
    return mutant_;
  }

 private:
  bool accept(const ProofMutant& candidate) {
    if (!fails_(candidate)) return false;
    mutant_ = candidate;
    return true;
  }

  void put_back_files() {
    if (!mutant_.files) return;
    ProofMutant candidate = mutant_;
    candidate.files.reset();
    accept(candidate);
  }

  void put_back_blocks(ProofGroups& groups) {
    for (std::size_t g = 0; g < std::min(groups.size(), from_.groups.size()); ++g) {
      for (std::size_t b = 0; b < std::min(groups[g].size(), from_.groups[g].size()); ++b) {
        if (groups[g][b] == from_.groups[g][b]) continue;
        ProofGroups candidate = groups;
        candidate[g][b] = from_.groups[g][b];
        if (with(candidate)) {
          groups = candidate;
          continue;
        }
        put_back_bytes(groups[g][b].payload, from_.groups[g][b].payload,
                       [&](ProofMutant& changed, const std::string& payload) {
                         candidate = groups;
                         candidate[g][b].payload = payload;
                         changed.proof = proof_bytes(candidate);
                       });
      }
    }
  }

  bool with(const ProofGroups& groups) {
    ProofMutant candidate = mutant_;
    candidate.proof = proof_bytes(groups);
    return accept(candidate);
  }

  /// Byte by byte, where the lengths are equal.
  template <class Change>
  void put_back_bytes(std::string bytes, const std::string& original, const Change& change) {
    for (std::size_t i = 0; bytes.size() == original.size() && i < bytes.size() && i < 4096; ++i) {
      if (bytes[i] == original[i]) continue;
      std::string candidate_bytes = bytes;
      candidate_bytes[i] = original[i];
      ProofMutant candidate = mutant_;
      change(candidate, candidate_bytes);
      if (accept(candidate)) bytes = candidate_bytes;
    }
  }

  const ProofCase& from_;
  ProofMutant mutant_;
  std::function<bool(const ProofMutant&)> fails_;
};

}  // namespace

ProofMutant minimise(const ProofCase& from, const ProofMutant& mutant,
                     const std::function<bool(const ProofMutant&)>& fails) {
  return MutantMinimiser(from, mutant, fails).run();
}

}  // namespace noli::audit
