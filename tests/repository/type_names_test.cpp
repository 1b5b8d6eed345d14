// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "type_names.h"
#include "workspace.h"

namespace noli::repository {
namespace {

namespace fs = std::filesystem;

TEST(TypeNames, EachIsDefinedOnce) {
  const auto twice = types_defined_twice(NOLI_SOURCE_DIR);
  EXPECT_TRUE(twice.empty()) << lines(twice);
}

TEST(TypeNames, TheScanSeesTheProject) {
  const auto types = [](const char* file) { return defined_types(read_text(fs::path(NOLI_SOURCE_DIR) / file)); };
  EXPECT_TRUE(types("include/noli/verify.h").contains("noli::CellNames"));
  EXPECT_TRUE(types("proofs/prover/cells/moving_cell.h").contains("noli::StepCell"));
  EXPECT_TRUE(types("certificates/features.h").contains("noli::certificates::Features"));
  EXPECT_TRUE(types("kernel/contact_condition.h").contains("noli::condition::AsPolynomials"));
  EXPECT_TRUE(types("proofs/checker/trajectory.h").contains("noli::checker::Claim"));
}

TEST(TypeNames, PlantedDuplicatesAreFound) {
  const TemporaryFolder root;
  write_file(root.path() / "kernel/a.h", "namespace noli {\nstruct Twice {\n  int x;\n};\nclass Once {};\n}\n");
  write_file(root.path() / "app/b.h", "namespace noli {\nusing Twice = int;\nclass Once;\n}\n");
  write_file(root.path() / "app/c.h", "namespace noli::app {\nenum class Twice { yes };\n}\n");
  write_file(root.path() / "tests/d.h", "namespace noli {\nclass Once {};\n}\n");
  const std::vector<std::string> expected = {"noli::Twice: app/b.h, kernel/a.h"};
  EXPECT_EQ(types_defined_twice(root.path()), expected);
}

TEST(TypeNames, EveryKindOfTypeIsFound) {
  const std::set<std::string> expected = {"A",    "B",    "n::C",    "n::m::D", "n::m::E", "n::m::F", "n::m::G",
                                          "n::H", "n::I", "n::J::K", "n::L",    "n::M",    "n::N"};
  EXPECT_EQ(defined_types("struct A {};\n"
                          "extern \"C\" { typedef struct { int x; } B; }\n"
                          "namespace n { class C final : public A {};\n"
                          "namespace m { enum class D : unsigned char { x }; enum E { y }; union F {};\n"
                          "inline int f() { return 1; } template <class T = A<int>> struct alignas(8) G : A {}; }\n"
                          "using H = int; template <class T> using I = A<T>; struct J::K {};\n"
                          "constexpr int x[] = {1, 2}; constexpr int y{3}; struct [[nodiscard]] L {};\n"
                          "inline namespace { struct M {}; } typedef int N; }\n"),
            expected);
}

TEST(TypeNames, WhatDefinesNoTypeIsIgnored) {
  EXPECT_EQ(defined_types("class A;\nenum B : int;\n"
                          "// struct C {};\n/* struct D {}; */\n#define E struct E {};\\\n  struct F {};\n"
                          "constexpr auto g = R\"x(struct G {};)\" struct G {};)x\", h = \"struct H {};\";\n"
                          "constexpr char c = '{'; constexpr int million = 1'000'000;\n"
                          "template <> struct std::hash<A> { struct I {}; };\n"
                          "struct J f(struct K) { struct L {}; using M = int; }\n"
                          "template <class T> struct N<T*> {};\nusing O::p;\nusing namespace q;\n"
                          "namespace r = s;\nextern template class T<int>;\n"),
            std::set<std::string>());
}

}  // namespace
}  // namespace noli::repository
