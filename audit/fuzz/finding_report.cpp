// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/finding_report.h"

#include <fmt/format.h>

#include <noli/errors.h>

namespace noli::audit {

std::string finding_line(const FuzzFinding& finding, const char* item, const std::string& more) {
  return fmt::format("finding: {}, block {}, {} {}: {}; {}\n", finding.generator, finding.block, item, finding.index,
                     on_one_line(more + finding.difference),
                     finding.place.empty() ? "not saved" : "saved as " + on_one_line(finding.place.string()));
}

Json finding_json(const FuzzFinding& finding, const char* place) {
  return {{"generator", finding.generator},
          {"block", finding.block},
          {"index", finding.index},
          {"difference", finding.difference},
          {place, finding.place.string()}};
}

}  // namespace noli::audit
