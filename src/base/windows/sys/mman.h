/* See base/windows/everywhere.h: there is no memory as a file, and no advice on memory. */
#pragma once

#include <sys/types.h>

enum { PROT_READ = 1, PROT_WRITE = 2, MAP_SHARED = 1, MADV_REMOVE = 9 };
enum { MFD_CLOEXEC = 1, MFD_ALLOW_SEALING = 2 };
#define MAP_FAILED ((void *)-1)
void *mmap(void *at, size_t size, int protection, int flags, int descriptor, off_t offset);
int munmap(void *at, size_t size);
int madvise(void *at, size_t size, int advice);
int memfd_create(const char *name, unsigned flags);
