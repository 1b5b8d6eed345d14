// SPDX-License-Identifier: Apache-2.0
#include <noli/errors.h>
#include <noli/simulate.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <unistd.h>

#include <cfenv>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "certify/runs/run_series_reader.h"
#include "python/src/background.h"
#include "python/src/bindings.h"
#include "python/src/options.h"
#include "python/src/series.h"
#include "report/documents.h"
#include "report/simulate_report.h"
#include "trajectory/stop.h"

namespace noli::python {
namespace {

namespace py = pybind11;

/// A simulation in a thread of its own, which is at most one window ahead of who asks for windows.
class Simulation {
 public:
  Simulation(std::filesystem::path scene, std::filesystem::path run, const py::dict& options) {
    request_.scene = std::move(scene);
    request_.run = std::move(run);
    put(options, "short", request_.brief);
    put(options, "resume", request_.resume);
    put(options, "force", request_.force);
    put(options, "prove", request_.prove);
    put(options, "until", request_.until);
    put(options, "past_duration", request_.past_duration);
    put(options, "ignore_space", request_.ignore_space);
    put(options, "threads", request_.threads);
    request_.deadline = deadline_of(options);
    request_.stop = &stop_;
    request_.keep_going = [this](const SeriesRow& row) { return offer(row); };
    thread_ = std::thread([this] { work(); });
  }
  ~Simulation() { close(); }
  /// Not in the child of a fork, which has no such thread.
  bool is_of_this_process() const { return process_ == ::getpid(); }
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// The next window, or None behind the last. Throws what the simulation threw.
  py::object next() {
    if (!is_of_this_process()) throw UsageError("the simulation belongs to the parent process");
    const auto alone = one_at_a_time_.enter();
    const Working working(stop_);
    const std::optional<SeriesRow> row = wait_for_row();
    if (!row) return py::none();
    std::optional<RunWindow> window;
    {
      const py::gil_scoped_release unlocked;
      window = read_up_to(row->time);
    }
    return window_of(*window, &*row);
  }

  /// Ends it at the last committed window, and waits for that.
  void close() {
    if (!is_of_this_process()) return;
    stop_ = true;
    changed_.notify_all();
    if (one_at_a_time_.is_mine()) return;  // a signal handler of the thread that waits for a window: it ends now
    const auto alone = one_at_a_time_.enter();
    const py::gil_scoped_release unlocked;
    if (thread_.joinable()) thread_.join();
  }

  /// Once it has ended.
  std::string json() const {
    if (!has_outcome()) return "null";
    return to_text(report::document("simulate", report::simulate_json(request_, *outcome_)));
  }
  std::string text() const {
    if (!has_outcome()) return "";
    return text_of(report::simulate_answer(report::simulate_json(request_, *outcome_), request_, *outcome_));
  }

 private:
  bool has_outcome() const {
    const std::lock_guard lock(mutex_);
    return ended_ && outcome_;
  }

  void work() {
    std::fesetenv(FE_DFL_ENV);
    const StopOfThread stop_of_thread(stop_);
    try {
      outcome_ = run_simulate(request_);
    } catch (...) {
      thrown_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }

  bool offer(const SeriesRow& row) {
    std::unique_lock lock(mutex_);
    while (row_ && !stop_) changed_.wait_for(lock, std::chrono::milliseconds(50));
    if (stop_) return false;
    row_ = row;
    changed_.notify_all();
    return true;
  }

  std::optional<SeriesRow> wait_for_row() {
    std::optional<SeriesRow> row;
    for (bool settled = false; !settled;) {
      {
        const py::gil_scoped_release unlocked;
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, std::chrono::milliseconds(50), [this] { return row_ || ended_; });
        settled = row_ || ended_;
        row = std::exchange(row_, std::nullopt);
        changed_.notify_all();
      }
      if (!settled && PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
    if (!row && thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
    return row;
  }

  /// The window that ends then, which has been committed. Those before it were there when a run was resumed.
  RunWindow read_up_to(double time) {
    if (!reader_) reader_.emplace(request_.run);
    reader_->look_again();
    while (auto window = reader_->next_window()) {
      if (window->end >= time) return *std::move(window);
    }
    throw InputError(request_.run.string(), "", "has fewer windows than were committed; expected no other writer");
  }

  SimulateRequest request_;
  std::optional<SimulateOutcome> outcome_;
  std::optional<SeriesReader> reader_;
  std::atomic<bool> stop_ = false;
  OneAtATime one_at_a_time_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<SeriesRow> row_;  ///< committed, and not asked for yet
  bool ended_ = false;
  std::exception_ptr thrown_;
  std::thread thread_;
  int process_ = ::getpid();
};

/// In the child of a fork it stays, since the destructors of its members would wait for the parent's thread.
struct Deleter {
  void operator()(Simulation* simulation) const {
    if (simulation->is_of_this_process()) delete simulation;
  }
};

}  // namespace

void bind_simulate(py::module_& core) {
  py::class_<Simulation, std::unique_ptr<Simulation, Deleter>>(core, "Simulation")
      .def(py::init<std::filesystem::path, std::filesystem::path, const py::dict&>())
      .def("next", &Simulation::next)
      .def("close", &Simulation::close)
      .def("json", &Simulation::json)
      .def("text", &Simulation::text);
}

}  // namespace noli::python
