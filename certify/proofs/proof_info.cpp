// SPDX-License-Identifier: Apache-2.0
#include <noli/proof.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <noli/errors.h>
#include "certify/proofs/parsed_claim.h"
#include "trajectory/blocks/block_file.h"
#include "trajectory/blocks/bytes.h"
#include "trajectory/stop.h"

namespace noli {
namespace {

constexpr FourLetters proof_content = four_letters("PROF");
constexpr std::size_t step_payload_size = 65;

std::string place(const Block& block) { return fmt::format("byte {}", block.payload_offset()); }

/// The contents of the committed groups.
class Contents {
 public:
  Contents(const std::filesystem::path& path, const std::function<void(double)>& progress)
      : path_(path.string()), reader_(path, proof_content), bytes_(std::filesystem::file_size(path)) {
    while (auto block = reader_.next()) {
      end_if_stopped();
      const auto read = static_cast<double>(block->payload_offset() + block->payload.size());
      if (progress) progress(std::min(1.0, read / static_cast<double>(bytes_)));
      add(*block);
    }
    if (!claim_) throw InputError(path_, "", "ends before its claim is committed");
    if (progress) progress(1);
  }

  ProofInfo info() const {
    static constexpr std::array<const char*, 3> motions = {"linear", "rest", "run"};
    const auto source = static_cast<std::size_t>(claim_->source);
    return {.motion = source < motions.size() ? motions[source] : "",
            .dimension = claim_->dimension,
            .strict = claim_->strict,
            .points = claim_->points,
            .distance = claim_->eta,
            .ring = claim_->ring,
            .merged = claim_->merged.size(),
            .excluded = claim_->excluded.size(),
            .steps = committed_.steps,
            .contacts = committed_.witnesses,
            .from = committed_.begin,
            .to = committed_.end,
            .token_bytes = committed_.token_bytes,
            .bytes = bytes_,
            .open_group = reader_.open_group().has_value()};
  }

 private:
  struct Totals {
    std::uint64_t steps = 0, witnesses = 0, token_bytes = 0;
    double begin = 0, end = 0;
  };

  void add(Block& block) {
    if (block.kind == block_format::commit) return commit(block);
    if (block.kind == four_letters("STEP")) add_step(block);
    if (block.kind == four_letters("TOKS")) open_.token_bytes += block.payload.size();
    if (!claim_) first_.push_back({block.kind, std::move(block.payload)});
  }

  void add_step(const Block& block) {
    if (block.payload.size() != step_payload_size) {
      throw InputError(path_, place(block), fmt::format("a step has {} bytes", step_payload_size));
    }
    if (open_.steps++ == 0) open_.begin = get<double>(block.payload.data() + 8);
    open_.end = get<double>(block.payload.data() + 16);
    if (block.payload[32] != 0) ++open_.witnesses;
  }

  void commit(const Block& block) {
    if (!claim_) claim_ = parse_claim({first_});
    if (!claim_) throw InputError(path_, place(block), "the first group has no claim");
    first_.clear();
    committed_ = open_;
  }

  std::string path_;
  BlockReader reader_;
  std::uint64_t bytes_;  ///< of the file
  ProofGroup first_;     ///< until it is committed
  std::optional<ParsedClaim> claim_;
  Totals open_, committed_;
};

}  // namespace

bool is_proof(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return false;  // a look would consume the beginning of a pipe
  std::array<char, block_format::file_header_size> begin{};
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(begin.data(), begin.size())) return false;
  return std::string_view(begin.data(), block_format::magic.size()) == block_format::magic &&
         get<FourLetters>(begin.data() + 12) == proof_content;
}

ProofInfo inspect_proof(const std::filesystem::path& file, const std::atomic<bool>* stop,
                        const std::function<void(double share)>& progress) {
  const StopOfThread stop_of_thread(stop);
  return Contents(file, progress).info();
}

}  // namespace noli
