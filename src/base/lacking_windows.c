/* What the headers of base/windows declare, over the functions of Windows. */
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/auxv.h>
#include <sys/file.h>
#include <sys/inotify.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>

#include "base/open.h"

#include <ftw.h>
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

/* ---------------------------------------------------------------- errors */

static int errno_of(DWORD error) {
  switch (error) {
  case ERROR_FILE_NOT_FOUND:
  case ERROR_PATH_NOT_FOUND:
  case ERROR_INVALID_NAME:
  case ERROR_BAD_NETPATH:
    return ENOENT;
  case ERROR_FILE_EXISTS:
  case ERROR_ALREADY_EXISTS:
    return EEXIST;
  case ERROR_DISK_FULL:
  case ERROR_HANDLE_DISK_FULL:
    return ENOSPC;
  case ERROR_DIR_NOT_EMPTY:
    return ENOTEMPTY;
  case ERROR_LOCK_VIOLATION:
    return EWOULDBLOCK;
  case ERROR_NOT_ENOUGH_MEMORY:
    return ENOMEM;
  case ERROR_ACCESS_DENIED:
  case ERROR_SHARING_VIOLATION:
  case ERROR_WRITE_PROTECT:
    return EACCES;
  default:
    return EIO;
  }
}

/* 0, or -1 with the errno of the last call. */
static int told(BOOL is_done) {
  if (!is_done)
    errno = errno_of(GetLastError());
  return is_done ? 0 : -1;
}

static int lacks(void) {
  errno = ENOSYS;
  return -1;
}

/* ---------------------------------------------------------------- opening */

static DWORD creation_of(int flags) {
  if (!(flags & O_CREAT))
    return flags & O_TRUNC ? TRUNCATE_EXISTING : OPEN_EXISTING;
  return flags & O_EXCL ? CREATE_NEW : flags & O_TRUNC ? CREATE_ALWAYS : OPEN_ALWAYS;
}

/* A handle whose file may be renamed and removed meanwhile; of a folder, too. */
static HANDLE handle_of(const char *path, DWORD access, DWORD creation) {
  const DWORD shared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
  return CreateFileA(path, access, shared, NULL, creation, FILE_FLAG_BACKUP_SEMANTICS, NULL);
}

/* The mode of a new file is the folder's. */
int open(const char *path, int flags, ...) {
  const int how = flags & (O_RDONLY | O_WRONLY | O_RDWR);
  const DWORD access = (how == O_WRONLY ? 0 : GENERIC_READ) | (how == O_RDONLY ? 0 : GENERIC_WRITE);
  const char *name = strcmp(path, "/dev/null") == 0 ? "NUL" : path;
  HANDLE handle = handle_of(name, access, creation_of(flags));
  if (handle == INVALID_HANDLE_VALUE)
    return told(FALSE);
  int descriptor =
      _open_osfhandle((intptr_t)handle, (flags & (O_APPEND | _O_NOINHERIT)) | _O_BINARY);
  if (descriptor < 0)
    CloseHandle(handle);
  return descriptor;
}

int openat(int folder, const char *name, int flags, ...) {
  return folder == AT_FDCWD ? open(name, flags) : lacks();
}

int dirfd(DIR *folder) {
  (void)folder;
  return lacks();
}

static HANDLE handle_in(int descriptor) { return (HANDLE)_get_osfhandle(descriptor); }

/* The locks of a file are those of a handle, so another number of the same handle keeps them. */
int cs_open_twice(int descriptor) { return _dup(descriptor); }

int fcntl(int descriptor, int command, ...) {
  if (command == F_DUPFD_CLOEXEC)
    return _dup(descriptor);
  if (handle_in(descriptor) == INVALID_HANDLE_VALUE) {
    errno = EBADF;
    return -1;
  }
  return command == F_GETFD ? 0 : lacks();
}

/* ---------------------------------------------------------------- reading and writing */

static OVERLAPPED place(off_t offset) {
  const uint64_t at = (uint64_t)offset;
  return (OVERLAPPED){.Offset = (DWORD)at, .OffsetHigh = (DWORD)(at >> 32)};
}

static DWORD part_of(size_t size) { return size < 1 << 30 ? (DWORD)size : 1 << 30; }

ssize_t pread(int descriptor, void *bytes, size_t size, off_t offset) {
  OVERLAPPED at = place(offset);
  DWORD done = 0;
  if (ReadFile(handle_in(descriptor), bytes, part_of(size), &done, &at) ||
      GetLastError() == ERROR_HANDLE_EOF)
    return (ssize_t)done;
  return told(FALSE);
}

