/* SPDX-License-Identifier: Apache-2.0 */
/* Libraries for the tests of `noli audit ccd`, one for each way to behave (MISBEHAVIOUR, below), in C99. */
/* NOLINTBEGIN(bugprone-reserved-identifier, performance-no-int-to-ptr): it has to misbehave. */
#define _DEFAULT_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <noli/ccd_plugin.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

enum behaviour {
  always_hits,
  never_hits,
  crashes,          /* at queries whose first coordinate is above 0 */
  ends_the_program, /* the same */
  hangs,            /* the same */
  sleeps,           /* the same */
  never_answers, /* except where it is asked whether it reports times */
  takes_memory,     /* the same */
  leaks,
  lies_about_time,
  has_wild_times,
  has_few_times,
  fails,
  answers_two,
  leaves_a_process,
  changes_its_mind,
  has_no_version,
  has_no_query,
  has_another_version,
  crashes_when_asked_again,
  crashes_when_loaded,
  finds_nothing,
  finds_neighbours,
  crashes_when_searching,
  says_what_it_is,
  says_too_much,
  writes_behind_the_points, /* and misses contacts */
  writes_all_over,          /* what it shares with the audit, at queries whose first coordinate is above 0 */
  writes_zeros_and_crashes, /* the same */
  marks_what_lies_behind,   /* finds nothing, and writes that all was found where something could be kept of it */
  says_why,                 /* to its standard error; then it crashes */
  ends_as_without_sandbox,  /* at queries whose first coordinate is above 0 */
  attacks_others            /* ends its parent, writes to its memory and to the file that NOLI_TEST_FILE names */
};

#define IS(behaviour) (MISBEHAVIOUR == (behaviour))

#if !defined(NO_VERSION)
uint32_t noli_ccd_version(void) { return IS(has_another_version) ? NOLI_CCD_VERSION + 1 : NOLI_CCD_VERSION; }
#endif

#if !defined(NO_QUERY)
static void crash(void) { raise(SIGSEGV); }

#if defined(CRASH_WHEN_LOADED)
__attribute__((constructor)) static void at_once(void) { crash(); }
#endif

/* Through a volatile pointer, for a compiler leaves out memory that nobody uses. */
static void leak(size_t bytes) {
  void* volatile const lost = malloc(bytes);
  if (lost != NULL) memset(lost, 1, bytes);
}

static void write_all_over(int byte) {
  FILE* const maps = fopen("/proc/self/maps", "r");
  char line[512];
  while (maps != NULL && fgets(line, sizeof line, maps) != NULL) {
    unsigned long begin = 0, end = 0;
    if (strstr(line, "memfd:noli_ccd") == NULL || sscanf(line, "%lx-%lx", &begin, &end) != 2) continue;
    memset((void*)begin, byte, end - begin);
  }
  if (maps != NULL) fclose(maps);
}

static void at_some_queries(double first) {
  if (!(first > 0)) return;
  if (IS(writes_zeros_and_crashes)) write_all_over(0);
  if (IS(crashes) || IS(writes_zeros_and_crashes)) crash();
  if (IS(ends_the_program)) exit(0);
  if (IS(ends_as_without_sandbox)) _exit(97); /* audit/ccd/host/sandbox.h */
  for (volatile int again = 1; again && IS(hangs);) {
  }
  while (IS(sleeps)) pause();
  while (IS(takes_memory)) leak((size_t)1 << 20);
}

/* Its number goes to the file that NOLI_TEST_PID_FILE names. */
static void leave_a_process(void) {
  const char* const name = getenv("NOLI_TEST_PID_FILE");
  FILE* const file = name == NULL ? NULL : fopen(name, "wx"); /* once */
  if (file == NULL) return;
  const pid_t child = fork();
  if (child == 0) {
    sleep(600);
    _exit(0);
  }
  fprintf(file, "%d", (int)child);
  fclose(file);
}

/* A few numbers behind those that it was given to read. */
static void write_behind(const double* points) {
  for (int i = 12; i < 16; ++i) ((double*)(uintptr_t)points)[i] = 0;
}

/* Between the positions and the edges, as records of a time, a pair and whether it was found, hit and failed. */
static void mark(const double* positions_end, const uint32_t* edges) {
  for (uint32_t* record = (uint32_t*)(uintptr_t)positions_end; record + 8 <= edges; record += 8) {
    record[0] = record[1] = 0;
    record[5] = record[6] = 1;
    record[7] = 0;
  }
}

