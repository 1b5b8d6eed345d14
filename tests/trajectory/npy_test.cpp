// SPDX-License-Identifier: Apache-2.0
//
// Arrays of numpy: each type, byte order and order of indices, and what is no array.
#include "trajectory/formats/arrays/npy.h"

#include <cstdint>
#include <limits>

#include "support.h"
#include "tests/support/numpy.h"
#include "tests/support/text_bytes.h"
#include "trajectory/formats/arrays/array_values.h"

namespace noli {
namespace {

using test::npy;
using test::NumpyArray;
using test::TextBytes;
using testing::input_error;

template <class Number>
std::vector<Number> read(const std::string& bytes, std::string* type = nullptr) {
  TextBytes stream(bytes);
  const NpyHeader header = read_npy_header(stream, "a").value();
  if (header.refusal.empty()) {
    EXPECT_EQ(header.bytes(), bytes.size());
  }
  if (type != nullptr) *type = header.text();
  if constexpr (std::is_same_v<Number, double>) return reals_of(stream, header, "a");
  if constexpr (!std::is_same_v<Number, double>) return integers_of(stream, header, "a");
}

TEST(Npy, HasRealNumbersOfEachTypeAndOrder) {
  const std::vector<double> numbers = {0.5, -1, 3, 1e10, -0.25, 0x1p-100};
  for (const std::string type : {"<f8", ">f8", "<f4", ">f4"}) {
    for (const bool fortran : {false, true}) {
      std::string text;
      EXPECT_EQ(read<double>(NumpyArray{type, {2, 3}, numbers, fortran}.bytes(), &text), numbers) << type;
      EXPECT_EQ(text, (type[2] == '8' ? "float64" : "float32") + std::string(" (2, 3)"));
    }
  }
}

TEST(Npy, HasIntegersOfEachTypeAndOrder) {
  const std::vector<double> small = {0, 1, 2, 100, 5, 127};
  const std::vector<std::int64_t> expected(small.begin(), small.end());
  for (const char order : {'<', '>', '|', '='}) {
    for (const std::string kind : {"i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8"}) {
      for (const bool fortran : {false, true}) {
        EXPECT_EQ(read<std::int64_t>(NumpyArray{order + kind, {3, 2}, small, fortran}.bytes()), expected)
            << order << kind;
      }
    }
  }
  EXPECT_EQ(read<std::int64_t>(NumpyArray{"<i2", {3}, {-1, -32768, 7}}.bytes()),
            (std::vector<std::int64_t>{-1, -32768, 7}));
  const std::string large = npy("{'descr': '<u8', 'fortran_order': False, 'shape': (1,), }", std::string(8, '\xff'));
  EXPECT_EQ(input_error([&] { read<std::int64_t>(large); }), "a: has the index 18446744073709551615");
}

TEST(Npy, HasThreeVersionsOfHeaders) {
  const std::string dictionary = R"({"shape":(2,), 'fortran_order' : False,'descr':'<f8'})";
  for (const int version : {1, 2, 3}) EXPECT_EQ(read<double>(npy(dictionary, std::string(16, 0), version)).size(), 2U);
  EXPECT_EQ(read<double>(npy("{'descr': '<f8', 'fortran_order': False, 'shape': (), }", std::string(8, 0))).size(), 1U);
  EXPECT_EQ(read<double>(npy("{'descr': '<f8', 'fortran_order': False, 'shape': (0L, 3L), }", "")).size(), 0U);
}

TEST(Npy, ALongArrayIsReadInParts) {
  std::vector<double> numbers(5000);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = 0.5 * static_cast<double>(i);
  for (const bool fortran : {false, true})
    EXPECT_EQ(read<double>(NumpyArray{">f4", {1000, 5}, numbers, fortran}.bytes()), numbers);
}

TEST(Npy, SaysWhatIsNoArray) {
  const auto refusal = [](const std::string& bytes) { return input_error([&] { read<double>(bytes); }); };
  const auto of = [&](const std::string& dictionary) { return refusal(npy(dictionary, "")); };
  EXPECT_EQ(refusal("PK\3\4 and so on"), "a: is not an array of numpy: it does not begin with \\x93NUMPY");
  EXPECT_EQ(refusal("\x93NUM"), "a: is not an array of numpy: it does not begin with \\x93NUMPY");
  EXPECT_EQ(refusal(npy("{}", "", 4)), "a: has version 4.0 of the format; expected 1.0 to 3.0");
  EXPECT_EQ(of("{}"), "a: the header lacks one of descr, fortran_order, shape");
  EXPECT_EQ(of("{'descr': '|O', 'fortran_order': False, 'shape': (1,)}"),
            "a: is an array of type '|O'; expected float32, float64 or integers");
  EXPECT_EQ(of("{'descr': '<f2', 'fortran_order': False, 'shape': (1,)}"),
            "a: is an array of type '<f2'; expected float32, float64 or integers");
  EXPECT_EQ(of("{'descr': '<c8', 'fortran_order': False, 'shape': (1,)}"),
            "a: is an array of type '<c8'; expected float32, float64 or integers");
  EXPECT_EQ(of("{'descr': [('x', '<f8')], 'fortran_order': False, 'shape': (1,)}"),
            "a: is an array of records; expected one of numbers");
  EXPECT_EQ(of("{'descr': '<f8', 'fortran_order': 0, 'shape': (1,)}"), "a: fortran_order is neither True nor False");
  EXPECT_EQ(of("{'descr': '<f8', 'fortran_order': False, 'shape': (-1,)}"),
            "a: the shape has no number before '-1,)}?'");
  EXPECT_EQ(of("{'descr': '<f8', 'fortran_order': False, 'shape': (1,), 'more': 1}"),
            "a: the header has the key 'more'; expected descr, fortran_order, shape, once each");
  EXPECT_EQ(of("{'descr': '<f8', 'descr': '<f8'}"),
            "a: the header has the key 'descr'; expected descr, fortran_order, shape, once each");
  EXPECT_EQ(of("{'descr': '<f8', 'fortran_order': False, 'shape': (1,)} x"), "a: something follows the header");
  EXPECT_NE(of("descr").find("is not a dictionary of three keys"), std::string::npos);
  EXPECT_EQ(of("{'descr"), "a: the header ends within a text");
}

/// What is not there is not allocated either: these end at once.
TEST(Npy, BelievesNoLength) {
  const auto of_shape = [](const std::string& shape) {
    return input_error([&] {
      TextBytes stream(npy("{'descr': '<f8', 'fortran_order': False, 'shape': " + shape + ", }", std::string(800, 0)));
      const NpyHeader header = read_npy_header(stream, "a").value();
      reals_of(stream, header, "a");
    });
  };
  EXPECT_EQ(of_shape("(1000000000000,)"), "a: ends before its last number; the file was cut off");
  EXPECT_EQ(of_shape("(1000000, 1000000)"), "a: ends before its last number; the file was cut off");
  EXPECT_EQ(of_shape("(4294967296, 4294967296, 3)"), "a: has the shape (4294967296, 4294967296, 3)");
  EXPECT_EQ(of_shape("(99999999999999999999,)"), "a: the shape has no number before '99999999999999999999,), }?'");
  const std::string long_header = "\x93NUMPY\2" + std::string(1, '\0') + std::string(4, '\xff');
  EXPECT_EQ(input_error([&] {
              TextBytes stream(long_header);
              read_npy_header(stream, "a");
            }),
            "a: has a header of 4294967295 bytes");
}

TEST(Npy, CutOffAnywhereItIsRefused) {
  const std::string whole = NumpyArray{"<f4", {2, 3}, {0, 1, 2, 3, 4, 5}}.bytes();
  for (std::size_t size = 1; size < whole.size(); ++size) {
    EXPECT_NE(input_error([&] {
                TextBytes stream(whole.substr(0, size));
                const auto header = read_npy_header(stream, "a");
                reals_of(stream, header.value(), "a");
              }),
              "")
        << size;
  }
  TextBytes nothing("");
  EXPECT_FALSE(read_npy_header(nothing, "a"));
}

}  // namespace
}  // namespace noli
