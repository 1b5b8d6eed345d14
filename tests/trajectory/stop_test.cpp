// SPDX-License-Identifier: Apache-2.0
#include "trajectory/stop.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>
#include <vector>

#include <noli/errors.h>
#include "tests/support/temporary_folder.h"
#include "trajectory/cells.h"
#include "trajectory/formats/frame_look.h"
#include "trajectory/formats/frames.h"
#include "trajectory/formats/query_csv.h"
#include "trajectory/input_file.h"
#include "trajectory/merge.h"
#include "trajectory/text.h"

namespace noli {
namespace {

/// Requests a stop while it exists.
struct Asked {
  explicit Asked(StopReason reason) { ask_to_stop(reason); }
  ~Asked() { forget_stops(); }
};

constexpr const char* obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\n";
constexpr const char* ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

TEST(Stop, IsAskedForAndForgotten) {
  EXPECT_FALSE(stop_asked());
  EXPECT_NO_THROW(end_if_stopped());
  {
    const Asked asked(StopReason::out_of_time);
    EXPECT_EQ(stop_asked(), StopReason::out_of_time);
    EXPECT_THROW(end_if_stopped(), Stopped);
    ask_to_stop(StopReason::interrupted);  // the user takes precedence
    EXPECT_EQ(stop_asked(), StopReason::interrupted);
  }
  EXPECT_FALSE(stop_asked());
}

TEST(Stop, OfAThreadIsHeardByThatThreadAlone) {
  std::atomic<bool> stop = false;
  {
    const StopOfThread of_thread(stop);
    EXPECT_FALSE(stop_asked());
    stop = true;
    EXPECT_EQ(stop_asked(), StopReason::interrupted);
    EXPECT_THROW(end_if_stopped(), Stopped);
    std::atomic<bool> other = false;
    {
      const StopOfThread inner(other);
      EXPECT_FALSE(stop_asked());
      const Asked asked(StopReason::out_of_time);
      EXPECT_EQ(stop_asked(), StopReason::out_of_time);
    }
    EXPECT_TRUE(stop_asked());
    std::thread([] { EXPECT_FALSE(stop_asked()); }).join();
  }
  EXPECT_FALSE(stop_asked());
}

TEST(Stop, OfAThreadMayBeNone) {
  const std::atomic<bool> stop = true;
  const StopOfThread of_thread(stop);
  {
    const StopOfThread none(nullptr);
    EXPECT_EQ(stop_of_thread(), &stop);
    EXPECT_TRUE(stop_asked());
  }
  EXPECT_EQ(stop_of_thread(), &stop);
}

TEST(InputFile, TheStopOfAThreadEndsItsWaitForAPipe) {
  const test::TemporaryFolder folder;
  const auto pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::atomic<bool> stop = false;
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop = true;
  });
  const StopOfThread of_thread(stop);
  EXPECT_THROW(read_whole_file(pipe), ReadInterrupted);
  later.join();
}

TEST(Stop, SaysWhy) {
  EXPECT_STREQ(Stopped(StopReason::interrupted, "").what(), "interrupted");
  EXPECT_STREQ(Stopped(StopReason::out_of_time, "a\nb").what(), "a\\nb: the time limit has passed");
  EXPECT_STREQ(ReadInterrupted("f").what(), "f: interrupted while it was read");
  const Asked asked(StopReason::out_of_time);
  EXPECT_STREQ(ReadInterrupted("f").what(), "f: the time limit has passed while it was read");
  EXPECT_EQ(ReadInterrupted("f").reason(), StopReason::out_of_time);
}

TEST(Stop, IsHeardByWhateverReadsFrames) {
  Mesh mesh;
  mesh.vertex_count = 3;
  mesh.faces = {{0, 1, 2}};
  mesh.edges = {{0, 1}};
  const std::vector<Position> positions(3);
  const std::vector<std::function<void()>> work = {
      [] { parse_frame(obj, "a.obj"); },
      [] { parse_frame(ply, "a.ply"); },
      [] { look_at_frame(obj, "a.obj"); },
      [] { look_at_frame(ply, "a.ply"); },
      [] { frame_hash("abc"); },
      [&] {
        Mesh copy = mesh;
        drop_redundant_cells(copy);
      },
      [&] { IdenticalVertices(3).refine(positions); },
      [] { parse_query_csv("0,1,0,1,0,1\n0,1,0,1,0,1\n0,1,0,1,0,1\n0,1,0,1,0,1\n", "q", QueryKind::vertex_vertex); },
  };
  for (std::size_t i = 0; i < work.size(); ++i) {
    EXPECT_NO_THROW(work[i]()) << i;
    const Asked asked(StopReason::interrupted);
    EXPECT_THROW(work[i](), Stopped) << i;
  }
}

TEST(InputFile, AFileWithoutAWriterIsWaitedForUntilAStop) {
  const test::TemporaryFolder folder;
  const auto pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::thread later([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    ask_to_stop(StopReason::out_of_time);
  });
  EXPECT_THROW(read_whole_file(pipe), ReadInterrupted);
  later.join();
  forget_stops();
}

TEST(InputFile, APipeIsReadToItsEnd) {
  const test::TemporaryFolder folder;
  const auto pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::string text(3'000'000, 'x');
  std::thread writer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));  // the reader waits for it
    std::FILE* const file = std::fopen(pipe.c_str(), "wb");
    std::fwrite(text.data(), 1, 1000, file);
    std::fflush(file);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    std::fwrite(text.data(), 1, text.size() - 1000, file);
    std::fclose(file);
  });
  EXPECT_TRUE(read_whole_file(pipe) == text);
  writer.join();
}

TEST(InputFile, FilesOfAllSizesAreReadWhole) {
  const test::TemporaryFolder folder;
  for (const std::size_t size : {1u, 4095u, 1u << 20, (1u << 20) + 1, 5'000'000u}) {
    std::string text(size, 'a');
    for (std::size_t i = 0; i < size; ++i) text[i] = static_cast<char>(i * i % 251);
    EXPECT_TRUE(read_whole_file(folder.write("f", text)) == text) << size;
  }
}

TEST(InputFile, SmallFilesAreReadAlsoAfterAStop) {
  const test::TemporaryFolder folder;
  const auto small = folder.write("small", "abc"), large = folder.write("large", std::string(3'000'000, 'x'));
  EXPECT_EQ(read_whole_file(large).size(), 3'000'000u);
  const Asked asked(StopReason::interrupted);
  EXPECT_EQ(read_whole_file(small), "abc");
  EXPECT_THROW(read_whole_file(large), ReadInterrupted);
}

TEST(InputFile, WhatHasNoEndIsRefused) {
  EXPECT_THROW(read_whole_file("/dev/zero"), InputError);
  EXPECT_THROW(read_whole_file("/dev/null"), InputError);
  const test::TemporaryFolder folder;
  EXPECT_THROW(read_whole_file(folder.path()), InputError);
  EXPECT_THROW(read_whole_file(folder / "none"), InputError);
  const auto huge = folder.write("huge", "x");
  std::filesystem::resize_file(huge, std::uintmax_t{1} << 42);
  EXPECT_THROW(read_whole_file(huge), InputError);
}

}  // namespace
}  // namespace noli
