// SPDX-License-Identifier: Apache-2.0
//
// Tests files of series, read back by HDF5's own functions, and the effect of a noli_series that fails.
#include "certify/runs/series_file.h"

#ifdef NOLI_SERIES

#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <numeric>
#include <stdexcept>

#include <noli/errors.h>
#include "app/exit_code.h"
#include "tests/app/process.h"
#include "tests/support/temporary_folder.h"

namespace noli::app_tests {
namespace {

/// An array as read by HDF5.
template <class T>
struct Array {
  std::vector<hsize_t> shape;
  std::vector<T> values;
  std::string unit;
  H5T_class_t type;
  H5D_layout_t layout;
  int filters;
};

std::string read_unit(hid_t dataset) {
  const hid_t attribute = H5Aopen(dataset, "unit", H5P_DEFAULT), type = H5Aget_type(attribute);
  char* text = nullptr;
  EXPECT_GE(H5Aread(attribute, type, static_cast<void*>(&text)), 0);
  std::string unit = text;
  H5free_memory(text);
  H5Tclose(type);
  H5Aclose(attribute);
  return unit;
}

template <class T>
Array<T> read_array(const std::filesystem::path& path, const std::string& name, hid_t native) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t dataset = H5Dopen2(file, name.c_str(), H5P_DEFAULT), space = H5Dget_space(dataset);
  const hid_t type = H5Dget_type(dataset), properties = H5Dget_create_plist(dataset);
  Array<T> array;
  array.shape.resize(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, array.shape.data(), nullptr);
  array.values.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  EXPECT_GE(H5Dread(dataset, native, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()), 0);
  array.unit = read_unit(dataset);
  array.type = H5Tget_class(type);
  array.layout = H5Pget_layout(properties);
  array.filters = H5Pget_nfilters(properties);
  for (const hid_t id : {properties, type}) H5Idec_ref(id);
  H5Sclose(space);
  H5Dclose(dataset);
  H5Fclose(file);
  return array;
}

class Series : public ::testing::Test {
 protected:
  /// Ignores SIGPIPE, as noli does at its start.
  Series() { std::signal(SIGPIPE, SIG_IGN); }

  test::TemporaryFolder folder;
  std::filesystem::path path = folder / "series.h5";

