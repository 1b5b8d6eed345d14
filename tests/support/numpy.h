// SPDX-License-Identifier: Apache-2.0
//
// Writes arrays as numpy does (numpy/lib/format.py), and archives of them with stored members.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace noli::test {

template <class T>
std::string little_endian(T value) {
  std::string bytes(sizeof value, 0);
  std::memcpy(bytes.data(), &value, sizeof value);
  if (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

/// An array with this dictionary and these bytes; they need not fit.
inline std::string npy(std::string dictionary, const std::string& numbers, int version = 1) {
  dictionary += '\n';
  const std::string length = version == 1 ? little_endian(static_cast<std::uint16_t>(dictionary.size()))
                                          : little_endian(static_cast<std::uint32_t>(dictionary.size()));
  return "\x93NUMPY" + std::string{static_cast<char>(version), '\0'} + length + dictionary + numbers;
}

/// One number: "<f8", ">i4", ...
inline std::string number_bytes(const std::string& type, double x) {
  std::string bytes;
  const bool is_signed = type[1] == 'i';
  switch (type[2]) {
    case '1':
      bytes = is_signed ? little_endian(static_cast<std::int8_t>(x)) : little_endian(static_cast<std::uint8_t>(x));
      break;
    case '2':
      bytes = is_signed ? little_endian(static_cast<std::int16_t>(x)) : little_endian(static_cast<std::uint16_t>(x));
      break;
    case '4':
      bytes = type[1] == 'f' ? little_endian(static_cast<float>(x))
              : is_signed    ? little_endian(static_cast<std::int32_t>(x))
                             : little_endian(static_cast<std::uint32_t>(x));
      break;
    default:
      bytes = type[1] == 'f' ? little_endian(x)
              : is_signed    ? little_endian(static_cast<std::int64_t>(x))
                             : little_endian(static_cast<std::uint64_t>(x));
  }
  if (type[0] == '>') std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

struct NumpyArray {
  std::string type = "<f8";
  std::vector<std::size_t> shape;
  std::vector<double> numbers;  ///< the last index runs fastest
  bool fortran = false;

  std::string bytes() const {
    std::string dimensions;
    for (const std::size_t n : shape) dimensions += std::to_string(n) + ", ";
    std::string data;
    for (std::size_t i = 0; i < numbers.size(); ++i) data += number_bytes(type, numbers[fortran ? in_c(i) : i]);
    return npy("{'descr': '" + type + "', 'fortran_order': " + (fortran ? "True" : "False") + ", 'shape': (" +
                   dimensions + "), }",
               data);
  }

 private:
  /// Where the number is in the order of C that is the i-th in the order of Fortran.
  std::size_t in_c(std::size_t i) const {
    std::vector<std::size_t> index;
    for (const std::size_t n : shape) {
      index.push_back(i % n);
      i /= n;
    }
    std::size_t at = 0;
    for (std::size_t k = 0; k < shape.size(); ++k) at = at * shape[k] + index[k];
    return at;
  }
};

inline std::uint32_t crc32(const std::string& bytes) {
  std::uint32_t crc = 0xffffffff;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xedb88320 : 0);
  }
  return ~crc;
}

/// A ZIP archive of members, not deflated.
inline std::string stored_zip(const std::vector<std::pair<std::string, std::string>>& members) {
  const auto u16 = [](std::size_t n) { return little_endian(static_cast<std::uint16_t>(n)); };
  const auto u32 = [](std::size_t n) { return little_endian(static_cast<std::uint32_t>(n)); };
  std::string file, directory;
  for (const auto& [name, bytes] : members) {
    const std::string common = u16(20) + u16(0) + u16(0) + u32(0) + little_endian(crc32(bytes)) + u32(bytes.size()) +
                               u32(bytes.size()) + u16(name.size()) + u16(0);
    directory += "PK\1\2" + u16(20) + common + u16(0) + u16(0) + u16(0) + u32(0) + u32(file.size()) + name;
    file += "PK\3\4" + common + name + bytes;
  }
  return file + directory + "PK\5\6" + u16(0) + u16(0) + u16(members.size()) + u16(members.size()) +
         u32(directory.size()) + u32(file.size()) + u16(0);
}

}  // namespace noli::test
