// SPDX-License-Identifier: Apache-2.0
//
// Writes ZIP archives of any size as Python's zipfile does. What repeats is given once, and zeros that repeat are holes
// in the file.
#pragma once

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/numpy.h"

namespace noli::test {

/// These bytes, so many times.
struct ZipPart {
  std::string bytes;
  std::uint64_t times = 1;
};

/// A member. The numbers are what the archive says of it: a test may change them between add() and finish().
struct ZipMember {
  std::string name;
  std::uint64_t size = 0, packed = 0, offset = 0;
  std::uint32_t crc = 0;
  std::uint16_t method = 0, flags = 0;
};

class ZipWriter {
 public:
  explicit ZipWriter(const std::filesystem::path& path) : file_(path, std::ios::binary) {}

  /// The result stays valid until the next add().
  ZipMember& add(const std::string& name, const std::vector<ZipPart>& parts, bool deflated = false) {
    ZipMember member{name, 0, 0, at_, 0, static_cast<std::uint16_t>(deflated ? Z_DEFLATED : 0), 0};
    const auto header = static_cast<std::uint64_t>(local_header(member).size());
    seek(at_ + header);
    for (const ZipPart& part : parts) {
      add_sum(member, part);
      member.packed += write(deflated ? deflate_part(part.bytes) : part.bytes, part.times);
    }
    if (deflated) member.packed += write(std::string("\3\0", 2), 1);  // a last block, without bytes
    members_.push_back(member);
    return members_.back();
  }

  /// Writes the directory, its end, and the headers of the members.
  void finish() {
    std::string directory;
    for (const ZipMember& member : members_) directory += entry(member);
    finish(directory, members_.size());
  }
  /// The same with this directory.
  void finish(const std::string& directory, std::uint64_t entries) {
    const std::uint64_t begin = at_;
    write(directory, 1);
    if (begin > zip64_from || entries > 0xffff) {
      const std::uint64_t record = at_;
      write("PK\6\6" + little_endian(std::uint64_t{44}) + u16(45) + u16(45) + u32(0) + u32(0) + little_endian(entries) +
                little_endian(entries) + little_endian(std::uint64_t{directory.size()}) + little_endian(begin),
            1);
      write("PK\6\7" + u32(0) + little_endian(record) + u32(1), 1);
    }
    const std::uint64_t count = std::min<std::uint64_t>(entries, 0xffff);
    write("PK\5\6" + u16(0) + u16(0) + u16(count) + u16(count) + u32(directory.size()) +
              u32(std::min<std::uint64_t>(begin, 0xffffffff)) + u16(0),
          1);
    for (const ZipMember& member : members_) {
      seek(member.offset);
      file_ << local_header(member);
    }
    file_.close();
  }

  /// Writes these bytes so many times, and returns how many bytes these are.
  std::uint64_t write(const std::string& bytes, std::uint64_t times) {
    const std::uint64_t all = bytes.size() * times;
    if (times > 1 && bytes.find_first_not_of('\0') == std::string::npos) {
      seek(at_ + all);
      return all;
    }
    for (std::uint64_t i = 0; i < times; ++i) file_ << bytes;
    at_ += all;
    return all;
  }

  /// The directory's entry.
  static std::string entry(const ZipMember& member) {
    std::string extra;
    if (member.size > zip64_from || member.packed > zip64_from) {
      extra += little_endian(member.size) + little_endian(member.packed);
    }
    const bool large = !extra.empty();
    if (member.offset > zip64_from) extra += little_endian(member.offset);
    if (!extra.empty()) extra = u16(1) + u16(extra.size()) + extra;
    return "PK\1\2" + u16(45) + u16(45) + common(member, large) + u16(member.name.size()) + u16(extra.size()) + u16(0) +
           u16(0) + u16(0) + u32(0) + u32(member.offset > zip64_from ? 0xffffffff : member.offset) + member.name +
           extra;
  }

 private:
  static constexpr std::uint64_t zip64_from = 0x7fffffff;  ///< Python's limit

  static std::string u16(std::uint64_t n) { return little_endian(static_cast<std::uint16_t>(n)); }
  static std::string u32(std::uint64_t n) { return little_endian(static_cast<std::uint32_t>(n)); }

  static std::string common(const ZipMember& member, bool large) {
    return u16(member.flags) + u16(member.method) + u32(0) + u32(member.crc) + u32(large ? 0xffffffff : member.packed) +
           u32(large ? 0xffffffff : member.size);
  }
  /// With 64 bits for the sizes, as numpy asks for.
  static std::string local_header(const ZipMember& member) {
    return "PK\3\4" + u16(45) + common(member, true) + u16(member.name.size()) + u16(20) + member.name + u16(1) +
           u16(16) + little_endian(member.size) + little_endian(member.packed);
  }

  static void add_sum(ZipMember& member, const ZipPart& part) {
    const auto* const bytes = reinterpret_cast<const Bytef*>(part.bytes.data());
    std::uint64_t length = part.bytes.size();
    std::uint64_t sum = ::crc32(0, bytes, static_cast<uInt>(length)), all = member.crc;
    member.size += length * part.times;
    for (std::uint64_t times = part.times; times > 0; times /= 2, length *= 2) {
      if (times % 2 == 1) all = ::crc32_combine(all, sum, static_cast<z_off_t>(length));
      sum = ::crc32_combine(sum, sum, static_cast<z_off_t>(length));
    }
    member.crc = static_cast<std::uint32_t>(all);
  }

  /// Blocks of their own: they may be repeated.
  static std::string deflate_part(const std::string& bytes) {
    z_stream stream{};
    deflateInit2(&stream, 1, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY);
    std::string packed(deflateBound(&stream, static_cast<uLong>(bytes.size())) + 64, 0);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    deflate(&stream, Z_FULL_FLUSH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
  }

  void seek(std::uint64_t at) {
    at_ = at;
    file_.seekp(static_cast<std::streamoff>(at));
  }
  std::ofstream file_;
  std::uint64_t at_ = 0;
  std::vector<ZipMember> members_;
};

}  // namespace noli::test
