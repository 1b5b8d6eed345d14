// SPDX-License-Identifier: Apache-2.0
//
// The memory that `noli audit` shares with the program that runs a library for it (host/main.cpp): what is to be asked,
// the answers, and how far it has come, which is all there still when the program has crashed. Exchange, for queries: a
// header, then `count` queries, then `count` answers. PipelineExchange, for a step of a whole mesh: a header, then
// positions, edges and faces; behind them, in memory that the host adds, an answer for each candidate.
//
// What is right is in neither: a library may read and write all of it.
//
// What this does not do: protect itself. A library that writes all over its memory spoils its own answers; who waits
// for them believes no number here that it has to count or to find its way by.
#pragma once

#include <noli/ccd_plugin.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace noli::audit {

enum class HostPhase : std::uint32_t { loading, answering, repeating, searching, done };

enum class LoadResult : std::uint32_t { ok, not_loaded, no_version, other_version, no_query, no_candidates };

/// How far it has come.
struct HostStatus {
  std::atomic<HostPhase> phase = HostPhase::loading;
  std::atomic<std::uint64_t> calls = 0;  ///< of noli_ccd_query, the one under way included
  std::atomic<std::uint64_t> at = 0;     ///< the query that is asked
  LoadResult loaded = LoadResult::ok;
  std::uint32_t version = 0;
  std::array<char, 1024> message{};
  std::array<char, 101> description{};  ///< what the library says that it is; empty if it says nothing
};

static_assert(std::atomic<std::uint64_t>::is_always_lock_free && std::atomic<HostPhase>::is_always_lock_free,
              "two processes share it");

constexpr std::size_t after(std::size_t bytes) { return (bytes + 63) / 64 * 64; }

// --- queries ---------------------------------------------------------------------------------------------------------

/// Coordinates as noli_ccd_query has them.
struct AskedQuery {
  std::array<double, 12> x_t0, x_t1;
};

/// A query of three dimensions: x_t0 and x_t1 are four points each.
template <class Query>
AskedQuery asked(const Query& query) {
  AskedQuery result{};
  for (std::size_t i = 0; i < 12; ++i) {
    result.x_t0[i] = query.x_t0[i / 3][i % 3];
    result.x_t1[i] = query.x_t1[i / 3][i % 3];
  }
  return result;
}

enum class AnswerState : std::uint32_t {
  not_asked,
  answered,
  crashed,  ///< set by who waits for the host, as are those below
  hung,
  too_much_memory
};

struct GivenAnswer {
  AnswerState state = AnswerState::not_asked;
  std::int32_t code = 0;        ///< what noli_ccd_query returned
  double time = 0;              ///< of impact
  double ns = 0;                ///< how long it took, once
  std::uint32_t changed = 0;    ///< asked again, it gave another answer
  std::uint32_t not_again = 0;  ///< do not ask again: it ended the program
};

constexpr std::size_t most_passes = 64;

/// How much memory was resident at the beginning, in the middle and at the end of the repetitions.
using Resident = std::array<std::uint64_t, 3>;
/// What an allocator takes at a time, or a page here and there, is no leak.
constexpr std::int64_t leak_slack = 256 << 10;

struct Exchange : HostStatus {
  // What the host is asked for.
  std::uint64_t count = 0;
  std::int32_t kind = 0;
  double tolerance = 0;
  std::uint64_t first = 0;        ///< the first query that has no answer yet
  double repeat_seconds = 0;      ///< about how long to ask all again; 0: not at all
  std::uint64_t most_growth = 0;  ///< stop asking again when that many bytes have been added

  // What it says.
  std::uint64_t repeated = 0;  ///< calls between the first and the last of `resident`
  Resident resident{};
  std::uint64_t passes = 0;  ///< whole ones
  std::array<double, most_passes> pass_seconds{};
  std::uint64_t pass_calls = 0;  ///< calls of one pass
};

constexpr std::size_t exchange_bytes(std::size_t count) {
  return after(sizeof(Exchange)) + count * (sizeof(AskedQuery) + sizeof(GivenAnswer));
}
inline AskedQuery* queries_of(Exchange& exchange) {
  return reinterpret_cast<AskedQuery*>(reinterpret_cast<char*>(&exchange) + after(sizeof(Exchange)));
}
inline GivenAnswer* answers_of(Exchange& exchange) {
  return reinterpret_cast<GivenAnswer*>(queries_of(exchange) + exchange.count);
}

// --- a step of a mesh ------------------------------------------------------------------------------------------------

/// A candidate, by its numbers as noli_ccd_candidates has them, and what the library answered.
struct PairAnswer {
  double time = 0;  ///< of impact, if it was a hit
  std::uint32_t kind = 0, first = 0, second = 0;
  std::int32_t code = 0;       ///< what noli_ccd_query returned
  std::uint32_t answered = 0;  ///< it returned
  std::uint32_t no_padding = 0;
};

/// The pair of features that something is about.
struct MeshPair {
  std::uint32_t kind = 0, first = 0, second = 0;
  std::uint32_t known = 0;  ///< else there is none
};

struct MeshSizes {
  std::uint64_t vertices = 0, edges = 0, faces = 0;
};

struct PipelineExchange : HostStatus {
  MeshSizes sizes;
  double tolerance = 0;
  std::uint32_t needs_search = 1;  ///< else a library without a search is asked about all pairs
  double repeat_seconds = 0;       ///< about how long to do it all again; 0: not at all

  // What the host says.
  std::uint64_t candidates = 0;  ///< answers that follow, ascending by kind, first, second
  std::int32_t search_code = 0;
  MeshPair asked;  ///< the query under way, or the last one
  double search_seconds = 0, query_seconds = 0;
  Resident resident{};  ///< while it is all done again; 0 if it is not
};

/// Where the arrays are.
struct MeshArrays {
  double *x_t0, *x_t1;
  std::uint32_t *edges, *faces;

  explicit MeshArrays(PipelineExchange& exchange) {
    const MeshSizes& n = exchange.sizes;
    x_t0 = reinterpret_cast<double*>(reinterpret_cast<char*>(&exchange) + after(sizeof(PipelineExchange)));
    x_t1 = x_t0 + 3 * n.vertices;
    edges = reinterpret_cast<std::uint32_t*>(x_t1 + 3 * n.vertices);
    faces = edges + 2 * n.edges;
  }
};

constexpr std::size_t exchange_bytes(const MeshSizes& n) {
  return after(after(sizeof(PipelineExchange)) + n.vertices * 6 * sizeof(double) +
               (2 * n.edges + 3 * n.faces) * sizeof(std::uint32_t));
}

/// Two features that are there and share no vertex. `edges`, `faces`: the vertices of each.
template <class Pair, class Edges, class Faces>
bool is_pair(const Pair& pair, const MeshSizes& n, const Edges& edges, const Faces& faces) {
  const auto shared = [](const auto& a, std::size_t count_a, const auto& b, std::size_t count_b) {
    for (std::size_t i = 0; i < count_a; ++i) {
      for (std::size_t k = 0; k < count_b; ++k) {
        if (a[i] == b[k]) return true;
      }
    }
    return false;
  };
  if (pair.kind == NOLI_CCD_EDGE_EDGE) {
    return pair.first < n.edges && pair.second < n.edges && !shared(edges(pair.first), 2, edges(pair.second), 2);
  }
  const std::array<std::uint32_t, 1> vertex = {pair.first};
  return pair.kind == NOLI_CCD_VERTEX_FACE && pair.first < n.vertices && pair.second < n.faces &&
         !shared(vertex, 1, faces(pair.second), 3);
}

}  // namespace noli::audit
