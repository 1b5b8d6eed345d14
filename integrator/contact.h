// SPDX-License-Identifier: Apache-2.0
//
// Contact in a run: the active layers, each with its clock, and the certificates that decide which must be active.
//
// Notation: that of integrator/contact_settings.h, and
//   layer     of a material: (material, l). All pairs for which it is active fire together, in the order of their keys
//             (integrator/layer_fire.h)
// Layer l fires at the times k h(l) of the run, no matter when a pair joined it, and writes only where it acts. So a
// run that activates layers when they are needed is, bit for bit, the run in which they always were active (design,
// "What an event may write").
//
// A run ends when a layer above most_layers would act, which is also a property of the motion. How many layers
// certificates activate in advance is not: it depends on when they checked, which differs in a resumed run. Only if a
// pair needs a thousand further layers before the first of them fires does the run end at once.
//
// certificates/cells.h finds the near pairs.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include "certificates/cells.h"
#include "certificates/stencil.h"
#include "integrator/books.h"
#include "integrator/clocks.h"
#include "integrator/contact_extremes.h"
#include "integrator/contact_settings.h"
#include "integrator/falling.h"
#include "integrator/kick.h"
#include "integrator/layer_fire.h"
#include "integrator/phase.h"

namespace noli::integrator {

/// A layer that fires, for recorders with layer_fires(), which precedes examined() for each of its pairs.
struct Firing {
  double time, h;  ///< h: of this kick, half of the layer's step when a run begins
  LayerTerms terms;
};

/// The pairs for which a layer is active, in the order of their keys. Many join and leave between two times at which
/// the layer fires, so changes are sorted in together, when the order is needed: n changes among N pairs take O(N + n
/// log n), not O(N n).
class PairList {
 public:
  /// Precondition: the pair is not in the list.
  void add(const certificates::Stencil& pair) {
    changes_.push_back({pair, true});
    ++size_;
  }
  /// Precondition: the pair is in the list.
  void remove(const certificates::Stencil& pair) {
    changes_.push_back({pair, false});
    --size_;
  }

  bool empty() const { return size_ == 0; }

  /// The pairs, by key. The span stays as it is while pairs are added and removed, until the next call.
  std::span<const certificates::Stencil> in_order() const {
    if (!changes_.empty()) settle();
    return pairs_;
  }

 private:
  struct Change {
    certificates::Stencil pair;
    bool joins;
  };

  /// Applies the changes. Of several changes of one pair, the last one counts.
  void settle() const {
    std::ranges::stable_sort(changes_, {}, [](const Change& change) { return change.pair.key; });
    merged_.clear();
    merged_.reserve(size_);
    auto old = pairs_.begin();
    for (auto change = changes_.begin(); change != changes_.end(); ++change) {
      if (change + 1 != changes_.end() && (change + 1)->pair.key == change->pair.key) continue;
      for (; old != pairs_.end() && old->key < change->pair.key; ++old) merged_.push_back(*old);
      if (old != pairs_.end() && old->key == change->pair.key) ++old;
      if (change->joins) merged_.push_back(change->pair);
    }
    merged_.insert(merged_.end(), old, pairs_.end());
    pairs_.swap(merged_);
    changes_.clear();
  }

  std::size_t size_ = 0;
  mutable std::vector<certificates::Stencil> pairs_, merged_;
  mutable std::vector<Change> changes_;
};

/// `Certificates`: certificates::Cells, or a replacement for comparison (tests/support/every_pair.h).
template <int Dim, template <int, class> class Certificates = certificates::Cells>
class Contact {
 public:
  using Scalar = double;
  using Particles = std::vector<Particle<double, Dim>>;

  /// `look_steps`: by vertex, the longest time between two forces on it; infinity without forces. The particles must
  /// not move in memory.
  Contact(const ContactSettings& settings, const Mesh& mesh, Particles& particles, std::vector<double> look_steps,
          double window_length)
      : settings_(settings),
        particles_(particles),
        look_steps_(std::move(look_steps)),
        layers_(settings.materials.size()),
        greatest_thicknesses_(greatest_thicknesses(settings)),
        layer_fire_(settings.inclusion_exclusion),
        is_struck_(particles.size(), 0),
        certificates_(*this, mesh, positions(particles), longest_slice * window_length) {}

