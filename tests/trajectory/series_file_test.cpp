// SPDX-License-Identifier: Apache-2.0
#include "noli/trajectory/series_file.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <system_error>

#include "support.h"

#ifdef NOLI_WITH_HDF5
#include <hdf5.h>
#endif

namespace noli {
namespace {

#ifndef NOLI_WITH_HDF5

TEST(SeriesFile, SaysWhatIsMissing) {
  EXPECT_FALSE(SeriesFile::available());
  const test::TemporaryFolder folder;
  try {
    SeriesFile(folder / "series.h5");
    ADD_FAILURE() << "it was made";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::not_supported);
    EXPECT_NE(std::string(error.what()).find("built without HDF5"), std::string::npos) << error.what();
  }
}

#else

/// An array as HDF5 gives it.
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
  test::TemporaryFolder folder;
  std::filesystem::path path = folder / "series.h5";
};

TEST_F(Series, IsReadBackPlain) {
  const std::vector<double> energies{0.1, -2, 1e300};
  const std::vector<std::int64_t> counts{1, -(std::int64_t{1} << 62), 3, 4, 5, 6};
  SeriesFile file(path);
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
  SeriesFile file(path);
  file.declare("positions", "m", {3, 2, 3});
  file.write_rows("positions", 0, first);
  file.write_rows("positions", 2, last);
  file.write_rows("positions", 1, first);
  EXPECT_THROW(file.write_rows("positions", 3, first), std::system_error) << "no such row";
  EXPECT_THROW(file.write_rows("positions", 1, std::span(first).first(5)), std::system_error) << "too short";
  EXPECT_THROW(file.write_rows("velocities", 1, first), std::system_error) << "no such array";
  file.close();
  const auto positions = read_array<double>(path, "positions", H5T_NATIVE_DOUBLE);
  EXPECT_EQ(positions.shape, (std::vector<hsize_t>{3, 2, 3}));
  EXPECT_EQ(positions.values, (std::vector<double>{1, 2, 3, 4, 5, 6, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
}

TEST_F(Series, BySeveralRowsAtOnce) {
  const std::vector<double> values{1, 2, 3, 4, 5, 6, 7, 8};
  SeriesFile file(path);
  file.declare("positions", "m", {5, 2});
  file.write_rows("positions", 1, values);
  file.write_rows("positions", 0, std::span(values).first(2));
  EXPECT_THROW(file.write_rows("positions", 2, values), std::system_error) << "one row too many";
  EXPECT_THROW(file.write_rows("positions", 0, std::span(values).first(3)), std::system_error) << "half a row";
  file.close();
  EXPECT_EQ(read_array<double>(path, "positions", H5T_NATIVE_DOUBLE).values,
            (std::vector<double>{1, 2, 1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST_F(Series, IsThereWhenItIsClosed) {
  {
    SeriesFile file(path);
    file.add("a", "1", std::span<const double>());
  }
  EXPECT_TRUE(folder.names().empty()) << "nothing is left of a file that was given up";
  SeriesFile file(path);
  file.close();
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"series.h5"}));
}

TEST_F(Series, Refuses) {
  const std::vector<double> values{1, 2, 3};
  SeriesFile file(path);
  file.add("a", "1", values);
  EXPECT_THROW(file.add("a", "1", values), std::system_error) << "the name is not new";
  EXPECT_THROW(file.add("a/b", "1", values), std::system_error) << "an array is no group";
  EXPECT_THROW(file.add("c", "1", values, {2, 2}), std::logic_error);
  EXPECT_THROW(SeriesFile(folder / "absent/series.h5"), std::system_error);
  EXPECT_TRUE(SeriesFile::available());
}

#endif

}  // namespace
}  // namespace noli
