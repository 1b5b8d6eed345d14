// SPDX-License-Identifier: Apache-2.0
#include <noli/version.h>

#include <CGAL/version.h>
#include <fmt/format.h>
#include <gmp.h>
#include <mpfr.h>

#include <boost/version.hpp>

#include "kernel/arithmetic/rounding.h"

namespace noli {

std::string version_text() {
  const RoundingReport& report = rounding_self_test();
  const std::string rounding = report ? "passed" : fmt::format("FAILED: {}", report.text());
  return fmt::format("noli {}\ncommit {}\nGMP {}\nMPFR {}\nCGAL {}\nBoost {}.{}.{}\nrounding self-test {}\n",
                     NOLI_VERSION, NOLI_COMMIT, gmp_version, mpfr_get_version(), CGAL_STR(CGAL_VERSION),
                     BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100, rounding);
}

std::string version_number() { return NOLI_VERSION; }

std::string version_commit() { return NOLI_COMMIT; }

}  // namespace noli
