// SPDX-License-Identifier: Apache-2.0
#include "app/ranks/ranks.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <noli/errors.h>
#include <noli/version.h>
#include "app/ranks/mpi_library.h"
#include "certify/process/this_program.h"
#include "kernel/parallel.h"

namespace noli::app {
namespace {

/// As the environment of a process that mpirun started tells it; 1 for all others.
int ranks_in_environment() {
  const char* const size = std::getenv("OMPI_COMM_WORLD_SIZE");
  return size == nullptr ? 1 : std::atoi(size);
}

/// Where it was built, or where it is installed.
std::filesystem::path library_file() {
  const auto here = beside_this_program("noli_mpi.so");
  return std::filesystem::exists(here) ? here : beside_this_program(NOLI_MPI_FOLDER) / "noli_mpi.so";
}

std::array<char, NOLI_MPI_PROGRAM_BYTES> this_program() {
  std::array<char, NOLI_MPI_PROGRAM_BYTES> bytes{};
  const std::string text = version_number() + ' ' + version_commit();
  std::copy_n(text.begin(), std::min(text.size(), bytes.size()), bytes.begin());
  return bytes;
}

void require(int result) {
  if (result != 0) throw std::runtime_error("MPI failed");
}

}  // namespace

struct Ranks::Library {
  explicit Library(const std::filesystem::path& file) : handle(::dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL)) {
    if (handle == nullptr) {
      throw UsageError(fmt::format(
          "mpirun started {} ranks, but noli_mpi.so cannot be loaded ({}); build Noli with NOLI_WITH_MPI, or use "
          "--shard",
          ranks_in_environment(), on_one_line(::dlerror())));
    }
    find(version, "noli_mpi_version");
    if (version() != NOLI_MPI_VERSION) throw UsageError("noli_mpi.so is of another version of Noli");
    find(begin, "noli_mpi_begin");
    find(next, "noli_mpi_next");
    find(take_no_more, "noli_mpi_take_no_more");
    find(meet, "noli_mpi_meet");
    find(end, "noli_mpi_end");
  }

  template <class Function>
  void find(Function*& function, const char* name) {
    function = reinterpret_cast<Function*>(::dlsym(handle, name));
    if (function == nullptr) throw UsageError(fmt::format("noli_mpi.so has no {}", name));
  }

  void* handle;  ///< never closed, as MPI cannot be unloaded
  decltype(noli_mpi_version)* version = nullptr;
  decltype(noli_mpi_begin)* begin = nullptr;
  decltype(noli_mpi_next)* next = nullptr;
  decltype(noli_mpi_take_no_more)* take_no_more = nullptr;
  decltype(noli_mpi_meet)* meet = nullptr;
  decltype(noli_mpi_end)* end = nullptr;
};

Ranks::Ranks(std::unique_ptr<Library> library) : library_(std::move(library)) {
  noli_mpi_place place = {};
  const int result = library_->begin(this_program().data(), &place);
  if (result == 1) {
    throw UsageError("not all ranks are the same program; expected one version and commit of Noli on all machines");
  }
  require(result);
  rank_ = place.rank;
  size_ = place.size;
  on_this_machine_ = place.on_this_machine;
}

Ranks::~Ranks() = default;

bool Ranks::are_there() { return ranks_in_environment() > 1; }

std::unique_ptr<Ranks> Ranks::of_this_job() {
  if (!are_there()) return nullptr;
  return std::unique_ptr<Ranks>(new Ranks(std::make_unique<Library>(library_file())));
}

int Ranks::threads() const { return std::max(1, hardware_threads() / on_this_machine_); }

std::uint64_t Ranks::next_task() {
  std::uint64_t task = 0;
  require(library_->next(&task));
  return task;
}

void Ranks::take_no_more() { require(library_->take_no_more()); }

void Ranks::meet() {
  std::int32_t code = 0;
  require(library_->meet(&code));
}

ExitCode Ranks::end(ExitCode code) {
  auto of_all = static_cast<std::int32_t>(code);
  require(library_->meet(&of_all));
  require(library_->end());
  return static_cast<ExitCode>(of_all);
}

}  // namespace noli::app
