// SPDX-License-Identifier: Apache-2.0
//
// What a library may no longer do once its process is in the sandbox: write to files, make, rename or remove them; send
// signals to other processes, trace them or write to their memory; start programs; use sockets.
//
// It may still read files, map memory, start threads, and compute. The calls of the system are filtered (seccomp), and
// where the kernel has Landlock, it closes the file system and other processes' memory a second time. Neither needs
// rights.
#pragma once

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <vector>

#if __has_include(<linux/landlock.h>)
#include <linux/landlock.h>
#endif

namespace noli::audit {

/// The exit code of a host that finds no sandbox.
inline constexpr int no_sandbox = 97;

namespace sandbox {

#if defined(__x86_64__)
inline constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
inline constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64;
#else
inline constexpr std::uint32_t architecture = 0;  ///< none that is known here
#endif

/// Calls that are refused whatever their arguments.
inline std::vector<long> refused_calls() {
  return {
    // other processes
    SYS_ptrace, SYS_process_vm_readv, SYS_process_vm_writev, SYS_rt_sigqueueinfo, SYS_rt_tgsigqueueinfo, SYS_tkill,
        SYS_setpriority, SYS_sched_setscheduler, SYS_sched_setparam, SYS_sched_setaffinity, SYS_setpgid, SYS_setsid,
        SYS_sched_setattr, SYS_execve, SYS_execveat, SYS_unshare, SYS_setns, SYS_kcmp, SYS_ioprio_set,
        SYS_migrate_pages, SYS_move_pages,
#if defined(SYS_pidfd_open)
        SYS_pidfd_open, SYS_pidfd_send_signal,
#endif
#if defined(SYS_pidfd_getfd)
        SYS_pidfd_getfd,
#endif
#if defined(SYS_process_madvise)
        SYS_process_madvise,
#endif
        // files
        SYS_unlinkat, SYS_renameat2, SYS_mkdirat, SYS_mknodat, SYS_linkat, SYS_symlinkat, SYS_truncate, SYS_fchmodat,
        SYS_fchmod, SYS_fchownat, SYS_fchown, SYS_utimensat, SYS_setxattr, SYS_lsetxattr, SYS_fsetxattr,
        SYS_removexattr, SYS_lremovexattr, SYS_fremovexattr, SYS_mount, SYS_umount2, SYS_pivot_root, SYS_chroot,
        SYS_swapon, SYS_swapoff, SYS_open_by_handle_at, SYS_renameat,
#if defined(SYS_openat2)
        SYS_openat2,
#endif
#if defined(SYS_io_uring_setup)
        SYS_io_uring_setup,
#endif
#if defined(__x86_64__)
        SYS_unlink, SYS_rename, SYS_mkdir, SYS_rmdir, SYS_mknod, SYS_link, SYS_symlink, SYS_chmod, SYS_chown,
        SYS_lchown, SYS_utime, SYS_utimes, SYS_futimesat, SYS_creat, SYS_vfork, SYS_fork,
#endif
        // others
        SYS_socket, SYS_socketpair, SYS_bpf, SYS_perf_event_open, SYS_userfaultfd, SYS_keyctl, SYS_add_key,
        SYS_request_key, SYS_shmget, SYS_shmat, SYS_shmctl, SYS_semget, SYS_semop, SYS_semtimedop, SYS_semctl,
        SYS_msgget, SYS_msgsnd, SYS_msgrcv, SYS_msgctl, SYS_mq_open, SYS_mq_unlink, SYS_acct, SYS_sethostname,
        SYS_setdomainname, SYS_clock_settime, SYS_settimeofday, SYS_clock_adjtime, SYS_adjtimex, SYS_quotactl,
        SYS_fanotify_init, SYS_syslog, SYS_vhangup, SYS_delete_module, SYS_reboot, SYS_init_module, SYS_finit_module,
  };
}

/// A program of the filter, put together line by line.
class Filter {
 public:
  Filter() {
    load(offsetof(seccomp_data, arch));
    go_on_if_equal(architecture);
    refuse(SECCOMP_RET_KILL_PROCESS);
    load(offsetof(seccomp_data, nr));
#if defined(__x86_64__)
    lines_.push_back(BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, 0x40000000, 0, 1));  // calls of the 32-bit interface
    refuse(SECCOMP_RET_KILL_PROCESS);
#endif
  }

