// SPDX-License-Identifier: Apache-2.0
#include "certify/runs/run_series.h"

#include <stdexcept>

#include "trajectory/blocks/bytes.h"

namespace noli {
namespace {

constexpr std::string_view letters = "noli row";
constexpr std::uint64_t version = 7;
constexpr std::size_t beginning = letters.size() + sizeof(version);

/// Calls f on each number of a layer, in order.
template <class Layer, class F>
void each_number(Layer& layer, F&& f) {
  f(layer.layer);
  f(layer.material);
  f(layer.pair);
  for (auto& v : layer.vertices) f(v);
  f(layer.time);
  f(layer.distance);
}

/// Calls f on each number of a row, in order, up to its histogram.
template <class Row, class F>
void each_number_of_row(Row& row, F&& f) {
  f(row.time);
  f(row.kinetic);
  f(row.kinetic_mean);
  for (auto* list : {&row.potential, &row.work, &row.damping_work, &row.held_work}) {
    for (auto& x : *list) f(x);
  }
  for (auto* x : {&row.restitution_work, &row.held_ahead, &row.integration}) f(*x);
  for (auto* list : {&row.momentum, &row.angular_momentum}) {
    for (auto& x : *list) f(x);
  }
  for (auto& n : row.events) f(n);
  f(row.breakpoints);
  f(row.halvings);
  each_number(row.deepest, f);
  each_number(row.nearest, f);
  f(row.steps.smallest);
}

/// Takes numbers from the front of bytes.
class Numbers {
 public:
  explicit Numbers(std::string_view bytes) : bytes_(bytes) {}

  void operator()(double& x) { x = take<double>(); }
  void operator()(std::uint64_t& n) { n = take<std::uint64_t>(); }
  void operator()(std::int64_t& n) { n = static_cast<std::int64_t>(take<std::uint64_t>()); }
  void operator()(std::uint16_t& n) { n = static_cast<std::uint16_t>(below(std::uint64_t{1} << 16)); }
  void operator()(std::uint32_t& n) { n = static_cast<std::uint32_t>(below(std::uint64_t{1} << 32)); }
  void operator()(FeaturePair& pair) { pair = static_cast<FeaturePair>(below(all_feature_pairs.size())); }

  std::size_t left() const { return bytes_.size(); }

 private:
  template <class T>
  T take() {
    if (bytes_.size() < sizeof(T)) throw std::invalid_argument("it ends too soon");
    const T value = get<T>(bytes_.data());
    bytes_.remove_prefix(sizeof(T));
    return value;
  }

  std::uint64_t below(std::uint64_t end) {
    const auto n = take<std::uint64_t>();
    if (n >= end)
      throw std::invalid_argument("a material, a layer, a vertex or a pair of features that does not exist");
    return n;
  }

  std::string_view bytes_;
};

/// A list, preceded by its size; `numbers`: numbers of 8 bytes per item.
template <class T>
std::vector<T> take_list(Numbers& take, std::size_t numbers) {
  std::uint64_t count = 0;
  take(count);
  if (count > take.left() / (8 * numbers)) throw std::invalid_argument("a list that is longer than what is left");
  return std::vector<T>(count);
}

StepHistogram take_steps(Numbers& take, double smallest) {
  StepHistogram steps{smallest, {}};
  std::uint64_t count = 0;
  take(count);
  if (count != take.left() / 16 || take.left() % 16 != 0) {
    throw std::invalid_argument("its size does not match its bins");
  }
  steps.bins.resize(count);
  for (auto& bin : steps.bins) {
    take(bin.number);
    take(bin.ticks);
  }
  for (std::size_t i = 1; i < count; ++i) {
    if (steps.bins[i].number <= steps.bins[i - 1].number)
      throw std::invalid_argument("the bins of steps do not ascend");
  }
  return steps;
}

std::vector<integrator::Anchor<double>> take_anchors(Numbers& take) {
  auto anchors = take_list<integrator::Anchor<double>>(take, 12);
  for (auto& anchor : anchors) {
    take(anchor.of.material);
    take(anchor.of.layer);
    take(anchor.of.kind);
    for (VertexId& v : anchor.of.vertices) take(v);
    for (double& weight : anchor.weights) take(weight);
    take(anchor.until);
  }
  return anchors;
}

}  // namespace

std::string encode(const SeriesRow& row, std::span<const integrator::Anchor<double>> anchors) {
  std::string bytes(letters);
  put(bytes, version);
  put(bytes, static_cast<std::uint64_t>(anchors.size()));
  for (const auto& anchor : anchors) {
    put(bytes, std::uint64_t{anchor.of.material});
    put(bytes, std::uint64_t{anchor.of.layer});
    put(bytes, static_cast<std::uint64_t>(anchor.of.kind));
    for (const VertexId v : anchor.of.vertices) put(bytes, static_cast<std::uint64_t>(v));
    for (const double weight : anchor.weights) put(bytes, weight);
    put(bytes, anchor.until);
  }
  each_number_of_row(row, [&bytes]<class T>(const T& x) {
    if constexpr (std::is_same_v<T, double>) {
      put(bytes, x);
    } else {
      put(bytes, static_cast<std::uint64_t>(x));
    }
  });
  put(bytes, static_cast<std::uint64_t>(row.contact_work.size()));
  for (const ContactWork& work : row.contact_work) {
    for (const double x : {work.potential, work.friction, work.restitution}) put(bytes, x);
  }
  put(bytes, static_cast<std::uint64_t>(row.script_work.size()));
  for (const double x : row.script_work) put(bytes, x);
  put(bytes, static_cast<std::uint64_t>(row.steps.bins.size()));
  for (const auto& bin : row.steps.bins) {
    put(bytes, static_cast<std::uint64_t>(bin.number));
    put(bytes, bin.ticks);
  }
  return bytes;
}

std::string not_a_row(std::string_view bytes) {
  if (bytes.empty()) return "a repair has no energies; expected a run of `noli simulate`";
  if (bytes.size() < beginning || !bytes.starts_with(letters)) {
    return "its series is not a row of version 7, so an earlier Noli wrote it; expected a run of this version";
  }
  const auto found = get<std::uint64_t>(bytes.data() + letters.size());
  return found == version ? "" : "its series is of version " + std::to_string(found) + "; expected version 7";
}

WindowState decode_state(std::string_view bytes) {
  if (const std::string problem = not_a_row(bytes); !problem.empty()) throw std::invalid_argument(problem);
  Numbers take(bytes.substr(beginning));
  WindowState state;
  state.anchors = take_anchors(take);
  SeriesRow& row = state.row;
  each_number_of_row(row, take);
  row.contact_work = take_list<ContactWork>(take, 3);
  for (ContactWork& work : row.contact_work) {
    for (double* x : {&work.potential, &work.friction, &work.restitution}) take(*x);
  }
  row.script_work = take_list<double>(take, 1);
  for (double& x : row.script_work) take(x);
  row.steps = take_steps(take, row.steps.smallest);
  return state;
}

double left_of_change(const SeriesRow& row, double energy_before) { return row.energy() - energy_before - row.given(); }

ActingLayer acting_layer(const std::optional<integrator::LayerAction>& action) {
  if (!action) return {};
  return {action->layer, action->material, action->pair.kind, action->pair.vertices, action->time, action->distance};
}

}  // namespace noli
