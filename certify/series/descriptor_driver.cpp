// SPDX-License-Identifier: Apache-2.0
#include "certify/series/descriptor_driver.h"

#if __has_include(<H5FDdevelop.h>)  // HDF5 1.13 and later
#include <H5FDdevelop.h>
#endif
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <iterator>
#include <limits>
#include <new>

namespace noli::series {
namespace {

int descriptor = -1;
void (*lost)(int) = nullptr;

/// The library's handle of an open file; its own part comes first.
struct File {
  H5FD_t pub{};
  haddr_t allocated = 0;
};

File& of(H5FD_t* file) { return *reinterpret_cast<File*>(file); }
const File& of(const H5FD_t* file) { return *reinterpret_cast<const File*>(file); }

haddr_t size() {
  struct stat status = {};
  if (::fstat(descriptor, &status) != 0) lost(errno);
  return static_cast<haddr_t>(status.st_size);
}

/// Moves all bytes, by pread or pwrite; returns how many were moved.
template <class Bytes, class Move>
std::size_t move_all(Move move, haddr_t at, std::size_t count, Bytes* bytes) {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t moved = move(descriptor, bytes + done, count - done, static_cast<off_t>(at + done));
    if (moved < 0 && errno == EINTR) continue;
    if (moved < 0) lost(errno);
    if (moved == 0) break;
    done += static_cast<std::size_t>(moved);
  }
  return done;
}

H5FD_t* open_it(const char* /*name*/, unsigned flags, hid_t /*access*/, haddr_t /*greatest*/) {
  if ((flags & H5F_ACC_TRUNC) != 0 && ::ftruncate(descriptor, 0) != 0) lost(errno);
  auto* file = new (std::nothrow) File;
  return file == nullptr ? nullptr : &file->pub;
}

herr_t close_it(H5FD_t* file) {
  delete &of(file);
  return 0;
}

herr_t what_it_can(const H5FD_t* /*file*/, unsigned long* flags) {
  if (flags != nullptr) {
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA;
  }
  return 0;
}

haddr_t allocated(const H5FD_t* file, H5FD_mem_t /*what*/) { return of(file).allocated; }

herr_t allocate(H5FD_t* file, H5FD_mem_t /*what*/, haddr_t end) {
  of(file).allocated = end;
  return 0;
}

haddr_t end_of_file(const H5FD_t* /*file*/, H5FD_mem_t /*what*/) { return size(); }

/// Beyond its end a file reads as zeros.
herr_t read_it(H5FD_t* /*file*/, H5FD_mem_t /*what*/, hid_t /*how*/, haddr_t at, std::size_t count, void* bytes) {
  auto* to = static_cast<char*>(bytes);
  const std::size_t done = move_all(::pread, at, count, to);
  std::fill(to + done, to + count, '\0');
  return 0;
}

herr_t write_it(H5FD_t* /*file*/, H5FD_mem_t /*what*/, hid_t /*how*/, haddr_t at, std::size_t count,
                const void* bytes) {
  if (move_all(::pwrite, at, count, static_cast<const char*>(bytes)) < count) lost(ENOSPC);
  return 0;
}

herr_t cut(H5FD_t* file, hid_t /*how*/, hbool_t /*closing*/) {
  if (::ftruncate(descriptor, static_cast<off_t>(of(file).allocated)) != 0) lost(errno);
  return 0;
}

hid_t registered() {
  static const H5FD_class_t driver = [] {
    H5FD_class_t d{};
#ifdef H5FD_CLASS_VERSION
    d.version = H5FD_CLASS_VERSION;
    d.value = static_cast<H5FD_class_value_t>(600);  // values from 512 on are free for any use
#endif
    d.name = "noli_descriptor";
    d.maxaddr = static_cast<haddr_t>(std::numeric_limits<off_t>::max());
    d.fc_degree = H5F_CLOSE_WEAK;
    d.open = open_it;
    d.close = close_it;
    d.query = what_it_can;
    d.get_eoa = allocated;
    d.set_eoa = allocate;
    d.get_eof = end_of_file;
    d.read = read_it;
    d.write = write_it;
    d.truncate = cut;
    constexpr std::array<H5FD_mem_t, H5FD_MEM_NTYPES> map = H5FD_FLMAP_DICHOTOMY;
    std::copy(map.begin(), map.end(), std::begin(d.fl_map));
    return d;
  }();
  return H5FDregister(&driver);
}

}  // namespace

bool use_descriptor(hid_t access, int file, void (*on_loss)(int)) {
  descriptor = file;
  lost = on_loss;
  const hid_t driver = registered();
  return driver >= 0 && H5Pset_driver(access, driver, nullptr) >= 0;
}

}  // namespace noli::series
