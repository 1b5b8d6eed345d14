// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/arrays/frames_in_memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <noli/errors.h>
#include "trajectory/formats/frame_sequence.h"
#include "trajectory/formats/open_frames.h"

namespace noli {
namespace {

using Positions = std::vector<Position>;

std::shared_ptr<GivenFrames> three_frames() {
  auto given = std::make_shared<GivenFrames>();
  given->mesh.vertex_count = 2;
  given->mesh.edges = {{0, 1}};
  given->count = 3;
  given->again = true;
  given->frame = [](std::size_t k) {
    const auto t = static_cast<double>(k);
    return std::optional(Positions{{t, 0, 0}, {t, 1, 0}});
  };
  return given;
}

/// Of all coordinates, as doubles are in memory.
Sha256Digest hash_of(const std::vector<Positions>& frames) {
  Sha256 hash;
  for (const Positions& x : frames) {
    hash.update({reinterpret_cast<const char*>(x.data()), x.size() * sizeof(Position)});
  }
  return hash.digest();
}

std::string message(const auto& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FramesInMemory, AreReadAndHashed) {
  const auto given = three_frames();
  FrameReading reading;
  reading.given = given;
  const auto source = open_frames({"V"}, reading);
  FrameSequence sequence(*source);
  EXPECT_EQ(sequence.step_count(), 2u);
  while (sequence.next()) continue;
  EXPECT_EQ(sequence.step(), 1u);
  EXPECT_EQ(sequence.name_t1(), "V[2]");
  const std::vector<FrameFacts> facts = source->take_facts();
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_EQ(facts[0].frames, 3u);
  EXPECT_EQ(facts[0].bytes, 3 * 2 * sizeof(Position));
  EXPECT_EQ(facts[0].sha256, hash_of({*given->frame(0), *given->frame(1), *given->frame(2)}));
  EXPECT_TRUE(facts[0].looked_at);
}

TEST(FramesInMemory, ThatNobodyAskedForAreHashedToo) {
  const auto given = three_frames();
  FramesInMemory source("V", given);
  source.read(0);
  EXPECT_EQ(source.take_facts()[0].sha256, hash_of({*given->frame(0), *given->frame(1), *given->frame(2)}));
  given->again = false;  // what is spent cannot be asked for
  FramesInMemory once("V", given);
  once.read(0);
  const FrameFacts facts = once.take_facts()[0];
  EXPECT_EQ(facts.frames, 1u);
  EXPECT_EQ(facts.sha256, hash_of({*given->frame(0)}));
}

TEST(FramesInMemory, EndWhereTheFunctionSaysSo) {
  const auto given = three_frames();
  given->count.reset();
  given->again = false;
  const auto frame = given->frame;
  given->frame = [frame](std::size_t k) { return k < 2 ? frame(k) : std::nullopt; };
  FramesInMemory source("V", given);
  FrameSequence sequence(source);
  EXPECT_EQ(sequence.step_count(), std::nullopt);
  EXPECT_TRUE(sequence.next());
  EXPECT_FALSE(sequence.next());
  EXPECT_EQ(source.take_facts()[0].frames, 2u);
}

TEST(FramesInMemory, WithBadNumbersAreRefused) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    const auto given = three_frames();
    given->frame = [bad](std::size_t k) { return std::optional(Positions{{0, 0, 0}, {0, 0, k == 1 ? bad : 0}}); };
    FramesInMemory source("V", given);
    EXPECT_EQ(message([&] { source.read(0); }), "");
    EXPECT_TRUE(message([&] { source.read(1); }).starts_with("V[1]: vertex 1: expected a finite number, found "));
    EXPECT_NE(message([&] { source.take_facts(); }), "") << "also where nobody asked for them";
  }
  const auto given = three_frames();
  given->frame = [](std::size_t) { return std::optional(Positions(3)); };
  FramesInMemory source("V", given);
  EXPECT_EQ(message([&] { source.read(0); }), "V[0]: has 3 positions; expected 2, one for each vertex");
}

TEST(FramesInMemory, ThatChangeBetweenTwoReadingsAreRefused) {
  const auto given = three_frames();
  double shift = 0;
  given->frame = [&shift](std::size_t k) {
    return std::optional(Positions{{static_cast<double>(k) + shift, 0, 0}, {0, 1, 0}});
  };
  for (const double change : {0.0, 1.0}) {
    shift = 0;
    FramesInMemory source("V", given);
    for (std::size_t k = 0; k < 3; ++k) source.read(k);
    shift = change;
    for (std::size_t k = 0; k < 3; ++k) source.read(k);
    EXPECT_EQ(message([&] { source.take_facts(); }).find("has changed") != std::string::npos, change != 0);
  }
}

}  // namespace
}  // namespace noli