ssize_t pwrite(int descriptor, const void *bytes, size_t size, off_t offset) {
  OVERLAPPED at = place(offset);
  DWORD done = 0;
  return told(WriteFile(handle_in(descriptor), bytes, part_of(size), &done, &at)) == 0
             ? (ssize_t)done
             : -1;
}

/* A folder cannot be synced, and need not be: names are written in order. */
int fsync(int descriptor) {
  if (FlushFileBuffers(handle_in(descriptor)))
    return 0;
  errno = GetLastError() == ERROR_ACCESS_DENIED ? EINVAL : EIO;
  return -1;
}

int syncfs(int descriptor) {
  (void)descriptor;
  return 0;
}

/* The lock is far behind all bytes, which Windows would otherwise let nobody read. */
int flock(int descriptor, int operation) {
  OVERLAPPED at = {.OffsetHigh = 0x40000000};
  const DWORD flags =
      LOCKFILE_EXCLUSIVE_LOCK | (operation & LOCK_NB ? LOCKFILE_FAIL_IMMEDIATELY : 0);
  return told(LockFileEx(handle_in(descriptor), flags, 0, 1, 0, &at));
}

/* ---------------------------------------------------------------- names */

int rename(const char *from, const char *to) {
  return told(MoveFileExA(from, to, MOVEFILE_REPLACE_EXISTING));
}

int remove(const char *path) {
  const DWORD found = GetFileAttributesA(path);
  if (found != INVALID_FILE_ATTRIBUTES && found & FILE_ATTRIBUTE_DIRECTORY)
    return told(RemoveDirectoryA(path));
  return told(DeleteFileA(path));
}

int unlinkat(int folder, const char *name, int flags) {
  (void)flags;
  return folder == AT_FDCWD ? remove(name) : lacks();
}

int cs_lacking_mkdir(const char *path, mode_t mode) {
  (void)mode;
  return told(CreateDirectoryA(path, NULL));
}

int link(const char *from, const char *to) { return told(CreateHardLinkA(to, from, NULL)); }

ssize_t readlink(const char *path, char *out, size_t size) {
  (void)path, (void)out, (void)size;
  return lacks();
}

/* With / between the names, and links followed; the caller frees it. */
static char *name_of(HANDLE handle) {
  char text[4096];
  const DWORD length = GetFinalPathNameByHandleA(handle, text, sizeof text, FILE_NAME_NORMALIZED);
  if (length == 0 || length >= sizeof text) {
    errno = ENAMETOOLONG;
    return NULL;
  }
  for (char *at = text; *at; at++)
    *at = *at == '\\' ? '/' : *at;
  return _strdup(strncmp(text, "//?/UNC/", 8) == 0 ? text + 7
                                                   : text + 4 * !strncmp(text, "//?/", 4));
}

char *realpath(const char *path, char *out) {
  char program[4096];
  if (strcmp(path, "/proc/self/exe") == 0 && GetModuleFileNameA(NULL, program, sizeof program))
    path = program;
  HANDLE handle = handle_of(path, 0, OPEN_EXISTING);
  if (handle == INVALID_HANDLE_VALUE) {
    told(FALSE);
    return NULL;
  }
  char *found = name_of(handle);
  CloseHandle(handle);
  if (!found || !out)
    return found;
  snprintf(out, PATH_MAX, "%s", found);
  free(found);
  return out;
}

/* ---------------------------------------------------------------- what is known of a file */

/* Windows counts hundreds of nanoseconds from 1601. */
static struct timespec time_of(FILETIME time) {
  const int64_t ticks =
      ((int64_t)time.dwHighDateTime << 32 | time.dwLowDateTime) - 116444736000000000;
  return (struct timespec){.tv_sec = ticks / 10000000, .tv_nsec = (long)(ticks % 10000000) * 100};
}

static int describe(HANDLE handle, struct cs_lacking_stat *out) {
  BY_HANDLE_FILE_INFORMATION found = {0};
  if (!GetFileInformationByHandle(handle, &found))
    return told(FALSE);
  const bool is_folder = found.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY;
  *out = (struct cs_lacking_stat){
      .st_dev = found.dwVolumeSerialNumber,
      .st_ino = (uint64_t)found.nFileIndexHigh << 32 | found.nFileIndexLow,
      .st_nlink = found.nNumberOfLinks,
      .st_size = (int64_t)((uint64_t)found.nFileSizeHigh << 32 | found.nFileSizeLow),
      .st_mode = is_folder ? S_IFDIR | 0777 : S_IFREG | 0666,
      .st_mtim = time_of(found.ftLastWriteTime),
      .st_ctim = time_of(found.ftLastWriteTime)};
  return 0;
}

