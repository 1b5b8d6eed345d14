/* SPDX-License-Identifier: Apache-2.0
 *
 * What noli_mpi.so gives `noli`, which loads it only where mpirun started it: ranks that share a counter of tasks. All
 * functions are called one at a time, and return 0 where all went well, 2 where MPI failed.
 */
#pragma once

#include <cstdint>

#define NOLI_MPI_VERSION 3
#define NOLI_MPI_PROGRAM_BYTES 128
#define NOLI_MPI_CLOSED (UINT64_C(1) << 62) /* more than any task */

extern "C" {

struct noli_mpi_place {
  int32_t rank, size;      /* of all ranks */
  int32_t on_this_machine; /* how many of them */
};

int32_t noli_mpi_version(void);

/* Begins. `program`: version and commit, NOLI_MPI_PROGRAM_BYTES bytes; 1 if not all ranks have the same ones, 3 if this
 * MPI does not let several threads call it one at a time. */
int noli_mpi_begin(const char* program, struct noli_mpi_place* place);
/* The next task that no rank has taken yet: 0, 1, ... */
int noli_mpi_next(uint64_t* task);
/* Closes the counter: what noli_mpi_next() and noli_mpi_look() give from now on is at least NOLI_MPI_CLOSED. */
int noli_mpi_close_counter(void);
/* What noli_mpi_next() would give, without taking it. */
int noli_mpi_look(uint64_t* task);
/* Waits until all ranks have called it; `code` of rank 0 becomes that of all. */
int noli_mpi_barrier(int32_t* code);
/* Sends bytes of all ranks to rank 0, 2^31 - 1 in all at most; 4 if there are more. Rank 0 gets how many each rank has,
 * and the bytes of one rank after another's: both stay until the next call. The others get nulls. */
int noli_mpi_gather(const char* bytes, uint64_t size, const uint64_t** sizes, const char** all);
/* Lets MPI answer other ranks. From any thread, between other calls. */
void noli_mpi_serve(void);
/* Ends. */
int noli_mpi_end(void);
}
