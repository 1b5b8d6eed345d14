// SPDX-License-Identifier: Apache-2.0
//
// Fuzzing of the predicates: adversarial queries (audit/fuzz/queries/query_generators.h), each decided by the kernel
// and by the slow oracle (oracle): contact, nearness, and the failure time of a certificate
// (audit/fuzz/queries/probe.h). A difference is shrunk and saved as a file that `noli ccd` reads and `noli fuzz queries
// --replay` asks again.
//
// Notation
//   block    queries of one generator (audit/fuzz/fuzzing.h). Block b is of generator b mod (number of generators).
//            What else each of them is asked comes from another stream of the same seed and block
//   answer   apart, touching, crossing or persistent: the oracle's
//   finding  a query on which the subject's answer is wrong: it is in contact or not, the kind, the least time rounded
//            down to double, the enclosure of that time; within eta or not, and the least such time rounded down; the
//            failure time, rounded down; or an answer of the oracle that the generator does not declare
//
// What this does not do: it does not look for crashes of the subject (libFuzzer targets do), nor time it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <noli/contact.h>
#include <noli/time_of_impact.h>
#include "audit/fuzz/fuzzing.h"
#include "audit/fuzz/queries/probe.h"
#include "audit/fuzz/queries/query_corpus.h"
#include "certify/queries/any_query.h"

namespace noli::audit {

/// One query of so many in a block is asked for a distance too: the oracle takes a millisecond for that.
constexpr std::size_t queries_per_distance = 32;

/// What the code under test says of a query.
struct Decision {
  std::optional<TimeEnclosure> contact;   ///< as noli::contact
  ContactKind kind = ContactKind::apart;  ///< as noli::first_contact; apart when that finds no contact
  double lower = 0;                       ///< the first time rounded down to double; meaningless when apart
};

/// The code under test. Called from several threads at once; `stages` counts as in noli::contact.
using Decide = std::function<Decision(const AnyQuery&, StageCounters& stages)>;

/// noli::contact and noli::first_contact.
Decision decide_with_kernel(const AnyQuery& query, StageCounters& stages);

/// What it says of a probe.
struct ProbeDecision {
  bool within = false;             ///< as noli::within_distance
  std::optional<double> within_t;  ///< as noli::first_within, rounded down to double
  double failure = 0;              ///< as noli::failure_time
};

/// The same for probes.
using DecideProbe = std::function<ProbeDecision(const AnyQuery&, const Probe&)>;

/// noli::within_distance, noli::first_within and noli::failure_time.
ProbeDecision probe_with_kernel(const AnyQuery& query, const Probe& probe);

/// Queries of a block.
constexpr std::uint64_t queries_per_block = 256;

/// Options of fuzzers of queries. The corpus is one of queries (audit/fuzz/queries/query_corpus.h).
struct QueryFuzzSettings : FuzzSettings {
  std::function<std::string(const std::filesystem::path& file)> command;  ///< that asks a saved finding again
};

struct QueryFuzzOptions : QueryFuzzSettings {
  Decide decide = decide_with_kernel;
  DecideProbe decide_probe = probe_with_kernel;
};

/// One query on which the subject is wrong.
struct Finding : FuzzFinding {
  AnyQuery query;                          ///< as generated
  AnyQuery shrunk;                         ///< simpler, and still a finding; saved labelled with the truth
  Probe probe;                             ///< what else it was asked; shrunk along if that is what went wrong
  ContactKind truth = ContactKind::apart;  ///< the oracle's answer to `shrunk`
};

/// Answers of one generator.
struct GeneratorTally {
  std::string name;
  QueryType type{};
  std::array<bool, 4> declared{};          ///< indexed by ContactKind
  std::array<std::uint64_t, 4> answers{};  ///< how often the oracle gave each

  std::uint64_t total() const;
};

/// Answers of the oracle to probes.
struct ProbeTally {
  std::uint64_t apart = 0, within = 0;                       ///< of queries: eta
  std::uint64_t failed = 0, failing = 0, never_failing = 0;  ///< of certificates: at `from`, later, never

  ProbeTally& operator+=(const ProbeTally& other);
  friend bool operator==(const ProbeTally&, const ProbeTally&) = default;
};

/// Items are queries, those of the corpus included.
struct QueryFuzzReport : FuzzTotals {
  std::array<std::uint64_t, 4> answers{};  ///< of the oracle, indexed by ContactKind
  ProbeTally probes;                       ///< one certificate per query, some distances
  std::vector<GeneratorTally> generators;  ///< in the order of query_generators()
  StageCounters stages;                    ///< of noli::contact, as counted by options.decide
  std::vector<Finding> findings;           ///< the first max_findings: of the corpus, then by block and index
  CorpusTally corpus;
};

/// Runs until count, time limit or stop flag; at least one of the three must be given, else std::invalid_argument.
/// With `count` the report is the same for any number of threads. What cannot be saved is in `not_saved`. Throws
/// InputError when the corpus cannot be read.
QueryFuzzReport fuzz_queries(const QueryFuzzOptions& options);

/// What is wrong with the subject's answers to a saved query, one line each; nothing if they are the oracle's.
std::vector<std::string> replay(const AnyQuery& query, const std::optional<Probe>& probe,
                                const Decide& decide = decide_with_kernel,
                                const DecideProbe& decide_probe = probe_with_kernel);

/// The same query made simpler, or nothing if there is nothing wrong; generator, block and file are left empty.
std::optional<Finding> shrunk_finding(const AnyQuery& query, const std::optional<Probe>& probe,
                                      const Decide& decide = decide_with_kernel,
                                      const DecideProbe& decide_probe = probe_with_kernel);

}  // namespace noli::audit
