// SPDX-License-Identifier: Apache-2.0
//
// Whole pairs of frames: everything but reading the files, all contacts counted, in units of the mean time of one
// textbook query on armadillo-rollers-vertex-face, measured before and after in the same run. And generated sheets of
// growing size, to see what a face costs. Every measurement runs in a process of its own; the median of five counts.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>

#include "bench/bench.h"
#include "bench/child.h"
#include "bench/data.h"
#include "bench/report.h"
#include "bench/sheets.h"
#include "bench/textbook.h"
#include "proofs/prover/verifier.h"
#include "trajectory/formats/frame_inputs.h"
#include "trajectory/formats/frame_sequence.h"

namespace noli::bench {
namespace {

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double verify_seconds(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1, int threads) {
  VerifyOptions options;
  options.threads = threads;
  return seconds_of([&] { benchmark::DoNotOptimize(verify_step(mesh, x_t0, x_t1, options).contacts); });
}

double verify_pair(const FramePair& pair, int threads) {
  FrameInputs frames({pair.path_t0, pair.path_t1});
  FrameSequence sequence(frames);
  sequence.next();
  return verify_seconds(sequence.mesh(), sequence.x_t0(), sequence.x_t1(), threads);
}

double verify_sheets(std::size_t faces) {
  const Step step = falling_sheets(faces);
  return verify_seconds(step.mesh, step.x_t0, step.x_t1, 1);
}

constexpr std::size_t chain_faces = 100'000;

/// The mean of the 15 last steps of a chain, in each of which the sheets of falling_sheets() come a sixteenth nearer.
/// `carried`: each step takes over what the one before leaves; else each is decided by itself.
double verify_chain(bool carried) {
  const Step whole = falling_sheets(chain_faces);
  const auto at = [&](double t) {
    std::vector<Position> x = whole.x_t0;
    for (std::size_t v = 0; v < x.size(); ++v) {
      for (std::size_t k = 0; k < 3; ++k) x[v][k] += t * (whole.x_t1[v][k] - x[v][k]);
    }
    return x;
  };
  std::unique_ptr<ChainMemory> chain;
  VerifyOptions options;
  options.threads = 1;
  if (carried) options.chain = &chain;
  double seconds = 0;
  for (int step = 0; step < 16; ++step) {
    const std::vector<Position> x_t0 = at(step / 16.0), x_t1 = at((step + 1) / 16.0);
    const double taken =
        seconds_of([&] { benchmark::DoNotOptimize(verify_step(whole.mesh, x_t0, x_t1, options).contacts); });
    if (step > 0) seconds += taken / 15;
  }
  return seconds;
}

/// Largest peak memory of the repetitions of each benchmark, by its name.
using Peaks = std::map<std::string, double>;

void register_measurement(const std::string& name, Peaks& peaks, std::function<double()> measure) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [name, &peaks, measure = std::move(measure)](benchmark::State& state) {
                                 for (auto _ : state) {
                                   const Measured measured = in_child(measure);
                                   state.SetIterationTime(measured.seconds);
                                   peaks[name] = std::max(peaks[name], measured.peak_bytes);
                                 }
                               })
      ->UseManualTime()
      ->Iterations(1)
      ->Repetitions(passes)
      ->ReportAggregatesOnly(true)
      ->Unit(benchmark::kMillisecond);
}

/// Mean time of a textbook query, in ns. The array is too large for the measurements' parent, so it lives in a child
/// too.
void register_unit(const std::string& name, Peaks& peaks) {
  register_measurement(name, peaks, [] {
    const auto file = read_query_file("armadillo-rollers-vertex-face");
    const auto work = workload(std::get<std::vector<VertexFace3>>(file.value().queries));
    std::size_t contacts = 0;
    const auto pass = [&] { contacts += count_true(work, [](const VertexFace3& q) { return textbook_meet(q); }); };
    pass();  // memory and caches are warm from here on
    const double seconds = seconds_of(pass);
    benchmark::DoNotOptimize(contacts);
    return seconds / static_cast<double>(work.size());
  });
}

