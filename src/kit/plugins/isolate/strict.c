#include "plugins/isolate/strict.h"

#ifdef __linux__
#include <errno.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h> /* __NR_: a C library older than the kernel lacks some SYS_ names */
#include <unistd.h>

/* ---------------------------------------------------------------- files */

#define READ_FILES (LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR)
#define OF_FILES                                                                                   \
  (LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_EXECUTE)
#define START_FILES (LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_EXECUTE)
#define ALL_OF_FIRST ((UINT64_C(1) << 13) - 1) /* the rights that Linux 5.13 knows */
/* Rights of later kernels, as numbers: the headers may be older than the kernel. */
#define REFER (UINT64_C(1) << 13)
#define TRUNCATE (UINT64_C(1) << 14)
#define IOCTL_DEVICE (UINT64_C(1) << 15)
#define BIND_AND_CONNECT 3
#define ABSTRACT_SOCKETS_AND_SIGNALS 3

/* Libraries, and the files that they read: the description of the processor, random numbers. */
static const char *const SYSTEM[] = {"/usr/lib",
                                     "/usr/lib64",
                                     "/usr/local/lib",
                                     "/lib",
                                     "/lib64",
                                     "/etc/ld.so.cache",
                                     "/etc/ld.so.conf",
                                     "/proc/cpuinfo",
                                     "/proc/meminfo",
                                     "/proc/self/maps",
                                     "/dev/null",
                                     "/dev/urandom",
                                     "/sys/devices/system/cpu"};

/* Files for libraries that a process has loaded itself: fonts, colours, languages. */
#define SHARED "/usr"

/* The program that starts programs with shared libraries. */
#ifdef __aarch64__
#define LOADER "/lib/ld-linux-aarch64.so.1"
#else
#define LOADER "/lib64/ld-linux-x86-64.so.2"
#endif

typedef struct ruleset {
  uint64_t files, network, scopes;
} ruleset;

static bool allow(int rules, const char *path, uint64_t rights) {
  struct landlock_path_beneath_attr rule = {.allowed_access = rights};
  struct stat found;
  rule.parent_fd = open(path, O_PATH | O_CLOEXEC);
  if (rule.parent_fd < 0)
    return errno == ENOENT || errno == EACCES; /* a missing file needs no right */
  if (fstat(rule.parent_fd, &found) == 0 && !S_ISDIR(found.st_mode))
    rule.allowed_access &= OF_FILES | TRUNCATE;
  /* A file without a name is in no folder: every process that has it open may read it. */
  bool is_added =
      syscall(__NR_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0) == 0 ||
      errno == EBADFD;
  close(rule.parent_fd);
  return is_added;
}

static bool allow_all(int rules, const cs_roots *roots, uint64_t rights) {
  for (size_t i = 0; roots && i < roots->count; i++)
    if (!allow(rules, roots->paths[i], rights))
      return false;
  return true;
}

/* The rights that this kernel knows. abi: the kernel's version of Landlock. */
static ruleset known_rights(long abi) {
  ruleset known = {.files = ALL_OF_FIRST};
  known.files |= (abi >= 2 ? REFER : 0) | (abi >= 3 ? TRUNCATE : 0) | (abi >= 5 ? IOCTL_DEVICE : 0);
  known.network = abi >= 4 ? BIND_AND_CONNECT : 0;
  known.scopes = abi >= 6 ? ABSTRACT_SOCKETS_AND_SIGNALS : 0;
  return known;
}

static bool add_rules(int rules, const cs_strict_rights *rights, uint64_t all) {
  uint64_t writing = all & ~(uint64_t)LANDLOCK_ACCESS_FS_EXECUTE;
  for (size_t i = 0; i < sizeof SYSTEM / sizeof *SYSTEM; i++)
    if (!allow(rules, SYSTEM[i], READ_FILES))
      return false;
  if (!allow(rules, "/dev/null", OF_FILES & writing))
    return false;
  if (rights->program)
    return allow(rules, LOADER, START_FILES) && allow(rules, rights->program, START_FILES) &&
           allow(rules, rights->file, READ_FILES);
  return allow(rules, SHARED, READ_FILES) && allow_all(rules, rights->read, READ_FILES) &&
         allow_all(rules, rights->write, writing);
}

