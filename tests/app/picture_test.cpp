// SPDX-License-Identifier: Apache-2.0
//
// Tests `noli export RUN --at`: pictures.
#include "report/figures/picture.h"

#include <gtest/gtest.h>

#include "tests/app/runs/simulate_fixture.h"

namespace noli::app_tests {
namespace {

using report::draw;
using report::Picture;
using report::View;

std::array<int, 3> pixel(const Picture& picture, double right, double down) {
  const auto i = static_cast<std::size_t>(right * static_cast<double>(picture.width));
  const auto j = static_cast<std::size_t>(down * static_cast<double>(picture.height));
  const std::uint8_t* const p = &picture.bytes.at(3 * (j * picture.width + i));
  return {p[0], p[1], p[2]};
}

bool is_white(const std::array<int, 3>& p) { return p == std::array<int, 3>{255, 255, 255}; }
bool is_grey(const std::array<int, 3>& p) { return !is_white(p) && std::abs(p[0] - p[2]) < 12; }

/// Adds a square in the plane of x and z, as two triangles, with its corner at x, y.
void add_square(Frame& frame, double x, double y, double size) {
  const auto first = static_cast<VertexId>(frame.mesh.vertex_count);
  frame.mesh.vertex_count += 4;
  for (const auto& [dx, dz] : {std::pair{0.0, 0.0}, {size, 0.0}, {size, size}, {0.0, size}}) {
    frame.positions.push_back({x + dx, y, dz});
  }
  frame.mesh.faces.push_back({first, first + 1, first + 2});
  frame.mesh.faces.push_back({first, first + 2, first + 3});
}

const View front{{0, -1, 0}, {0, 0, 1}, 90};

TEST(Picture, MarksStandBeforeAllElse) {
  Frame frame;
  add_square(frame, 0, 0, 1);  // nearer to the viewer
  add_square(frame, 0, 1, 1);  // hidden by the first
  View view = front;
  const std::vector<bool> fixed(frame.mesh.vertex_count, false);
  const std::array<int, 3> plain = pixel(draw(frame, fixed, view), 0.7, 0.7);
  view.marks = {{2, 0}};  // the lower right half of the hidden square
  const std::array<int, 3> marked = pixel(draw(frame, fixed, view), 0.7, 0.7);
  EXPECT_NE(marked, plain);
  EXPECT_GT(marked[0], 2 * marked[2]);  // red
  EXPECT_GT(marked[0], 2 * marked[1]);
  view.marks = {{2, 1}};
  const std::array<int, 3> other = pixel(draw(frame, fixed, view), 0.7, 0.7);
  EXPECT_GT(other[1], 2 * other[2]);  // yellow
}

TEST(Picture, FocusFillsThePicture) {
  Frame frame;
  add_square(frame, 0, 0, 1);
  View view = front;
  view.height = 90;
  const std::vector<bool> fixed(frame.mesh.vertex_count, false);
  view.focus = report::Focus{{0, 0, 0}, 0.25};  // a corner: a quarter of the picture
  const Picture picture = draw(frame, fixed, view);
  EXPECT_FALSE(is_white(pixel(picture, 0.9, 0.1)));
  EXPECT_TRUE(is_white(pixel(picture, 0.1, 0.1)));
  EXPECT_TRUE(is_white(pixel(picture, 0.9, 0.9)));
  const std::array<int, 3> dot = pixel(picture, 0.5, 0.5);
  EXPECT_LT(dot[0] + dot[1] + dot[2], 200);
}

TEST(Picture, TheNearerOfTwoIsSeen) {
  Frame frame;
  add_square(frame, 0, 0, 1);
  add_square(frame, 0.25, 1, 0.5);  // behind it
  const std::vector<bool> free(8, false);
  const auto covered = pixel(draw(frame, free, front), 0.4, 0.55);
  EXPECT_GT(covered[2], covered[0]) << "the first colour is blue";
  frame.positions = {};
  frame.mesh = {};
  add_square(frame, 0, 0, 1);
  add_square(frame, 0.25, -1, 0.5);  // in front of it
  const auto covering = pixel(draw(frame, free, front), 0.4, 0.55);
  EXPECT_GT(covering[0], covering[2]) << "the second is orange";
}

TEST(Picture, ShowsAllOfIt) {
  Frame frame;
  add_square(frame, 5, 3, 2);
  const Picture picture = draw(frame, std::vector<bool>(4, false), front);
  EXPECT_EQ(picture.width, 90U);
  EXPECT_EQ(picture.height, 90U);
  EXPECT_EQ(picture.bytes.size(), 3U * 90 * 90);
  EXPECT_TRUE(is_white(pixel(picture, 0.01, 0.5)));
  EXPECT_TRUE(is_white(pixel(picture, 0.5, 0.99)));
  for (const double x : {0.1, 0.9}) EXPECT_FALSE(is_white(pixel(picture, x, 0.35))) << x;
}

TEST(Picture, OfWallsOnlyBordersAreSeen) {
  Frame frame;
  add_square(frame, 0, -1, 1);
  add_square(frame, 0.25, 0, 0.5);
  std::vector<bool> fixed(8, false);
  std::fill(fixed.begin(), fixed.begin() + 4, true);
  const Picture open = draw(frame, fixed, front);
  const auto centre = pixel(open, 0.5, 0.4);
  EXPECT_FALSE(is_white(centre));
  EXPECT_FALSE(is_grey(centre)) << "what is behind the wall";
  fixed.assign(8, true);
  EXPECT_TRUE(is_white(pixel(draw(frame, fixed, front), 0.5, 0.2))) << "walls alone";
}

TEST(Picture, ViewsThatAreNoneAreRefused) {
  Frame frame;
  add_square(frame, 0, 0, 1);
  EXPECT_THROW(draw(frame, std::vector<bool>(4, false), View{{0, 0, 0}, {0, 0, 1}, 90}), std::invalid_argument);
  EXPECT_THROW(draw(frame, std::vector<bool>(4, false), View{{0, 0, 1}, {0, 0, 1}, 90}), std::invalid_argument);
}

#ifdef NOLI_WITH_PNG

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes.at(at + k));
  return value;
}

