// SPDX-License-Identifier: Apache-2.0
#include "certify/ranks/ranks.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

#include <noli/errors.h>
#include <noli/version.h>
#include "certify/process/this_program.h"
#include "certify/ranks/mpi_library.h"
#include "kernel/parallel.h"

namespace noli {
namespace {

int number_in_environment(const char* name) {
  const char* const text = std::getenv(name);
  return text == nullptr ? 0 : std::atoi(text);
}

/// As the environment of a process that mpirun or srun started as part of an MPI job tells it; 0 for all others.
int ranks_in_environment() {
  const char* const wanted = std::getenv("NOLI_MPI");
  if (wanted != nullptr && std::string(wanted) == "0") return 0;
  const int of_srun = std::getenv("PMIX_RANK") == nullptr ? 0 : number_in_environment("SLURM_NTASKS");
  return std::max({0, number_in_environment("OMPI_COMM_WORLD_SIZE"), number_in_environment("PMI_SIZE"), of_srun});
}

/// Where it was built, or where it is installed.
std::filesystem::path library_file() {
  const auto here = beside_this_program("noli_mpi.so");
  std::error_code error;
  return std::filesystem::exists(here, error) ? here : beside_this_program(NOLI_MPI_FOLDER) / "noli_mpi.so";
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
          "mpirun started {} ranks, but noli_mpi.so cannot be loaded ({}); install the package noli-mpi, build Noli "
          "with NOLI_WITH_MPI, or use --shard",
          ranks_in_environment(), on_one_line(::dlerror())));
    }
    find(version, "noli_mpi_version");
    if (version() != NOLI_MPI_VERSION) throw UsageError("noli_mpi.so is from another version of Noli");
    find(begin, "noli_mpi_begin");
    find(next, "noli_mpi_next");
    find(close_counter, "noli_mpi_close_counter");
    find(look, "noli_mpi_look");
    find(barrier, "noli_mpi_barrier");
    find(gather, "noli_mpi_gather");
    find(serve, "noli_mpi_serve");
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
  decltype(noli_mpi_close_counter)* close_counter = nullptr;
  decltype(noli_mpi_look)* look = nullptr;
  decltype(noli_mpi_barrier)* barrier = nullptr;
  decltype(noli_mpi_gather)* gather = nullptr;
  decltype(noli_mpi_serve)* serve = nullptr;
  decltype(noli_mpi_end)* end = nullptr;
};

Ranks::Ranks(std::unique_ptr<Library> library) : library_(std::move(library)) {
  noli_mpi_place place = {};
  const int result = library_->begin(this_program().data(), &place);
  if (result == 1) {
    throw UsageError("not all ranks run the same program; expected one version and commit of Noli on all machines");
  }
  if (result == 3) {
    throw UsageError("this MPI lets only one thread call it; expected one with MPI_THREAD_SERIALIZED");
  }
  require(result);
  if (place.size != ranks_in_environment()) {
    throw UsageError(fmt::format("MPI has {} ranks, the environment {}: noli_mpi.so was built for another MPI",
                                 place.size, ranks_in_environment()));
  }
  rank_ = place.rank;
  size_ = place.size;
  on_this_machine_ = place.on_this_machine;
}

Ranks::~Ranks() = default;

bool Ranks::started_by_mpirun() { return ranks_in_environment() > 1; }

bool Ranks::is_mpi_job() { return ranks_in_environment() > 0; }

bool Ranks::has_library() {
  std::error_code error;
  return std::filesystem::exists(library_file(), error);
}

std::unique_ptr<Ranks> Ranks::of_this_job() {
  if (!started_by_mpirun()) return nullptr;
  return std::unique_ptr<Ranks>(new Ranks(std::make_unique<Library>(library_file())));
}

int Ranks::threads() const { return std::max(1, hardware_threads() / on_this_machine_); }

std::optional<std::uint64_t> Ranks::next_task() {
  std::uint64_t task = 0;
  require(library_->next(&task));
  return task < NOLI_MPI_CLOSED ? std::optional(task) : std::nullopt;
}

void Ranks::serve() {
  const auto now = std::chrono::steady_clock::now();
  if (!is_first() || now - served_ < std::chrono::milliseconds(10)) return;
  served_ = now;
  library_->serve();
}

void Ranks::close_counter() { require(library_->close_counter()); }

bool Ranks::counter_is_closed() {
  std::uint64_t task = 0;
  require(library_->look(&task));
  return task >= NOLI_MPI_CLOSED;
}

std::vector<std::string> Ranks::gather(const std::string& text) {
  const std::uint64_t* sizes = nullptr;
  const char* all = nullptr;
  require(library_->gather(text.data(), text.size(), &sizes, &all));
  std::vector<std::string> texts;
  for (int i = 0; is_first() && i < size_; all += sizes[i++]) texts.emplace_back(all, sizes[i]);
  return texts;
}

void Ranks::barrier() {
  std::int32_t code = 0;
  require(library_->barrier(&code));
}

int Ranks::end(int code) {
  std::int32_t of_all = code;
  require(library_->barrier(&of_all));
  require(library_->end());
  return of_all;
}

}  // namespace noli
