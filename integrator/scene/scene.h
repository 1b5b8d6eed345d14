// SPDX-License-Identifier: Apache-2.0
//
// A scene as plain data: the fields of schemas/scene.json, with every default filled in. SI units. Vectors of scenes of
// dimension 2 have a third coordinate, which is zero. integrator/scene/build_model.h makes the meshes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <noli/mesh.h>
#include "integrator/clocks.h"
#include "integrator/model.h"
#include "integrator/scene/schema.h"

namespace noli::integrator {

constexpr double most_vertices = 2e7;  ///< of a generated mesh; more would not fit into memory with all their forces

struct MeshFile {
  std::string path;  ///< as written in the scene
  friend bool operator==(const MeshFile&, const MeshFile&) = default;
};

struct LoosePoints {
  std::vector<Position> at;
  friend bool operator==(const LoosePoints&, const LoosePoints&) = default;
};

struct Chain {
  std::vector<Position> points;
  std::uint32_t segments = 1;
  bool smooth = false, closed = false;
  friend bool operator==(const Chain&, const Chain&) = default;
};

struct Ring {
  double radius = 1;
  std::uint32_t segments = 3;
  friend bool operator==(const Ring&, const Ring&) = default;
};

enum class Diagonals : std::uint8_t { alternating, parallel };

/// A place at which a grid's triangles are smaller by a factor.
struct FinePlace {
  std::array<double, 2> at{};
  double factor = 2, radius = 0;
  friend bool operator==(const FinePlace&, const FinePlace&) = default;
};

struct Grid {
  std::array<double, 2> size{1, 1};
  std::array<std::uint32_t, 2> cells{1, 1};
  Diagonals diagonals = Diagonals::alternating;
  std::optional<FinePlace> refine;
  friend bool operator==(const Grid&, const Grid&) = default;
};

struct Ribbon {
  std::vector<Position> points;
  double width = 1;
  std::uint32_t segments = 1, across = 1;
  Position side{0, 0, 1};
  friend bool operator==(const Ribbon&, const Ribbon&) = default;
};

struct Disc {
  double radius = 1;
  std::uint32_t rings = 1;
  friend bool operator==(const Disc&, const Disc&) = default;
};

struct Rod {
  double length = 1, radius = 1;
  std::uint32_t segments = 1, sides = 3;
  friend bool operator==(const Rod&, const Rod&) = default;
};

struct Sphere {
  double radius = 1;
  std::uint32_t subdivisions = 0;
  friend bool operator==(const Sphere&, const Sphere&) = default;
};

struct SurfaceOfBox {
  std::array<double, 3> size{1, 1, 1};
  std::array<std::uint32_t, 3> cells{1, 1, 1};
  friend bool operator==(const SurfaceOfBox&, const SurfaceOfBox&) = default;
};

struct Torus {
  double radius = 2, tube_radius = 1;
  std::uint32_t segments = 3, sides = 3;
  friend bool operator==(const Torus&, const Torus&) = default;
};

struct Pyramid {
  double radius = 1, height = 1;
  std::uint32_t sides = 3;
  friend bool operator==(const Pyramid&, const Pyramid&) = default;
};

using MeshSource =
    std::variant<MeshFile, LoosePoints, Chain, Ring, Grid, Ribbon, Disc, Rod, Sphere, SurfaceOfBox, Torus, Pyramid>;

struct Deform {
  Position stretch{1, 1, 1};
  double twist = 0;  ///< [degrees/m]
  friend bool operator==(const Deform&, const Deform&) = default;
};

/// A turn about an axis through the origin.
struct AxisTurn {
  Position axis{0, 0, 1};  ///< of any length but zero
  double degrees = 0;
  friend bool operator==(const AxisTurn&, const AxisTurn&) = default;
};

/// w, x, y, z; of any length but zero.
struct Quaternion {
  std::array<double, 4> parts{1, 0, 0, 0};
  friend bool operator==(const Quaternion&, const Quaternion&) = default;
};

struct Transform {
  double scale = 1;
  std::variant<std::monostate, AxisTurn, Quaternion> rotate;
  Position translate{};
  friend bool operator==(const Transform&, const Transform&) = default;
};

/// Copies of a body in rows.
struct Array {
  std::array<std::uint32_t, 3> counts{1, 1, 1};
  Position spacing{};
  std::size_t copies() const { return std::size_t{counts[0]} * counts[1] * counts[2]; }
  friend bool operator==(const Array&, const Array&) = default;
};

struct ElasticMaterial {
  double young = 0, poisson = 0, density = 0, thickness = 0;
  double width = 0;  ///< of the section of a curve
  double bending = 1;
  friend bool operator==(const ElasticMaterial&, const ElasticMaterial&) = default;
};

/// Mass per area of a sheet [kg/m^2], per length of a curve [kg/m], per vertex [kg].
struct Densities {
  double area = 0, length = 0, vertex = 0;
  friend bool operator==(const Densities&, const Densities&) = default;
};

struct SpringMaterial {
  double edge_stiffness = 0, bending_stiffness = 0;
  Densities densities;  ///< exactly one is given
  friend bool operator==(const SpringMaterial&, const SpringMaterial&) = default;
};

struct Material {
  std::variant<ElasticMaterial, SpringMaterial> kind;
  double damping = 0, bending_damping = 0;  ///< [s]
  friend bool operator==(const Material&, const Material&) = default;
};

/// A closed box.
struct Box {
  Position low{}, high{};
  friend bool operator==(const Box&, const Box&) = default;
};

/// Steps given in the scene [s].
struct GivenSteps {
  std::optional<double> stretch, bend;
  friend bool operator==(const GivenSteps&, const GivenSteps&) = default;
};

/// Factors and steps for the cells whose centre is in the box. The last patch that gives a step counts.
struct Patch {
  Box box;
  double stiffness_factor = 1, density_factor = 1;
  GivenSteps steps;
  friend bool operator==(const Patch&, const Patch&) = default;
};

/// Vertices of a body: each part a number, the name of a set, or a box.
using Selection = std::vector<std::variant<VertexId, std::string, Box>>;

struct Body {
  std::string name;
  MeshSource mesh;
  Deform deform;
  Transform transform;
  Array array;
  double perturb = 0;
  Position velocity{};
  Position spin{};  ///< in dimension 2 only its third coordinate
  Material material;
  std::vector<Patch> patches;
  bool stretch = true, bend = true;
  GivenSteps steps;
  Selection pin;
  friend bool operator==(const Body&, const Body&) = default;
};

struct ScriptPath {
  std::vector<double> times;
  std::vector<Position> moves;
  friend bool operator==(const ScriptPath&, const ScriptPath&) = default;
};

struct ScriptFrames {
  std::vector<std::string> files;
  double rate = 1, from = 0;
  friend bool operator==(const ScriptFrames&, const ScriptFrames&) = default;
};

struct ScriptedVertices {
  std::size_t body = 0;
  Selection vertices;
  std::variant<ScriptPath, ScriptFrames> motion;
  friend bool operator==(const ScriptedVertices&, const ScriptedVertices&) = default;
};

constexpr double default_stability = 0.05;  ///< of contact: step / sqrt(mass / (2 stiffness))
constexpr double greatest_stability = 0.5;  ///< above it a bounce gains energy without end

/// How bodies meet, as far as it is given.
struct ContactValues {
  std::optional<double> thickness, stiffness, step, stability;
  std::optional<double> restitution;  ///< of energy, even if it was given for velocity
  std::optional<double> friction;
  friend bool operator==(const ContactValues&, const ContactValues&) = default;
};

/// Two bodies, by their numbers, the lesser first.
using BodyPair = std::array<std::size_t, 2>;

struct ContactPair {
  BodyPair bodies{};
  ContactValues values;
  friend bool operator==(const ContactPair&, const ContactPair&) = default;
};

struct SceneContact {
  ContactValues values;  ///< for all pairs without values of their own
  LayerSchedule layers;
  bool inclusion_exclusion = false;
  std::uint32_t most_layers = 1000;
  std::vector<ContactPair> pairs;  ///< each pair at most once
  std::vector<BodyPair> excluded;  ///< none of `pairs`

