// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/tokens/proof_file.h"

#include <algorithm>

#include "trajectory/blocks/bytes.h"
#include "trajectory/cell_features.h"

namespace noli {

/// The vertices of a cell as the mesh has them.
Sha256Digest cells_hash(const ProofHeader& header) {
  std::string bytes;
  put(bytes, std::uint64_t{header.vertices});
  put(bytes, std::uint64_t{header.mesh->cell_count()});
  for (std::uint32_t c = 0; c < header.mesh->cell_count(); ++c) {
    const auto vertices = corners(*header.mesh, c);
    const auto count = static_cast<std::uint8_t>(corner_count(*header.mesh, c));
    put(bytes, count);
    for (std::uint8_t i = 0; i < count; ++i) put(bytes, vertices[i]);
    put(bytes, header.labels[c]);
  }
  return sha256(bytes);
}

namespace {

std::string claim_payload(const ProofHeader& header) {
  std::string bytes;
  put(bytes, static_cast<std::uint8_t>(header.source));
  put(bytes, static_cast<std::uint8_t>(header.dimension));
  put(bytes, static_cast<std::uint8_t>((header.strict ? 1 : 0) | (header.points ? 2 : 0)));
  put(bytes, std::uint8_t{0});
  put(bytes, header.ring);
  put(bytes, header.eta);
  bytes.append(bytes_of(header.cells ? *header.cells : cells_hash(header)));
  put(bytes, static_cast<std::uint32_t>(header.merged.size()));
  for (const auto& [v, same] : header.merged) {
    put(bytes, v);
    put(bytes, same);
  }
  put(bytes, static_cast<std::uint32_t>(header.excluded.size()));
  for (const auto& [a, b] : header.excluded) {
    put(bytes, a);
    put(bytes, b);
  }
  return bytes;
}

/// Block LABL.
std::string labels_payload(const ProofHeader& header) {
  std::string bytes;
  for (const std::uint32_t label : header.labels) put(bytes, label);
  return bytes;
}

/// The hash of the breakpoints of a step.
Sha256Digest breakpoints_hash(const WorldLines& lines, int dimension, double shift) {
  Sha256 hash;
  std::string bytes;
  for (std::size_t v = 0; v < lines.vertex_count(); ++v) {
    const auto times = lines.times(static_cast<VertexId>(v));
    const auto positions = lines.positions(static_cast<VertexId>(v));
    put(bytes, std::uint64_t{times.size()});
    for (std::size_t i = 0; i < times.size(); ++i) {
      put(bytes, times[i] + shift + 0.0);  // -0 becomes +0
      for (std::size_t k = 0; k < 3; ++k) {
        put(bytes, k < static_cast<std::size_t>(dimension) ? positions[i][k] + 0.0 : 0.0);
      }
    }
    if (bytes.size() < 1 << 16) continue;
    hash.update(bytes);
    bytes.clear();
  }
  hash.update(bytes);
  return hash.digest();
}

std::int32_t unit(const exact::ExponentRange& range) { return range.high < range.low ? 0 : range.low; }

}  // namespace

motion::Scale units_of(const WorldLines& lines, int dimension, double shift, double eta) {
  motion::Scale units;
  units.space.add(eta);
  for (VertexId v = 0; v < lines.vertex_count(); ++v) {
    for (const double t : lines.times(v)) units.time.add(t + shift);
    for (const Position& x : lines.positions(v)) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) units.space.add(x[k]);
    }
  }
  return units;
}

ProofFile::ProofFile(std::unique_ptr<Sink> sink, const ProofHeader& header)
    : blocks_(std::move(sink), content), dimension_(header.dimension), eta_(header.eta) {
  blocks_.append(four_letters("CLAM"), claim_payload(header));
  const bool labelled = std::ranges::any_of(header.labels, [](std::uint32_t label) { return label != 0; });
  if (header.source != ProofSource::run && labelled) blocks_.append(four_letters("LABL"), labels_payload(header));
  blocks_.commit();
}

ProofFile::ProofFile(std::unique_ptr<Sink> sink, const CommitPoint& committed, const ProofHeader& header)
    : blocks_(std::move(sink), committed), dimension_(header.dimension), eta_(header.eta) {}

std::string ProofFile::step_payload(std::uint64_t number, Kind kind, const WorldLines& lines, double shift,
                                    const std::optional<Sha256Digest>& hash) const {
  const motion::Scale units = units_of(lines, dimension_, shift, eta_);
  std::string bytes;
  put(bytes, number);
  put(bytes, lines.first_time() + shift);
  put(bytes, lines.last_time() + shift);
  put(bytes, static_cast<std::uint32_t>(unit(units.space)));
  put(bytes, static_cast<std::uint32_t>(unit(units.time)));
  put(bytes, static_cast<std::uint8_t>(kind));
  bytes.append(bytes_of(hash ? *hash : breakpoints_hash(lines, dimension_, shift)));
  return bytes;
}

ProofFile::Kind ProofFile::kind_of(std::string_view step_payload) {
  constexpr std::size_t place = 3 * sizeof(std::uint64_t) + 2 * sizeof(std::int32_t);
  const bool witness = step_payload.size() > place && step_payload[place] == static_cast<char>(Kind::witness);
  return witness ? Kind::witness : Kind::proof;
}

void ProofFile::begin_step(std::uint64_t number, Kind kind, const WorldLines& lines, double shift,
                           const std::optional<Sha256Digest>& hash) {
  append(step_kind, step_payload(number, kind, lines, shift, hash));
}

bool ProofFile::tokens(const std::function<bool(const std::function<void(std::string_view)>&)>& make) {
  bool whole = false;
  try {
    whole = make([this](std::string_view payload) { tokens(payload); });
  } catch (...) {
    discard();
    throw;
  }
  if (!whole) discard();
  return whole;
}

}  // namespace noli
