// SPDX-License-Identifier: Apache-2.0
//
// The implementation of a Simulation: particles, clocks and the loop over events.
//
// Notation: that of integrator/simulation.h and integrator/divisions.h, and
//   slot      many forces that fire in a row: a group of a division, or gravity on the vertices of one step
//   carried   of a vertex: gravity acts on it together with the force of its shortest step
//
// If forces have clocks of their own, they are in OwnClocks, and gravity has slots only for vertices that are not
// carried. An empty division has no slot and no event, so features that a scene does not use cost nothing.
#pragma once

#include <array>
#include <iterator>
#include <limits>
#include <span>
#include <stdexcept>
#include <type_traits>

#include "integrator/check_model.h"
#include "integrator/contact.h"
#include "integrator/divisions.h"
#include "integrator/gravity_events.h"
#include "integrator/groups.h"
#include "integrator/kick.h"
#include "integrator/own_clocks.h"
#include "integrator/phase.h"
#include "integrator/scripts.h"
#include "integrator/simulation.h"

namespace noli::integrator {

namespace detail {
/// Makes the engine look for NaNs and infinities after each force.
struct Watch : BreakpointCount {};
}  // namespace detail

/// `Touching` replaces Contact in a run with other numbers (audit/numerics/replayed_contact.h); void: Contact. If its
/// numbers are not S, models with contact are refused.
template <class S, int Dim, class Touching>
class Engine {
 public:
  using ContactType = std::conditional_t<std::is_void_v<Touching>, Contact<Dim>, Touching>;
  using Divisions = OfEachForce<Division, S, Dim>;

  explicit Engine(Model<S, Dim> model)
      : window_length_(model.window_length),
        most_breakpoints_(model.most_breakpoints),
        clocks_(model.clocks),
        timeline_(model.scripts) {
    check_model(model);
    make_particles(model);
    make_scripted(model);
    take_forces(model);
    make_gravity(model);
    make_own_clocks();
    make_contact(model);
  }

  /// Restores a snapshot. The state of all clocks follows from its time.
  void resume(const Snapshot<S, Dim>& snapshot) {
    windows_ = snapshot.windows;
    time_ = snapshot.time;
    const double t = time_;
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      particles_[i].x = snapshot.x[i];
      particles_[i].v = snapshot.v[i];
      particles_[i].t = t;
    }
    for (Group& slot : slots_) slot.clock.next = first_after(t, slot.clock.step);
    gravity_.falling().begin_window(window_end_after(t));
    if (t > 0) gravity_.falling().resume(t);
    due_ = nullptr;
    timeline_.skip_to(t);
    make_own_clocks();
    if constexpr (has_contact) {
      if (contact_) contact_->restore(snapshot.anchors);
    }
  }

  Snapshot<S, Dim> snapshot() const {
    Snapshot<S, Dim> result{windows_, time_, {}, {}, {}};
    if constexpr (has_contact) {
      if (contact_) result.anchors = contact_->anchors(time_);
    }
    for (const Particle<S, Dim>& p : particles_) {
      result.x.push_back(p.x);
      result.v.push_back(p.v);
    }
    return result;
  }

  double time() const { return time_; }
  std::uint64_t windows() const { return windows_; }
  std::uint64_t events() const { return events_; }
  const std::vector<Particle<S, Dim>>& particles() const { return particles_; }
  const std::vector<S>& masses() const { return masses_; }
  const S& contact_at_start() const { return contact_at_start_; }
  const Falling<S, Dim>& falling() const { return gravity_.falling(); }
  const ContactType* contact() const { return contact_.get(); }
  ContactType* contact() { return contact_.get(); }
  void show(Activity& activity) {
    activity_ = &activity;
    if (contact_) contact_->show(activity);
  }

