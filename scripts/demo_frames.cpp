// SPDX-License-Identifier: Apache-2.0
//
// demo_frames clean|contact N FOLDER: writes a short sequence of PLY frames, FOLDER/00.ply to FOLDER/05.ply, of two
// rippled sheets of N by N squares (4 N^2 faces together), the upper one sinking towards the lower one while both fall.
//   clean    the upper sheet stops above the lower one
//   contact  one corner of it goes through, between frames 3 and 4
// For N below 20 the ripples are cut so coarsely that the clean one may touch, too.
// Coordinates are in metres. Only +, - and * are used, so the bytes are the same everywhere.
#include <charconv>
#include <fstream>
#include <iostream>
#include <string>

namespace {

constexpr int frames = 6;

/// A smooth bump train of height 1 and period 1: 16 u^2 (1 - u)^2 on the fractional part u of `s` >= 0.
double ripple(double s) {
  const double u = s - static_cast<double>(static_cast<long>(s));
  return 16 * u * u * (1 - u) * (1 - u);
}

/// Height of the lower sheet over the plane through its rim, at (x, y) in [0, 1]^2 and frame f.
double height(double x, double y, int f) { return 0.02 * (ripple(3 * x + 0.05 * f) + ripple(2 * y + 0.03 * f)); }

/// How far the upper sheet is above the lower one in frame f.
double gap(bool contact, int f) { return contact ? 0.07 - 0.02 * f : 0.01 + 0.01 * (frames - 1 - f); }

/// A sheet `above` the lower one at its corner (0, 0) and `slope` more at (1, 1), moved sideways by `offset` squares.
void write_vertices(std::ostream& out, int n, int f, double offset, double above, double slope) {
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const double x = (i + offset) / n;
      const double y = (j + offset) / n;
      out << x << ' ' << y << ' ' << height(x, y, f) - 0.1 * f + above + slope * x * y << '\n';
    }
  }
}

void write_faces(std::ostream& out, int n, int first) {
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int a = first + i * (n + 1) + j;
      const int b = a + n + 1;
      out << "3 " << a << ' ' << b << ' ' << a + 1 << "\n3 " << b << ' ' << b + 1 << ' ' << a + 1 << '\n';
    }
  }
}

bool write_frame(const std::string& path, bool contact, int n, int f) {
  std::ofstream out(path);
  out.precision(17);
  const int vertices = (n + 1) * (n + 1);
  out << "ply\nformat ascii 1.0\nelement vertex " << 2 * vertices
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << 4 * n * n
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  write_vertices(out, n, f, 0, 0, 0);
  write_vertices(out, n, f, 0.25, gap(contact, f), 0.2);
  write_faces(out, n, 0);
  write_faces(out, n, vertices);
  out.close();
  return !out.fail();
}

bool write_frames(const std::string& folder, bool contact, int n) {
  for (int f = 0; f < frames; ++f) {
    const std::string path = folder + "/0" + std::to_string(f) + ".ply";
    if (!write_frame(path, contact, n, f)) {
      std::cerr << path << ": cannot be written\n";
      return false;
    }
  }
  return true;
}

/// The number in `text`, or 0 if it is none between 1 and 10,000.
int squares(const std::string& text) {
  int n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  return error == std::errc() && end == text.data() + text.size() && n >= 1 && n <= 10000 ? n : 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string kind = argc == 4 ? argv[1] : "";
  const int n = argc == 4 ? squares(argv[2]) : 0;
  if ((kind != "clean" && kind != "contact") || n == 0) {
    std::cerr << "usage: demo_frames clean|contact N FOLDER\n";
    return 3;
  }
  return write_frames(argv[3], kind == "contact", n) ? 0 : 4;
}
