/* What ran is written to the files of a build for coverage (-Db_coverage=true) when a process ends by
 * exit, and only where it may write them. This stands before the calls by which celspan ends in other
 * ways, and lets a process that confines itself write in the folder of the build, too: the linker puts
 * it there (--wrap). A process whose files may not grow beyond some size writes no counts, for those
 * that were cut off would spoil the others. */
#include <stdlib.h>
#include <sys/resource.h>

#include "sandbox/strict.h"

void __gcov_dump(void);
void __gcov_reset(void);

_Noreturn void __real__exit(int code);
_Noreturn void __wrap__exit(int code);
int __real_raise(int number);
int __wrap_raise(int number);
const char *__real_cs_strict_enter(const cs_roots *read, const cs_roots *write);
const char *__wrap_cs_strict_enter(const cs_roots *read, const cs_roots *write);

static bool has_size_limit(void) {
  struct rlimit files;
  return getrlimit(RLIMIT_FSIZE, &files) == 0 && files.rlim_cur != RLIM_INFINITY;
}

/* Counts go to files below GCOV_PREFIX; there can be none below this. */
__attribute__((constructor)) static void begin(void) {
  if (has_size_limit())
    setenv("GCOV_PREFIX", "/dev/null", 1);
}

static void tell(void) {
  __gcov_dump();
  __gcov_reset();
}

void __wrap__exit(int code) {
  tell();
  __real__exit(code);
}

int __wrap_raise(int number) {
  tell();
  return __real_raise(number);
}

const char *__wrap_cs_strict_enter(const cs_roots *read, const cs_roots *write) {
  cs_roots with = {.count = 0};
  if (has_size_limit())
    return __real_cs_strict_enter(read, write);
  bool is_good = cs_roots_add(&with, COUNTED_BUILD);
  for (size_t i = 0; i < write->count && is_good; i++)
    is_good = cs_roots_add(&with, write->paths[i]);
  const char *refusal = is_good ? __real_cs_strict_enter(read, &with) : "too many folders";
  cs_roots_finish(&with);
  return refusal;
}