static const char *confine_files(const cs_strict_rights *rights) {
  long abi = syscall(__NR_landlock_create_ruleset, NULL, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (abi < 1)
    return "the kernel has no Landlock (it needs Linux 5.13 or later, with Landlock enabled)";
  ruleset known = known_rights(abi);
  size_t size = abi >= 6 ? sizeof known : abi >= 4 ? 2 * sizeof(uint64_t) : sizeof(uint64_t);
  int rules = (int)syscall(__NR_landlock_create_ruleset, &known, size, 0);
  if (rules < 0)
    return "Landlock does not accept rules";
  bool is_confined =
      add_rules(rules, rights, known.files) && syscall(__NR_landlock_restrict_self, rules, 0) == 0;
  close(rules);
  return is_confined ? NULL : "Landlock refused the rules";
}

/* ---------------------------------------------------------------- system calls */

#if defined(__x86_64__)
#define ARCHITECTURE AUDIT_ARCH_X86_64
#elif defined(__aarch64__)
#define ARCHITECTURE AUDIT_ARCH_AARCH64
#endif

#ifdef ARCHITECTURE
#define OTHER_TABLE 0x40000000u /* x86-64: numbers of a second table of the same calls */
#define LOAD(field) BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, field))
#define ANSWER(what) BPF_STMT(BPF_RET | BPF_K, what)
#define REFUSAL ANSWER(SECCOMP_RET_ERRNO | EPERM)
#define REFUSE(number) BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, number, 0, 1), REFUSAL

static const char *confine_calls(bool starts_program) {
  struct sock_filter filter[] = {
      LOAD(arch), BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, ARCHITECTURE, 1, 0),
      ANSWER(SECCOMP_RET_KILL_PROCESS), LOAD(nr),
      BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, OTHER_TABLE, 0, 1), REFUSAL,
      /* no other programs or processes; a process remains in its group, which is ended as a
       * whole */
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, __NR_execve, 0, 1),
      ANSWER(starts_program ? SECCOMP_RET_ALLOW : SECCOMP_RET_ERRNO | EPERM), REFUSE(__NR_execveat),
      REFUSE(__NR_setpgid), REFUSE(__NR_setsid), REFUSE(__NR_ptrace), REFUSE(__NR_process_vm_readv),
      REFUSE(__NR_process_vm_writev), REFUSE(__NR_kill), REFUSE(__NR_pidfd_open),
      REFUSE(__NR_pidfd_getfd), REFUSE(__NR_pidfd_send_signal),
      /* the network */
      REFUSE(__NR_socket), REFUSE(__NR_socketpair), REFUSE(__NR_connect), REFUSE(__NR_bind),
      REFUSE(__NR_listen), REFUSE(__NR_accept), REFUSE(__NR_accept4),
      /* other interfaces of the kernel */
      REFUSE(__NR_io_uring_setup), REFUSE(__NR_bpf), REFUSE(__NR_perf_event_open),
      REFUSE(__NR_userfaultfd), REFUSE(__NR_keyctl), REFUSE(__NR_add_key), REFUSE(__NR_request_key),
      REFUSE(__NR_mount), REFUSE(__NR_umount2), REFUSE(__NR_unshare), REFUSE(__NR_setns),
      REFUSE(__NR_chroot), REFUSE(__NR_pivot_root), REFUSE(__NR_open_by_handle_at),
      REFUSE(__NR_personality), ANSWER(SECCOMP_RET_ALLOW)};
  struct sock_fprog program = {sizeof filter / sizeof *filter, filter};
  return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0
             ? NULL
             : "the kernel does not accept a filter of system calls (seccomp)";
}
#else
static const char *confine_calls(bool starts_program) {
  (void)starts_program;
  return "system calls cannot be filtered on this processor";
}
#endif

const char *cs_strict_enter(const cs_strict_rights *rights) {
  const struct rlimit none = {0, 0};
  if (setrlimit(RLIMIT_CORE, &none) != 0 || prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
    return "the kernel does not let a process give up privileges";
  const char *refusal = confine_files(rights);
  return refusal ? refusal : confine_calls(rights->program != NULL);
}

void cs_strict_close(int first) {
  /* old C libraries have no function for it */
  syscall(__NR_close_range, first, ~0U, 0);
}

#else
const char *cs_strict_enter(const cs_strict_rights *rights) {
  (void)rights;
  return "it needs Landlock and seccomp of Linux";
}

void cs_strict_close(int first) { (void)first; }
#endif
