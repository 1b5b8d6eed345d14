// SPDX-License-Identifier: Apache-2.0
//
// Tests frames of HDF5: VTKHDF as h5py writes it, series.h5 of a run, and files that are damaged or hostile.
#ifdef NOLI_SERIES

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <limits>
#include <random>

#include "tests/app/process.h"
#include "tests/app/runs/simulate_fixture.h"
#include "tests/app/worked_example.h"
#include "tests/support/vtkhdf.h"
#include "trajectory/blocks/sha256.h"

namespace noli::app_tests {
namespace {

using Words = std::vector<std::string>;
using test::VtkHdfFile;

class Hdf5Frames : public Simulate {
 protected:
  static std::string sample(const std::string& name) {
    return (fs::path(NOLI_SOURCE_DIR) / "tests" / "data" / "frames" / name).string();
  }
  std::string proof_of(const Words& frames, int code = 0) const {
    Words words = {"verify", "--force", "--proof", folder.path("p.noli")};
    words.insert(words.end(), frames.begin(), frames.end());
    const Process process = run_noli(words);
    EXPECT_EQ(process.exit_code, code) << frames[0] << process.out << process.err;
    return test::read_text(folder.path("p.noli"));
  }
  std::string good() const {
    test::write_vtkhdf(folder.path("good.vtkhdf"), {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1}, 1,
                       {{0, 1, 2}, {3, 4, 5}}, H5T_IEEE_F64LE);
    return folder.path("good.vtkhdf");
  }
  /// The good file, with one of its arrays replaced.
  std::string with(const char* name, const std::vector<double>& values, std::vector<hsize_t> shape = {},
                   hid_t type = H5T_STD_I64LE) const {
    fs::copy_file(good(), folder.path("changed.vtkhdf"), fs::copy_options::overwrite_existing);
    const hid_t file = H5Fopen(folder.path("changed.vtkhdf").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    H5Ldelete(file, name, H5P_DEFAULT);
    if (!values.empty()) {
      if (shape.empty()) shape = {values.size()};
      const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
      const hid_t id = H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      H5Dclose(id);
      H5Sclose(space);
    }
    H5Fclose(file);
    return folder.path("changed.vtkhdf");
  }
  static void expect_refused(const std::string& file, const std::string& what) {
    const Process process = run_noli({"verify", "--static", file});
    EXPECT_EQ(process.exit_code, 3) << what << process.out << process.err;
    EXPECT_NE(process.err.find(file), std::string::npos) << process.err;
    EXPECT_NE(process.err.find(what), std::string::npos) << process.err;
  }
};

TEST_F(Hdf5Frames, OfOthersHaveTheMotionOfTheirArrays) {
  const std::string expected = proof_of({sample("numpy.npz")});
  for (const char* const name : {"once.vtkhdf", "again.vtkhdf", "grid.hdf", "parts.vtkhdf"}) {
    EXPECT_TRUE(proof_of({sample(name)}) == expected) << name;
    const Json found = json_of({"verify", sample(name)}, 0);
    ASSERT_EQ(found["inputs"].size(), 1U);
    EXPECT_EQ(found["inputs"][0]["numbers"], std::string(name) == "parts.vtkhdf" ? "float32" : "float64");
    EXPECT_EQ(found["inputs"][0]["sha256"], hex(sha256(test::read_text(sample(name))))) << name;
    EXPECT_EQ(run_noli({"check", folder.path("p.noli"), sample(name)}).exit_code, 0);
    if (verified_checker_is_there()) {
      EXPECT_EQ(run_noli({"check", "--verified", folder.path("p.noli"), sample(name)}).exit_code, 0);
    }
  }
}

TEST_F(Hdf5Frames, ASeriesHasTheFramesThatAreExported) {
  const std::string run = run_path("run");
  ASSERT_EQ(run_noli({"simulate", scene(resting_bar(1, 0.25)), "-o", run}).exit_code, 0);
  const double rate = 60;
  ASSERT_EQ(run_noli({"export", run, "--fps", std::to_string(rate), "-o", folder.path("f_%03d.ply")}).exit_code, 0);
  Words exported;
  for (const auto& entry : fs::directory_iterator(folder.path(""))) {
    if (entry.path().extension() == ".ply") exported.push_back(entry.path().string());
  }
  std::ranges::sort(exported);
  const Json series = json_of({"verify", "--points", run + "/series.h5"}, 0);
  EXPECT_EQ(series["statement"]["frames"], exported.size());
  Words words = {"--points"};
  words.insert(words.end(), exported.begin(), exported.end());
  const std::string expected = proof_of(words);
  EXPECT_TRUE(proof_of({"--points", run + "/series.h5"}) == expected);
}

TEST_F(Hdf5Frames, PolygonsAreCutAsInOtherForms) {
  const VtkHdfFile file(folder.path("quad.vtkhdf"));
  file.array("VTKHDF/Points", {0, 0, 0, 1, 0, 0, 1, 1, 0.5, 0, 1, 0}, {4, 3}, H5T_IEEE_F32BE);
  file.counts("VTKHDF/NumberOfPoints", {4});
  file.group("VTKHDF/Polygons");
  file.counts("VTKHDF/Polygons/NumberOfCells", {1});
  file.counts("VTKHDF/Polygons/NumberOfConnectivityIds", {4});
  file.counts("VTKHDF/Polygons/Connectivity", {0, 1, 2, 3});
  file.counts("VTKHDF/Polygons/Offsets", {0, 4});
  H5Fflush(file.id(), H5F_SCOPE_LOCAL);
  const Process process = run_noli({"verify", "--static", folder.path("quad.vtkhdf")});
  EXPECT_EQ(process.exit_code, 0) << process.err;
  EXPECT_NE(process.out.find("1 polygon of more than three corners is cut into fans of triangles; largest "
                             "non-planarity in all frames: 0."),
            std::string::npos)
      << process.out;
  const Process refused = run_noli({"verify", "--static", "--polygons", "refuse", folder.path("quad.vtkhdf")});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("a face of 4 corners"), std::string::npos) << refused.err;
}

TEST_F(Hdf5Frames, WhatIsNotAsItMustBeIsNamed) {
  EXPECT_EQ(run_noli({"verify", "--static", good()}).exit_code, 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused(with("VTKHDF/Points", {}), "VTKHDF/Points: is not there");
  expect_refused(with("VTKHDF/Points", std::vector<double>(18, 0)), "expected real numbers of shape (points, 3)");
  expect_refused(with("VTKHDF/Points", std::vector<double>(12, 0), {4, 3}, H5T_IEEE_F64LE), "has 4 rows; expected 6");
  expect_refused(with("VTKHDF/Points", std::vector<double>(18, nan), {6, 3}, H5T_IEEE_F32LE),
                 "[0]: vertex 0: expected a finite coordinate");
  expect_refused(with("VTKHDF/NumberOfPoints", {-6}), "-6 is not a count");
  expect_refused(with("VTKHDF/NumberOfPoints", {}), "VTKHDF/NumberOfPoints: is not there");
  expect_refused(with("VTKHDF/NumberOfPoints", {6, 0}), "a different number of parts");
  expect_refused(with("VTKHDF/Polygons/Connectivity", {0, 1, 2, 3, 4, 6}), "a cell has point 6; expected 0 to 5");
  expect_refused(with("VTKHDF/Polygons/Connectivity", {0, 1, 2}), "has 3 rows; expected 6");
  expect_refused(with("VTKHDF/Polygons/Offsets", {1, 3, 6}), "begin with 1, not 0");
  expect_refused(with("VTKHDF/Polygons/Offsets", {0, 4, 3}), "ends at");
  expect_refused(with("VTKHDF/Polygons/Offsets", {0, 3, 5}), "cell 1 of type 7 has 2 points");
  expect_refused(with("VTKHDF/Polygons/NumberOfCells", {0x1p62}), "rows");
  expect_refused(with("VTKHDF/Steps/PointOffsets", {7}), "expected 6 from row 7 on");
  expect_refused(with("VTKHDF/Steps/PartOffsets", {1}), "has parts that are not there");
  expect_refused(with("VTKHDF/Steps/CellOffsets", {0, 0}), "another number of columns");
  expect_refused(folder.write("text.h5", "no HDF5"), "is not HDF5, or damaged");
  expect_refused(folder.write("empty.hdf", ""), "is not HDF5, or damaged");
  expect_refused(folder.path("missing.hdf5"), "cannot be opened");
}

/// Links and external data would have the library open other files.
TEST_F(Hdf5Frames, NothingOutsideTheFileIsRead) {
  fs::copy_file(good(), folder.path("linked.vtkhdf"));
  const hid_t file = H5Fopen(folder.path("linked.vtkhdf").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Ldelete(file, "VTKHDF/Points", H5P_DEFAULT);
  H5Lcreate_external(folder.path("good.vtkhdf").c_str(), "/VTKHDF/Points", file, "VTKHDF/Points", H5P_DEFAULT,
                     H5P_DEFAULT);
  H5Fclose(file);
  expect_refused(folder.path("linked.vtkhdf"), "VTKHDF/Points: is a soft or external link");

  fs::copy_file(good(), folder.path("external.vtkhdf"));
  const hid_t other = H5Fopen(folder.path("external.vtkhdf").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Ldelete(other, "VTKHDF/Points", H5P_DEFAULT);
  const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_external(made, "/etc/passwd", 0, 144);
  const std::array<hsize_t, 2> shape = {6, 3};
  const hid_t space = H5Screate_simple(2, shape.data(), nullptr);
  H5Dclose(H5Dcreate2(other, "VTKHDF/Points", H5T_IEEE_F64LE, space, H5P_DEFAULT, made, H5P_DEFAULT));
  H5Sclose(space);
  H5Pclose(made);
  H5Fclose(other);
  expect_refused(folder.path("external.vtkhdf"), "is in other files");
}

/// What is left out because it is a link, or reads as zeros because nobody wrote it, must not leave the rest `proved`.
TEST_F(Hdf5Frames, NothingIsLeftOutSilently) {
  const auto changed = [&](const std::function<void(hid_t)>& change) {
    fs::copy_file(good(), folder.path("changed.vtkhdf"), fs::copy_options::overwrite_existing);
    const hid_t file = H5Fopen(folder.path("changed.vtkhdf").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    change(file);
    H5Fclose(file);
    return folder.path("changed.vtkhdf");
  };
  for (const char* const part : {"VTKHDF/Polygons", "VTKHDF/Steps", "VTKHDF/Points", "VTKHDF"}) {
    expect_refused(changed([&](hid_t file) {
                     H5Lmove(file, part, file, "elsewhere", H5P_DEFAULT, H5P_DEFAULT);
                     H5Lcreate_soft("/elsewhere", file, part, H5P_DEFAULT, H5P_DEFAULT);
                   }),
                   std::string(part) + ": is a soft or external link");
  }
  expect_refused(changed([](hid_t file) {
                   H5Ldelete(file, "VTKHDF/Steps", H5P_DEFAULT),
                       H5Ldelete(file, "VTKHDF/Polygons/Connectivity", H5P_DEFAULT);
                 }),
                 "Connectivity: is not there");
  expect_refused(
      changed([](hid_t file) {
        H5Ldelete(file, "VTKHDF/Polygons/Offsets", H5P_DEFAULT);
        const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
        const hsize_t size = 3, chunk = 1;
        H5Pset_chunk(made, 1, &chunk);
        const hid_t space = H5Screate_simple(1, &size, nullptr);
        H5Dclose(H5Dcreate2(file, "VTKHDF/Polygons/Offsets", H5T_STD_I64LE, space, H5P_DEFAULT, made, H5P_DEFAULT));
        H5Sclose(space);
        H5Pclose(made);
      }),
      "VTKHDF/Polygons/Offsets: has numbers that were never written");
}

TEST_F(Hdf5Frames, WithoutNumberOfPartsNoPartIsLeftOut) {
  const auto write = [&](const std::vector<double>& part_offsets) {
    const VtkHdfFile file(folder.path("parts.vtkhdf"));
    std::vector<double> x(36, 0);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<double>(i * i % 7);
    file.array("VTKHDF/Points", x, {12, 3}, H5T_IEEE_F64LE);
    file.counts("VTKHDF/NumberOfPoints", {6, 6});
    file.group("VTKHDF/Polygons");
    file.counts("VTKHDF/Polygons/NumberOfCells", {2, 2});
    file.counts("VTKHDF/Polygons/NumberOfConnectivityIds", {6, 6});
    file.counts("VTKHDF/Polygons/Connectivity", {0, 1, 2, 3, 4, 5, 0, 1, 2, 3, 4, 5});
    file.counts("VTKHDF/Polygons/Offsets", {0, 3, 6, 0, 3, 6});
    file.group("VTKHDF/Steps");
    file.attribute("VTKHDF/Steps", "NSteps", {2});
    file.counts("VTKHDF/Steps/PartOffsets", part_offsets);
    file.counts("VTKHDF/Steps/PointOffsets", {0, 6});
    file.array("VTKHDF/Steps/CellOffsets", {0, 0, 0, 0, 0, 0, 2, 0}, {2, 4}, H5T_STD_I64LE);
    file.array("VTKHDF/Steps/ConnectivityIdOffsets", {0, 0, 0, 0, 0, 0, 6, 0}, {2, 4}, H5T_STD_I64LE);
    return folder.path("parts.vtkhdf");
  };
  expect_refused(write({0, 0}), "VTKHDF/Steps/NumberOfParts: is not there");
  EXPECT_EQ(json_of({"info", write({0, 1})}, 0)["files"][0]["frames"], 2);
}

TEST_F(Hdf5Frames, ABodyAndMeshesThatDifferMayBeHdf5) {
  const std::string obstacle = folder.write("far.obj", "v 9 9 9\nv 10 9 9\nv 9 10 9\nf 1 2 3\n");
  const Process joined = run_noli({"verify", "--body", "a=" + sample("once.vtkhdf"), "--obstacle", obstacle});
  EXPECT_EQ(joined.exit_code, 0) << joined.err;
  test::write_vtkhdf(folder.path("one.vtkhdf"), {0, 0, 0, 1, 0, 0, 0, 1, 0}, 1, {{0, 1, 2}}, H5T_IEEE_F64LE);
  const Process apart = run_noli({"verify", "--static", good(), folder.path("one.vtkhdf")});
  EXPECT_EQ(apart.exit_code, 0) << apart.err;
  EXPECT_NE(apart.out.find("2 meshes at rest"), std::string::npos) << apart.out;
}

/// An array of 10^12 numbers in a small file: chunks that were never written.
TEST_F(Hdf5Frames, AHugeArrayAllocatesNothing) {
  fs::copy_file(good(), folder.path("huge.vtkhdf"));
  const hid_t file = H5Fopen(folder.path("huge.vtkhdf").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  for (const char* const name : {"VTKHDF/Polygons/Connectivity", "VTKHDF/Polygons/NumberOfConnectivityIds"}) {
    H5Ldelete(file, name, H5P_DEFAULT);
  }
  const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
  const hsize_t huge = 1'000'000'000'000, chunk = 1000;
  H5Pset_chunk(made, 1, &chunk);
  const hid_t space = H5Screate_simple(1, &huge, nullptr);
  H5Dclose(H5Dcreate2(file, "VTKHDF/Polygons/Connectivity", H5T_STD_I64LE, space, H5P_DEFAULT, made, H5P_DEFAULT));
  H5Sclose(space);
  H5Pclose(made);
  const hsize_t one = 1;
  const hid_t single = H5Screate_simple(1, &one, nullptr);
  const hid_t count = H5Dcreate2(file, "VTKHDF/Polygons/NumberOfConnectivityIds", H5T_STD_I64LE, single, H5P_DEFAULT,
                                 H5P_DEFAULT, H5P_DEFAULT);
  const std::int64_t value = 1'000'000'000'000;
  H5Dwrite(count, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value);
  H5Dclose(count);
  H5Sclose(single);
  H5Fclose(file);
  expect_refused(folder.path("huge.vtkhdf"), "has numbers that were never written");
}

TEST_F(Hdf5Frames, WithoutTheProgramTheyAreRefused) {
  fs::create_directory(folder.path("bin"));
  ProcessOptions options;
  options.program = folder.path("bin/noli");
  fs::copy_file(NOLI_COMMAND, options.program);
  const Process process = run_noli({"verify", "--static", good()}, options);
  EXPECT_EQ(process.exit_code, 3);
  EXPECT_NE(process.err.find("is an HDF5 file; noli_series, which reads it, is missing"), std::string::npos)
      << process.err;
}

/// Flips bits and cuts the end. Whatever the library makes of it, noli answers, and says which file is at fault.
void expect_answers(std::size_t mutations) {
  const Folder folder;
  std::mt19937_64 random(28);
  std::size_t refused = 0;
  for (const char* const name : {"once.vtkhdf", "again.vtkhdf", "grid.hdf", "parts.vtkhdf"}) {
    const std::string bytes =
        test::read_text((std::filesystem::path(NOLI_SOURCE_DIR) / "tests" / "data" / "frames" / name).string());
    for (std::size_t i = 0; i < mutations; ++i) {
      std::string changed = bytes;
      for (std::size_t flips = random() % 3 + 1; flips > 0; --flips) {
        changed[random() % changed.size()] ^= static_cast<char>(1 << random() % 8);
      }
      if (random() % 8 == 0) changed.resize(random() % changed.size());
      const std::string file = folder.write("changed.vtkhdf", changed);
      const Process process = run_noli({"verify", "--no-check", "--time-limit", "20s", file});
      refused += process.exit_code == 3 ? 1 : 0;
      const bool answered = process.exit_code == 0 || process.exit_code == 1 || process.exit_code == 3;
      // The library may crash: then the program that has it is lost, and noli says so.
      const bool lost =
          process.exit_code == 4 && process.err.find("noli_series failed on " + file) != std::string::npos;
      EXPECT_TRUE(answered || lost) << name << " " << i << " " << process.exit_code << process.err;
      EXPECT_EQ(process.exit_code >= 3, process.err.find(file) != std::string::npos) << process.err;
    }
  }
  EXPECT_GT(refused, 0U);
}

TEST(DamagedHdf5, AlwaysGetsAnAnswer) { expect_answers(40); }
TEST(DamagedHdf5, SlowAlwaysGetsAnAnswer) { expect_answers(200); }

}  // namespace
}  // namespace noli::app_tests

#endif
