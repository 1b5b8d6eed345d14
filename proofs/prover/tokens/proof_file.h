// SPDX-License-Identifier: Apache-2.0
//
// Writes proof files (proofs/FORMAT.md): the claim, then step after step, each committed when it is complete.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "kernel/motion_points.h"
#include "proofs/prover/cells/labels.h"
#include "proofs/prover/tokens/tokens.h"
#include "trajectory/blocks/block_file.h"
#include "trajectory/blocks/sha256.h"
#include "trajectory/world_lines.h"

namespace noli {

enum class ProofSource : std::uint8_t { frames = 0, frames_at_rest = 1, run = 2 };

/// Blocks CLAM and, for frames whose labels are not all 0, LABL.
struct ProofHeader {
  ProofSource source = ProofSource::frames;
  int dimension = 3;
  bool strict = false, points = false;
  std::size_t vertices = 0;
  const Mesh* mesh = nullptr;                   ///< after merging
  std::span<const std::uint32_t> labels;        ///< of its cells
  std::optional<Sha256Digest> cells = {};       ///< cells_hash, if known
  std::vector<std::array<VertexId, 2>> merged;  ///< a vertex and the one that represents it, ascending
  LabelPairs excluded;
  double eta = 0;
  std::uint32_t ring = 1;
};

/// The hash of the cells with their labels, for the claim.
Sha256Digest cells_hash(const ProofHeader& header);

/// The units of a step's numbers, eta included. `shift`: added to all times of the lines.
motion::Scale units_of(const WorldLines& lines, int dimension, double shift, double eta);

class ProofFile {
 public:
  static constexpr FourLetters content = four_letters("PROF");

  /// Writes the header. This and all below throw what the sink throws.
  ProofFile(std::unique_ptr<Sink> sink, const ProofHeader& header);
  /// Goes on after a commit, like BlockWriter.
  ProofFile(std::unique_ptr<Sink> sink, const CommitPoint& committed, const ProofHeader& header);

  enum class Kind : std::uint8_t { proof = 0, witness = 1 };

  /// Adds blocks of a step that another file has: STEP first, as step_payload() gives it.
  void append(FourLetters kind, std::string_view payload) { blocks_.append(kind, payload); }
  static constexpr FourLetters step_kind = four_letters("STEP"), tree_kind = four_letters("TREE"),
                               tokens_kind = four_letters("TOKS");
  /// The payload of a STEP block, for begin_step() with the same arguments.
  std::string step_payload(std::uint64_t number, Kind kind, const WorldLines& lines, double shift,
                           const std::optional<Sha256Digest>& hash) const;
  /// Whether the payload of a STEP block begins a proof, or a witness.
  static Kind kind_of(std::string_view step_payload);

  /// Begins step `number`, whose times are those of `lines` plus `shift`. In two dimensions third coordinates count as
  /// 0. `hash`: of a window of a run, that of its group.
  void begin_step(std::uint64_t number, Kind kind, const WorldLines& lines, double shift,
                  const std::optional<Sha256Digest>& hash = {});
  void tree(std::string_view payload) { blocks_.append(tree_kind, payload); }
  void tokens(std::string_view payload) { blocks_.append(tokens_kind, payload); }
  /// All tokens that `make` passes on. If it returns false or throws, the step is dropped.
  bool tokens(const std::function<bool(const std::function<void(std::string_view)>&)>& make);
  void witness(std::string_view payload) { blocks_.append(four_letters("WITN"), payload); }
  void commit() { blocks_.commit(); }
  /// Drops the step that was begun.
  void discard() { blocks_.discard(); }
  const CommitPoint& committed() const { return blocks_.committed(); }

 private:
  BlockWriter blocks_;
  int dimension_;
  double eta_;
};

}  // namespace noli
