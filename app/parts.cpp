// SPDX-License-Identifier: Apache-2.0
#include "app/parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <system_error>
#include <vector>

#include "certify/process/this_program.h"
#include "certify/proofs/checker.h"
#include "report/figures/png.h"
#include "report/page/report_page.h"

namespace noli::app {
namespace {

bool is_beside_this(const char* program) {
  std::error_code error;
  return std::filesystem::exists(beside_this_program(program), error);
}

}  // namespace

std::string parts_text() {
  std::vector<const char*> without;
  if (!has_checker(Checker::plain)) without.push_back("proof checker");
  if (!has_checker(Checker::verified)) without.push_back("verified checker");
  if (!report::has_report_page()) without.push_back("reports");
  if (!report::can_write_png()) without.push_back("pictures");
  if (!is_beside_this("noli_series")) without.push_back("series.h5");
  if (!is_beside_this("noli_mpi.so") && !is_beside_this(NOLI_MPI_FOLDER "/noli_mpi.so")) without.push_back("MPI");
  if (!has_audits()) without.push_back("fuzz and audit");
  return without.empty() ? "with all parts\n" : fmt::format("without {}\n", fmt::join(without, ", "));
}

}  // namespace noli::app
