// SPDX-License-Identifier: Apache-2.0
//
// Tests damaged proofs about the worked example's edges, found by mutation because they reached new code. The name of
// each file states the checker's answer. The fuzz target of the checker starts from the same files.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "proof_writer.h"
#include "tests/checker/support.h"

namespace noli::checker::test {
namespace {

namespace fs = std::filesystem;

/// The words without numbers and signs, as in the names of files.
std::string as_name(const std::string& words) {
  std::string name;
  for (const char c : words) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (letter) name += static_cast<char>(c | 0x20);
    if (!letter && !name.empty() && name.back() != '-') name += '-';
  }
  if (!name.empty() && name.back() == '-') name.pop_back();
  return name;
}

TEST(Seeds, EachIsJudgedAsItsNameSays) {
  const Folder folder;
  const Proof edges = two_edges();
  const std::vector<std::string> frames = {folder.write("0.obj", obj(edges.frames[0], edges.cells)),
                                           folder.write("1.obj", obj(edges.frames[1], edges.cells))};
  int accepted = 0, rejected = 0;
  for (const auto& seed : fs::directory_iterator(fs::path(NOLI_SOURCE_DIR) / "tests/fuzz/seeds/checker")) {
    const std::string name = seed.path().filename();
    if (!name.starts_with("accepted-") && !name.starts_with("rejected-")) continue;
    std::ifstream file(seed.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    ASSERT_FALSE(bytes.empty()) << name;
    ASSERT_EQ(bytes[0], 'P') << name;
    const std::string proof = folder.write("proof.noli", bytes.substr(1));
    const Verdict said = verdict(proof, frames);
    ++(said.code == 0 ? accepted : rejected);
    EXPECT_EQ(said.code, name.starts_with("accepted-") ? 0 : 3) << name << ": " << said.words;
    if (said.code != 3) continue;
    const std::size_t why = said.words.find(": ");
    ASSERT_NE(why, std::string::npos) << name;
    EXPECT_TRUE(name.ends_with(as_name(said.words.substr(why)))) << name << ": " << said.words;
  }
  EXPECT_GE(accepted, 1);
  EXPECT_GE(rejected, 40);
}

}  // namespace
}  // namespace noli::checker::test