  Contact(const Contact&) = delete;
  Contact& operator=(const Contact&) = delete;

  // --- What happens when ---------------------------------------------------------------------------------------------

  bool started() const { return started_; }

  /// From now on shows its phases there.
  void show(Activity& activity) { activity_ = &activity; }

  /// The extremes since the last forget_extremes().
  const ContactExtremes& extremes() const { return extremes_; }
  void forget_extremes() { extremes_ = {}; }

  /// Certifies the present state.
  void start(double t) {
    started_ = true;
    const PhaseScope certifying(*activity_, Phase::certificate);
    certificates_.start(t);
  }

  /// Checks a vertex after an event at time t.
  void look(VertexId i, double t) { certificates_.look(i, t); }

  double next_certificate() { return certificates_.next_time(); }
  void run_certificate() {
    const PhaseScope certifying(*activity_, Phase::certificate);
    certificates_.run_next();
  }

  double next_layer() const { return agenda_.empty() ? never : std::get<0>(*agenda_.begin()); }

  /// Fires the next layer; returns the number of pairs on which it acted. (The number for which it fired is not a
  /// property of the motion.) Tells gravity which vertices it strikes.
  template <class Recorder>
  std::size_t fire_next(Recorder& record, Books<double, Dim>& books, ScriptBook<double, Dim>& scripts,
                        Falling<double, Dim>& falling) {
    const auto [t, material, l] = *agenda_.begin();
    Layer& layer = layers_[material][l - 1];
    agenda_.erase(agenda_.begin());
    ++layer.clock.next;
    agenda_.insert({layer.clock.time(), material, l});
    return fire(Kicked<double, Dim, Recorder>{particles_, record, t, &scripts}, books, falling, material, l,
                layer.clock.step);
  }

  /// The half kicks with which a run begins.
  template <class Recorder>
  void fire_halves(Recorder& record, Books<double, Dim>& books, ScriptBook<double, Dim>& scripts,
                   Falling<double, Dim>& falling) {
    for (std::size_t m = 0; m < layers_.size(); ++m) {
      for (std::size_t l = 1; l <= layers_[m].size(); ++l) {
        fire(Kicked<double, Dim, Recorder>{particles_, record, 0, &scripts}, books, falling,
             static_cast<std::uint16_t>(m), static_cast<std::uint32_t>(l), 0.5 * layers_[m][l - 1].clock.step);
      }
    }
  }

  /// The anchors of friction at a window's end.
  std::vector<Anchor<double>> anchors(double t) const { return layer_fire_.anchors().after(t); }
  void restore(std::span<const Anchor<double>> anchors) { layer_fire_.anchors().restore(anchors); }

  /// Calls each(pair, closest points, g, r(l) times the weight of the pair, h(l)) for all active layers that act at the
  /// present positions.
  template <class Each>
  void for_each_acting(Each&& each) const {
    const auto position = [this](VertexId v) { return particles_[v].x; };
    for_each_layer([&](const Layer& layer, std::uint16_t, std::uint32_t) {
      layer_fire_.for_each_acting(layer.pairs.in_order(), layer.terms, position,
                                  [&](const certificates::Stencil& pair, const auto& closest, double g, double weight) {
                                    each(pair, closest, g, weight * layer.terms.stiffness, layer.clock.step);
                                  });
    });
  }

  /// Calls each(pairs, material, l) for all layers that may act, with the pairs for which they are active, in the order
  /// of their keys.
  template <class Each>
  void for_each_active(Each&& each) const {
    for_each_layer([&](const Layer& layer, std::uint16_t material, std::uint32_t l) {
      if (!layer.pairs.empty()) each(layer.pairs.in_order(), material, l);
    });
  }
  /// Precondition: the layer is or was active for a pair.
  LayerTerms terms_of(std::uint16_t material, std::uint32_t l) const { return layers_[material][l - 1].terms; }
  double step_of(std::uint16_t material, std::uint32_t l) const { return layers_[material][l - 1].clock.step; }

  const CertificateCounts& counts() const { return certificates_.counts(); }

  // --- For the certificates ------------------------------------------------------------------------------------------

