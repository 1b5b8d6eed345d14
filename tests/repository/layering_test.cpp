// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "layers.h"
#include "workspace.h"

namespace noli::repository {
namespace {

namespace fs = std::filesystem;

TEST(Layering, TheProjectKeepsTheTable) {
  const auto violations = layering_violations(NOLI_SOURCE_DIR);
  EXPECT_TRUE(violations.empty()) << lines(violations);
}

TEST(Layering, TheScanSeesTheProject) {
  const fs::path verifier = fs::path("proofs") / "prover" / "verifier.h";
  const auto found = includes(read_text(fs::path(NOLI_SOURCE_DIR) / verifier));
  int kernel = 0;
  int trajectory = 0;
  for (const Include& include : found) {
    const auto layer = included_layer(NOLI_SOURCE_DIR, verifier, include.target);
    kernel += layer == "kernel" ? 1 : 0;
    trajectory += layer == "trajectory" ? 1 : 0;
  }
  EXPECT_GE(kernel, 1);
  EXPECT_GE(trajectory, 1);
}

struct Planted {
  const char* name;
  const char* file;
  const char* line;
  bool violation;
};

void PrintTo(const Planted& planted, std::ostream* out) { *out << planted.name; }

class PlantedInclude : public testing::TestWithParam<Planted> {};

TEST_P(PlantedInclude, IsJudged) {
  const TemporaryFolder root;
  for (const char* header : {"kernel/k.h", "trajectory/t.h", "certificates/c.h", "integrator/i.h", "proofs/prover/p.h",
                             "proofs/checker/c.h", "audit/a.h", "app/a.h", "certify/c.h", "report/r.h", "oracle/o.h",
                             "tests/app/t.h", "bench/b.h", "include/noli/n.h", "include/noli/mesh.h"}) {
    write_file(root.path() / header, "#pragma once\n");
  }
  write_file(root.path() / GetParam().file, std::string("#pragma once\n") + GetParam().line + "\n");
  const auto violations = layering_violations(root.path());
  EXPECT_EQ(violations.size(), GetParam().violation ? 1U : 0U) << lines(violations);
  if (!violations.empty()) {
    EXPECT_TRUE(violations.front().starts_with(std::string(GetParam().file) + ":2: ")) << violations.front();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Layering, PlantedInclude,
    testing::Values(Planted{"KernelKnowsNoTrajectory", "kernel/x.h", "#include \"trajectory/t.h\"", true},
                    Planted{"KernelKnowsItself", "kernel/x.h", "#include \"kernel/k.h\"", false},
                    Planted{"KernelKnowsTheWorld", "kernel/x.h", "#include <vector>", false},
                    Planted{"KernelByARelativePath", "kernel/x.h", "#include \"../trajectory/t.h\"", true},
                    Planted{"KernelKnowsNoTrajectoryAsInstalled", "kernel/x.h", "#include <noli/trajectory/t.h>", true},
                    Planted{"KernelInBrackets", "kernel/x.h", "#  include <trajectory/t.h>", true},
                    Planted{"KernelByADetour", "kernel/x.h", "#include \"kernel/../trajectory/t.h\"", true},
                    Planted{"KernelByAMacro", "kernel/x.h", "#include HEADER", true},
                    Planted{"KernelKnowsNoOracle", "kernel/x.cpp", "#include \"oracle/o.h\"", true},
                    Planted{"TrajectoryKnowsNoKernel", "trajectory/x.h", "#include \"kernel/k.h\"", true},
                    Planted{"CertificatesKnowTheKernel", "certificates/x.h", "#include \"kernel/k.h\"", false},
                    Planted{"CertificatesKnowNoIntegrator", "certificates/x.h", "#include \"integrator/i.h\"", true},
                    Planted{"IntegratorKnowsCertificates", "integrator/x.h", "#include \"certificates/c.h\"", false},
                    Planted{"IntegratorKnowsNoProofs", "integrator/x.h", "#include \"proofs/prover/p.h\"", true},
                    Planted{"ProverKnowsTheKernel", "proofs/prover/x.h", "#include \"kernel/k.h\"", false},
                    Planted{"ProverKnowsNoIntegrator", "proofs/prover/x.h", "#include \"integrator/i.h\"", true},
                    Planted{"ProverKnowsNoCertificates", "proofs/prover/x.h", "#include \"certificates/c.h\"", true},
                    Planted{"CheckerKnowsItself", "proofs/checker/x.h", "#include \"c.h\"", false},
                    Planted{"CheckerKnowsNoKernel", "proofs/checker/x.h", "#include \"kernel/k.h\"", true},
                    Planted{"CheckerKnowsNoProver", "proofs/checker/x.h", "#include \"../prover/p.h\"", true},
                    Planted{"CertifyKnowsBothWings", "certify/x.h", "#include \"integrator/i.h\"", false},
                    Planted{"CertifyKnowsTheProver", "certify/runs/x.h", "#include \"proofs/prover/p.h\"", false},
                    Planted{"CertifyKnowsNoChecker", "certify/x.h", "#include \"proofs/checker/c.h\"", true},
                    Planted{"CertifyKnowsNoReport", "certify/x.h", "#include \"report/r.h\"", true},
                    Planted{"CertifyKnowsNoApp", "certify/x.h", "#include \"app/a.h\"", true},
                    Planted{"CertifyKnowsNoAudit", "certify/x.h", "#include \"audit/a.h\"", true},
                    Planted{"ReportKnowsCertify", "report/x.h", "#include \"certify/c.h\"", false},
                    Planted{"ReportKnowsNoAudit", "report/figures/x.h", "#include \"audit/a.h\"", true},
                    Planted{"IntegratorKnowsNoCertify", "integrator/x.h", "#include \"certify/c.h\"", true},
                    Planted{"AuditKnowsReport", "audit/fuzz/x.h", "#include \"report/r.h\"", false},
                    Planted{"AuditKnowsTheOracle", "audit/x.h", "#include \"oracle/o.h\"", false},
                    Planted{"AuditKnowsNoApp", "audit/x.h", "#include \"app/a.h\"", true},
                    Planted{"AuditKnowsNoOtherTests", "audit/x.h", "#include \"tests/app/t.h\"", true},
                    Planted{"AuditKnowsWhatPlugInsKnow", "audit/x.h", "#include <noli/n.h>", false},
                    Planted{"WhatPlugInsKnowIsNotInTheKernel", "kernel/x.h", "#include <noli/n.h>", true},
                    Planted{"WhatPlugInsKnowKnowsNobody", "include/noli/x.h", "#include <noli/kernel/k.h>", true},
                    Planted{"OracleKnowsNoKernel", "oracle/x.h", "#include \"kernel/k.h\"", true},
                    Planted{"AppKnowsAudit", "app/x.h", "#include \"audit/a.h\"", false},
                    Planted{"AppKnowsNoBench", "app/x.h", "#include \"bench/b.h\"", true},
                    Planted{"BenchKnowsAudit", "bench/x.h", "#include \"audit/a.h\"", false},
                    Planted{"AuditKnowsNoBench", "audit/x.h", "#include \"bench/b.h\"", true},
                    Planted{"TrajectoryKnowsItsPublicHeaders", "trajectory/x.h", "#include <noli/mesh.h>", false},
                    Planted{"KernelKnowsNoPublicHeadersOfOthers", "kernel/x.h", "#include <noli/mesh.h>", true},
                    Planted{"PublicHeadersKnowEachOther", "include/noli/x.h", "#include <noli/mesh.h>", false},
                    Planted{"PublicHeadersKnowNothingInside", "include/noli/x.h", "#include \"kernel/k.h\"", true},
                    Planted{"ExamplesKnowWhatIsInstalled", "examples/x.cpp", "#include <noli/mesh.h>", false},
                    Planted{"ExamplesKnowNothingElse", "examples/x.cpp", "#include <noli/kernel/k.h>", true},
                    Planted{"ExamplesKnowNoAudit", "examples/x.cpp", "#include <noli/audit/a.h>", true},
                    Planted{"TestsKnowAll", "tests/app/x.h", "#include \"app/a.h\"", false}),
    [](const auto& planted) { return std::string(planted.param.name); });

}  // namespace
}  // namespace noli::repository
