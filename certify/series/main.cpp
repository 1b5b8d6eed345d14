// SPDX-License-Identifier: Apache-2.0
//
// noli_series: makes a file of series from the stream of stream.h.
//   noli_series write <STREAM 1<>FILE.h5
//
// HDF5 is linked to this program and not to noli: it brings many other libraries, and ends the process when a disk is
// full or memory runs out. The program gets no file names, and has limits of its own.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <exception>
#include <new>
#include <string_view>

#include "certify/series/ending.h"
#include "certify/series/hdf5_file.h"
#include "certify/series/stream_reader.h"

namespace noli::series {
namespace {

/// Little memory is enough: pieces are small, and HDF5 keeps little of arrays without chunks.
void limit_memory() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they take terabytes of addresses
  constexpr rlim_t most = rlim_t{1} << 30;
  struct rlimit limit = {};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur <= most) return;
  limit.rlim_cur = most;
  if (::setrlimit(RLIMIT_AS, &limit) != 0) end_with(Ending::failure, "memory cannot be limited");
#endif
}

void require_file(int descriptor) {
  struct stat status = {};
  const bool regular = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  const int flags = ::fcntl(descriptor, F_GETFL);
  if (regular && flags != -1 && (flags & O_ACCMODE) == O_RDWR && (flags & O_APPEND) == 0) return;
  end_with(Ending::bad_stream,
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
      if (arrays.size() == most_arrays) end_with(Ending::bad_stream, "the stream: too many arrays");
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

}  // namespace
}  // namespace noli::series

int main(int argc, char** argv) {
  using namespace noli::series;
  if (argc != 2 || std::string_view(argv[1]) != "write") {
    end_with(Ending::bad_stream, "usage: noli_series write <STREAM 1<>FILE.h5 (noli starts it by itself)");
  }
  std::signal(SIGXFSZ, SIG_IGN);  // so that write() fails at the size limit instead
  std::set_terminate([] { end_with(Ending::failure, "internal error"); });
  limit_memory();
  try {
    write();
  } catch (const std::bad_alloc&) {
    end_with(Ending::failure, "out of memory");
  }
  ::_exit(static_cast<int>(Ending::written));  // HDF5 has nothing left to write
}