int cs_lacking_fstat(int descriptor, struct cs_lacking_stat *out) {
  HANDLE handle = handle_in(descriptor);
  *out = (struct cs_lacking_stat){.st_mode = S_IFIFO};
  return GetFileType(handle) == FILE_TYPE_DISK ? describe(handle, out) : 0;
}

int cs_lacking_stat(const char *path, struct cs_lacking_stat *out) {
  HANDLE handle = handle_of(path, 0, OPEN_EXISTING);
  if (handle == INVALID_HANDLE_VALUE)
    return told(FALSE);
  const int outcome = describe(handle, out);
  CloseHandle(handle);
  return outcome;
}

int fstatat(int folder, const char *name, struct cs_lacking_stat *out, int flags) {
  (void)flags;
  return folder == AT_FDCWD ? cs_lacking_stat(name, out) : lacks();
}

static bool is_visited(const char *name) {
  return strcmp(name, ".") != 0 && strcmp(name, "..") != 0;
}

/* Visits the contents of a folder. */
static int visit_inside(const char *folder, cs_lacking_visit *visit, int flags) {
  DIR *list = opendir(folder);
  int outcome = list ? 0 : -1;
  for (struct dirent *entry; outcome == 0 && (entry = readdir(list));) {
    char path[4096];
    if (is_visited(entry->d_name) &&
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name) < (int)sizeof path)
      outcome = nftw(path, visit, 0, flags);
  }
  if (list)
    closedir(list);
  return outcome;
}

int nftw(const char *path, cs_lacking_visit *visit, int descriptors, int flags) {
  struct cs_lacking_stat about;
  struct FTW where = {0};
  (void)descriptors;
  if (cs_lacking_stat(path, &about) != 0)
    return -1;
  if (!S_ISDIR(about.st_mode))
    return visit(path, &about, FTW_F, &where);
  if (flags & FTW_DEPTH) {
    const int outcome = visit_inside(path, visit, flags);
    return outcome ? outcome : visit(path, &about, FTW_DP, &where);
  }
  const int outcome = visit(path, &about, FTW_D, &where);
  return outcome ? outcome : visit_inside(path, visit, flags);
}

/* ---------------------------------------------------------------- texts */

void *memmem(const void *in, size_t size, const void *what, size_t length) {
  const char *at = in;
  for (size_t left = size; left >= length; left--, at++)
    if (memcmp(at, what, length) == 0)
      return (void *)(uintptr_t)at;
  return NULL;
}

char *stpcpy(char *to, const char *from) {
  const size_t length = strlen(from);
  return (char *)memcpy(to, from, length + 1) + length;
}

char *strcasestr(const char *in, const char *what) {
  for (const size_t length = strlen(what); *in; in++)
    if (_strnicmp(in, what, length) == 0)
      return (char *)(uintptr_t)in;
  return NULL;
}

int strerror_r(int number, char *out, size_t size) { return strerror_s(out, size, number); }

const char *strsignal(int number) {
  (void)number;
  return "a signal";
}

int dprintf(int descriptor, const char *format, ...) {
  char text[1024];
  va_list values;
  va_start(values, format);
  int length = vsnprintf(text, sizeof text, format, values);
  va_end(values);
  return _write(descriptor, text,
                (unsigned)(length < (int)sizeof text ? length : (int)sizeof text));
}

int setenv(const char *name, const char *value, int replace) {
  return !replace && getenv(name) ? 0 : _putenv_s(name, value);
}

locale_t newlocale(int mask, const char *name, locale_t base) {
  return (void)mask, (void)name, base;
}
locale_t uselocale(locale_t locale) { return locale; }

/* ---------------------------------------------------------------- the machine */

long sysconf(int name) {
  SYSTEM_INFO info;
  MEMORYSTATUSEX memory = {.dwLength = sizeof memory};
  GetSystemInfo(&info);
  if (name == _SC_NPROCESSORS_ONLN)
    return (long)info.dwNumberOfProcessors;
  if (name == _SC_PAGESIZE)
    return (long)info.dwPageSize;
  return GlobalMemoryStatusEx(&memory) ? (long)(memory.ullTotalPhys / info.dwPageSize) : -1;
}

int getrlimit(int resource, struct rlimit *out) {
  *out = (struct rlimit){UINT64_MAX, UINT64_MAX};
  return (void)resource, 0;
}

int setrlimit(int resource, const struct rlimit *limit) {
  return (void)resource, (void)limit, lacks();
}

