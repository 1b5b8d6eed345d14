// SPDX-License-Identifier: Apache-2.0
//
// Tests which motions checkers read themselves.
#include "certify/proofs/check_frames.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/support/temporary_folder.h"

namespace noli {
namespace {

TEST(CheckersRead, FramesOfOneMeshInFormatsOfTheirs) {
  EXPECT_TRUE(checkers_read({"a.ply", "b.obj"}, {}));
  EXPECT_FALSE(checkers_read({"a.ply", "b.vtu"}, {}));
  FrameReading joined;
  joined.bodies = {{"cloth", {"a.ply", "b.ply"}}};
  EXPECT_FALSE(checkers_read({"a.ply", "b.ply"}, joined));
  FrameReading in_memory;
  in_memory.given = std::make_shared<GivenFrames>();
  EXPECT_FALSE(checkers_read({"a.ply", "b.ply"}, in_memory));
}

TEST(LeftToCheckers, IsAFileOfNoKnownKindToo) {
  const test::TemporaryFolder folder;
  const std::filesystem::path unknown = folder.write("frames.txt", "no frames");
  EXPECT_FALSE(checkers_read({unknown}, {}));
  EXPECT_TRUE(left_to_checkers({unknown}, {}));
  EXPECT_FALSE(left_to_checkers({unknown, unknown}, {}));
  EXPECT_FALSE(left_to_checkers({"-"}, {}));
  EXPECT_FALSE(left_to_checkers({folder.write("motion.npz", "PK\x03\x04")}, {}));
  FrameReading in_memory;
  in_memory.given = std::make_shared<GivenFrames>();
  EXPECT_FALSE(left_to_checkers({"frames"}, in_memory));
  FrameReading joined;
  joined.bodies = {{"cloth", {unknown}}};
  EXPECT_FALSE(left_to_checkers({unknown}, joined));
}

}  // namespace
}  // namespace noli
