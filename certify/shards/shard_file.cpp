// SPDX-License-Identifier: Apache-2.0
#include "certify/shards/shard_file.h"

#include <fmt/format.h>

#include <cstring>
#include <memory>
#include <system_error>
#include <utility>

#include <noli/errors.h>
#include "certify/proofs/claim.h"
#include "proofs/prover/tokens/proof_file.h"
#include "trajectory/blocks/block_sink.h"
#include "trajectory/blocks/sha256.h"
#include "trajectory/replaced_file.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

constexpr FourLetters content = four_letters("SHRD");
constexpr FourLetters task_kind = four_letters("TASK");
constexpr const char* remove_it = "remove it, and run `noli verify --shard` again";

/// Copies the groups of a proof behind its claim.
void copy_steps(const fs::path& proof, BlockWriter& to) {
  BlockReader from(proof, ProofFile::content);
  while (const auto block = from.next()) {
    const std::uint64_t group = from.committed().groups - (block->kind == block_format::commit ? 1 : 0);
    if (group == 0) continue;
    if (block->kind == block_format::commit) {
      to.commit();
    } else {
      to.append(block->kind, block->payload);
    }
  }
}

/// `rest` writes what comes behind the head.
template <class Rest>
void write(const fs::path& file, const Json& head, const Rest& rest) {
  ReplacedFile part(file, {.name = ScratchName::random});
  {
    BlockWriter writer(std::make_unique<FileSink>(part.path(), FileSink::Open::create), content);
    writer.append(task_kind, head.dump());
    writer.commit();
    rest(writer);
  }
  part.take_name();
}

std::uint64_t groups_of_steps(const std::optional<fs::path>& proof) {
  if (!proof) return 0;
  return BlockReader(*proof, ProofFile::content).look_at_commits().count - 1;
}

}  // namespace

Json shared_claim_json(Claim claim) {
  if (claim.motion == "run") {
    claim.steps = 0;
    claim.from = claim.to = 0;
  }
  return claim_json(claim);
}

void write_shard(const fs::path& file, Json head, const std::optional<fs::path>& proof) {
  head["groups"] = groups_of_steps(proof);
  write(file, head, [&](BlockWriter& writer) {
    if (proof) copy_steps(*proof, writer);
  });
}

void write_part_shard(const fs::path& file, Json head, const StepProof* proof) {
  head["groups"] = proof == nullptr ? 0 : 1;
  write(file, head, [&](BlockWriter& writer) {
    if (proof == nullptr) return;
    writer.append(ProofFile::step_kind, std::string(sizeof(std::uint64_t), '\0'));
    if (!proof->leaf_cells.empty()) writer.append(ProofFile::tree_kind, encoded_tree(proof->leaf_cells));
    proof->tokens.give([&](std::string_view piece) { writer.append(ProofFile::tokens_kind, piece); });
    writer.commit();
  });
}

ShardReader::ShardReader(const fs::path& file, const std::string& request_hash, std::uint64_t task)
    : reader_(file, content) {
  const std::uint64_t groups = BlockReader(file, content).look_at_commits().count;
  const auto block = next_block();
  if (block && block->kind == task_kind) head_ = Json::parse(block->payload, nullptr, false);
  const auto has = [this](const char* member, const Json& value) {
    return head_.is_object() && head_.contains(member) && head_[member] == value;
  };
  if (!has("format", "noli shard") || !has("version", 1)) {
    throw InputError(file.string(), "", std::string("is not a shard; ") + remove_it);
  }
  if (!has("request", request_hash)) {
    throw InputError(file.string(), "",
                     std::string("is a shard of another request than request.json beside it; ") + remove_it);
  }
  if (!has("task", task)) {
    throw InputError(file.string(), "", fmt::format("is the shard of another task than {}; {}", task + 1, remove_it));
  }
  next_block();  // its commit
  next_ = next_block();
  if (!has("groups", groups - 1) || reader_.committed().groups == 0) {
    throw InputError(file.string(), "", std::string("is cut off; ") + remove_it);
  }
}

std::optional<Block> ShardReader::next_block() {
  try {
    return reader_.next();
  } catch (const InputError& damage) {
    throw InputError(damage, remove_it);
  }
}

std::optional<std::string> other_input(const ShardReader& shard, const std::vector<FrameFacts>& files) {
  return reading(shard.name(), [&]() -> std::optional<std::string> {
    const Json& known = shard.head().at("files");
    if (known.empty()) throw std::invalid_argument("the shard does not say what it was made from");
    for (const Json& file : known) {
      const auto index = file.at(0).get<std::uint64_t>();
      if (index >= files.size()) throw std::invalid_argument("the shard was made from more files");
      const FrameFacts& facts = files[index];
      if (!facts.looked_at || hex(facts.sha256) != file.at(1).get<std::string>()) return facts.file;
    }
    return std::nullopt;
  });
}

std::optional<std::uint64_t> ShardReader::next_step() const {
  std::uint64_t number = 0;
  if (!next_) return std::nullopt;
  if (next_->kind != ProofFile::step_kind || next_->payload.size() < sizeof number) {
    throw InputError(reader_.name(), fmt::format("byte {}", next_->offset), "expected a block STEP");
  }
  std::memcpy(&number, next_->payload.data(), sizeof number);
  return number;
}

void ShardReader::blocks(std::uint64_t step, const std::function<void(FourLetters, std::string_view)>& take) {
  for (auto number = next_step(); number && *number <= step; number = next_step()) {
    for (; next_ && next_->kind != block_format::commit; next_ = next_block()) {
      if (*number == step) take(next_->kind, next_->payload);
    }
    next_ = next_block();
  }
}

}  // namespace noli
