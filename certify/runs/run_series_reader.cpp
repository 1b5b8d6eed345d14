// SPDX-License-Identifier: Apache-2.0
#include "certify/runs/run_series_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

#include <noli/errors.h>
#include "certify/simulate/retries.h"
#include "integrator/clocks.h"

namespace noli {
namespace {

// The checks of a row: whether its numbers can be those of its window. Numbers that follow from the motion are compared
// with it; the others must be possible for the integrator. Energies, momenta and works may be any doubles, as they can
// overflow when velocities do not. Only `integration` is compared with them, in all rows except the first. The checks
// throw std::invalid_argument, one line without place.

constexpr std::uint64_t most_counted = std::uint64_t{1} << 53;

template <class... Parts>
void require(bool holds, fmt::format_string<Parts...> problem, Parts&&... parts) {
  if (!holds) throw std::invalid_argument(fmt::format(problem, std::forward<Parts>(parts)...));
}

// --- Times -----------------------------------------------------------------------------------------------------------

/// A simulation's windows begin at 0 and go up to the next multiple of their length, or end before it. (The reader has
/// checked that each begins where the previous one ends.)
void check_times(const SeriesRow& row, const RunWindow& window, const RunScene& scene) {
  require(window.index > 0 || window.begin == 0, "is of a first window that begins at {} s; expected 0", window.begin);
  const double length = scene.header.window_length;
  require(window.begin < 0x1p52 * length,
          "is of a window that begins at {} s; expected fewer than 2^52 windows of {} s", window.begin, length);
  const double last = static_cast<double>(integrator::first_after(window.begin, length)) * length;
  require(window.end <= last, "is of a window from {} s to {} s; expected at most {} s", window.begin, window.end,
          last);
  require(row.time == window.end, "ends at {} s; expected {} s", row.time, window.end);
}

// --- Counts ----------------------------------------------------------------------------------------------------------

void check_counts(const SeriesRow& row, const RunWindow& window, std::uint64_t halvings_before) {
  for (const std::uint64_t events : row.events) {
    require(events <= most_counted, "{} events; expected at most 2^53", events);
  }
  require(row.breakpoints == window.breakpoints && row.breakpoints <= most_counted,
          "{} breakpoints; expected the {} of its world lines", row.breakpoints, window.breakpoints);
  constexpr std::uint64_t most_a_window = Retries::most - 1;
  const std::uint64_t most = most_a_window * (window.index + 1);
  require(row.halvings <= most, "{} halvings; expected at most {}", row.halvings, most);
  require(row.halvings >= halvings_before, "{} halvings; expected at least {}, which the window before has",
          row.halvings, halvings_before);
}

// --- Books -----------------------------------------------------------------------------------------------------------

void check_books(const SeriesRow& row, const SeriesRow& before) {
  require(row.contact_work.size() == before.contact_work.size(), "{} materials; expected the {} of the window before",
          row.contact_work.size(), before.contact_work.size());
  require(row.script_work.size() == before.script_work.size(), "{} scripts; expected the {} of the window before",
          row.script_work.size(), before.script_work.size());
  const double left = left_of_change(row, before.energy());
  require(row.integration == left || !std::isfinite(left),
          "an integration of {} J; expected {} J, which is what is left", row.integration, left);
}

// --- Layers ----------------------------------------------------------------------------------------------------------

/// `what`: the owner of the pair, for messages.
void check_pair(std::string_view what, FeaturePair pair, std::span<const VertexId> all, const RunScene& scene) {
  const bool flat = scene.header.dimension == 2;
  require(!flat || pair == FeaturePair::vertex_edge || pair == FeaturePair::vertex_vertex,
          "{} between a pair of features that 2D does not have: {}", what, name(pair));
  const std::span<const VertexId> vertices = all.first(point_count(pair));
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    require(vertices[i] < scene.mesh.vertex_count, "{} at vertex {}; expected one below {}", what, vertices[i],
            scene.mesh.vertex_count);
    require(std::ranges::count(vertices.first(i), vertices[i]) == 0, "{} that names a vertex twice: {}", what,
            vertices[i]);
  }
}

void check_layer(const ActingLayer& layer, const RunWindow& window, const RunScene& scene) {
  if (layer.layer == 0) return require(layer == ActingLayer{}, "numbers of a layer that did not act");
  constexpr std::uint64_t most_layers = std::numeric_limits<std::uint32_t>::max();
  constexpr std::uint64_t most_materials = std::numeric_limits<std::uint16_t>::max();
  require(layer.layer <= most_layers, "layer {}; expected at most {}", layer.layer, most_layers);
  require(layer.material <= most_materials, "material {}; expected at most {}", layer.material, most_materials);
  check_pair("a layer", layer.pair, layer.vertices, scene);
  require(window.begin <= layer.time && layer.time <= window.end, "a layer acts at {} s; expected {} s to {} s",
          layer.time, window.begin, window.end);
  require(layer.distance >= 0 && std::isfinite(layer.distance),
          "a layer at a distance {} m; expected a finite one, 0 or more", layer.distance);
}

void check_layers(const SeriesRow& row, const RunWindow& window, const RunScene& scene) {
  const ActingLayer &deepest = row.deepest, &nearest = row.nearest;
  check_layer(deepest, window, scene);
  check_layer(nearest, window, scene);
  require((deepest.layer == 0) == (nearest.layer == 0), "a deepest layer or a nearest one, not both");
  require(nearest.layer <= deepest.layer, "a layer {} that is deeper than the deepest, {}", nearest.layer,
          deepest.layer);
  require(nearest.distance <= deepest.distance, "a nearest distance {} m that is farther than the deepest layer's",
          nearest.distance);
}

// --- Steps -----------------------------------------------------------------------------------------------------------

/// The sum of all ticks; stops before 2^64.
std::uint64_t ticks_of(const StepHistogram& steps, std::uint64_t expected) {
  std::uint64_t sum = 0;
  for (const auto& bin : steps.bins) {
    require(bin.ticks <= expected - sum, "more than {} ticks in its bins; expected this many", expected);
    sum += bin.ticks;
  }
  return sum;
}

void check_steps(const StepHistogram& steps, const RunWindow& window, const RunScene& scene) {
  const double length = window.end - window.begin;
  const std::int64_t greatest = step_bin(length);
  for (const auto& bin : steps.bins) {
    require(least_step_bin <= bin.number && bin.number <= greatest, "the bin {}; expected bins of steps from {} to {}",
            bin.number, least_step_bin, greatest);
    require(bin.ticks > 0, "an empty bin, {}; expected only those that have ticks", bin.number);
  }
  const auto free = static_cast<std::uint64_t>(std::ranges::count(scene.labels, 0));
  require(free < most_counted >> 32, "{} free vertices; expected fewer", free);
  const std::uint64_t expected = free << 32, found = ticks_of(steps, expected);
  require(found == expected, "{} ticks in its bins; expected {}, 2^32 for each free vertex", found, expected);
  if (free == 0)
    return require(steps.smallest == 0, "a smallest step of {} s; expected 0, nothing is free", steps.smallest);
  require(0 < steps.smallest && steps.smallest <= length, "a smallest step of {} s; expected one up to {} s",
          steps.smallest, length);
}

// --- Rows and anchors ------------------------------------------------------------------------------------------------

/// `before`: the row of the previous window, or null for the first.
void check_row(const SeriesRow& row, const RunWindow& window, const RunScene& scene, const SeriesRow* before) {
  check_times(row, window, scene);
  check_counts(row, window, before != nullptr ? before->halvings : 0);
  if (before != nullptr) check_books(row, *before);
  check_layers(row, window, scene);
  check_steps(row.steps, window, scene);
}

/// Checks the anchors of friction at the window's end.
void check_anchors(std::span<const integrator::Anchor<double>> anchors, std::size_t materials, const RunWindow& window,
                   const RunScene& scene) {
  require(std::ranges::adjacent_find(anchors, std::ranges::greater_equal(), &integrator::Anchor<double>::of) ==
              anchors.end(),
          "anchors that do not ascend");
  for (const auto& anchor : anchors) {
    require(anchor.of.material < materials, "an anchor of material {}; expected one below {}", anchor.of.material,
            materials);
    require(anchor.of.layer > 0, "an anchor of layer 0; expected one from 1 on");
    check_pair("an anchor", anchor.of.kind, anchor.of.vertices, scene);
    for (const double weight : anchor.weights) {
      require(std::abs(weight) <= 1, "an anchor with the weight {}; expected one from -1 to 1", weight);
    }
    const double latest = window.end + 1.5 * scene.header.window_length;  // no layer's step is longer than a window
    require(anchor.until >= window.end && anchor.until <= latest,
            "an anchor that ends at {} s; expected a time from {} s to {} s", anchor.until, window.end, latest);
  }
}

}  // namespace

SeriesReader::SeriesReader(const std::filesystem::path& run) : RunReader(run), run_(run) {}

std::optional<RunWindow> SeriesReader::next_window() {
  std::optional<RunWindow> window = RunReader::next_window();
  if (window) take_row(*window);
  return window;
}

void SeriesReader::skip_to(const CommitPoint& commit) {
  state_.reset();
  RunReader::skip_to(commit);
}

void SeriesReader::take_row(const RunWindow& window) {
  const std::optional<WindowState> before = std::exchange(state_, std::nullopt);
  why_none_ = not_a_row(window.state);
  if (!why_none_.empty()) return;
  try {
    state_ = decode_state(window.state);
    check_row(state_->row, window, scene(), before ? &before->row : nullptr);
    check_anchors(state_->anchors, state_->row.contact_work.size(), window, scene());
  } catch (const std::invalid_argument& error) {
    refuse(error.what());
  }
}

const WindowState& SeriesReader::state() const {
  if (!state_) refuse(why_none_);
  return *state_;
}

void SeriesReader::refuse(const std::string& problem) const {
  throw InputError(trajectory_path(run_).string(), "", fmt::format("the state of window {}: {}", windows(), problem));
}

}  // namespace noli
