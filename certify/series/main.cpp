// SPDX-License-Identifier: Apache-2.0
//
// noli_series: makes a file of series from the stream of stream.h, and arrays of numpy from the frames of an HDF5 file.
//   noli_series write <STREAM 1<>FILE.h5
//   noli_series frames fan|refuse <FILE.vtkhdf >ARRAYS       the word says what becomes of polygons
//   noli_series look fan|refuse <FILE.vtkhdf                 a line about them
//
// HDF5 is linked to this program and not to noli: it brings many other libraries, ends the process when a disk is full
// or memory runs out, and is not made for hostile files. The program gets no file names, and has limits of its own.
#include <fcntl.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <exception>
#include <new>
#include <string_view>
#include <vector>

#include "certify/series/ending.h"
#include "certify/series/frames_out.h"
#include "certify/series/hdf5_file.h"
#include "certify/series/hdf5_input.h"
#include "certify/series/stream_reader.h"

namespace noli::series {
namespace {

constexpr rlim_t seconds_to_look = 30;
/// Writing needs little memory: pieces are small, and HDF5 keeps little of arrays without chunks. Reading needs a mesh
/// and a frame.
constexpr rlim_t memory_to_write = rlim_t{1} << 30, memory_to_read = rlim_t{1} << 33;

void limit_memory(rlim_t most) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they take terabytes of addresses
  struct rlimit limit = {};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur <= most) return;
  limit.rlim_cur = most;
  if (::setrlimit(RLIMIT_AS, &limit) != 0) end_with(Ending::failure, "memory cannot be limited");
#endif
}

/// Nobody waits for the answer of a program whose noli has been killed.
void end_with_parent() {
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
}

/// A damaged file can send the library round in circles. To look at a file reads no positions, so it takes little.
void limit_time_of_look() {
  struct rlimit limit = {};
  if (::getrlimit(RLIMIT_CPU, &limit) != 0 || limit.rlim_cur <= seconds_to_look) return;
  limit.rlim_cur = seconds_to_look;
  if (::setrlimit(RLIMIT_CPU, &limit) != 0) end_with(Ending::failure, "time cannot be limited");
}

void require_input(int descriptor) {
  struct stat status = {};
  if (::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode)) return;
  end_with(Ending::bad_input, "standard input: expected a regular file (<FILE)");
}

void require_file(int descriptor) {
  struct stat status = {};
  const bool regular = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  const int flags = ::fcntl(descriptor, F_GETFL);
  if (regular && flags != -1 && (flags & O_ACCMODE) == O_RDWR && (flags & O_APPEND) == 0) return;
  end_with(Ending::bad_input,
           "standard output: expected a regular file that is open for reading and writing (1<>FILE)");
}

void write() {
  require_file(STDOUT_FILENO);
  StreamReader stream(STDIN_FILENO);
  Hdf5File file(STDOUT_FILENO);
  std::vector<Array> arrays;
  for (;;) {
    const Message message = stream.next_message();
    if (message == Message::end) break;
    if (message == Message::array) {
      if (arrays.size() == most_arrays) end_with(Ending::bad_input, "the stream: too many arrays");
      arrays.push_back(stream.array());
      file.declare(arrays.back());
    } else {
      const Piece piece = stream.piece(arrays);
      file.write(arrays[piece.array], piece, stream.values(piece.count));
    }
  }
  stream.require_end();
  file.close();
}

void read(std::string_view what, std::string_view polygons) {
  require_input(STDIN_FILENO);
  if (what == "look") limit_time_of_look();
  const auto answer = what == "look" ? write_look : write_frames;
  try {
    answer(STDIN_FILENO, STDOUT_FILENO, polygons == "refuse" ? PolygonRule::refuse : PolygonRule::fan);
  } catch (const BadInput& error) {
    end_with(Ending::bad_input, error.what());
  }
}

}  // namespace
}  // namespace noli::series

int main(int argc, char** argv) {
  using namespace noli::series;
  const std::vector<std::string_view> words(argv + 1, argv + argc);
  const bool to_write = words == std::vector<std::string_view>{"write"};
  const bool to_read =
      words.size() == 2 && (words[0] == "frames" || words[0] == "look") && (words[1] == "fan" || words[1] == "refuse");
  if (!to_write && !to_read) {
    end_with(
        Ending::bad_input,
        "usage: noli_series write <STREAM 1<>FILE.h5, or noli_series frames|look fan|refuse <FILE.vtkhdf >ARRAYS (noli "
        "starts it by itself)");
  }
  end_with_parent();
  std::signal(SIGXFSZ, SIG_IGN);  // so that write() fails at the size limit instead
  std::set_terminate([] { end_with(Ending::failure, "internal error"); });
  limit_memory(to_write ? memory_to_write : memory_to_read);
  try {
    if (to_write) write();
    if (to_read) read(words[0], words[1]);
  } catch (const std::bad_alloc&) {
    end_with(Ending::failure, "out of memory");
  }
  ::_exit(static_cast<int>(Ending::written));  // HDF5 has nothing left to write
}