  certificates::Line<Dim> line(VertexId i) const {
    const auto& p = particles_[i];
    return {p.x, p.t, p.v};
  }
  bool immovable(VertexId i) const { return particles_[i].inverse_mass == 0; }
  std::uint16_t material(const certificates::Stencil& pair) const {
    if (!settings_.excluded_pairs.empty() && std::ranges::binary_search(settings_.excluded_pairs, pair.key)) {
      return ContactSettings::excluded;
    }
    const std::span<const VertexId> vertices(pair.vertices.data(), pair.size());
    return settings_.material(vertices.first(pair.first()), vertices.subspan(pair.first()));
  }
  double thickness(std::uint16_t material, std::uint32_t l) const {
    return layer_thickness(settings_.materials[material], settings_.schedule, l);
  }
  /// Shows the broad phase as long as the returned object lives.
  PhaseScope in_broad_phase() const { return {*activity_, Phase::broad_phase}; }
  double look_step(VertexId i) const { return look_steps_[i]; }
  std::uint32_t least_layers() const { return settings_.least_layers; }
  std::size_t many_walls() const { return 64; }
  double greatest_thickness(VertexId i) const {
    return greatest_thicknesses_[settings_.groups[i] * settings_.class_count + settings_.class_of(i)];
  }

  void activate(const certificates::Stencil& pair, std::uint16_t material, std::uint32_t l, double t) {
    auto& of_material = layers_[material];
    const double step = l <= of_material.size() ? of_material[l - 1].clock.step
                                                : layer_step(settings_.materials[material], settings_.schedule, l);
    // A step that is too short to be counted at this time (first_after) would never come.
    if (l > most_in_advance + settings_.most_layers || !(t < 0x1p52 * step)) throw ContactLimit(pair, t);
    while (of_material.size() < l) {
      of_material.push_back(make_layer(material, static_cast<std::uint32_t>(of_material.size() + 1)));
    }
    Layer& layer = of_material[l - 1];
    if (layer.pairs.empty()) {
      // At t itself the layer gives no impulse, as it is activated before it is needed.
      layer.clock.next = std::max(layer.clock.next, first_after(t, layer.clock.step));
      agenda_.insert({layer.clock.time(), material, l});
    }
    layer.pairs.add(pair);
  }

  void deactivate(const certificates::Stencil& pair, std::uint16_t material, std::uint32_t l) {
    Layer& layer = layers_[material][l - 1];
    layer.pairs.remove(pair);
    if (layer.pairs.empty()) agenda_.erase({layer.clock.time(), material, l});
  }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();
  static constexpr double longest_slice = 8;  ///< in windows
  /// The layers above most_layers that a pair may have, so that watch() sees when one would act.
  static constexpr std::uint64_t most_in_advance = 1000;
  static_assert(ContactSettings::excluded == certificates::no_material);

  /// A pair for which the layer fired, and which was too far apart for it to act.
  struct Clear {
    std::size_t number;  ///< among the pairs for which it has fired
    double distance;     ///< [m]
  };

  struct Layer {
    Clock clock;
    LayerTerms terms;
    PairList pairs;  ///< the pairs for which it is active
  };

  /// Calls each(layer, material, l) for all layers that may act.
  template <class Each>
  void for_each_layer(Each&& each) const {
    for (std::size_t m = 0; m < layers_.size(); ++m) {
      const std::size_t count = std::min<std::size_t>(layers_[m].size(), settings_.most_layers);
      for (std::size_t l = 1; l <= count; ++l) {
        each(layers_[m][l - 1], static_cast<std::uint16_t>(m), static_cast<std::uint32_t>(l));
      }
    }
  }

  void drop_if_clear(const certificates::Stencil& pair, std::uint16_t material, std::uint32_t l, double distance,
                     double t) {
    const PhaseScope certifying(*activity_, Phase::certificate);
    certificates_.drop_if_clear(pair, material, l, distance, t);
  }

  static std::vector<Vec<double, Dim>> positions(const Particles& particles) {
    std::vector<Vec<double, Dim>> x;
    for (const auto& p : particles) x.push_back(p.x);
    return x;
  }

