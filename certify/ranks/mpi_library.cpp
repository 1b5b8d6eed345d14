// SPDX-License-Identifier: Apache-2.0
//
// noli_mpi.so: the only code that knows MPI.
//
// Tasks are taken from a counter in the memory of rank 0 with MPI_Fetch_and_op. On one machine, and over networks with
// remote memory access, rank 0 does nothing for it; over others it answers when it calls noli_mpi_serve(). Ranks that
// wait ask every few milliseconds: MPI's own waiting would take the processors from those that work.
#include "certify/ranks/mpi_library.h"

#include <mpi.h>

#include <chrono>
#include <cstring>
#include <limits>
#include <numeric>
#include <thread>
#include <vector>

namespace {

struct Job {
  MPI_Win window = MPI_WIN_NULL;
  std::uint64_t* counter = nullptr;
  int rank = 0, size = 1;
};

Job& job() {
  static Job one;
  return one;
}

void wait_for(MPI_Request& request) {
  for (int done = 0;;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done != 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

int ranks_on_this_machine() {
  MPI_Comm near = MPI_COMM_NULL;
  int size = 1;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &near);
  MPI_Comm_size(near, &size);
  MPI_Comm_free(&near);
  return size;
}

bool all_have(const char* program) {
  std::vector<char> all(static_cast<std::size_t>(job().size) * NOLI_MPI_PROGRAM_BYTES);
  MPI_Allgather(program, NOLI_MPI_PROGRAM_BYTES, MPI_CHAR, all.data(), NOLI_MPI_PROGRAM_BYTES, MPI_CHAR,
                MPI_COMM_WORLD);
  for (std::size_t i = 0; i < all.size(); i += NOLI_MPI_PROGRAM_BYTES) {
    if (std::memcmp(program, all.data() + i, NOLI_MPI_PROGRAM_BYTES) != 0) return false;
  }
  return true;
}

}  // namespace

extern "C" {

std::int32_t noli_mpi_version(void) { return NOLI_MPI_VERSION; }

int noli_mpi_begin(const char* program, noli_mpi_place* place) {
  int level = 0;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &level) != MPI_SUCCESS) return 2;
  if (level < MPI_THREAD_SERIALIZED) return 3;
  MPI_Comm_rank(MPI_COMM_WORLD, &job().rank);
  MPI_Comm_size(MPI_COMM_WORLD, &job().size);
  *place = {job().rank, job().size, ranks_on_this_machine()};
  if (!all_have(program)) return 1;
  const MPI_Aint bytes = job().rank == 0 ? sizeof(std::uint64_t) : 0;
  MPI_Win_allocate(bytes, sizeof(std::uint64_t), MPI_INFO_NULL, MPI_COMM_WORLD, &job().counter, &job().window);
  if (job().rank == 0) *job().counter = 0;
  MPI_Barrier(MPI_COMM_WORLD);
  MPI_Win_lock_all(0, job().window);
  return 0;
}

int noli_mpi_next(std::uint64_t* task) {
  const std::uint64_t one = 1;
  MPI_Fetch_and_op(&one, task, MPI_UINT64_T, 0, 0, MPI_SUM, job().window);
  return MPI_Win_flush(0, job().window) == MPI_SUCCESS ? 0 : 2;
}

int noli_mpi_close_counter(void) {
  const std::uint64_t many = NOLI_MPI_CLOSED;
  std::uint64_t before = 0;
  MPI_Fetch_and_op(&many, &before, MPI_UINT64_T, 0, 0, MPI_MAX, job().window);
  return MPI_Win_flush(0, job().window) == MPI_SUCCESS ? 0 : 2;
}

int noli_mpi_look(std::uint64_t* task) {
  MPI_Fetch_and_op(nullptr, task, MPI_UINT64_T, 0, 0, MPI_NO_OP, job().window);
  return MPI_Win_flush(0, job().window) == MPI_SUCCESS ? 0 : 2;
}

int noli_mpi_barrier(std::int32_t* code) {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  wait_for(request);
  MPI_Ibcast(code, 1, MPI_INT32_T, 0, MPI_COMM_WORLD, &request);
  wait_for(request);
  return 0;
}

int noli_mpi_gather(const char* bytes, std::uint64_t size, const std::uint64_t** sizes, const char** all) {
  static std::vector<std::uint64_t> of_ranks;
  static std::vector<char> text;
  MPI_Request request = MPI_REQUEST_NULL;
  of_ranks.assign(job().rank == 0 ? static_cast<std::size_t>(job().size) : 0, 0);
  MPI_Igather(&size, 1, MPI_UINT64_T, of_ranks.data(), 1, MPI_UINT64_T, 0, MPI_COMM_WORLD, &request);
  wait_for(request);
  std::uint64_t total = std::accumulate(of_ranks.begin(), of_ranks.end(), std::uint64_t{0});
  MPI_Ibcast(&total, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD, &request);
  wait_for(request);
  if (total > std::numeric_limits<std::int32_t>::max()) return 4;
  const std::vector<int> counts(of_ranks.begin(), of_ranks.end());
  std::vector<int> offsets(counts.size(), 0);
  std::exclusive_scan(counts.begin(), counts.end(), offsets.begin(), 0);
  text.resize(job().rank == 0 ? total : 0);
  MPI_Igatherv(bytes, static_cast<int>(size), MPI_CHAR, text.data(), counts.data(), offsets.data(), MPI_CHAR, 0,
               MPI_COMM_WORLD, &request);
  wait_for(request);
  *sizes = job().rank == 0 ? of_ranks.data() : nullptr;
  *all = job().rank == 0 ? text.data() : nullptr;
  return 0;
}

void noli_mpi_serve(void) {
  int there = 0;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, MPI_STATUS_IGNORE);
}

int noli_mpi_end(void) {
  MPI_Win_unlock_all(job().window);
  MPI_Win_free(&job().window);
  return MPI_Finalize() == MPI_SUCCESS ? 0 : 2;
}
}