  /// False if `stop`, which is polled, returned true: the state is then between two events of the window. Closes the
  /// books also when it throws ContactLimit.
  template <class Recorder, class Stop>
  bool run_window(Recorder& record, Books<S, Dim>& books, const Stop& stop) {
    double end = window_end_after(time_);
    open(record);
    books.make_room(material_count_, script_count_);
    script_book_ = {scripted_, books.scripts};
    const PhaseScope queueing(*activity_, Phase::queue);
    bool whole = false;
    try {
      whole = run_events(end, record, books, stop);
      instant_.close(particles_, books);
      if (whole) fall_at_end(end, record, books);
    } catch (const ContactLimit&) {
      close_books(books);
      throw;
    }
    close_books(books);
    if (!whole) return false;
    close(end, record);
    ++windows_;
    time_ = end;
    return true;
  }

  /// The groups; if forces have clocks of their own, the sets of forces with the same step.
  std::vector<StepGroup> groups() const {
    std::vector<StepGroup> result;
    for (const Group& slot : slots_) {
      result.push_back({slot.kind, slot.clock.step, slot.end - slot.begin});
    }
    if (clocks_ != Clocks::own) return result;
    const std::vector<StepGroup> own = groups_by_step(divisions_);
    result.insert(result.end(), own.begin(), own.end());
    return result;
  }

  /// Calls each(division) for all divisions, in the order of kinds.
  template <class Each>
  void for_each_division(Each&& each) const {
    integrator::for_each_division(divisions_, each);
  }

 private:
  static constexpr std::uint64_t events_between_questions = 1 << 14;  ///< about a millisecond
  static constexpr int most_rows = 256;
  static constexpr std::size_t kinds = std::tuple_size_v<Divisions>;
  static constexpr bool has_contact = std::is_same_v<S, typename ContactType::Scalar>;

  template <class Recorder>
  using Now = Kicked<S, Dim, Recorder>;

  double window_end_after(double t) const {
    return static_cast<double>(first_after(t, window_length_)) * window_length_;
  }

  // --- Construction --------------------------------------------------------------------------------------------------