  bool excludes(const BodyPair& pair) const { return std::ranges::find(excluded, pair) != excluded.end(); }
  friend bool operator==(const SceneContact&, const SceneContact&) = default;
};

enum class Record : std::uint8_t { full, frames };

struct Scene {
  std::filesystem::path path;  ///< of the file; paths in it are relative to its folder
  std::string title, about;
  int dimension = 3;
  double duration = 0, window = 0;
  std::optional<std::uint64_t> most_breakpoints;  ///< of a window
  std::uint64_t seed = 1;
  Record record = Record::full;
  double frame_rate = 60;
  Clocks steps = Clocks::grouped;
  double step_factor = 0.5;
  bool allow_unstable = false;
  Position gravity{};
  std::optional<double> gravity_step;
  std::vector<Body> bodies;
  std::vector<ScriptedVertices> scripts;
  std::optional<SceneContact> contact;  ///< nothing: a contact ends the run
  Json document;                        ///< the document that was read, with overrides applied and defaults filled in
  std::vector<DefaultTaken> defaults;
};

/// Whether the scene is shorter in its short form.
inline bool has_short_form(const Scene& scene) {
  const auto brief = scene.document.find("short");
  return brief != scene.document.end() && !brief->empty();
}

/// How many windows reach up to a time. If the time is a whole number of windows up to rounding, such as 0.07 with
/// windows of 0.01, it is exactly that number.
inline double windows_up_to(double time, double window) { return std::ceil(time / window * (1 - 0x1p-50)); }

/// Whether some of the `there` windows of a run up to `time` have ended early.
inline bool some_ended_early(std::uint64_t there, double time, double window) {
  return static_cast<double>(there) > windows_up_to(time, window);
}

/// The least total number of windows of a run that has `there` windows up to `time`, if the whole run has `all` windows
/// when none ends early. It takes more if further windows end early because they have too many breakpoints. Empty if no
/// run can have reached this time.
inline std::optional<std::uint64_t> windows_in_all(std::uint64_t there, double time, double window, std::uint64_t all) {
  if (!(time >= 0 && time < 0x1p52 * window)) return std::nullopt;
  const std::uint64_t behind = first_after(time, window) - 1;
  return there + (all > behind ? all - behind : 0);
}

}  // namespace noli::integrator
