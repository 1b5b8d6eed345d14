// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/frame_order.h"
#include "tests/support/temporary_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>

#include "support.h"

namespace noli {
namespace {

using Paths = std::vector<std::filesystem::path>;
using testing::input_error;

constexpr const char* advice = "; pass --order natural, or --order given if this is the order you mean";

Paths cloth(const std::vector<int>& numbers) {
  Paths paths;
  for (const int k : numbers) paths.emplace_back(fmt::format("cloth_{}.obj", k));
  return paths;
}

std::string order_refusal(const Paths& frames) {
  return input_error([&] { order_frames(frames); });
}
Paths natural(const Paths& frames) { return order_frames(frames, FrameOrder::natural).frames; }
void expect_taken(const Paths& frames) { EXPECT_EQ(order_frames(frames).frames, frames); }
std::vector<std::string> notes(const Paths& frames) { return order_frames(frames).notes; }

TEST(FrameOrder, TheShellPutsTenBeforeTwo) {
  const Paths shell = cloth({0, 1, 10, 11, 2, 3, 4, 5, 6, 7, 8, 9});
  const Paths time = cloth({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
  EXPECT_EQ(order_refusal(shell), std::string("frames: cloth_10.obj comes before cloth_2.obj") + advice);
  const OrderedFrames sorted = order_frames(shell, FrameOrder::natural);
  EXPECT_EQ(sorted.frames, time);
  EXPECT_EQ(sorted.how, "sorted by the numbers in the names (--order natural)");
  EXPECT_EQ(sorted.notes,
            std::vector<std::string>{"frames were sorted by the numbers in their names (--order natural): "
                                     "10 of 12 changed places"});
  const OrderedFrames given = order_frames(shell, FrameOrder::given);
  EXPECT_EQ(given.frames, shell);
  EXPECT_EQ(given.how, "as given, against the numbers in the names (--order given)");
  EXPECT_EQ(given.notes, std::vector<std::string>{"frames are in the order given (--order given), against their "
                                                  "numbers: cloth_10.obj comes before cloth_2.obj"});
  for (const FrameOrder order : {FrameOrder::checked, FrameOrder::natural, FrameOrder::given}) {
    EXPECT_EQ(order_frames(time, order).frames, time);
    EXPECT_TRUE(order_frames(time, order).notes.empty());
  }
  EXPECT_EQ(order_frames(time).how, "as given, which is the order of the numbers in the names");
}

TEST(FrameOrder, AFolderIsOneHoweverItIsSpelled) {
  const noli::test::TemporaryFolder folder;
  std::filesystem::create_directory_symlink(folder.path(), folder / "link");
  const std::string name = folder.path().filename().string();
  for (const std::filesystem::path& other : {folder / "link", folder.path() / ".." / name, folder.path() / "."}) {
    const Paths frames = {folder / "cloth_10.obj", other / "cloth_9.obj"};
    EXPECT_NE(order_refusal(frames).find("comes before"), std::string::npos) << other;
    expect_taken({other / "cloth_9.obj", folder / "cloth_10.obj"});
  }
}

TEST(FrameOrder, NamesThatDifferInMoreThanNumbersAreTakenAsTheyAre) {
  expect_taken({"b.ply", "a.ply"});
  expect_taken({"after_1.ply", "before_0.ply"});
  expect_taken({"run_2/rest.ply", "start_1/rest.ply"});
  expect_taken({});
  EXPECT_EQ(order_frames({"b.ply", "a.ply"}).how, "as given; no two names differ only in their numbers");
}

TEST(FrameOrder, ExtensionsAndFoldersBelongToTheName) {
  EXPECT_EQ(order_refusal({"a_2.ply", "a_1.obj"}), std::string("frames: a_2.ply comes before a_1.obj") + advice);
  EXPECT_EQ(order_refusal({"run_10/end.ply", "run_9/end.ply"}),
            std::string("frames: run_10/end.ply comes before run_9/end.ply") + advice);
  expect_taken({"run_1/a_9.ply", "run_2/a_3.ply"});
  expect_taken({"./a_1.ply", "a_2.ply"});
  EXPECT_NE(order_refusal({"./a_2.ply", "a_1.ply"}), "");
}

TEST(FrameOrder, SeveralNumbersCompareOneAfterTheOther) {
  expect_taken({"s1_f9.ply", "s1_f10.ply", "s2_f1.ply"});
  EXPECT_NE(order_refusal({"s2_f1.ply", "s1_f9.ply"}), "");
  expect_taken({"v1.2.9.ply", "v1.2.10.ply", "v1.10.1.ply"});
  EXPECT_NE(order_refusal({"v1.2.10.ply", "v1.2.9.ply"}), "");
}

TEST(FrameOrder, NumbersOfAnyLengthWithLeadingZeros) {
  expect_taken({"a_007.ply", "a_8.ply", "a_08.ply", "a_0009.ply"});
  const std::string nines(40, '9');
  expect_taken({"a_" + nines + ".ply", "a_1" + std::string(40, '0') + ".ply"});
  EXPECT_NE(order_refusal({"a_1" + std::string(40, '0') + ".ply", "a_" + nines + ".ply"}), "");
  EXPECT_NE(order_refusal({"a_1" + nines + "1.ply", "a_1" + nines + "0.ply"}), "") << "the last of 42 digits decides";
}

TEST(FrameOrder, AsksWhereANumberMayBeADecimalOrTwo) {
  expect_taken({"t_0.10.ply", "t_0.90.ply", "t_1.00.ply"});
  expect_taken({"t_0.5.ply", "t_1.ply", "t_1.5.ply"});
  EXPECT_EQ(
      order_refusal({"t_0.9.ply", "t_0.10.ply"}),
      std::string("frames: t_0.9.ply comes before t_0.10.ply, which is against their numbers if these are decimals "
                  "(0.10 before 0.9)") +
          advice);
  EXPECT_EQ(order_refusal({"t_0.10.ply", "t_0.9.ply"}),
            std::string("frames: t_0.10.ply comes before t_0.9.ply, which is right only if the numbers are decimals "
                        "(0.10 before 0.9)") +
                advice);
  EXPECT_EQ(natural({"t_0.9.ply", "t_0.10.ply"}), (Paths{"t_0.10.ply", "t_0.9.ply"}));
  expect_taken({"t_0.05.ply", "t_0.1.ply", "t_0.15.ply"});  // counters are not padded like 05 and 1
  EXPECT_NE(order_refusal({"t_0.1.ply", "t_0.05.ply"}), "");
}

TEST(FrameOrder, ExponentsAndSigns) {
  expect_taken({"t_9e-05.ply", "t_0.0001.ply", "t_1.5e+01.ply", "t_16.ply"});
  EXPECT_NE(order_refusal({"t_1e-04.ply", "t_1e-05.ply"}), "");
  EXPECT_NE(order_refusal({"t1e6.ply", "t1e5.ply"}), "") << "two numbers, with a letter between them";
  expect_taken({"z_-10.ply", "z_-9.ply", "z_-0.ply", "z_0.ply", "z_1.ply"});
  EXPECT_NE(order_refusal({"z_-9.ply", "z_-10.ply"}), "");
  expect_taken({"cloth-9.ply", "cloth-10.ply"});
  EXPECT_NE(order_refusal({"cloth-10.ply", "cloth-9.ply"}), "");
}

TEST(FrameOrder, FamiliesKeepTheirPlaces) {
  expect_taken({"a_1.ply", "b_5.ply", "a_2.ply", "b_6.ply"});
  EXPECT_EQ(natural({"a_2.ply", "b_6.ply", "x.ply", "a_1.ply", "b_5.ply"}),
            (Paths{"a_1.ply", "b_5.ply", "x.ply", "a_2.ply", "b_6.ply"}));
}

TEST(FrameOrder, NotesGaps) {
  EXPECT_EQ(notes(cloth({1, 2, 3, 5})), std::vector<std::string>{"cloth_3.obj to cloth_5.obj: frame 4 is missing"});
  EXPECT_EQ(notes(cloth({1, 2, 3, 9})),
            std::vector<std::string>{"cloth_3.obj to cloth_9.obj: frames 4 to 8 are missing"});
  EXPECT_EQ(notes(cloth({0, 10, 20, 40, 70})),
            (std::vector<std::string>{"cloth_20.obj to cloth_40.obj: frame 30 is missing",
                                      "cloth_40.obj to cloth_70.obj: frames 50 to 60, by 10, are missing"}));
  EXPECT_EQ(notes(cloth({0, 2, 4, 7})),
            std::vector<std::string>{"cloth_4.obj to cloth_7.obj: the number grows by 3 here, usually by 2"});
  EXPECT_EQ(order_frames(cloth({5, 3, 2}), FrameOrder::natural).notes[1],
            "cloth_3.obj to cloth_5.obj: frame 4 is missing");
  EXPECT_TRUE(notes(cloth({0, 10, 20, 30})).empty());
  EXPECT_TRUE(notes(cloth({3, 5})).empty()) << "two frames have one stride";
  EXPECT_TRUE(notes({"t_0.1.ply", "t_0.2.ply", "t_0.9.ply"}).empty()) << "times need not be even";
  EXPECT_TRUE(notes({"s1_f1.ply", "s1_f2.ply", "s2_f1.ply"}).empty()) << "which number counts is not clear";
}

TEST(FrameOrder, OfManyGapsTenAreShown) {
  std::vector<int> numbers = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  for (int k = 0; k < 13; ++k) numbers.push_back(20 + 2 * k);
  const auto all = notes(cloth(numbers));
  ASSERT_EQ(all.size(), 11u);
  EXPECT_EQ(all.back(), "and 3 more gaps in the numbers");
}

TEST(FrameOrder, NotesAFileThatIsGivenTwice) {
  EXPECT_EQ(notes({"a.ply", "b.ply", "./a.ply"}), std::vector<std::string>{"a.ply is given twice: as frames 1, 3"});
  EXPECT_EQ(notes(cloth({1, 1, 1, 2})), std::vector<std::string>{"cloth_1.obj is given 3 times: as frames 1, 2, 3"});
  EXPECT_EQ(order_frames({"a_2.ply", "a_1.ply", "a_2.ply"}, FrameOrder::natural).notes.back(),
            "a_2.ply is given twice: as frames 2, 3");
}

/// Names in a wrong random order are refused, and the message names two that are out of order. Sorting restores the
/// right order.
RC_GTEST_PROP(FrameOrder, PermutedNames, ()) {
  const auto count = *rc::gen::inRange<std::size_t>(2, 20);
  const auto numbers = *rc::gen::unique<std::vector<int>>(count, rc::gen::inRange(0, 3000));
  const int width = *rc::gen::inRange(1, 6);  // 7 or 00007
  const bool folder = *rc::gen::arbitrary<bool>();
  const auto path = [&](int number) -> std::filesystem::path {
    return folder ? fmt::format("run/step_{:0{}}/mesh.ply", number, width)
                  : fmt::format("cloth_{:0{}}.{}", number, width, number % 2 == 0 ? "obj" : "ply");
  };
  Paths given, time;
  for (const int number : numbers) given.push_back(path(number));
  std::vector<int> sorted = numbers;
  std::ranges::sort(sorted);
  for (const int number : sorted) time.push_back(path(number));
  RC_ASSERT(natural(given) == time);
  RC_ASSERT(order_frames(given, FrameOrder::given).frames == given);
  RC_ASSERT(order_frames(time).frames == time);
  if (given == time) return;
  const std::string problem = order_refusal(given);
  bool named = false;
  for (std::size_t i = 0; i < given.size(); ++i) {
    for (std::size_t j = i + 1; j < given.size(); ++j) {
      named |= numbers[i] > numbers[j] &&
               problem == fmt::format("frames: {} comes before {}{}", given[i].string(), given[j].string(), advice);
    }
  }
  RC_ASSERT(named);
}

/// Frames with equal numbers keep their order.
RC_GTEST_PROP(FrameOrder, SortsStably, ()) {
  const auto numbers = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 4));
  Paths given;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    given.emplace_back(fmt::format("a_{}{}.ply", std::string(i % 7, '0'), numbers[i]));
  }
  std::vector<std::size_t> order(numbers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return numbers[i]; });
  Paths expected;
  for (const std::size_t i : order) expected.push_back(given[i]);
  RC_ASSERT(natural(given) == expected);
}

}  // namespace
}  // namespace noli
