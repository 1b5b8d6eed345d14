// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/tokens/tokens.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "proofs/prover/tokens/short_direction.h"

namespace noli {
namespace {

std::string bytes_of(const Tokens& tokens) {
  std::string bytes;
  tokens.give([&](std::string_view piece) { bytes += piece; });
  return bytes;
}

std::vector<std::string> pieces_of(const Tokens& tokens, std::size_t begin, std::size_t end) {
  std::vector<std::string> pieces;
  tokens.give(begin, end, [&](std::string_view piece) { pieces.emplace_back(piece); });
  return pieces;
}

TEST(Tokens, AreTheBytesOfTheFormat) {
  Tokens tokens;
  tokens.halve();
  tokens.axis(2, false);
  tokens.drop(1);
  tokens.direction(std::array<int, 3>{1, -1, 511});
  tokens.direction(std::array<Integer, 3>{Integer(64), Integer(-1), Integer(0)});
  EXPECT_EQ(bytes_of(tokens), std::string("\x00\x0d\x21\x10\x01\xfc\xff\x1f\x11\x80\x01\x01\x00", 13));
}

TEST(Tokens, AreOneStreamHoweverManyPieces) {
  Tokens tokens;
  std::string wanted;
  std::vector<std::size_t> places;
  for (int i = 0; i < 100'000; ++i) {
    places.push_back(tokens.place());
    if (i % 3 == 0) {
      tokens.direction(std::array<int, 3>{i % 512, 0, 0});
      wanted += {'\x10', static_cast<char>(i % 512 & 0xff), static_cast<char>(i % 512 >> 8), 0, 0};
    } else {
      tokens.left();
      wanted += '\x01';
    }
  }
  EXPECT_EQ(bytes_of(tokens), wanted);
  EXPECT_GT(pieces_of(tokens, 0, tokens.place()).size(), 2u);
  for (const std::string& piece : pieces_of(tokens, 0, tokens.place())) EXPECT_LE(piece.size(), Tokens::longest_piece);
  // From any place to any other.
  std::size_t at = 0;
  for (std::size_t i = 0; i + 1 < places.size(); i += 997) {
    std::string part;
    const std::size_t j = std::min(i + 60'000, places.size() - 1);
    for (const std::string& piece : pieces_of(tokens, places[i], places[j])) part += piece;
    ASSERT_EQ(part, wanted.substr(at, part.size())) << i;
    EXPECT_EQ(part.size(), (j - i) + 4 * ((j + 2) / 3 - (i + 2) / 3));
    for (std::size_t k = i; k < i + 997; ++k) at += k % 3 == 0 ? 5 : 1;
  }
}

TEST(Tokens, ForgetWhatIsTruncatedInWhateverPieceItIs) {
  for (const int kept : {0, 1, 900, 65'533, 65'534, 65'535, 65'536, 131'000}) {
    SCOPED_TRACE(kept);
    Tokens tokens;
    for (int i = 0; i < kept; ++i) tokens.left();
    const std::size_t place = tokens.place();
    for (int i = 0; i < 100'000; ++i) tokens.right();
    tokens.truncate(place);
    EXPECT_EQ(tokens.place(), place);
    for (int i = 0; i < 5; ++i) tokens.empty();
    EXPECT_EQ(bytes_of(tokens), std::string(static_cast<std::size_t>(kept), '\x01') + std::string(5, '\x0e'));
  }
}

TEST(JoinedTokens, ComeInTheirPlaces) {
  JoinedTokens all;
  all.places.push_back(all.tokens.place());
  all.tokens.left();
  all.places.push_back(all.tokens.place());
  all.places.push_back(all.tokens.place());
  all.tokens.right();
  all.inserted.resize(3);
  all.inserted[0].tokens.halve();
  all.inserted[2].tokens.one();
  all.inserted[2].tokens.both();
  std::string bytes;
  all.give([&](std::string_view piece) { bytes += piece; });
  EXPECT_EQ(bytes, std::string("\x00\x01\x04\x05\x02", 5));
}

TEST(ShortDirections, AreWholeNumbersOfTenBitsAlongTheSameLine) {
  for (const double scale : {1.0, 0x1p-300, 0x1p300, 3e-7}) {
    const auto m = shortened(std::array<double, 3>{scale * -3, scale * 1, scale * 0.001});
    EXPECT_EQ(m, (std::array<double, 3>{-511, 170, 0}));
  }
  EXPECT_EQ(shortened(std::array<double, 2>{5, -5}), (std::array<double, 2>{511, -511}));
}

TEST(ShortDirections, OfNothingPassNoTest) {
  for (const double bad : {0.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    const auto m = shortened(std::array<double, 3>{bad, 0, 0});
    EXPECT_FALSE(m[0] > 0 && std::isfinite(m[0])) << bad;
  }
}

TEST(ShortDirections, AreWrittenWithTheFewestBitsThatPass) {
  const std::array<double, 3> n = {1, 0x1p-15, 0};
  const auto length = [&](double least) {
    Tokens tokens;
    put_direction(
        n, [&](const std::array<double, 3>& m) { return m[1] > least * m[0]; }, tokens);
    return bytes_of(tokens).size();
  };
  EXPECT_EQ(length(-1), 1u) << "an axis";
  EXPECT_EQ(length(0), 1u + 3 + 1 + 1) << "2^20, 2^5 and 0, made odd";
  EXPECT_GT(length(0x1.fffffffp-16), 5u);
}

}  // namespace
}  // namespace noli
