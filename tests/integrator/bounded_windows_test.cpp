// SPDX-License-Identifier: Apache-2.0
//
// A window that has too many breakpoints ends early: after all events of the time at which it has as many as the model
// allows, counted in the serial order of events. The next one goes on from there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"
#include "running.h"

namespace noli::integrator {
namespace {

struct Case {
  std::string scene, steps;
  std::size_t most;  ///< breakpoints
};

void PrintTo(const Case& of, std::ostream* out) { *out << of.scene << " " << of.steps << " " << of.most; }

Scene scene_of(const Case& of) {
  const auto path = std::filesystem::path(NOLI_SOURCE_DIR) / "scenes" / (of.scene + ".json");
  std::ifstream file(path);
  Json document = Json::parse(file);
  document["steps"] = of.steps;
  return parse_scene(document.dump(), path, Form::brief);
}

template <int Dim>
struct Window {
  double begin, end;
  std::vector<Breakpoint<double, Dim>> stream;
  Books<double, Dim> books;
};

template <int Dim>
Window<Dim> next_window(Simulation<double, Dim>& simulation) {
  Window<Dim> window{simulation.time(), 0, {}, {}};
  Recording<double, Dim> recording;
  simulation.run_window(recording, window.books);
  window.end = simulation.time();
  window.stream.assign(recording.stream().begin(), recording.stream().end());
  return window;
}

template <int Dim>
void expect_same_bytes(const Window<Dim>& a, const Window<Dim>& b) {
  EXPECT_EQ(a.end, b.end);
  EXPECT_EQ(a.books.work(), b.books.work());
  EXPECT_EQ(a.books.scripts, b.books.scripts);
  ASSERT_EQ(a.stream.size(), b.stream.size());
  for (std::size_t i = 0; i < a.stream.size(); ++i) {
    ASSERT_EQ(a.stream[i].t, b.stream[i].t) << i;
    ASSERT_EQ(a.stream[i].vertex, b.stream[i].vertex) << i;
    ASSERT_EQ(a.stream[i].x, b.stream[i].x) << i;
  }
}

class BoundedWindows : public testing::TestWithParam<Case> {
 protected:
  static constexpr int whole_windows = 3;

  template <int Dim>
  static Model<double, Dim> model(std::size_t most) {
    Model<double, Dim> model = build_model<Dim>(scene_of(GetParam())).model;
    model.most_breakpoints = most;
    return model;
  }

  /// Where the first window has to end: from one that is as long as it likes.
  template <int Dim>
  static double expected_first_end() {
    Simulation<double, Dim> unbounded(model<Dim>(std::numeric_limits<std::size_t>::max()));
    const Window<Dim> whole = next_window(unbounded);
    std::vector<double> times;
    for (const auto& b : whole.stream) times.push_back(b.t);
    std::ranges::sort(times);
    for (std::size_t i = GetParam().most - 1; i < times.size(); ++i) {
      if (times[i] > 0) return times[i];
    }
    return whole.end;
  }

  template <int Dim>
  static void expect_bounded(const Window<Dim>& window, double length) {
    const std::size_t most = GetParam().most;
    const auto before_end =
        std::ranges::count_if(window.stream, [&](const auto& b) { return b.t > window.begin && b.t < window.end; });
    const std::size_t vertices =
        static_cast<std::size_t>(std::ranges::count(window.stream, window.begin, &Breakpoint<double, Dim>::t));
    if (before_end > 0) {
      EXPECT_LT(vertices + static_cast<std::size_t>(before_end), most) << "it ends late, at " << window.end;
    }
    const bool is_whole = std::round(window.end / length) * length == window.end;
    if (!is_whole) {
      EXPECT_GE(window.stream.size(), most) << "it ends early, at " << window.end;
    }
  }

  template <int Dim>
  static void check() {
    const Model<double, Dim> bounded = model<Dim>(GetParam().most);
    const double length = bounded.window_length;
    Simulation<double, Dim> simulation(bounded);
    double whole = 0;
    int early = 0;
    while (whole < whole_windows) {
      const Snapshot<double, Dim> before = simulation.snapshot();
      const Window<Dim> window = next_window(simulation);
      if (before.windows == 0) {
        EXPECT_EQ(window.end, expected_first_end<Dim>());
      }
      ASSERT_LT(window.begin, window.end);
      ASSERT_LE(window.end, (whole + 1) * length);
      expect_bounded(window, length);
      if (before.windows > 0 && before.windows < 50) {
        Simulation<double, Dim> resumed(bounded, before);
        expect_same_bytes(window, next_window(resumed));
        test::expect_same(simulation.snapshot(), resumed.snapshot());
      }
      if (window.end == (whole + 1) * length) {
        ++whole;
      } else {
        ++early;
      }
    }
    EXPECT_GT(early, whole_windows);
    EXPECT_EQ(simulation.windows(), static_cast<std::uint64_t>(early + whole_windows));
  }
};

TEST_P(BoundedWindows, EndAfterAllEventsOfThatTimeAndGoOnToTheByte) {
  scene_of(GetParam()).dimension == 2 ? check<2>() : check<3>();
}

INSTANTIATE_TEST_SUITE_P(, BoundedWindows,
                         testing::Values(Case{"swinging_cloth", "grouped", 1000}, Case{"swinging_cloth", "own", 1000},
                                         Case{"swinging_cloth", "own", 1}, Case{"hanging_chain", "own", 200},
                                         Case{"plane_compactor", "grouped", 700}, Case{"plane_compactor", "own", 700},
                                         Case{"stack", "grouped", 5000}, Case{"stack", "own", 3001},
                                         Case{"through_ring", "grouped", 4000}));

/// So many that rows of forces fire together up to nearly the end of the window.
TEST(BoundedWindowsInRows, AreTheSameHoweverForcesFireInRows) {
  const auto path = std::filesystem::path(NOLI_SOURCE_DIR) / "scenes" / "swinging_cloth.json";
  std::ifstream file(path);
  Json document = Json::parse(file);
  document["steps"] = "own";
  document["window"] = 0.5;
  Model<double, 3> model = build_model<3>(parse_scene(document.dump(), path, Form::brief)).model;
  Simulation<double, 3> unbounded(model);
  const Window<3> whole = next_window(unbounded);
  ASSERT_GT(whole.stream.size(), 100'000U);
  model.most_breakpoints = 90'000;
  Simulation<double, 3> simulation(model);
  const Window<3> window = next_window(simulation);
  std::vector<double> times;
  for (const auto& b : whole.stream) times.push_back(b.t);
  std::ranges::sort(times);
  EXPECT_EQ(window.end, times[model.most_breakpoints - 1]);
}

}  // namespace
}  // namespace noli::integrator
