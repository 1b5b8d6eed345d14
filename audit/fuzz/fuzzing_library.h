// SPDX-License-Identifier: Apache-2.0
//
// The harness of a fuzzer that tests somebody else's library. Findings are saved as they are, and made smaller at the
// end of the run.
#pragma once

#include <algorithm>
#include <chrono>
#include <utility>

#include "audit/ccd/library_answers.h"
#include "audit/fuzz/fuzzing.h"

namespace noli::audit {

/// `Options` have `asked`, the library, and `first_only`; `Report` has `knows_times`. The subject needs, beside what
/// Fuzzing asks for,
///   shrink_findings()    makes those of the report smaller
template <class Subject, class Options, class Report, class Item, class Corpus = ShapeCorpus>
class FuzzingLibrary : public Fuzzing<Subject, Options, Report, Item, Corpus> {
  using Base = Fuzzing<Subject, Options, Report, Item, Corpus>;

 public:
  /// Throws what the constructor of Fuzzing throws.
  explicit FuzzingLibrary(const Options& options) : Base(options), asked_(options.asked) {}

  /// Call it once. Throws InputError for a library that cannot be used, and what Fuzzing throws.
  Report run() {
    require_ccd_library(asked_.path, asked_.host);
    if (const auto& limit = options_.limits.time_limit) {
      using Clock = std::chrono::steady_clock;
      asked_.host.deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(*limit);
    }
    report_.knows_times = knows_times(options_.asked);
    report_ = Base::run();
    static_cast<Subject&>(*this).shrink_findings();
    report_.interrupted |= this->stopped();  // while they were shrunk
    return std::move(report_);
  }

  bool enough() const { return options_.first_only && report_.findings_total > 0; }

 protected:
  using Base::options_, Base::report_;

  LibraryUnderTest asked_;  ///< with the time limit of the run
};

/// The library with the limits for making a finding smaller. A query that may hang gets only a part of its time limit;
/// otherwise this could take hours.
inline LibraryUnderTest asked_while_shrinking(LibraryUnderTest library, bool may_hang) {
  constexpr std::chrono::nanoseconds least = std::chrono::milliseconds(20);
  HostOptions& host = library.host;
  host.most_hangs = 1;
  if (may_hang) host.query_limit = std::min(host.query_limit, std::max(host.query_limit / 50, least));
  host.deadline.reset();
  return library;
}

}  // namespace noli::audit
