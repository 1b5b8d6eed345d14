// SPDX-License-Identifier: Apache-2.0
//
// Tests that a window with too many breakpoints ends early: after all events of the time at which it has as many as the
// model allows, counted in the serial order of events. The next window continues from there.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"
#include "running.h"

namespace noli::integrator {
namespace {

struct Case {
  std::string scene, steps;
  std::size_t most;   ///< breakpoints
  double window = 0;  ///< length of a window [s]; 0: the scene's
};

void PrintTo(const Case& of, std::ostream* out) { *out << of.scene << " " << of.steps << " " << of.most; }

Scene scene_of(const Case& of) {
  const auto path = std::filesystem::path(NOLI_SOURCE_DIR) / "scenes" / (of.scene + ".json");
  std::ifstream file(path);
  Json document = Json::parse(file);
  document["steps"] = of.steps;
  if (of.window > 0) document["window"] = of.window;
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

  /// Where the window after `before` must end, computed from a window without a limit.
  template <int Dim>
  static double expected_end(const Snapshot<double, Dim>& before) {
    const Model<double, Dim> model = BoundedWindows::model<Dim>(std::numeric_limits<std::size_t>::max());
    Simulation<double, Dim> unbounded =
        before.windows == 0 ? Simulation<double, Dim>(model) : Simulation<double, Dim>(model, before);
    const Window<Dim> whole = next_window(unbounded);
    std::vector<double> times;
    for (const auto& b : whole.stream) times.push_back(b.t);
    std::ranges::sort(times);
    for (std::size_t i = GetParam().most - 1; i < times.size(); ++i) {
      if (times[i] > whole.begin) return times[i];
    }
    return whole.end;
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
      ASSERT_LT(window.begin, window.end);
      ASSERT_LE(window.end, (whole + 1) * length);
      if (before.windows < 50) {
        EXPECT_EQ(window.end, expected_end(before)) << before.windows;
      }
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
    EXPECT_GE(early, whole_windows);
    EXPECT_EQ(simulation.windows(), static_cast<std::uint64_t>(early + whole_windows));
  }
};

TEST_P(BoundedWindows, EndAfterAllEventsOfThatTimeAndGoOnToTheByte) {
  scene_of(GetParam()).dimension == 2 ? check<2>() : check<3>();
}

INSTANTIATE_TEST_SUITE_P(, BoundedWindows,
                         testing::Values(Case{"swinging_cloth", "grouped", 1000}, Case{"swinging_cloth", "own", 1000},
                                         Case{"swinging_cloth", "own", 1},
                                         // So many breakpoints that forces fire in batches almost up to the end.
                                         Case{"swinging_cloth", "own", 90'000, 0.5}, Case{"hanging_chain", "own", 200},
                                         Case{"plane_compactor", "grouped", 700}, Case{"plane_compactor", "own", 700},
                                         Case{"stack", "grouped", 5000}, Case{"stack", "own", 3001},
                                         Case{"through_ring", "grouped", 4000}));

}  // namespace
}  // namespace noli::integrator
