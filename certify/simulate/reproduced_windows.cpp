// SPDX-License-Identifier: Apache-2.0
#include "certify/simulate/reproduced_windows.h"

#include <fmt/format.h>

#include <utility>
#include <variant>

#include <noli/errors.h>
#include "certify/simulate/model_facts.h"
#include "certify/simulate/model_run.h"
#include "integrator/contact_extremes.h"
#include "integrator/scene/build_model.h"
#include "integrator/scene/read_scene.h"
#include "trajectory/blocks/run_manifest.h"

namespace noli {
namespace {

namespace fs = std::filesystem;

template <int Dim>
class Again : public ReproducedWindows {
 public:
  Again(fs::path run, integrator::Model<double, Dim> model, std::function<bool()> stop)
      : run_(std::move(run)), model_(std::move(model)), stop_(std::move(stop)) {}

  std::vector<Position> beginning() const override { return positions_of<Dim>(model_.x); }

  void continue_after(const RunWindow& window, const WindowState& state) override {
    before_ = snapshot_of<Dim>(window, state);
    simulation_.reset();
  }

  std::optional<WorldLines> next(const RunWindow& window, const WindowState& state) override {
    const std::uint64_t halvings = state.row.halvings;
    if (!simulation_ || halvings != halvings_) simulation_.emplace(simulation_at<Dim>(model_, before_, halvings));
    halvings_ = halvings;
    if (!integrate(window)) return std::nullopt;
    WorldLines lines = integrator::world_lines<Dim>(recording_, model_.x.size());
    integrator::Snapshot<double, Dim> there = snapshot_of<Dim>(window, state);
    require_same(window, lines, there);
    before_ = std::move(there);
    return lines;
  }

 private:
  /// False when it was stopped.
  bool integrate(const RunWindow& window) {
    recording_.clear();
    integrator::Books<double, Dim> books;
    try {
      if (!simulation_->run_window(recording_, books, stop_)) return false;
    } catch (const integrator::ContactLimit& limit) {
      differs(window, fmt::format("ends at {:.17g} s, where a pair needs more layers than allowed", limit.time));
    }
    if (!simulation_->finite()) differs(window, "has numbers that are not finite");
    return true;
  }

  void require_same(const RunWindow& window, const WorldLines& lines,
                    const integrator::Snapshot<double, Dim>& there) const {
    const Sha256Digest expected = window.lines ? lines_hash(Dim, *window.lines) : window.lines_hash;
    const Sha256Digest found = lines_hash(Dim, lines);
    if (found != expected) {
      differs(window, fmt::format("has world lines with SHA-256 {}; expected {}, which the run has", hex(found),
                                  hex(expected)));
    }
    const auto here = simulation_->snapshot();
    if (here.x != there.x || here.v != there.v || here.anchors != there.anchors)
      differs(window, "ends in a different state from the run");
  }

  [[noreturn]] void differs(const RunWindow& window, const std::string& problem) const {
    throw InputError(trajectory_path(run_).string(), fmt::format("window {}", window.index + 1),
                     "integrated again, it " + problem +
                         ": the run has been changed, or another version of noli wrote it (`noli info` says which)");
  }

  fs::path run_;
  integrator::Model<double, Dim> model_;
  std::function<bool()> stop_;
  integrator::Snapshot<double, Dim> before_;
  std::uint64_t halvings_ = 0;
  std::optional<integrator::Simulation<double, Dim>> simulation_;
  integrator::Recording<double, Dim> recording_;
};

/// Paths in a scene are relative to the folder of its file, which a run does not know.
void require_files(const fs::path& run, const integrator::Scene& scene) {
  std::error_code error;
  const auto require = [&](const std::string& file) {
    if (fs::exists(scene.path.parent_path() / file, error)) return;
    throw UsageError(fmt::format(
        "--reproduce: the scene of {} names {}, which is not in {}; pass --scene-folder FOLDER, the one of the scene "
        "that was run",
        run.string(), file, scene.path.parent_path().string()));
  };
  for (const integrator::Body& body : scene.bodies) {
    if (const auto* mesh = std::get_if<integrator::MeshFile>(&body.mesh)) require(mesh->path);
  }
  for (const auto& script : scene.scripts) {
    const auto* frames = std::get_if<integrator::ScriptFrames>(&script.motion);
    if (frames == nullptr) continue;
    for (const std::string& file : frames->files) require(file);
  }
}

template <int Dim>
std::unique_ptr<ReproducedWindows> make(const fs::path& run, const RunManifest& manifest,
                                        const integrator::Scene& scene, const RunScene& expected,
                                        const std::function<bool()>& stop) {
  auto model = integrator::build_model<Dim>(scene).model;
  if (manifest.model_sha256 && *manifest.model_sha256 != hash_of<Dim>(model)) {
    throw InputError((run / "manifest.json").string(), "/model/sha256",
                     "the run began with other meshes or paths; expected the files that the scene names, unchanged");
  }
  const bool same = model.mesh == expected.mesh && labels_of<Dim>(model) == expected.labels &&
                    exclusions_of<Dim>(model) == expected.exclusions && scene.window == expected.header.window_length;
  if (!same) {
    throw InputError((run / "scene.json").string(), "", "has different cells or windows from trajectory.blocks");
  }
  return std::make_unique<Again<Dim>>(run, std::move(model), stop);
}

}  // namespace

std::unique_ptr<ReproducedWindows> ReproducedWindows::of(const fs::path& run, const std::optional<fs::path>& files,
                                                         const RunScene& scene, const std::function<bool()>& stop) {
  const RunManifest manifest = read_manifest(run);
  const fs::path file = files.value_or(run) / "scene.json";
  const integrator::Scene read = integrator::parse_scene(noli::read_scene(run, manifest), file);
  require_files(run, read);
  if (read.dimension != static_cast<int>(scene.header.dimension)) {
    throw InputError((run / "scene.json").string(), "/dimension", "is not that of trajectory.blocks");
  }
  return read.dimension == 2 ? make<2>(run, manifest, read, scene, stop) : make<3>(run, manifest, read, scene, stop);
}

}  // namespace noli
