// SPDX-License-Identifier: Apache-2.0
#include "certify/proofs/proof_blocks.h"

#include <noli/errors.h>
#include "proofs/prover/tokens/proof_file.h"
#include "trajectory/blocks/bytes.h"

namespace noli {

namespace {

void append_block(std::string& bytes, FourLetters kind, std::string_view payload) {
  put_block(
      kind, payload.size(), [&](const ByteConsumer& take) { take(payload); },
      [&](std::string_view part) { bytes += part; });
}

}  // namespace

ProofGroups parse_proof(std::string bytes, const std::string& name) {
  BlockReader reader(std::move(bytes), name, ProofFile::content);
  ProofGroups groups;
  ProofGroup group;
  while (auto block = reader.next()) {
    if (block->kind != block_format::commit) {
      group.push_back({block->kind, std::move(block->payload)});
      continue;
    }
    groups.push_back(std::move(group));
    group.clear();
  }
  if (reader.open_group() || groups.empty()) throw InputError(name, "", "expected a whole proof");
  return groups;
}

std::string proof_bytes(const ProofGroups& groups, const Spoiled& spoiled) {
  std::string bytes(block_format::magic);
  put(bytes, block_format::version);
  put(bytes, ProofFile::content);
  Sha256Digest running{};
  std::size_t begin = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (const ProofBlock& block : groups[i]) append_block(bytes, block.kind, block.payload);
    const Spoiled::What what = spoiled.group == i ? spoiled.what : Spoiled::What::nothing;
    if (what == Spoiled::What::no_commit) break;
    Sha256Digest group = sha256(std::string_view(bytes).substr(begin));
    if (what == Spoiled::What::group_hash) group[0] ^= 1;
    running = next_running_hash(running, group);
    if (what == Spoiled::What::running_hash) running[0] ^= 1;
    std::string payload;
    put(payload, std::uint64_t{i + (what == Spoiled::What::number ? 1 : 0)});
    payload.append(bytes_of(group));
    payload.append(bytes_of(running));
    append_block(bytes, block_format::commit, payload);
    begin = bytes.size();
  }
  return bytes;
}

std::string uint_bytes(std::uint64_t value) {
  std::string bytes;
  for (; value >= 0x80; value >>= 7) bytes += static_cast<char>((value & 0x7f) | 0x80);
  return bytes + static_cast<char>(value);
}

std::string sint_bytes(std::int64_t value) {
  const auto twice = static_cast<std::uint64_t>(value) << 1;
  return uint_bytes(value < 0 ? ~twice : twice);
}

}  // namespace noli