  void make_particles(const Model<S, Dim>& model) {
    masses_ = model.mass;
    particles_.resize(model.x.size());
    here_.resize(model.x.size());
    instant_ = Instant<S, Dim>(model.x.size());
    all_.resize(model.x.size());
    std::iota(all_.begin(), all_.end(), VertexId{0});
    const std::vector<std::uint8_t> held = held_vertices(model);
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      particles_[i] = {model.x[i], 0, model.v[i], S(1) / model.mass[i]};
      if (!held[i]) continue;
      particles_[i].inverse_mass = S(0);
      particles_[i].v.setZero();
    }
  }

  void make_scripted(const Model<S, Dim>& model) {
    if (model.scripts.empty()) return;
    scripted_.resize(particles_.size());
    for (const auto& script : model.scripts) {
      scripted_[script.vertex].script = script.number;
      script_count_ = std::max<std::size_t>(script_count_, script.number + std::size_t{1});
    }
  }

  void take_forces(Model<S, Dim>& model) {
    auto lists = model.forces.lists();
    [&]<std::size_t... I>(std::index_sequence<I...>) { (take_list(std::get<I>(divisions_), std::get<I>(lists)), ...); }
    (std::make_index_sequence<kinds>{});
  }

  template <class F>
  void take_list(Division<F>& division, ForceList<F>& list) {
    division.list = std::move(list);
    for (const F& force : division.list.forces) division.damped |= force.damping != S(0);
    if (clocks_ == Clocks::own) return;
    const std::vector<Group> groups = make_groups(division.list, window_length_);
    slots_.insert(slots_.end(), groups.begin(), groups.end());
  }

  void make_gravity(const Model<S, Dim>& model) {
    if (!model.gravity || model.gravity->acceleration == Vec<S, Dim>::Zero()) return;
    gravity_ = GravityEvents<S, Dim>(model, steps_of_forces(), masses_);
    gravity_.falling().begin_window(window_end_after(0));
    std::vector<Group> groups = gravity_groups(gravity_.steps(), clocks_);
    slots_.insert(slots_.begin(), std::make_move_iterator(groups.begin()), std::make_move_iterator(groups.end()));
  }

  void make_own_clocks() {
    if (clocks_ != Clocks::own) return;
    std::array<ForceTable, kinds> tables;
    std::vector<double> steps;
    std::vector<Calendar::EventData> data;
    Carriers carriers(gravity_.steps());
    std::uint16_t kind = 0;
    for_each_division([&](const auto& d) {
      tables[kind] = ForceTable(d.list.forces, steps.size());
      steps.insert(steps.end(), d.list.steps.begin(), d.list.steps.end());
      for (std::size_t i = 0; i < d.list.forces.size(); ++i) {
        data.push_back({kind, carriers.take(d.list.forces[i].vertices, d.list.steps[i])});
      }
      ++kind;
    });
    own_ = OwnClocks<kinds>(tables, Calendar(steps, data, time()), particles_.size());
  }

  void make_contact(const Model<S, Dim>& model) {
    if (!model.contact) return;
    material_count_ = model.contact->materials.size();
    if constexpr (has_contact) {
      contact_ = std::make_unique<ContactType>(*model.contact, model.mesh, particles_, look_steps(), window_length_);
      contact_->show(*activity_);
    } else {
      throw std::invalid_argument("model: no contact is computed in these numbers");
    }
  }

  std::vector<double> steps_of_forces() const {
    return shortest_steps(divisions_, particles_.size(),
                          [this](VertexId v) { return particles_[v].inverse_mass == S(0); });
  }

  /// The shortest step of everything that acts on each vertex.
  std::vector<double> look_steps() const { return gravity_.empty() ? steps_of_forces() : gravity_.steps().steps; }

  // --- The loop ------------------------------------------------------------------------------------------------------

  template <class Recorder>
  Now<Recorder> at(double t, Recorder& record) {
    return {particles_, record, t, &script_book_};
  }

  /// Runs events up to `end`, which becomes an earlier time if breakpoints become too many. False if it was stopped.
  template <class Recorder, class Stop>
  bool run_events(double& end, Recorder& record, Books<S, Dim>& books, const Stop& stop) {
    if (windows_ == 0) start(record, books);
    start_contact(record, books);
    std::uint64_t turns = 0, last = events_;
    while (run_next(end, record, books)) {
      if (record.size() >= most_breakpoints_ && record.last_time() > time_) end = record.last_time();
      if (events_ + ++turns - last < events_between_questions) continue;
      if (stop()) return false;
      last = events_ + turns;
    }
    return true;
  }

  template <class Recorder>
  void start(Recorder& record, Books<S, Dim>& books) {
    const Now<Recorder> now = at<Recorder>(0, record);
    while (timeline_.next_time() <= 0) turn(now);
    if (!gravity_.empty()) {
      fall(books, [&](Account<S, Dim>& account) { gravity_.start(now, all_, instant_, account); });
    }
    for (const Group& slot : slots_) {
      if (slot.kind != ForceKind::gravity) fire_slot(now, slot, S(0.5) * S(slot.clock.step), books);
    }
    instant_.close(particles_, books);
    if (clocks_ != Clocks::own) return;
    for_each_division([&](auto& division) { start_own(now, division, books); });
  }

  /// Certifies the present state. At time 0, fires half kicks of the layers that act.
  template <class Recorder>
  void start_contact(Recorder& record, Books<S, Dim>& books) {
    if constexpr (has_contact) {
      if (!contact_ || contact_->started()) return;
      contact_->start(time());
      if (windows_ > 0) return;
      contact_->for_each_acting([this](const auto&, const auto&, const S& g, const S& r, double) {
        contact_at_start_ += S(0.5) * r * g * g;
      });
      contact_->fire_halves(record, books, script_book_, gravity_.falling());
    }
  }

  template <class Recorder, class F>
  void start_own(const Now<Recorder>& now, const Division<F>& division, Books<S, Dim>& books) {
    for (std::size_t i = 0; i < division.list.forces.size(); ++i) {
      const DueForce half{now.t, 0.5 * division.list.steps[i], i};
      fire_single(now.record, division, std::span(&half, 1), books);
    }
  }

  /// Runs the next event, or the next few. False if all are later than `end`. Events at one time have this order:
  /// breakpoints of scripts, certificates, slots, gravity on struck vertices, forces with clocks of their own, layers
  /// of contact.
  template <class Recorder>
  bool run_next(double end, Recorder& record, Books<S, Dim>& books) {
    if (due_ == nullptr) due_ = next_slot();
    Group* const slot = due_;
    const double slot_time = slot != nullptr ? slot->clock.time() : std::numeric_limits<double>::infinity();
    const double turn_time = timeline_.next_time();
    const double own_time = own_.empty() ? std::numeric_limits<double>::infinity() : own_.next_time();
    const double struck_time = gravity_.falling().next_struck();
    const double force_time = std::min({slot_time, own_time, struck_time});
    if (turn_time <= end && turn_time <= force_time && !contact_before(turn_time)) {
      turn(at<Recorder>(turn_time, record));
      return true;
    }
    if (contact_ && run_contact(end, force_time, record, books)) return true;
    if (struck_time <= end && struck_time < slot_time && struck_time <= own_time) {
      fall_where_struck(at<Recorder>(struck_time, record), books);
      return true;
    }
    if (own_time <= end && own_time < slot_time) {
      run_own(end, std::min({slot_time, turn_time, struck_time}), record, books);
      return true;
    }
    if (slot_time > end) return false;
    ++slot->clock.next;
    due_ = next_slot();
    fire_slot(at<Recorder>(slot_time, record), *slot, S(slot->clock.step), books);
    if (last_of(slot_time)) instant_.close(particles_, books);
    return true;
  }

  /// Whether an event of contact comes before t.
  bool contact_before(double t) const {
    return contact_ && (contact_->next_certificate() < t || contact_->next_layer() < t);
  }

  /// Runs the next event of contact, if it is up to `end` and nothing else comes before it.
  template <class Recorder>
  bool run_contact(double end, double force_time, Recorder& record, Books<S, Dim>& books) {
    if constexpr (has_contact) {
      const double certificate = contact_->next_certificate(), layer = contact_->next_layer();
      if (certificate <= end && certificate <= force_time && certificate <= layer) {
        contact_->run_certificate();
        return true;
      }
      if (layer <= end && layer < force_time) {
        events_ += contact_->fire_next(record, books, script_book_, gravity_.falling());
        return true;
      }
    }
    return false;
  }

  template <class Recorder, class Vertices>
  void look(const Now<Recorder>& now, const Vertices& vertices) const {
    if (!contact_) return;
    const PhaseScope certifying(*activity_, Phase::certificate);
    for (const VertexId v : vertices) {
      if (particles_[v].inverse_mass != S(0)) contact_->look(v, now.t);
    }
  }

  /// The slot that fires next; the first one of several.
  Group* next_slot() {
    Group* best = nullptr;
    double time = std::numeric_limits<double>::infinity();
    for (Group& slot : slots_) {
      const double t = slot.clock.time();
      if (t < time) {
        time = t;
        best = &slot;
      }
    }
    return best;
  }

  template <class Recorder>
  void turn(const Now<Recorder>& now) {
    const Turn<S, Dim>& turn = timeline_.take();
    now.record.reserve(1);
    script_book_.turn(turn.vertex, now.t, particles_[turn.vertex].v);
    set_velocity(now, turn.vertex, turn.x, turn.v);
    if (contact_ && contact_->started()) contact_->look(turn.vertex, now.t);
  }

  template <class Recorder>
  void fire_slot(const Now<Recorder>& now, const Group& slot, const S& h, Books<S, Dim>& books) {
    if (slot.kind == ForceKind::gravity) return fall_slot(now, slot, books);
    const auto fire_if = [&](const auto& division) {
      using F = typename std::remove_cvref_t<decltype(division.list.forces)>::value_type;
      if (F::kind == slot.kind) fire_group(now, division, slot, h, books);
    };
    for_each_division(fire_if);
  }

  /// Whether the group that fires at t is the last one at this time; always false at time 0, when all fire.
  bool last_of(double t) const { return t > 0 && due_->clock.time() != t; }

  /// Runs some rows of forces with clocks of their own, up to `end` and before `other`.
  template <class Recorder>
  void run_own(double end, double other, Recorder& record, Books<S, Dim>& books) {
    constexpr bool watched = std::is_same_v<Recorder, detail::Watch>;  // it looks after each force
    const auto is_due = [&] { return own_.next_time() <= end && own_.next_time() < other; };
    const auto prefetch = [this](VertexId v) { __builtin_prefetch(&particles_[v], 1); };
    // Certificates must see all vertices at one time, and a breakpoint that ends a window early must be the last.
    const bool alone = watched || contact_ || nearly_full(record);
    for (int rows = 0; rows < (alone ? 1 : most_rows) && is_due(); ++rows) {
      own_.take_row(alone ? 1 : own_.longest_row, is_due, prefetch);
      fire_row(record, books, std::make_index_sequence<kinds>{});
    }
  }

  /// Whether the rows of run_own could have more breakpoints than a window.
  template <class Recorder>
  bool nearly_full(const Recorder& record) const {
    constexpr std::size_t most = most_rows * OwnClocks<kinds>::longest_row * ForceTable::most_vertices;
    return record.size() + most >= most_breakpoints_;
  }

  template <class Recorder, std::size_t... I>
  void fire_row(Recorder& record, Books<S, Dim>& books, std::index_sequence<I...>) {
    (fire_single(record, std::get<I>(divisions_), own_.row(I), books), ...);
  }

  template <class Recorder, class F>
  void fire_group(const Now<Recorder>& now, const Division<F>& division, const Group& group, const S& h,
                  Books<S, Dim>& books) {
    const PhaseScope firing(*activity_, Phase::force);
    events_ += group.end - group.begin;
    now.record.reserve(group.vertices.size());
    Account<S, Dim>& account = books.of(F::kind);
    if (division.damped) {
      fire_group_as<true>(now, division, group, h, account);
    } else {
      fire_group_as<false>(now, division, group, h, account);
    }
    look(now, group.vertices);
  }

  /// Flattened, like fire_single_as: each force takes a few dozen operations on numbers that should stay in registers,
  /// and so should the account.
  template <bool Damped, class Recorder, class F>
  [[gnu::flatten]] void fire_group_as(const Now<Recorder>& now, const Division<F>& division, const Group& group,
                                      const S& h, Account<S, Dim>& account) {
    const std::span<const F> forces(division.list.forces.data() + group.begin, group.end - group.begin);
    Account<S, Dim> sum;
    kick_all<Damped, F, S, Dim>(now, forces, group.vertices, here_, h, last_of(now.t), instant_, sum, *activity_);
    account += sum;
    if constexpr (std::is_same_v<Recorder, detail::Watch>) {
      for (const F& force : forces) watch(now, force);
    }
  }

  template <class Recorder, class F>
  void fire_single(Recorder& record, const Division<F>& division, std::span<const DueForce> firing,
                   Books<S, Dim>& books) {
    if (firing.empty()) return;
    const PhaseScope striking(*activity_, Phase::force);
    events_ += firing.size();
    record.reserve(F::size * firing.size());
    const SingleBlows<F, S, Dim, Recorder> blows{division.list.forces, firing, particles_, record, &script_book_};
    Account<S, Dim>& account = books.of(F::kind);
    if (division.damped) {
      fire_single_as<true>(blows, account);
    } else {
      fire_single_as<false>(blows, account);
    }
    if (!gravity_.empty()) {
      gravity_.fire_with(at<Recorder>(0, record), std::span<const F>(division.list.forces), firing);
    }
    if (!contact_ || !contact_->started()) return;
    for (const DueForce& due : firing) {
      look(at<Recorder>(due.t, record), division.list.forces[due.force].vertices);
    }
  }

  template <bool Damped, class Recorder, class F>
  [[gnu::flatten]] void fire_single_as(const SingleBlows<F, S, Dim, Recorder>& blows, Account<S, Dim>& account) {
    strike<Damped, F, S, Dim>(blows, account, *activity_);
    if constexpr (std::is_same_v<Recorder, detail::Watch>) {
      for (const DueForce& due : blows.firing) {
        watch(at<Recorder>(due.t, blows.record), blows.forces[due.force]);
      }
    }
  }

  // --- Gravity -------------------------------------------------------------------------------------------------------

  /// Certificates check carried vertices after their forces have fired, at the same time. (A certificate of this time
  /// may come in between: it sees the present positions and velocities.)
  template <class Recorder>
  void fall_slot(const Now<Recorder>& now, const Group& slot, Books<S, Dim>& books) {
    fall(books, [&](Account<S, Dim>& account) { gravity_.fire(now, slot, last_of(now.t), instant_, account); });
    if (!contact_) return;
    const PhaseScope certifying(*activity_, Phase::certificate);
    for (const VertexId i : slot.vertices) {
      if (gravity_.steps().carried[i] == 0) contact_->look(i, now.t);
    }
  }

  template <class Recorder>
  void fall_where_struck(const Now<Recorder>& now, Books<S, Dim>& books) {
    std::span<const VertexId> moved;
    fall(books, [&](Account<S, Dim>& account) { moved = gravity_.fire_where_struck(now, account); });
    look(now, moved);
  }

  template <class Recorder>
  void fall_at_end(double end, Recorder& record, Books<S, Dim>& books) {
    if (gravity_.empty()) return;
    const Now<Recorder> now = at<Recorder>(end, record);
    const double next_end = window_end_after(end);
    std::span<const VertexId> moved;
    fall(books, [&](Account<S, Dim>& account) { moved = gravity_.end_window(now, next_end, all_, account); });
    look(now, moved);
  }

  /// Counts the events that `fire(account)` books.
  template <class Fire>
  void fall(Books<S, Dim>& books, const Fire& fire) {
    const PhaseScope kicking(*activity_, Phase::kick);
    Account<S, Dim>& account = books.of(ForceKind::gravity);
    const std::uint64_t before = account.events;
    fire(account);
    events_ += account.events - before;
  }

  void close_books(Books<S, Dim>& books) {
    fall(books, [this](Account<S, Dim>& account) { gravity_.close_books(account); });
    books.sum_contact();
  }

  // --- Ends of windows -----------------------------------------------------------------------------------------------

  template <class Recorder>
  void open(Recorder& record) {
    const PhaseScope recording(*activity_, Phase::recording);
    record.reserve(particles_.size());
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      record.put(static_cast<VertexId>(i), particles_[i].t, particles_[i].x, true);
    }
    if (contact_) contact_->forget_extremes();
  }

  template <class Recorder>
  void close(double end, Recorder& record) {
    const PhaseScope recording(*activity_, Phase::recording);
    record.reserve(particles_.size());
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      Particle<S, Dim>& p = particles_[i];
      if (p.t == end) continue;
      p.x = p.at(end);
      p.t = end;
      record.put(static_cast<VertexId>(i), end, p.x, true);
    }
  }

  template <class Recorder, class F>
  void watch(const Now<Recorder>& now, const F& force) const {
    for (const VertexId v : force.vertices) {
      if (particles_[v].finite()) continue;
      throw NotFinite{now.t, F::kind, {force.vertices.begin(), force.vertices.end()}, v};
    }
  }

  double window_length_;
  std::size_t most_breakpoints_;
  Clocks clocks_;
  Timeline<S, Dim> timeline_;
  std::vector<S> masses_;
  std::vector<Particle<S, Dim>> particles_;
  std::vector<typename ScriptBook<S, Dim>::ScriptedVertex> scripted_;  ///< by vertex; empty without scripts
  std::size_t material_count_ = 0, script_count_ = 0;
  ScriptBook<S, Dim> script_book_;  ///< of the window that runs
  Instant<S, Dim> instant_;         ///< of the groups that strike now
  std::vector<VertexId> all_;       ///< vertices
  GravityEvents<S, Dim> gravity_;
  std::vector<Here<S, Dim>> here_;  ///< for kick_all; meaningless between calls
  Divisions divisions_;
  std::vector<Group> slots_;
  Group* due_ = nullptr;  ///< the slot that fires next, if known
  OwnClocks<kinds> own_;
  std::unique_ptr<ContactType> contact_;  ///< of the particles above; nothing in scenes without contact
  S contact_at_start_{};                  ///< its potential at time 0 [J], once the run has begun there
  std::uint64_t windows_ = 0;
  double time_ = 0;  ///< the last window's end [s]
  std::uint64_t events_ = 0;
  Activity unseen_;
  Activity* activity_ = &unseen_;
};

}  // namespace noli::integrator
