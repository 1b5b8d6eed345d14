// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/proofs/minimise_proof.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <noli/errors.h>
#include "certify/proofs/proof_blocks.h"

namespace noli::audit {

namespace {

/// Half the size, and one less from where tokens are short.
std::size_t next_size(std::size_t size) { return size > 16 ? size / 2 : size - 1; }

/// Leaves out stretches of a sequence, the long ones first, for as long as `holds` for the rest.
template <class Sequence, class Holds>
bool leave_out(Sequence& all, const Holds& holds) {
  bool progress = false;
  for (std::size_t size = all.size(); size > 0; size = std::min(next_size(size), all.size())) {
    for (std::size_t end = all.size(); end > 0;) {
      const std::size_t begin = end - std::min(size, end);
      Sequence fewer = all;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(begin), fewer.begin() + static_cast<std::ptrdiff_t>(end));
      if (holds(fewer)) {
        all = std::move(fewer);
        progress = true;
      }
      end = begin;
    }
  }
  return progress;
}

template <class Holds>
bool put_zeros(std::string& bytes, const Holds& holds) {
  bool progress = false;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (bytes[i] == '\0') continue;
    std::string candidate = bytes;
    candidate[i] = '\0';
    if (!holds(candidate)) continue;
    bytes = std::move(candidate);
    progress = true;
  }
  return progress;
}

std::optional<ProofGroups> groups_of(const std::string& proof) {
  try {
    return parse_proof(proof, "proof");
  } catch (const InputError&) {
    return std::nullopt;
  }
}

class ProofMinimiser {
 public:
  ProofMinimiser(const ProofFiles& files, const std::function<bool(const ProofFiles&)>& fails, std::size_t budget)
      : files_(files), fails_(fails), budget_(budget) {}

  ProofFiles run() {
    for (bool progress = true; progress && budget_ > 0;) {
      progress = fewer_frames();
      progress |= smaller_proof();
    }
    return files_;
  }

 private:
  bool holds(const ProofFiles& candidate) {
    if (budget_ == 0) return false;
    --budget_;
    if (!fails_(candidate)) return false;
    files_ = candidate;
    return true;
  }

  bool proof_holds(std::string proof) {
    if (proof.empty()) return false;          // nobody reads that
    if (proof == files_.proof) return false;  // no progress, though it fails too
    return holds({std::move(proof), files_.extension, files_.files});
  }

  bool fewer_frames() {
    std::vector<std::string> frames = files_.files;
    return leave_out(frames, [&](const std::vector<std::string>& fewer) {
      return !fewer.empty() && holds({files_.proof, files_.extension, fewer});
    });
  }

  bool smaller_proof() {
    if (auto groups = groups_of(files_.proof)) return smaller_groups(*groups);
    const auto bytes_hold = [this](const std::string& proof) { return proof_holds(proof); };
    std::string bytes = files_.proof;
    const bool shorter = leave_out(bytes, bytes_hold);
    return put_zeros(bytes, bytes_hold) || shorter;
  }

  bool smaller_groups(ProofGroups& groups) {
    const auto groups_hold = [this](const ProofGroups& all) { return proof_holds(proof_bytes(all)); };
    bool progress = leave_out(groups, groups_hold);
    for (ProofGroup& group : groups) {
      progress |= leave_out(group, [&](const ProofGroup& fewer) { return with(groups, group, fewer, groups_hold); });
      for (ProofBlock& block : group) {
        const auto payload_holds = [&](const std::string& payload) {
          return with(groups, block.payload, payload, groups_hold);
        };
        progress |= leave_out(block.payload, payload_holds);
        progress |= put_zeros(block.payload, payload_holds);
      }
    }
    return progress;
  }

  /// Whether it holds of the groups with this in the place of a part of them.
  template <class Part, class Holds>
  static bool with(const ProofGroups& groups, Part& part, const Part& other, const Holds& groups_hold) {
    Part was = std::exchange(part, other);
    const bool result = groups_hold(groups);
    part = std::move(was);
    return result;
  }

  ProofFiles files_;
  const std::function<bool(const ProofFiles&)>& fails_;
  std::size_t budget_;
};

}  // namespace

ProofFiles minimise(const ProofFiles& files, const std::function<bool(const ProofFiles&)>& fails, std::size_t budget) {
  return ProofMinimiser(files, fails, budget).run();
}

JudgedProof minimise_finding(JudgedProof finding, const Checkers& checkers, const std::atomic<bool>& stop,
                             std::size_t budget) {
  const std::string kind = kind_of(finding.judgement);
  const auto fails = [&](const ProofFiles& candidate) {
    if (stop) return false;
    ProofJudgement judgement = judge_proof(candidate, checkers);
    if (kind_of(judgement) != kind) return false;
    finding = {candidate, std::move(judgement)};
    return true;
  };
  minimise(ProofFiles(finding.files), fails, budget);
  return finding;
}

JudgedProof replay_proof(ProofFiles files, bool smaller, const Checkers& checkers, const std::atomic<bool>& stop) {
  constexpr std::size_t most_candidates = 20'000;
  JudgedProof proof{std::move(files), {}};
  proof.judgement = judge_proof(proof.files, checkers);
  if (!smaller || proof.judgement.difference.empty()) return proof;
  return minimise_finding(std::move(proof), checkers, stop, most_candidates);
}

}  // namespace noli::audit