  Layer make_layer(std::uint16_t material, std::uint32_t l) const {
    const ContactMaterial& m = settings_.materials[material];
    const LayerSchedule& s = settings_.schedule;
    const double step = layer_step(m, s, l);
    const LayerTerms terms{
        layer_thickness(m, s, l), layer_stiffness(m, s, l), m.restitution, m.friction, 1.5 * step, material, l};
    return {{step, 1}, terms, {}};
  }

  template <class Recorder>
  std::size_t fire(const Kicked<double, Dim, Recorder>& now, Books<double, Dim>& books, Falling<double, Dim>& falling,
                   std::uint16_t material, std::uint32_t l, double h) {
    const double t = now.t;
    const PhaseScope busy(*activity_, Phase::layer);
    if (l > settings_.most_layers) {
      watch(material, l, t);
      return 0;
    }
    const auto firing = layers_[material][l - 1].pairs.in_order();  // as they are now, despite later changes
    now.record.reserve(4 * firing.size());
    const LayerTerms terms = terms_of(material, l);
    if constexpr (requires { now.record.layer_fires(Firing{t, h, terms}); }) {
      now.record.layer_fires(Firing{t, h, terms});
    }
    Account<double, Dim>& account = books.contact[material];
    std::size_t acted = 0;
    const auto seen = [&](std::size_t i, const Approach<double, Dim>& approach, const Course& course) {
      if constexpr (requires { now.record.examined(firing[i], course); }) {
        now.record.examined(firing[i], approach.with_corners(course));
      }
      const double d = approach.distance;
      if (d < terms.thickness) {
        ++acted;
        extremes_.add({firing[i], t, d, material, l});
      } else if (d > terms.thickness) {
        clear_.push_back({i, d});
      }
    };
    layer_fire_(now, firing, terms, h, account, seen,
                [this](const auto& pair, const auto& closest) { add_struck(pair, closest); });
    account.events += acted;
    for (const VertexId i : struck_) falling.strike(i, material, t);
    certify(firing, material, l, t);
    return acted;
  }

  /// Updates certificates for the struck vertices and clear pairs. Called after the layer has fired for all its pairs,
  /// as a vertex is part of many pairs.
  void certify(std::span<const certificates::Stencil> fired, std::uint16_t material, std::uint32_t l, double t) {
    const PhaseScope certifying(*activity_, Phase::certificate);
    for (const VertexId i : struck_) {
      is_struck_[i] = 0;
      look(i, t);
    }
    for (const Clear& clear : clear_) certificates_.drop_if_clear(fired[clear.number], material, l, clear.distance, t);
    struck_.clear();
    clear_.clear();
  }

  /// Checks a layer that must not act. Throws ContactLimit if it would.
  void watch(std::uint16_t material, std::uint32_t l, double t) {
    const auto watched = layers_[material][l - 1].pairs.in_order();
    const double eta = terms_of(material, l).thickness;
    for (const certificates::Stencil& pair : watched) {
      const double d = closest_of<double, Dim>(pair, [&](VertexId v) { return particles_[v].at(t); }).distance();
      if (!(d >= eta)) throw ContactLimit(pair, t);
      if (d > eta) drop_if_clear(pair, material, l, d, t);
    }
  }

  void add_struck(const certificates::Stencil& pair, const certificates::Closest<Dim>& closest) {
    for_each_struck<double, Dim>(pair, closest, [this](VertexId v) {
      if (is_struck_[v] || immovable(v)) return;
      is_struck_[v] = 1;
      struck_.push_back(v);
    });
  }

  ContactSettings settings_;
  Particles& particles_;
  std::vector<double> look_steps_;
  std::vector<std::vector<Layer>> layers_;                             ///< [material][l - 1]
  std::vector<double> greatest_thicknesses_;                           ///< [group * class_count + class]
  std::set<std::tuple<double, std::uint16_t, std::uint32_t>> agenda_;  ///< of layers with pairs: when they fire next
  LayerFire<double, Dim> layer_fire_;
  std::vector<std::uint8_t> is_struck_;  ///< by vertex: struck by the layer that fires now
  std::vector<VertexId> struck_;         ///< these vertices
  std::vector<Clear> clear_;             ///< pairs of the layer that fires now
  ContactExtremes extremes_;
  Activity unseen_;
  Activity* activity_ = &unseen_;
  bool started_ = false;
  Certificates<Dim, Contact> certificates_;
};

}  // namespace noli::integrator
