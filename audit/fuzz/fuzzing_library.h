// SPDX-License-Identifier: Apache-2.0
//
// The harness of a fuzzer whose subject asks somebody else's library: what is found is kept as it is, and made smaller
// when all is done.
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

  /// Once. Throws InputError for a library that is not as it has to be, and what Fuzzing throws.
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

  LibraryUnderTest asked_;  ///< to be asked until the time of the run is over
};

/// The library as it is asked while a finding is made smaller. A query that may hang gets a part of its limit only;
/// otherwise that would take all day.
inline LibraryUnderTest asked_while_shrinking(LibraryUnderTest library, bool may_hang) {
  constexpr std::chrono::nanoseconds least = std::chrono::milliseconds(20);
  HostOptions& host = library.host;
  host.most_hangs = 1;
  if (may_hang) host.query_limit = std::min(host.query_limit, std::max(host.query_limit / 50, least));
  host.deadline.reset();
  return library;
}

}  // namespace noli::audit
