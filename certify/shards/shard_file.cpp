// SPDX-License-Identifier: Apache-2.0
#include "certify/shards/shard_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstring>
#include <memory>
#include <system_error>
#include <utility>

#include <noli/errors.h>
#include "proofs/prover/tokens/proof_file.h"
#include "trajectory/blocks/block_sink.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

constexpr FourLetters content = four_letters("SHRD");
constexpr FourLetters task_kind = four_letters("TASK");

/// A file that vanishes unless it gets its name.
class PartOf {
 public:
  explicit PartOf(const fs::path& file) : file_(file), part_(file.string() + fmt::format(".{}.part", ::getpid())) {
    fs::remove(part_);
  }
  ~PartOf() {
    std::error_code error;
    fs::remove(part_, error);
  }
  PartOf(const PartOf&) = delete;
  PartOf& operator=(const PartOf&) = delete;

  const fs::path& path() const { return part_; }
  void give_name() const {
    fs::rename(part_, file_);
    sync_folder(file_.parent_path());
  }

 private:
  fs::path file_, part_;
};

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

std::uint64_t groups_of_steps(const std::optional<fs::path>& proof) {
  if (!proof) return 0;
  return BlockReader(*proof, ProofFile::content).look_at_commits().count - 1;
}

}  // namespace

void write_shard(const fs::path& file, Json head, const std::optional<fs::path>& proof) {
  const PartOf part(file);
  head["groups"] = groups_of_steps(proof);
  {
    BlockWriter writer(std::make_unique<FileSink>(part.path(), FileSink::Open::create), content);
    writer.append(task_kind, head.dump());
    writer.commit();
    if (proof) copy_steps(*proof, writer);
  }
  part.give_name();
}

ShardReader::ShardReader(const fs::path& file, const std::string& request_hash, std::uint64_t task)
    : reader_(file, content) {
  const std::uint64_t groups = BlockReader(file, content).look_at_commits().count;
  const auto block = reader_.next();
  if (block && block->kind == task_kind) head_ = Json::parse(block->payload, nullptr, false);
  if (!head_.is_object() || head_.value("format", "") != "noli shard" || head_.value("version", 0) != 1) {
    throw InputError(file.string(), "", "is no shard; expected a file that `noli verify --shard` wrote");
  }
  if (head_.value("request", "") != request_hash) {
    throw InputError(file.string(), "", "is a shard of another request than request.json beside it");
  }
  if (head_.value("task", ~std::uint64_t{0}) != task) {
    throw InputError(file.string(), "", fmt::format("is the shard of another task than {}", task + 1));
  }
  reader_.next();  // its commit
  next_ = reader_.next();
  if (head_.value("groups", std::uint64_t{0}) + 1 != groups || reader_.committed().groups == 0) {
    throw InputError(file.string(), "", "is cut off; remove it, and do its task again");
  }
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
    for (; next_ && next_->kind != block_format::commit; next_ = reader_.next()) {
      if (*number == step) take(next_->kind, next_->payload);
    }
    next_ = reader_.next();
  }
}

}  // namespace noli