class ExportPicture : public Simulate {
 protected:
  Process export_at(const std::vector<std::string>& options) const {
    std::vector<std::string> arguments{"export", run_path("r")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_noli(arguments);
  }
};

TEST_F(ExportPicture, IsWrittenOfATimeOfTheRun) {
  for (const char* record : {"full", "frames"}) {
    Json json = hanging_sheet();
    json["record"] = record;
    ASSERT_EQ(run_noli({"simulate", scene(json), "-o", run_path("r"), "--force"}).exit_code, 0);
    const Process result = export_at({"--at", "0.2", "-o", run_path("p.png"), "--force"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find("WRITTEN  " + run_path("p.png") + "  640 x "), std::string::npos) << result.out;
    const std::string png = bytes_of(run_path("p.png"));
    ASSERT_TRUE(png.starts_with("\x89PNG\r\n"));
    EXPECT_EQ(big_endian(png, 16), 640U);
    EXPECT_NE(export_at({"--at", "0.2", "-o", run_path("p.png")}).exit_code, 0) << "it is there already";
    EXPECT_EQ(export_at({"--at", "0.2", "--from", "1", "0", "0", "-o", run_path("q.png"), "--force"}).exit_code, 0);
    EXPECT_EQ(export_at({"--at", "0.2", "--from", "1,0,0", "-o", run_path("commas.png"), "--force"}).exit_code, 0);
    EXPECT_EQ(bytes_of(run_path("commas.png")), bytes_of(run_path("q.png")));
    EXPECT_NE(bytes_of(run_path("q.png")), png);
  }
}

TEST_F(ExportPicture, HasTheSizeAndTheBodyThatAreAskedFor) {
  Json json = hanging_sheet();
  json["bodies"].push_back(json["bodies"][0]);
  json["bodies"][0]["name"] = "near";
  json["bodies"][1]["name"] = "far";
  json["bodies"][1]["transform"]["translate"] = {9, 0, 0};
  ASSERT_EQ(run_noli({"simulate", scene(json), "-o", run_path("r")}).exit_code, 0);
  std::map<std::string, std::string> of_body;
  for (const char* body : {"", "near", "far"}) {
    std::vector<std::string> options{"--at", "0.2", "--size", "320x200", "-o", run_path("p.png"), "--force"};
    if (*body != 0) options.insert(options.end(), {"--zoom", body});
    const Process result = export_at(options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find("  320 x 200 pixels, at 0.2 s\n"), std::string::npos) << result.out;
    of_body[body] = bytes_of(run_path("p.png"));
    EXPECT_EQ(big_endian(of_body[body], 16), 320U);
    EXPECT_EQ(big_endian(of_body[body], 20), 200U);
  }
  EXPECT_NE(of_body["near"], of_body[""]);
  EXPECT_NE(of_body["far"], of_body["near"]) << "another colour";
  EXPECT_GT(of_body["near"].size(), of_body[""].size()) << "a sheet that fills the picture has more in it";
}

/// A falling sheet moves down in a film, while pictures of single times center it.
TEST_F(ExportPicture, AFilmHasOneViewOfAllFrames) {
  for (const char* record : {"full", "frames"}) {
    Json json = hanging_sheet();
    json["record"] = record;
    json["frame_rate"] = 20;
    json["bodies"][0].erase("pin");
    ASSERT_EQ(run_noli({"simulate", scene(json), "-o", run_path("r"), "--force"}).exit_code, 0);
    const std::vector<std::string> options{"--fps",  "20", "--size", "160x120", "-o", run_path("film/%02d.png"),
                                           "--force"};
    const Process result = export_at(options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find("  6 frames of "), std::string::npos) << result.out;
    std::set<std::string> different;
    for (int i = 0; i < 6; ++i) {
      const std::string png = bytes_of(run_path("film/0" + std::to_string(i) + ".png"));
      EXPECT_EQ(big_endian(png, 16), 160U);
      EXPECT_EQ(big_endian(png, 20), 120U);
      different.insert(png);
    }
    EXPECT_EQ(different.size(), 6U);
    EXPECT_EQ(export_at({"--at", "0", "--size", "160x120", "-o", run_path("p.png"), "--force"}).exit_code, 0);
    EXPECT_EQ(different.count(bytes_of(run_path("p.png"))), 0U) << "it shows the whole fall";
  }
}

TEST_F(ExportPicture, OfARunWithoutWindowsIsRefused) {
  const auto json = nlohmann::json::parse(R"({"noli_scene": 1, "title": "Two sheets", "duration": 0.1,
    "gravity": [0, 0, -9.81], "bodies": [
      {"name": "floor", "mesh": {"grid": {"size": [1, 1], "cells": [1, 1]}}, "pin": ["all"],
       "material": {"edge_stiffness": 0, "mass_per_area": 1}},
      {"name": "sheet", "mesh": {"grid": {"size": [0.5, 0.4], "cells": [1, 1]}},
       "transform": {"translate": [0, 0, 1e-5]},
       "material": {"edge_stiffness": 1, "mass_per_area": 1}}]})");
  const Process fall = run_noli({"simulate", scene(json), "-o", run_path("r")});
  ASSERT_NE(fall.out.find("CONTACT  window 1  "), std::string::npos) << fall.out << fall.err;
  const std::string run = run_path("r");
  for (const Process& result : {run_noli({"export", run, "--fps", "10", "-o", folder.path("%d.ply")}),
                                run_noli({"export", run, "--at", "0", "-o", folder.path("p.png")})}) {
    EXPECT_EQ(result.exit_code, 3) << result.out;
    EXPECT_NE(result.err.find("has no windows"), std::string::npos) << result.err;
  }
}

TEST_F(ExportPicture, BadInputIsNamed) {
  ASSERT_EQ(run_noli({"simulate", scene(hanging_sheet()), "-o", run_path("r")}).exit_code, 0);
  const auto expect_refused = [&](const std::vector<std::string>& options, const char* what) {
    const Process result = export_at(options);
    EXPECT_EQ(result.exit_code, 3) << what;
    EXPECT_NE(result.err.find(what), std::string::npos) << result.err;
  };
  expect_refused({"--at", "3", "-o", run_path("p.png")}, "ends at 0.25 s");
  expect_refused({"--at", "-1", "-o", run_path("p.png")}, "expected a time up to then");
  expect_refused({"--at", "0.1", "-o", run_path("p.jpg")}, ".png");
  expect_refused({"--at", "0.1", "--from", "0", "0", "0", "-o", run_path("p.png")}, "--from");
  expect_refused({"--at", "0.1", "--fps", "3", "-o", run_path("p.png")}, "--fps");
  expect_refused({"--at", "0.1", "--from", "1,0", "-o", run_path("p.png")}, "--from");
  expect_refused({"--from", "0", "0", "1", "-o", run_path("p.png")}, "expected --at TIME for one picture");
  for (const std::vector<std::string>& option :
       {std::vector<std::string>{"--from", "0,0,1"}, {"--size", "64x64"}, {"--zoom", "sheet"}}) {
    expect_refused({option[0], option[1], "-o", run_path("%d.ply")}, "are for pictures; expected --at");
  }
  for (const char* size : {"640", "640x", "x480", "640x480x3", "15x100", "100x8193", "-5x100", "a"}) {
    expect_refused({"--at", "0.1", "--size", size, "-o", run_path("p.png")}, "expected WIDTHxHEIGHT in pixels");
  }
  expect_refused({"--at", "0.1", "--zoom", "nobody", "-o", run_path("p.png")}, "expected a body of the run");
}

#endif

}  // namespace
}  // namespace noli::app_tests