std::string megabytes(const Peaks& peaks, const std::string& name) {
  return fmt::format("{:.0f}", peaks.at(name) / 1e6);
}

std::string pair_name(const FramePair& pair, int threads) { return fmt::format("{}/threads:{}", pair.name, threads); }

void add_pair(const FramePair& pair, const MedianReporter& reporter, const Peaks& peaks, double unit_ns, Table& table) {
  const double* const one = reporter.median_ns(pair_name(pair, 1));
  const double* const two = reporter.median_ns(pair_name(pair, 2));
  if (one == nullptr || two == nullptr) return;
  table.row({pair.name, fmt::format("{:.3f}", *one * 1e-9), unit_ns > 0 ? fmt::format("{:.2g}", *one / unit_ns) : "-",
             fmt::format("{:.3f}", *two * 1e-9), fmt::format("{:.2f}", *one / *two),
             megabytes(peaks, pair_name(pair, 1))});
}

constexpr std::array<std::size_t, 4> sheet_faces = {1'000, 10'000, 100'000, 1'000'000};

std::string sheets_name(std::size_t faces) { return fmt::format("sheets/{}", faces); }

void add_sheets(std::size_t faces, const MedianReporter& reporter, const Peaks& peaks, Table& table) {
  const double* const ns = reporter.median_ns(sheets_name(faces));
  if (ns == nullptr) return;
  const std::size_t count = falling_sheets(faces).mesh.faces.size();
  table.row({fmt::format("{}", count), fmt::format("{:.4f}", *ns * 1e-9),
             fmt::format("{:.0f}", *ns / static_cast<double>(count)), megabytes(peaks, sheets_name(faces))});
}

double mean_unit_ns(const MedianReporter& reporter) {
  const double *const before = reporter.median_ns("unit/before"), *const after = reporter.median_ns("unit/after");
  return before == nullptr || after == nullptr ? 0 : (*before + *after) / 2;
}

void print_tables(const std::vector<FramePair>& pairs, const MedianReporter& reporter, const Peaks& peaks) {
  const double unit_ns = mean_unit_ns(reporter);
  Table frames({"frames", "1 thread, s", "in textbook queries", "2 threads, s", "speed-up", "peak MB"});
  for (const FramePair& pair : pairs) add_pair(pair, reporter, peaks, unit_ns, frames);
  Table growth({"sheets: faces", "1 thread, s", "ns a face", "peak MB"});
  for (const std::size_t faces : sheet_faces) add_sheets(faces, reporter, peaks, growth);
  const double *const carried = reporter.median_ns("chain/carried"), *const alone = reporter.median_ns("chain/alone");
  if (carried != nullptr && alone != nullptr) {
    std::fputs(fmt::format("\nA step of a chain, {} faces: {:.4f} s; decided by itself: {:.4f} s ({:.2f})\n",
                           chain_faces, *carried * 1e-9, *alone * 1e-9, *carried / *alone)
                   .c_str(),
               stdout);
  }
  std::fputs(fmt::format("\n{}\nOne textbook query: {:.1f} ns.\n\n{}", frames.text(), unit_ns, growth.text()).c_str(),
             stdout);
}

}  // namespace

bool run() {
  const auto pairs = frame_pairs();
  Peaks peaks;
  const bool has_unit = read_query_file("armadillo-rollers-vertex-face").has_value();
  if (has_unit) register_unit("unit/before", peaks);
  for (const FramePair& pair : pairs) {
    for (const int threads : {1, 2}) {
      register_measurement(pair_name(pair, threads), peaks, [pair, threads] { return verify_pair(pair, threads); });
    }
  }
  if (has_unit) register_unit("unit/after", peaks);
  for (const std::size_t faces : sheet_faces) {
    register_measurement(sheets_name(faces), peaks, [faces] { return verify_sheets(faces); });
  }
  for (const bool carried : {true, false}) {
    register_measurement(carried ? "chain/carried" : "chain/alone", peaks, [carried] { return verify_chain(carried); });
  }
  MedianReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  print_tables(pairs, reporter, peaks);
  return true;  // the sheets need no data
}

}  // namespace noli::bench