/* Of the name with which the program was started: realpath knows the program's file. */
uint64_t getauxval(unsigned long type) { return (void)type, 0; }

/* ---------------------------------------------------------------- signals */

/* Of the flags and sets of signals none has an equal here. */
int sigaction(int number, const struct sigaction *action, struct sigaction *before) {
  if (!action || number == SIGALRM)
    return lacks();
  void (*old)(int) = signal(number, action->sa_handler);
  if (before)
    before->sa_handler = old;
  return old == SIG_ERR ? -1 : 0;
}
int sigaltstack(const stack_t *stack, stack_t *before) { return (void)stack, (void)before, 0; }
int sigprocmask(int how, const sigset_t *set, sigset_t *before) {
  return (void)how, (void)set, (void)before, 0;
}
int sigemptyset(sigset_t *set) { return (void)set, 0; }
int sigfillset(sigset_t *set) { return (void)set, 0; }
int sigaddset(sigset_t *set, int number) { return (void)set, (void)number, 0; }
int sigdelset(sigset_t *set, int number) { return (void)set, (void)number, 0; }

/* ---------------------------------------------------------------- what there is not */

int timer_create(int clock, struct sigevent *event, timer_t *timer) {
  return (void)clock, (void)event, (void)timer, lacks();
}
int timer_settime(timer_t timer, int flags, const struct itimerspec *value,
                  struct itimerspec *before) {
  return (void)timer, (void)flags, (void)value, (void)before, lacks();
}
int setitimer(int which, const struct itimerval *value, struct itimerval *before) {
  return (void)which, (void)value, (void)before, lacks();
}
pid_t fork(void) { return lacks(); }
pid_t getppid(void) { return lacks(); }
int kill(pid_t process, int number) { return (void)process, (void)number, lacks(); }
int setpgid(pid_t process, pid_t group) { return (void)process, (void)group, lacks(); }
int pipe2(int ends[2], int flags) { return (void)ends, (void)flags, lacks(); }
int waitid(int kind, id_t id, siginfo_t *out, int options) {
  return (void)kind, (void)id, (void)out, (void)options, lacks();
}
pid_t waitpid(pid_t process, int *status, int options) {
  return (void)process, (void)status, (void)options, lacks();
}

/* No source is ever ready. */
int poll(struct pollfd *sources, nfds_t count, int milliseconds) {
  (void)milliseconds;
  for (nfds_t i = 0; i < count; i++)
    sources[i].revents = 0;
  return 0;
}
int ppoll(struct pollfd *sources, nfds_t count, const struct timespec *time, const sigset_t *mask) {
  return (void)sources, (void)count, (void)time, (void)mask, lacks();
}
int munmap(void *at, size_t size) { return (void)at, (void)size, lacks(); }
int madvise(void *at, size_t size, int advice) {
  return (void)at, (void)size, (void)advice, lacks();
}
int memfd_create(const char *name, unsigned flags) { return (void)name, (void)flags, lacks(); }
int socketpair(int family, int kind, int protocol, int ends[2]) {
  return (void)family, (void)kind, (void)protocol, (void)ends, lacks();
}
int setsockopt(int socket, int level, int name, const void *value, socklen_t size) {
  return (void)socket, (void)level, (void)name, (void)value, (void)size, lacks();
}
int getsockopt(int socket, int level, int name, void *value, socklen_t *size) {
  return (void)socket, (void)level, (void)name, (void)value, (void)size, lacks();
}
ssize_t recv(int socket, void *bytes, size_t size, int flags) {
  return (void)socket, (void)bytes, (void)size, (void)flags, lacks();
}
ssize_t sendmsg(int socket, const struct msghdr *message, int flags) {
  return (void)socket, (void)message, (void)flags, lacks();
}
ssize_t recvmsg(int socket, struct msghdr *message, int flags) {
  return (void)socket, (void)message, (void)flags, lacks();
}
int inotify_init1(int flags) { return (void)flags, lacks(); }
int inotify_add_watch(int queue, const char *path, uint32_t events) {
  return (void)queue, (void)path, (void)events, lacks();
}
int prctl(int option, ...) { return (void)option, lacks(); }
int ioctl(int descriptor, unsigned long request, ...) {
  return (void)descriptor, (void)request, lacks();
}

int pthread_getcpuclockid(pthread_t thread, clockid_t *clock) {
  return (void)thread, (void)clock, ENOSYS;
}

void *mmap(void *at, size_t size, int protection, int flags, int descriptor, off_t offset) {
  (void)at, (void)size, (void)protection, (void)flags, (void)descriptor, (void)offset;
  lacks();
  return MAP_FAILED;
}