  static SeriesProgram program(const std::filesystem::path& file = NOLI_SERIES) {
    SeriesProgram program;
    program.file = file;
    return program;
  }
  /// A shell script in place of noli_series.
  SeriesProgram script(const std::string& lines) const {
    const std::filesystem::path file = folder.write("script", "#!/bin/sh\n" + lines + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    return program(file);
  }
  /// Writes a megabyte and returns the message of the WriteError.
  std::string failure(const SeriesProgram& of) const {
    try {
      SeriesFile file(path, of);
      file.add("a", "1", std::vector<double>(1 << 17, 1));
      file.close();
    } catch (const WriteError& error) {
      return error.what();
    }
    ADD_FAILURE() << "it was written";
    return "";
  }
  void expect_nothing_left() const {
    for (const std::string& name : folder.names()) EXPECT_EQ(name.find("series"), std::string::npos) << name;
  }
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(Series, IsReadBackPlain) {
  const std::vector<double> energies{0.1, -2, 1e300};
  const std::vector<std::int64_t> counts{1, -(std::int64_t{1} << 62), 3, 4, 5, 6};
  SeriesFile file(path, program());
  file.add("energy/kinetic", "J", energies);
  file.add("energy/bending", "J", energies);
  file.add("events", "1", counts, {2, 3});
  file.add("nothing", "m/s²", std::span<const double>());
  file.close();
  const auto kinetic = read_array<double>(path, "energy/kinetic", H5T_NATIVE_DOUBLE);
  EXPECT_EQ(kinetic.shape, (std::vector<hsize_t>{3}));
  EXPECT_EQ(kinetic.values, energies);
  EXPECT_EQ(kinetic.unit, "J");
  EXPECT_EQ(kinetic.type, H5T_FLOAT);
  EXPECT_EQ(kinetic.layout, H5D_CONTIGUOUS);
  EXPECT_EQ(kinetic.filters, 0);
  const auto events = read_array<std::int64_t>(path, "events", H5T_NATIVE_INT64);
  EXPECT_EQ(events.shape, (std::vector<hsize_t>{2, 3}));
  EXPECT_EQ(events.values, counts);
  EXPECT_EQ(events.type, H5T_INTEGER);
  const auto nothing = read_array<double>(path, "nothing", H5T_NATIVE_DOUBLE);
  EXPECT_EQ(nothing.shape, (std::vector<hsize_t>{0}));
  EXPECT_EQ(nothing.unit, "m/s²");
}

TEST_F(Series, ByRows) {
  const std::vector<double> first{1, 2, 3, 4, 5, 6}, last{7, 8, 9, 10, 11, 12};
  SeriesFile file(path, program());
  file.declare("positions", "m", {3, 2, 3});
  file.write_rows("positions", 0, first);
  file.write_rows("positions", 2, last);
  file.write_rows("positions", 1, first);
  EXPECT_THROW(file.write_rows("positions", 3, first), std::logic_error) << "no such row";
  EXPECT_THROW(file.write_rows("positions", 1, std::span(first).first(5)), std::logic_error) << "too short";
  EXPECT_THROW(file.write_rows("velocities", 1, first), std::logic_error) << "no such array";
  file.close();
  const auto positions = read_array<double>(path, "positions", H5T_NATIVE_DOUBLE);
  EXPECT_EQ(positions.shape, (std::vector<hsize_t>{3, 2, 3}));
  EXPECT_EQ(positions.values, (std::vector<double>{1, 2, 3, 4, 5, 6, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
}

TEST_F(Series, BySeveralRowsAtOnce) {
  const std::vector<double> values{1, 2, 3, 4, 5, 6, 7, 8};
  SeriesFile file(path, program());
  file.declare("positions", "m", {5, 2});
  file.write_rows("positions", 1, values);
  file.write_rows("positions", 0, std::span(values).first(2));
  EXPECT_THROW(file.write_rows("positions", 2, values), std::logic_error) << "one row too many";
  EXPECT_THROW(file.write_rows("positions", 0, std::span(values).first(3)), std::logic_error) << "half a row";
  file.close();
  EXPECT_EQ(read_array<double>(path, "positions", H5T_NATIVE_DOUBLE).values,
            (std::vector<double>{1, 2, 1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST_F(Series, IsThereWhenItIsClosed) {
  {
    SeriesFile file(path, program());
    file.add("a", "1", std::span<const double>());
  }
  EXPECT_TRUE(folder.names().empty()) << "nothing is left of a file that was given up";
  SeriesFile file(path, program());
  file.close();
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"series.h5"}));
}

TEST_F(Series, Refuses) {
  const std::vector<double> values{1, 2, 3};
  SeriesFile file(path, program());
  file.add("a", "1", values);
  EXPECT_THROW(file.add("a", "1", values), std::logic_error) << "the name is not new";
  EXPECT_THROW(file.add("a/b", "1", values), std::logic_error) << "an array is not a group";
  EXPECT_THROW(file.add("c", "1", values, {2, 2}), std::logic_error);
  EXPECT_THROW(SeriesFile(folder / "absent/series.h5", program()), std::system_error);
}

TEST_F(Series, OfRowsLargerThanAPiece) {
  constexpr std::uint64_t vertices = 100'000, row = 3 * vertices;
  std::vector<double> first(row), both(2 * row);
  std::iota(first.begin(), first.end(), 0.5);
  std::iota(both.begin(), both.end(), -1e6);
  SeriesFile file(path, program());
  file.declare("positions", "m", {3, vertices, 3});
  file.declare("wide", "1", {2, row});
  file.write_rows("positions", 0, first);
  file.write_rows("positions", 1, both);
  file.write_rows("wide", 0, both);
  file.close();
  std::vector<double> all = first;
  all.insert(all.end(), both.begin(), both.end());
  EXPECT_TRUE(read_array<double>(path, "positions", H5T_NATIVE_DOUBLE).values == all);
  EXPECT_TRUE(read_array<double>(path, "wide", H5T_NATIVE_DOUBLE).values == both);
}

// --- Names -----------------------------------------------------------------------------------------------------------

TEST_F(Series, WhatAKilledRunLeftIsReplaced) {
  folder.write("series.h5.part", "half a file");
  folder.write("series.h5", "an old one");
  SeriesFile file(path, program());
  file.add("a", "1", std::vector<double>{1});
  EXPECT_EQ(test::read_text(path), "an old one");
  file.close();
  EXPECT_EQ(read_array<double>(path, "a", H5T_NATIVE_DOUBLE).values, (std::vector<double>{1}));
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"series.h5"}));
}

TEST_F(Series, ALinkIsNotFollowed) {
  const auto target = folder.write("precious", "theirs");
  std::filesystem::create_symlink(target, path.string() + ".part");
  EXPECT_THROW(SeriesFile(path, program()), InputError);
  EXPECT_EQ(test::read_text(target), "theirs");
  std::filesystem::remove(path.string() + ".part");
  std::filesystem::create_symlink(folder / "dangling", path.string() + ".part");
  EXPECT_THROW(SeriesFile(path, program()), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "dangling"));
  std::filesystem::remove(path.string() + ".part");
  std::filesystem::create_symlink(target, path);  // the link is replaced, not its target
  SeriesFile(path, program()).close();
  EXPECT_EQ(test::read_text(target), "theirs");
  EXPECT_TRUE(std::filesystem::is_regular_file(std::filesystem::symlink_status(path)));
}

TEST_F(Series, WhatTakesThePartsPlaceDoesNotTakeTheName) {
  SeriesFile file(path, program());
  std::filesystem::remove(path.string() + ".part");
  folder.write("series.h5.part", "another");
  EXPECT_THROW(file.close(), WriteError);
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"series.h5.part"}));
}