  void refuse_call(long number, std::uint32_t error = EPERM) {
    lines_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(number), 0, 1));
    refuse(SECCOMP_RET_ERRNO | error);
  }
  /// Where any of these bits of an argument is set.
  void refuse_bits(long number, std::size_t argument, std::uint32_t bits) {
    refuse_where(number, argument, BPF_JSET, bits, true);
  }
  /// Where none of these bits of an argument is set.
  void refuse_without(long number, std::size_t argument, std::uint32_t bits) {
    refuse_where(number, argument, BPF_JSET, bits, false);
  }
  /// Where an argument is this number.
  void refuse_value(long number, std::size_t argument, std::uint32_t value) {
    refuse_where(number, argument, BPF_JEQ, value, true);
  }
  /// Calls whose numbers are not less than this: as a kernel that does not know them.
  void refuse_from(std::uint32_t number) {
    lines_.push_back(BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, number, 0, 1));
    refuse(SECCOMP_RET_ERRNO | ENOSYS);
  }
  /// Where an argument is none of two numbers.
  void refuse_others(long number, std::size_t argument, std::uint32_t a, std::uint32_t b) {
    lines_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(number), 0, 5));
    load(offsetof(seccomp_data, args) + 8 * argument);
    lines_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, a, 2, 0));
    lines_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, b, 1, 0));
    refuse(SECCOMP_RET_ERRNO | EPERM);
    load(offsetof(seccomp_data, nr));
  }
  bool install() {
    refuse(SECCOMP_RET_ALLOW);
    const sock_fprog program = {static_cast<unsigned short>(lines_.size()), lines_.data()};
    return ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
  }

 private:
  /// Refuses a call whose argument passes the test, or fails it.
  void refuse_where(long number, std::size_t argument, std::uint16_t test, std::uint32_t value, bool passes) {
    const std::uint8_t if_true = passes ? 0 : 1, if_false = passes ? 1 : 0;
    lines_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(number), 0, 4));
    load(offsetof(seccomp_data, args) + 8 * argument);
    const auto code = static_cast<std::uint16_t>(BPF_JMP | test | BPF_K);
    lines_.push_back(BPF_JUMP(code, value, if_true, if_false));
    refuse(SECCOMP_RET_ERRNO | EPERM);
    load(offsetof(seccomp_data, nr));
  }
  void load(std::size_t offset) {
    lines_.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)));
  }
  void go_on_if_equal(std::uint32_t value) { lines_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 1, 0)); }
  void refuse(std::uint32_t how) { lines_.push_back(BPF_STMT(BPF_RET | BPF_K, how)); }

  std::vector<sock_filter> lines_;
};

inline bool filter_calls() {
  if (architecture == 0) return false;
  Filter filter;
  for (const long number : refused_calls()) filter.refuse_call(number);
  constexpr std::uint32_t writes = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;
  filter.refuse_bits(SYS_openat, 2, writes);
#if defined(__x86_64__)
  filter.refuse_bits(SYS_open, 1, writes);
#endif
  constexpr std::uint32_t thread = 0x00010000;  // CLONE_THREAD: without it, it is a process
  filter.refuse_without(SYS_clone, 0, thread);
#if defined(SYS_clone3)
  filter.refuse_call(SYS_clone3, ENOSYS);  // its flags are behind a pointer; the C library goes on with clone
#endif
  const auto own = static_cast<std::uint32_t>(::getpid());
  filter.refuse_others(SYS_kill, 0, own, own);
  filter.refuse_others(SYS_tgkill, 0, own, own);
  filter.refuse_others(SYS_prlimit64, 0, 0, own);
  for (const std::uint32_t sends_signals : {F_SETOWN, F_SETSIG, F_SETOWN_EX}) {
    filter.refuse_value(SYS_fcntl, 1, sends_signals);
  }
  // Of devices and open files only what the C library asks: terminals take typed commands, files have flags.
  filter.refuse_others(SYS_ioctl, 1, TCGETS, FIONREAD);
  // These have the same numbers everywhere. Those of 2019 and later that are not refused are known to be harmless;
  // what comes after them nobody here knows.
  constexpr std::array mounts_and_more = {428, 429, 430, 431, 432, 433, 442, 443, 452, 457, 458};
  for (const long number : mounts_and_more) filter.refuse_call(number);
  filter.refuse_from(463);
  return filter.install();
}

/// The file system once more, where the kernel knows how. Whether it does is not asked.
inline void close_files() {
#if defined(SYS_landlock_create_ruleset) && defined(LANDLOCK_ACCESS_FS_WRITE_FILE)
  landlock_ruleset_attr rules = {};
  rules.handled_access_fs = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
                            LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
                            LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_SOCK |
                            LANDLOCK_ACCESS_FS_MAKE_FIFO | LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;
  const auto ruleset = static_cast<int>(::syscall(SYS_landlock_create_ruleset, &rules, sizeof rules, 0));
  if (ruleset < 0) return;
  ::syscall(SYS_landlock_restrict_self, ruleset, 0);
  ::close(ruleset);
#endif
}

}  // namespace sandbox

/// From now on, for this thread and all that it starts. False where the machine has no such filter; then nothing is
/// promised.
inline bool enter_sandbox() {
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return false;
  sandbox::close_files();
  return sandbox::filter_calls();
}

}  // namespace noli::audit