static void must_be_refused(long result) {
  if (result != -1 || (errno != EPERM && errno != ENOSYS)) crash();
}

/* Ways around the calls that are known for it. */
static void attack_by_the_back_door(const char* name) {
  int ends[2];
  if (pipe(ends) != 0) crash();
  must_be_refused(fcntl(ends[0], F_SETOWN, getppid()));
  must_be_refused(fcntl(ends[0], 10 /* F_SETSIG */, SIGKILL));
  close(ends[0]);
  close(ends[1]);
  must_be_refused(ioctl(0, TIOCSTI, "x"));
  must_be_refused(syscall(452 /* fchmodat2 */, AT_FDCWD, name, 0777, 0));
  must_be_refused(syscall(SYS_shmat, 0, NULL, 0));
  must_be_refused(syscall(SYS_sched_setattr, getppid(), NULL, 0));
  must_be_refused(syscall(SYS_mq_open, "noli", O_CREAT | O_RDWR, 0600, NULL));
  if (write(9, "x", 1) > 0) crash(); /* that noli was started with */
}

/* Crashes when anything of that succeeds. */
static void attack_others(void) {
  char path[64];
  const char* const name = getenv("NOLI_TEST_FILE");
  if (name == NULL || fopen(name, "w") != NULL) crash();
  snprintf(path, sizeof path, "/proc/%d/mem", (int)getppid());
  if (open(path, O_RDWR) >= 0) crash();
  attack_by_the_back_door(name);
  if (kill(getppid(), SIGKILL) == 0 || unlink(name) == 0 || rename(name, "elsewhere") == 0) crash();
  const pid_t child = fork();
  if (child == 0) _exit(0);
  if (child > 0) crash();
}

static int is_asked_again(void) {
  static int calls = 0;
  return ++calls > 3;
}

int noli_ccd_query(int kind, const double x_t0[12], const double x_t1[12], double tolerance, double* time_of_impact) {
  (void)kind, (void)x_t1, (void)tolerance;
  while (IS(never_answers) && x_t0[3] != -4) pause();
  at_some_queries(x_t0[0]);
  if (IS(leaks)) leak(4096);
  if (IS(leaves_a_process)) leave_a_process();
  if (IS(writes_behind_the_points)) {
    write_behind(x_t1);
    return NOLI_CCD_NO_HIT;
  }
  if (IS(writes_all_over) && x_t0[0] > 0) write_all_over(0xff);
  if (IS(attacks_others)) attack_others();
  if (IS(says_why)) {
    fputs("no memory for the \x1b[31mtree\n", stderr);
    crash();
  }
  if (IS(fails)) return NOLI_CCD_FAILED;
  if (IS(answers_two)) return 2;
  if (IS(crashes_when_asked_again) && is_asked_again()) crash();
  if (IS(changes_its_mind)) return is_asked_again() ? NOLI_CCD_HIT : NOLI_CCD_NO_HIT;
  if (IS(never_hits)) return NOLI_CCD_NO_HIT;
  if (IS(has_few_times) && x_t0[0] > 0) return NOLI_CCD_HIT;
  *time_of_impact = IS(lies_about_time) ? 1 : IS(has_wild_times) ? -7 : 0;
  return NOLI_CCD_HIT;
}
#endif

#if defined(WITH_CANDIDATES)
int noli_ccd_candidates(size_t vertices, const double* x_t0, const double* x_t1, size_t edges,
                        const uint32_t* edge_vertices, size_t faces, const uint32_t* face_vertices, double distance,
                        noli_ccd_candidate found, void* data) {
  (void)x_t0, (void)x_t1, (void)edges, (void)edge_vertices, (void)face_vertices, (void)distance;
  if (IS(crashes_when_searching)) crash();
  if (IS(marks_what_lies_behind)) {
    mark(x_t1 + 3 * vertices, edge_vertices);
    return 0;
  }
  for (uint32_t v = 0; !IS(finds_nothing) && v < vertices; ++v) {
    for (uint32_t f = 0; f < faces; ++f) found(data, NOLI_CCD_VERTEX_FACE, v, f);
  }
  return 0;
}
#endif

#if defined(WITH_DESCRIPTION)
const char* noli_ccd_description(void) {
  static char much[300];
  memset(much, 'x', sizeof much - 1);
  return IS(says_too_much) ? much : "tests 1.0\nof Noli";
}
#endif
/* NOLINTEND(bugprone-reserved-identifier, performance-no-int-to-ptr) */
