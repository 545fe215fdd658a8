#include "base/machine.h"

#include <math.h>
#ifdef __linux__
#include <sched.h>
#endif
#include <stdlib.h>
#include <unistd.h>

/* The number of processors that this process may run on. */
static long allowed_processors(void) {
#ifdef __linux__
  cpu_set_t sets[16]; /* larger than the masks of all kernels, which refuse shorter ones */
  if (sched_getaffinity(0, sizeof sets, sets) == 0)
    return CPU_COUNT_S(sizeof sets, sets);
#endif
  return sysconf(_SC_NPROCESSORS_ONLN);
}

void cs_machine_group(cs_control_group *out) {
  const char *folder = getenv("CELSPAN_CGROUP");
  cs_control_group_read("/proc/self", folder && folder[0] ? folder : NULL, out);
}

int cs_machine_processors(const cs_control_group *group) {
  long count = allowed_processors();
  double quota = ceil(group->processors);
  count = quota < (double)count ? (long)quota : count;
  return count < 1 ? 1 : (int)count;
}

uint64_t cs_machine_memory(void) {
  long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
  return pages > 0 && size > 0 ? (uint64_t)pages * (uint64_t)size : 0;
}