// --- Programs that fail ----------------------------------------------------------------------------------------------

/// Simulates a full disk for programs that are started while it exists.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    limit_file_size(bytes);
  }
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  struct rlimit before_ = {};
};

TEST_F(Series, AFullDiskIsNamed) {
  for (const rlim_t bytes : {0, 1, 100, 2048, 100'000, 1'000'000}) {
    const FileSizeLimit limit(bytes);
    const std::string said = failure(program());
    EXPECT_TRUE(has(said, path.string() + ": not written: File too large; ")) << said;
    EXPECT_TRUE(has(said, "make room on the disk of " + folder.path().string())) << said;
    EXPECT_TRUE(has(said, "--resume")) << said;
    expect_nothing_left();
  }
}

TEST_F(Series, AProgramThatEndsIsNamed) {
  std::signal(SIGPIPE, SIG_IGN);
  EXPECT_TRUE(has(failure(script("kill -SEGV $$")), "noli_series was ended by signal 11"));
  EXPECT_TRUE(has(failure(script("head -c 100000 >/dev/null; kill -KILL $$")), "noli_series was ended by signal 9"));
  EXPECT_TRUE(has(failure(script("echo a reason >&2; exit 4")), ": not written: a reason; "));
  EXPECT_TRUE(has(failure(script("cat >/dev/null; exit 3")), "noli_series ended with code 3"));
  EXPECT_TRUE(has(failure(script("exit 0")), "noli_series ended before all was written"));
  expect_nothing_left();
}

TEST_F(Series, AProgramThatHangsIsEnded) {
  SeriesProgram hangs = script("exec sleep 1000");
  hangs.patience = std::chrono::milliseconds(300);
  EXPECT_TRUE(has(failure(hangs), "noli_series read nothing for"));
  hangs = script("cat >/dev/null; exec sleep 1000");
  hangs.patience = std::chrono::milliseconds(300);
  EXPECT_TRUE(has(failure(hangs), "noli_series read nothing for"));
  expect_nothing_left();
}

TEST_F(Series, WhoStopsDoesNotWait) {
  SeriesProgram hangs = script("exec sleep 1000");
  const auto begin = std::chrono::steady_clock::now();
  hangs.stop = [begin] { return std::chrono::steady_clock::now() > begin + std::chrono::milliseconds(200); };
  SeriesFile file(path, hangs);
  EXPECT_THROW(file.add("a", "1", std::vector<double>(1 << 17, 1)), SeriesStopped);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST_F(Series, AProgramThatIsMissingIsNotThere) {
  EXPECT_TRUE(program().available());
  EXPECT_FALSE(program(folder / "absent").available());
  EXPECT_THROW(SeriesFile(path, program(folder / "absent")), std::system_error);
  expect_nothing_left();
}

// --- The stream of noli_series ---------------------------------------------------------------------------------------

/// The program's message about a stream, and its exit code.
std::string said_of(const test::TemporaryFolder& folder, const std::string& stream) {
  folder.write("stream", stream);
  const std::string in = (folder / "stream").string(), out = (folder / "out").string(), err = (folder / "err").string();
  const int status = std::system((std::string(NOLI_SERIES) + " write <" + in + " 1<>" + out + " 2>" + err).c_str());
  if (!WIFEXITED(status)) return "signal";
  return std::to_string(WEXITSTATUS(status)) + " " + test::read_text(err);
}

TEST_F(Series, AStreamThatIsNoneIsRefused) {
  using namespace series;
  std::string beginning, whole;
  put_beginning(beginning);
  whole = beginning;
  put_array(whole, {Type::f64, "a", "1", {2, 3}});
  put_values(whole, 0, 0, 6);
  whole += std::string(48, '\0');
  const std::string open = whole;
  put_end(whole);
  EXPECT_EQ(said_of(folder, whole), "0 ");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_TRUE(said_of(folder, whole.substr(0, size)).starts_with("3 the stream: ")) << size;
  }
  EXPECT_TRUE(has(said_of(folder, whole + "x"), "3 the stream: continues after its end"));
  const auto refused = [&](const auto& append, const std::string& problem) {
    std::string stream = open;
    append(stream);
    put_end(stream);
    const std::string said = said_of(folder, stream);
    EXPECT_TRUE(said.starts_with("3 the stream: ") && has(said, problem)) << said;
  };
  const std::uint64_t huge = ~std::uint64_t{0};
  refused(
      [](std::string& s) {
        put_array(s, {Type::f64, std::string(257, 'n'), "1", {1}});
      },
      "the length of a name 257");
  refused([](std::string& s) { put_array(s, {Type::f64, "n", "1", {}}); }, "without dimensions");
  refused([](std::string& s) { put_array(s, {static_cast<Type>(2), "n", "1", {1}}); }, "a type 2; expected at most 1");
  refused([&](std::string& s) { put_array(s, {Type::f64, "n", "1", {huge, huge}}); }, "too large");
  refused([](std::string& s) { put_values(s, 1, 0, 1); }, "array 1, which is not there");
  refused([](std::string& s) { put_values(s, 0, 0, 7); }, "values beyond the array a");
  refused([&](std::string& s) { put_values(s, 0, huge, 2); }, "values beyond the array a");
  refused([&](std::string& s) { put_values(s, 0, 0, huge); }, "a piece of 18446744073709551615");
  refused([](std::string& s) { put_values(s, 0, 1, 4); }, "neither rows of the array a nor a part of one");
  refused([](std::string& s) { put_values(s, 0, 0, 0); }, "an empty piece");
  refused([](std::string& s) { put(s, std::uint64_t{4}); }, "message 4; expected 1, 2 or 3");
  // HDF5 restricts names.
  std::string stream = open;
  put_array(stream, {Type::f64, "a", "1", {1}});
  put_end(stream);
  EXPECT_EQ(said_of(folder, stream), "4 HDF5 fails: a\n");
}

TEST_F(Series, TheProgramWritesToRegularFilesAlone) {
  const std::string program = NOLI_SERIES;
  const auto code = [](const std::string& command) { return WEXITSTATUS(std::system(command.c_str())); };
  EXPECT_EQ(code(program + " write </dev/null >" + (folder / "out").string() + " 2>/dev/null"), 3);
  EXPECT_EQ(code(program + " write </dev/null 1<>/dev/null 2>/dev/null"), 3);
  EXPECT_EQ(code(program + " 2>/dev/null"), 3);
}

}  // namespace
}  // namespace noli::app_tests

#endif
