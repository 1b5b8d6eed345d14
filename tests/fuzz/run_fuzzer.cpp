// SPDX-License-Identifier: Apache-2.0
//
// Fuzzes the commands that read the folder of a run: for any numbers in its motion and states, with correct checksums,
// they give an answer or say what is wrong with the input.
//
// Input: changes to the blocks of a small run, as defined in tests/trajectory/mutate_run.h.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <noli/errors.h>
#include <noli/export.h>
#include <noli/simulate.h>
#include <noli/verify.h>
#include "certify/run_explanation.h"
#include "certify/runs/run_info.h"
#include "check_frame.h"
#include "report/figures/run_figure.h"
#include "report/page/report_page.h"
#include "report/page/report_run.h"
#include "report/run_explanation_report.h"
#include "tests/app/runs/bouncing_point.h"
#include "tests/support/temporary_folder.h"
#include "tests/trajectory/mutate_run.h"
#include "trajectory/stop.h"
#include "trajectory/write_file.h"

namespace {

namespace fs = std::filesystem;
using namespace noli;
using namespace noli::report;

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// An intact run, made once, and the path of its damaged copy.
struct Runs {
  noli::test::TemporaryFolder folder;
  fs::path scene = folder / "scene.json", whole = folder / "whole", run = folder / "run";
  std::string bytes;

  Runs() {
    nlohmann::json json = noli::app_tests::bouncing_point();
    json["duration"] = 0.5;
    noli::write_file(scene, json.dump());
    SimulateRequest request = simulate(whole);
    run_simulate(request);
    bytes = bytes_of(noli::trajectory_path(whole));
  }

  SimulateRequest simulate(const fs::path& to) const {
    SimulateRequest request;
    request.scene = scene;
    request.run = to;
    request.threads = 1;
    request.deadline = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    return request;
  }

  void make(std::string_view changes) const {
    fs::remove_all(run);
    fs::copy(whole, run, fs::copy_options::recursive);
    noli::write_file(noli::trajectory_path(run), noli::testing::mutated_run(bytes, changes));
  }
};

/// Calls the command. Exceptions other than these are findings.
template <class Command>
void ends(const Command& command) {
  try {
    command();
  } catch (const noli::InputError& error) {
    noli::fuzz::require(std::string_view(error.what()).find('\n') == std::string_view::npos);
  } catch (const noli::ReadInterrupted&) {
  } catch (const UsageError&) {
  }
}

void verify(const fs::path& run) {
  VerifyRequest request;
  request.frames = {run};
  request.run = true;
  request.threads = 1;
  request.deadline = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  run_verify(request);
}

/// Writes the report of the run to an empty page.
void report_page(const fs::path& run) {
  ReportPage page;
  page.page = {{"title", ""}, {"verdict", {{"word", "report"}, {"tone", "neutral"}, {"lines", Json::array()}}}};
  report_run(run, {}, page);
}

void all_commands(const Runs& runs) {
  const fs::path& run = runs.run;
  ends([&] { verify(run); });
  ends([&] {
    const RunExplanation explanation = explain_run(run);
    const Json json = to_json(explanation);
    noli::fuzz::require(json.is_object() && !answer_of(json, explanation).text.empty());
  });
  if (has_report_page()) ends([&] { report_page(run); });
  ends([&] { run_export({run, 20, (runs.folder / "frame%d.obj").string(), true}); });
  for (const char* const figure : figure_names) {
    ends([&] { run_figure({run, figure, (runs.folder / "figure.svg").string()}); });
  }
  ends([&] { run_info(run); });
  ends([&] { run_reproduce({runs.scene, false, run, 6, runs.folder / "block"}); });
  ends([&] {
    SimulateRequest request = runs.simulate(run);
    request.resume = true;
    run_simulate(request);
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Runs runs;
  runs.make({reinterpret_cast<const char*>(data), size});
  all_commands(runs);
  return 0;
}
