// SPDX-License-Identifier: Apache-2.0
//
// Tests what several checkers say of parts of a proof, and the one verdict that is made of it.
#include "certify/proofs/check_parts.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "certify/proofs/proof_blocks.h"
#include "tests/support/temporary_folder.h"
#include "trajectory/blocks/bytes.h"

namespace noli {
namespace {

using Words = std::vector<std::string>;

/// What a checker says of the steps from `first` to `last`.
std::string part(int first, int last, const std::string& hash = std::string(64, 'a'), const std::string& merged = "0") {
  return fmt::format(
      "accepted: nothing that is compared touches; not compared: 1-2; steps {0}..{1}\n"
      "claim motion=linear dimension=3 steps={0}..{1} strict=0 merged={3} excluded=1-2 cells=c empty=0 from={2} to={1} "
      "proof={4}\n"
      "Steps {0}..{1} of frames, straight lines between them; from {2} to {1}; dimension 3; 2 cells of 6 vertices.\n"
      "Compared: features of two different cells.\n",
      first, last, first - 1, merged, hash);
}

TEST(JoinedWords, AreThoseOfOneChecker) {
  const auto joined = joined_words({part(1, 4), part(5, 5), part(6, 12)}, 0);
  ASSERT_TRUE(joined.has_value());
  EXPECT_EQ(*joined,
            "accepted: nothing that is compared touches; not compared: 1-2\n"
            "claim motion=linear dimension=3 steps=12 strict=0 merged=0 excluded=1-2 cells=c empty=0 from=0 to=12\n"
            "12 steps of frames, straight lines between them; from 0 to 12; dimension 3; 2 cells of 6 vertices.\n"
            "Compared: features of two different cells.\n");
}

TEST(JoinedWords, AreAboutAsManyStepsAsAreAskedFor) {
  EXPECT_TRUE(joined_words({part(1, 4), part(5, 9)}, 9).has_value());
  EXPECT_FALSE(joined_words({part(1, 4), part(5, 9)}, 10).has_value());
}

TEST(AskedSteps, AreANumberAskedForOnce) {
  EXPECT_EQ(asked_steps({"strict", "distance=1"}), 0U);
  EXPECT_EQ(asked_steps({"strict", "steps=12"}), 12U);
  for (const char* const word : {"steps", "steps=", "steps=0", "steps=1..2", "steps=3..", "steps=x", "steps=-1"}) {
    EXPECT_EQ(asked_steps({word}), std::nullopt) << word;
  }
  EXPECT_EQ(asked_steps({"steps=2", "steps=3"}), std::nullopt);
  EXPECT_EQ(asked_steps({"steps=2", "steps"}), std::nullopt);
  EXPECT_EQ(asked_steps({"steps", "steps=2"}), std::nullopt);
}

TEST(JoinedWords, AreOfPartsAlone) {
  EXPECT_FALSE(joined_words({"accepted: nothing touches\nclaim motion=linear steps=4 strict=0 from=0 to=4\n"}, 0));
  EXPECT_FALSE(joined_words({"accepted: nothing touches; steps 1..2\n"}, 0));
  EXPECT_FALSE(joined_words({"; steps .."}, 0));
}

TEST(JoinedWords, LackNoStepAndHaveNoneTwice) {
  EXPECT_TRUE(joined_words({part(1, 4), part(5, 9)}, 0).has_value());
  EXPECT_FALSE(joined_words({part(1, 4), part(6, 9)}, 0).has_value());
  EXPECT_FALSE(joined_words({part(1, 4), part(4, 9)}, 0).has_value());
  EXPECT_FALSE(joined_words({part(2, 4), part(5, 9)}, 0).has_value());
  EXPECT_FALSE(joined_words({part(5, 9), part(1, 4)}, 0).has_value());
  EXPECT_FALSE(joined_words({part(1, 4), part(5, 3)}, 0).has_value());
  EXPECT_FALSE(joined_words({}, 0).has_value());
}

TEST(JoinedWords, AreAboutOneProofAndOneClaim) {
  EXPECT_FALSE(joined_words({part(1, 4), part(5, 9, std::string(64, 'b'))}, 0).has_value());
  EXPECT_FALSE(joined_words({part(1, 4), part(5, 9, std::string(64, 'a'), "1")}, 0).has_value());
}

TEST(JoinedWords, AreAcceptedByAll) {
  std::string refuted = part(5, 9), cut = part(5, 9);
  refuted.replace(0, 8, "refuted:");
  EXPECT_FALSE(joined_words({part(1, 4), refuted}, 0).has_value());
  for (std::size_t size = 0; size < 200; size += 7)
    EXPECT_FALSE(joined_words({part(1, 4), cut.substr(0, size)}, 0).has_value());
  EXPECT_FALSE(joined_words({part(1, 4), ""}, 0).has_value());
  // The lines disagree about the steps.
  for (const char* const line : {"; steps 5..9", " steps=5..9", "Steps 5..9", "from 4"}) {
    std::string other = part(5, 9);
    other[other.find(line) + std::string(line).find_first_of("54")] = '1';
    EXPECT_FALSE(joined_words({part(1, 4), other}, 0).has_value()) << line;
  }
}

class PartsOfProof : public testing::Test {
 protected:
  /// A file whose steps have so many bytes of tokens.
  std::filesystem::path write(const std::vector<std::size_t>& tokens, const char* last_kind = "TOKS") const {
    ProofGroups groups = {{{four_letters("CLAM"), "claim"}}};
    for (const std::size_t size : tokens) {
      groups.push_back({{four_letters("STEP"), std::string(65, 's')}, {four_letters("TOKS"), std::string(size, 't')}});
    }
    const std::string kind = last_kind;
    FourLetters letters = 0;
    for (std::size_t i = 4; i-- > 0;) letters = letters << 8 | static_cast<unsigned char>(kind[i]);
    groups.back().back().kind = letters;
    return folder.write("proof.noli", proof_bytes(groups));
  }
  test::TemporaryFolder folder;
};

using Firsts = std::vector<std::uint64_t>;

TEST_F(PartsOfProof, HaveAboutEqualBytes) {
  EXPECT_EQ(parts_of_proof(write(std::vector<std::size_t>(12, 1000)), 3), (Firsts{1, 5, 9}));
  EXPECT_EQ(parts_of_proof(write({9000, 1000, 1000, 1000, 1000, 1000, 1000, 1000, 1000, 1000}), 2), (Firsts{1, 2}));
  EXPECT_EQ(parts_of_proof(write({1000, 1000, 1000, 9000}), 2), (Firsts{1, 4}));
  EXPECT_EQ(parts_of_proof(write(std::vector<std::size_t>(5, 1000)), 1), (Firsts{1}));
}

TEST_F(PartsOfProof, AreAsManyAsAreAskedForOrThereAreSteps) {
  for (std::size_t parts = 1; parts <= 9; ++parts) {
    const Firsts firsts = parts_of_proof(write({90000, 0, 0, 5, 0, 7, 100}), parts);
    EXPECT_EQ(firsts.size(), std::min<std::size_t>(parts, 7));
    EXPECT_EQ(firsts[0], 1U);
    EXPECT_TRUE(std::ranges::is_sorted(firsts, std::less_equal<>()) || firsts.size() == 1);
    EXPECT_LE(firsts.back(), 7U);
  }
}

TEST_F(PartsOfProof, OfAFileThatCannotBePartedAreNone) {
  const auto whole = write({1000, 1000});
  const std::string bytes = [&] {
    std::ifstream file(whole, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }();
  EXPECT_EQ(parts_of_proof(whole, 2).size(), 2U);
  EXPECT_TRUE(parts_of_proof(write({1000, 1000}, "WITN"), 2).empty());
  EXPECT_TRUE(parts_of_proof(folder.path() / "none.noli", 2).empty());
  EXPECT_TRUE(parts_of_proof(folder.path(), 2).empty());
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{10}, std::size_t{20}, bytes.size() / 2, bytes.size() - 1}) {
    EXPECT_TRUE(parts_of_proof(folder.write("cut.noli", bytes.substr(0, size)), 2).empty()) << size;
  }
  std::string other_step = bytes;
  other_step[other_step.find("STEP") + 4] = 64;
  EXPECT_TRUE(parts_of_proof(folder.write("step.noli", other_step), 2).empty());
  std::string long_block = bytes;
  long_block[16 + 4 + 7] = '\x7f';  // the highest byte of a length
  EXPECT_TRUE(parts_of_proof(folder.write("long.noli", long_block), 2).empty());
}

TEST(StepsOfPart, HaveAnOpenEndLast) {
  EXPECT_EQ(steps_of_part({1, 5, 9}, 0), "1..4");
  EXPECT_EQ(steps_of_part({1, 5, 9}, 1), "5..8");
  EXPECT_EQ(steps_of_part({1, 5, 9}, 2), "9..");
}

}  // namespace
}  // namespace noli
