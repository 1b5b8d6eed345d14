// SPDX-License-Identifier: Apache-2.0
#include "licences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "kernel/parallel.h"
#include "layers.h"
#include "workspace.h"

namespace noli::repository {
namespace {

namespace fs = std::filesystem;

/// The layers with code in the libraries or in the command.
const std::set<std::string> shipped = {"kernel",         "trajectory", "certificates", "integrator", "proofs",
                                       "proofs/checker", "certify",    "report",       "audit",      "app",
                                       "oracle",         "include",    "python"};

fs::path in_project(const fs::path& file) { return file.lexically_relative(NOLI_SOURCE_DIR); }

bool is_shipped(const fs::path& file) {
  const fs::path inside = in_project(file);
  return *inside.begin() != ".." && shipped.contains(layer_of(inside));
}

std::vector<CompileCommand> shipped_commands() {
  std::vector<CompileCommand> commands = compile_commands(NOLI_BINARY_DIR);
  std::erase_if(commands, [](const CompileCommand& command) { return !is_shipped(command.file); });
  return commands;
}

CompileCommand kernel_command() {
  for (const CompileCommand& command : shipped_commands()) {
    if (in_project(command.file) == fs::path("kernel") / "parallel.cpp") return command;
  }
  throw std::runtime_error("the build does not compile kernel/parallel.cpp");
}

/// A source that includes every header of a layer, so that headers that none of our sources includes are judged too.
/// Headers of noli_series are left out: they need HDF5's, and its own sources include them all.
std::string all_headers(const std::string& layer) {
  std::string text;
  for (const fs::path& file : files_below(NOLI_SOURCE_DIR)) {
    const bool of_series = in_project(file).parent_path() == fs::path("certify") / "series";
    if (file.extension() == ".h" && layer_of(in_project(file)) == layer && !of_series)
      text += "#include \"" + file.string() + "\"\n";
  }
  return text;
}

struct Input {
  CompileCommand command;
  fs::path file;
};

std::vector<Input> shipped_inputs(const fs::path& scratch) {
  std::vector<Input> inputs;
  std::set<std::string> layers;
  for (const CompileCommand& command : shipped_commands()) {
    inputs.push_back({command, command.file});
    const std::string layer = layer_of(in_project(command.file));
    if (!layers.insert(layer).second) continue;
    std::string name = layer + "_headers.cpp";
    std::replace(name.begin(), name.end(), '/', '_');
    write_file(scratch / name, all_headers(layer));
    inputs.push_back({command, scratch / name});
  }
  return inputs;
}

std::vector<fs::path> files_read_for_what_ships() {
  const TemporaryFolder scratch;
  const std::vector<Input> inputs = shipped_inputs(scratch.path());
  std::vector<std::vector<fs::path>> read(inputs.size());
  parallel_for(inputs.size(), 0, [&](std::size_t i) { read[i] = files_read(inputs[i].command, inputs[i].file); });
  std::set<fs::path> all;
  for (const auto& files : read) all.insert(files.begin(), files.end());
  std::erase_if(all, [&](const fs::path& file) { return file.parent_path() == fs::canonical(scratch.path()); });
  return {all.begin(), all.end()};
}

bool reads(const std::vector<fs::path>& files, const std::string& part) {
  return std::any_of(files.begin(), files.end(),
                     [&](const fs::path& f) { return f.string().find(part) != std::string::npos; });
}

TEST(LicencesSlow, WhatShipsStandsOnNothingStricterThanLgpl) {
  const std::vector<fs::path> files = files_read_for_what_ships();
  EXPECT_TRUE(reads(files, "/include/CGAL/")) << "the scan no longer sees what the kernel stands on";
  EXPECT_TRUE(reads(files, "gmp"));
  const auto violations = licence_violations(files);
  EXPECT_TRUE(violations.empty()) << lines(violations);
}

/// Compiles one line with the kernel's flags and judges every file that the compiler reads.
std::vector<std::string> violations_of(const std::string& line) {
  const TemporaryFolder scratch;
  write_file(scratch.path() / "planted.cpp", line + "\n");
  return licence_violations(files_read(kernel_command(), scratch.path() / "planted.cpp"));
}

TEST(Licences, APlantedGplPackageOfCgalIsFound) {
  const auto violations = violations_of("#include <CGAL/Triangulation_2.h>");
  EXPECT_NE(lines(violations).find("/CGAL/Triangulation_2.h is licensed GPL-3.0-or-later"), std::string::npos)
      << lines(violations);
  EXPECT_NE(lines(violations).find("/CGAL/license/"), std::string::npos);
}

TEST(Licences, AnLgplPackageOfCgalIsNot) { EXPECT_EQ(lines(violations_of("#include <CGAL/Interval_nt.h>")), ""); }

TEST(Licences, APlantedMprealIsFound) {
  const TemporaryFolder scratch;
  write_file(scratch.path() / "mpreal.h", "// a wrapper\n");
  const auto violations = violations_of("#include \"" + (scratch.path() / "mpreal.h").string() + "\"");
  EXPECT_EQ(violations.size(), 1U) << lines(violations);
}

TEST(Licences, ACompilerThatFailsIsNoticed) {
  EXPECT_THROW(violations_of("#include \"no_such_header.h\""), std::runtime_error);
}

struct Header {
  const char* name;
  const char* path;
  const char* text;
  bool objectionable;
};

void PrintTo(const Header& header, std::ostream* out) { *out << header.name; }

class StatedLicence : public testing::TestWithParam<Header> {};

TEST_P(StatedLicence, IsJudged) {
  EXPECT_EQ(!objection(GetParam().path, GetParam().text).empty(), GetParam().objectionable)
      << objection(GetParam().path, GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(
    Licences, StatedLicence,
    testing::Values(
        Header{"CgalLgpl", "/i/include/CGAL/a.h",
               "// SPDX-License-Identifier: LGPL-3.0-or-later OR LicenseRef-Commercial\n", false},
        Header{"CgalGpl", "/i/include/CGAL/a.h",
               "// SPDX-License-Identifier: GPL-3.0-or-later OR LicenseRef-Commercial\n", true},
        Header{"CgalGplAndMit", "/i/include/CGAL/a.h",
               "// SPDX-License-Identifier: ( GPL-3.0-or-later OR LicenseRef-Commercial ) AND MIT\n", true},
        Header{"CgalBoost", "/i/include/CGAL/a.h", "// SPDX-License-Identifier: BSL-1.0\n", false},
        Header{"CgalSilent", "/i/include/CGAL/a.h", "// no word\n", true},
        Header{"CgalMarkOfLgpl", "/i/include/CGAL/license/lgpl.h", "// SPDX-License-Identifier: LGPL-3.0-or-later\n",
               false},
        Header{"CgalMarkOfGpl", "/i/include/CGAL/license/a.h", "// SPDX-License-Identifier: LGPL-3.0-or-later\n", true},
        Header{"TwoLinesOneGpl", "/i/a.h",
               "// SPDX-License-Identifier: MIT\n// SPDX-License-Identifier: GPL-2.0-only\n", true},
        Header{"GplWithException", "/i/a.h", "/* SPDX-License-Identifier: GPL-2.0 WITH Linux-syscall-note */\n", false},
        Header{"GplOrMit", "/i/a.h", "// SPDX-License-Identifier: GPL-2.0-only OR MIT\n", false},
        Header{"Agpl", "/i/a.h", "// SPDX-License-Identifier: AGPL-3.0-only\n", true},
        Header{"GplInWords", "/i/a.h", "/* under the terms of the GNU\n * General Public License */", true},
        Header{"LgplInWords", "/i/a.h",
               "/* GNU Lesser\n * General Public License, or the GNU General Public License */", false},
        Header{"RuntimeException", "/i/a.h", "// GNU General Public License ... GCC Runtime Library\n// Exception",
               false},
        Header{"EigenOther", "/i/Eigen/src/Core/util/NonMPL2.h", "", true},
        Header{"EigenMpl", "/i/Eigen/Core",
               "// This Source Code Form is subject to the terms of the Mozilla Public License", false},
        Header{"Silent", "/i/a.h", "int f();", false}),
    [](const auto& header) { return std::string(header.param.name); });

TEST(Licences, TheCommandNeedsTheStatedLibrariesOnly) {
  const auto [exit_code, output] = run("readelf -d " + quoted(NOLI_COMMAND));
  ASSERT_EQ(exit_code, 0);
  ASSERT_NE(output.find("(NEEDED)"), std::string::npos);
  EXPECT_EQ(lines(unexpected_libraries(output)), "");
  // See kernel/parallel.cpp: it is loaded with the program, not by TBB.
  EXPECT_EQ(output.find("[libtbb.so") == std::string::npos, output.find("[libtbbmalloc.so") == std::string::npos);
}

/// The libraries that the program needs, directly or indirectly.
std::string ldd(const std::string& program) {
  const auto [exit_code, output] = run("ldd " + quoted(program));
  EXPECT_EQ(exit_code, 0) << program;
  EXPECT_NE(output.find("libgmp"), std::string::npos) << output;
  return output;
}

TEST(Licences, NeitherHdf5NorWhatItsPackageBringsIsInTheCommand) {
  EXPECT_EQ(lines(network_libraries(ldd(NOLI_COMMAND))), "");
}

TEST(Licences, APlantedNetworkIsFound) {
  const auto found = network_libraries(
      "\tlibgmp.so.10 => /lib/libgmp.so.10 (0x1)\n\tlibcurl-gnutls.so.4 => /lib/x (0x2)\n\tlibc.so.6 => /lib/c "
      "(0x3)\n\tlibcrypto.so.3 => /lib/y (0x4)\n\tlibssl.so.3 => /lib/z (0x5)\n");
  EXPECT_EQ(lines(found), "libcurl-gnutls.so.4\nlibssl.so.3\n");
}

#ifdef NOLI_SERIES
TEST(Licences, Hdf5IsInTheProgramForSeries) {
  const auto [exit_code, output] = run("readelf -d " + quoted(NOLI_SERIES));
  ASSERT_EQ(exit_code, 0);
  EXPECT_NE(output.find("libhdf5"), std::string::npos);
}
#endif

/// A static library that refers to HDF5 would force it on every program that links it.
TEST(Licences, NoLibraryOfOursRefersToHdf5) {
  int seen = 0;
  for (const char* const library : {"kernel/libnoli_kernel.a", "trajectory/libnoli_trajectory.a",
                                    "certify/libnoli_certify.a", "report/libnoli_report.a", "audit/libnoli_audit.a"}) {
    const auto [exit_code, output] =
        run("nm -C --undefined-only " + quoted((fs::path(NOLI_BINARY_DIR) / library).string()));
    EXPECT_EQ(exit_code, 0) << library;
    EXPECT_EQ(output.find(" H5"), std::string::npos) << library;
    seen += output.find(" U ") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(seen, 5);
}

TEST(Licences, APlantedLibraryIsFound) {
  const auto found = unexpected_libraries(
      " 0x1 (NEEDED)  Shared library: [libgmp.so.10]\n 0x1 (NEEDED)  Shared library: [libreadline.so.8]\n");
  EXPECT_EQ(lines(found), "libreadline.so.8\n");
}

bool has_word(const std::string& flags, const std::string& word) {
  return (" " + flags + " ").find(" " + word + " ") != std::string::npos;
}

TEST(BuildFlags, NothingFusesOrReordersAndEigenIsHeldToItsFreeLicence) {
  const auto commands = shipped_commands();
  ASSERT_FALSE(commands.empty());
  for (const CompileCommand& command : commands) {
    EXPECT_TRUE(has_word(command.flags, "-ffp-contract=off")) << command.file;
    EXPECT_TRUE(has_word(command.flags, "-DEIGEN_MPL2_ONLY")) << command.file;
    for (const char* forbidden : {"-ffast-math", "-Ofast", "-funsafe-math-optimizations", "-march=native", "-mfma"}) {
      EXPECT_FALSE(has_word(command.flags, forbidden)) << command.file;
    }
  }
}

TEST(BuildFlags, TheKernelIsCompiledForSwitchedRounding) {
  EXPECT_TRUE(has_word(kernel_command().flags, "-frounding-math"));
  for (const CompileCommand& command : shipped_commands()) {
    if (layer_of(in_project(command.file)) != "kernel") continue;
    EXPECT_TRUE(has_word(command.flags, "-frounding-math")) << command.file;
  }
}

}  // namespace
}  // namespace noli::repository
