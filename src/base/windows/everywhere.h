/* What the sources ask of a system, for the C library of Windows, which lacks it or has it
 * otherwise. The build includes this file before every other, and finds the headers in this folder
 * before the system's: they complete those that Windows has, and stand for those that it has not.
 *
 * Files behave as elsewhere: an open one can be renamed and removed, a name replaces another, and
 * no byte is changed. Much fails as in a kernel without it: processes, signals to others, timers,
 * memory as a file, changes of files to wait for. Every caller has a way for this, or a sentence.
 *
 * Here are the functions of string.h, stdlib.h, stdio.h and locale.h. There is one locale.
 */
#pragma once

#include <stddef.h>

/* A host may have functions with these names, or Windows has, for other things. */
#define dirfd cs_lacking_dirfd
#define dprintf cs_lacking_dprintf
#define fcntl cs_lacking_fcntl
#define flock cs_lacking_flock
#define fork cs_lacking_fork
#define fstatat cs_lacking_fstatat
#define fsync cs_lacking_fsync
#define getauxval cs_lacking_getauxval
#define getppid cs_lacking_getppid
#define getrlimit cs_lacking_getrlimit
#define getsockopt cs_lacking_getsockopt
#define inotify_add_watch cs_lacking_inotify_add_watch
#define inotify_init1 cs_lacking_inotify_init1
#define ioctl cs_lacking_ioctl
#define kill cs_lacking_kill
#define link cs_lacking_link
#define madvise cs_lacking_madvise
#define memfd_create cs_lacking_memfd_create
#define memmem cs_lacking_memmem
#define mmap cs_lacking_mmap
#define munmap cs_lacking_munmap
#define newlocale cs_lacking_newlocale
#define nftw cs_lacking_nftw
#define openat cs_lacking_openat
#define pipe2 cs_lacking_pipe2
#define poll cs_lacking_poll
#define ppoll cs_lacking_ppoll
#define prctl cs_lacking_prctl
#define pread cs_lacking_pread
#define pwrite cs_lacking_pwrite
#define readlink cs_lacking_readlink
#define realpath cs_lacking_realpath
#define recv cs_lacking_recv
#define recvmsg cs_lacking_recvmsg
#define remove cs_lacking_remove
#define rename cs_lacking_rename
#define sendmsg cs_lacking_sendmsg
#define setenv cs_lacking_setenv
#define setitimer cs_lacking_setitimer
#define setpgid cs_lacking_setpgid
#define setrlimit cs_lacking_setrlimit
#define setsockopt cs_lacking_setsockopt
#define sigaction cs_lacking_sigaction
#define sigaddset cs_lacking_sigaddset
#define sigaltstack cs_lacking_sigaltstack
#define sigdelset cs_lacking_sigdelset
#define sigemptyset cs_lacking_sigemptyset
#define sigfillset cs_lacking_sigfillset
#define sigprocmask cs_lacking_sigprocmask
#define socketpair cs_lacking_socketpair
#define stpcpy cs_lacking_stpcpy
#define strcasestr cs_lacking_strcasestr
#define strerror_r cs_lacking_strerror_r
#define strsignal cs_lacking_strsignal
#define syncfs cs_lacking_syncfs
#define sysconf cs_lacking_sysconf
#define timer_create cs_lacking_timer_create
#define timer_settime cs_lacking_timer_settime
#define unlinkat cs_lacking_unlinkat
#define uselocale cs_lacking_uselocale
#define waitid cs_lacking_waitid
#define waitpid cs_lacking_waitpid

void *memmem(const void *in, size_t size, const void *what, size_t length);
char *stpcpy(char *to, const char *from);
char *strcasestr(const char *in, const char *what);
const char *strsignal(int number);
int strerror_r(int number, char *out, size_t size);
char *realpath(const char *path, char *out);
int setenv(const char *name, const char *value, int replace);
int dprintf(int descriptor, const char *format, ...);

int rename(const char *from, const char *to);
int remove(const char *path);

typedef int locale_t;
enum { LC_ALL_MASK = 1 };
locale_t newlocale(int mask, const char *name, locale_t base);
locale_t uselocale(locale_t locale);
