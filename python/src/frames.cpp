// SPDX-License-Identifier: Apache-2.0
#include "python/src/frames.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <string>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <noli/errors.h>
#include "python/src/arrays.h"
#include "trajectory/write_file.h"

namespace noli::python {
namespace {

namespace py = pybind11;

/// Gives what the last step has freed back to the system. With an arena for each thread, the allocator would keep twice
/// what a step needs.
void return_memory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

using FrameFunction = std::function<std::optional<std::vector<Position>>(std::size_t)>;

/// Each frame is an array that `next` makes, or None behind the last.
FrameFunction from_calls(const py::object& next, std::shared_ptr<Background*> background) {
  return [next, background = std::move(background)](std::size_t k) {
    return_memory();
    std::optional<std::vector<Position>> frame;
    const auto ask = [&] {
      const py::object array = next(k);
      if (!array.is_none()) frame = PositionArray(array.cast<py::array>()).frame(0);
    };
    (*background)->call(ask);
    return frame;
  };
}

FrameFunction from_array(py::array array) {
  auto positions = std::make_shared<const PositionArray>(std::move(array));
  return [positions](std::size_t k) {
    return_memory();
    return std::optional(positions->frame(k));
  };
}

}  // namespace

Frames::Frames(py::object given) : background_(std::make_shared<Background*>(nullptr)) {
  auto frames = std::make_shared<GivenFrames>();
  const auto vertices = given.attr("vertices").cast<std::size_t>();
  frames->mesh = mesh_of(given.attr("mesh"), vertices);
  frames->bodies = bodies_of(given.attr("mesh"), vertices);
  frames->count = given.attr("count").cast<std::optional<std::size_t>>();
  frames->again = given.attr("again").cast<bool>();
  frames->numbers = given.attr("numbers").cast<std::string>();
  const py::object array = given.attr("array");
  frames->frame = array.is_none() ? from_calls(given.attr("next"), background_) : from_array(array.cast<py::array>());
  // The last owner may be a worker thread without the GIL.
  given_ = std::shared_ptr<const GivenFrames>(frames.get(), [frames, given = std::move(given)](const void*) mutable {
    const py::gil_scoped_acquire locked;
    frames.reset();
    given.release().dec_ref();
  });
}

void Frames::read_again_through(Background* background) {
  if (!given_->again) throw UsageError("the frames came from a generator, which is spent; expected an array or a list");
  call_through(background);
}

Mesh mesh_of(const py::object& mesh, std::size_t vertex_count) {
  using Indices = py::array_t<std::int64_t>;
  return mesh_of(vertex_count, mesh.attr("faces").cast<Indices>(), mesh.attr("edges").cast<Indices>(),
                 mesh.attr("points").cast<Indices>());
}

std::vector<FrameBody> bodies_of(const py::object& mesh, std::size_t vertex_count) {
  std::vector<FrameBody> bodies;
  for (const auto& row : mesh.attr("_consecutive_bodies")(vertex_count)) {
    const auto [name, first_vertex, vertices, first_face, faces] =
        row.cast<std::tuple<std::string, std::uint64_t, std::uint64_t, std::uint64_t, std::uint64_t>>();
    bodies.push_back({name, first_vertex, vertices, first_face, faces, false});
  }
  return bodies;
}

std::shared_ptr<const IgnoredGroups> ignored_groups_of(const py::object& mesh, std::size_t vertex_count, bool named) {
  const auto text = mesh.attr("_groups")(vertex_count, named).cast<std::optional<std::string>>();
  if (!text) return nullptr;
  auto groups = std::make_shared<IgnoredGroups>();
  groups->file = groups->folder.path() / "ignore.json";
  write_file(groups->file, *text);
  return groups;
}

}  // namespace noli::python
