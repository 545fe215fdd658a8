#include "base/ceiling.h"

#include <stdio.h>
#include <unistd.h>

#define MIB ((uint64_t)1 << 20)

/* The bytes that a group must have free in addition to the counted ones: a sixteenth of its limit,
 * for other processes and the kernel, until the group is asked again. */
static uint64_t margin_of(const cs_ceiling *ceiling) { return ceiling->limit / 16; }

/* rest: the part of the whole that other processes leave. */
static void lower(cs_ceiling *ceiling, const char *whose, uint64_t whole, uint64_t rest) {
  uint64_t part = rest / 4 * 3; /* may be more than addresses of 32 bits can reach */
  size_t most = part < SIZE_MAX ? (size_t)part : SIZE_MAX;
  if (most >= ceiling->most)
    return;
  ceiling->most = most;
  ceiling->whole = whole;
  ceiling->whose = whose;
}

void cs_ceiling_init(cs_ceiling *ceiling, const cs_control_group *group, uint64_t machine,
                     uint64_t given) {
  *ceiling = (cs_ceiling){.most = SIZE_MAX, .usage = -1, .stat = -1};
  atomic_init(&ceiling->asked, 0);
  if (machine)
    lower(ceiling, "this machine", machine, machine);
  if (group->memory != CS_CONTROL_GROUP_NONE && (!machine || group->memory < machine)) {
    cs_control_group_open(group->folder, &ceiling->usage, &ceiling->stat);
    uint64_t used = cs_control_group_used(ceiling->usage, ceiling->stat);
    ceiling->limit = group->memory;
    lower(ceiling, "this control group", group->memory,
          group->memory > used ? group->memory - used : 0);
  }
  if (given)
    lower(ceiling, "CELSPAN_MEMORY", given, given);
}

void cs_ceiling_finish(cs_ceiling *ceiling) {
  if (ceiling->usage >= 0)
    close(ceiling->usage);
  if (ceiling->stat >= 0)
    close(ceiling->stat);
  ceiling->usage = ceiling->stat = -1;
  ceiling->most = SIZE_MAX;
}

/* The group is asked again after a quarter of the memory that is free now has been allocated. */
static bool group_refuses(cs_ceiling *ceiling, size_t held, size_t more) {
  if (ceiling->usage < 0 ||
      held + more <= atomic_load_explicit(&ceiling->asked, memory_order_relaxed))
    return false;
  uint64_t used = cs_control_group_used(ceiling->usage, ceiling->stat) + margin_of(ceiling);
  uint64_t left = ceiling->limit > used ? ceiling->limit - used : 0;
  if (more > left)
    return true;
  uint64_t step = left / 4 > more ? left / 4 : more;
  atomic_store_explicit(&ceiling->asked, held + (size_t)step, memory_order_relaxed);
  return false;
}

cs_refusal cs_ceiling_refuses(cs_ceiling *ceiling, size_t held, size_t more) {
  if (more > ceiling->most || held > ceiling->most - more)
    return CS_REFUSAL_HELD;
  return group_refuses(ceiling, held, more) ? CS_REFUSAL_GROUP : CS_REFUSAL_NONE;
}

void cs_ceiling_tell(const cs_ceiling *ceiling, cs_refusal refusal, char *text, size_t size) {
  if (refusal == CS_REFUSAL_GROUP)
    snprintf(text, size, "the control group of this process, of %llu MiB, is full",
             (unsigned long long)(ceiling->limit / MIB));
  else
    snprintf(text, size,
             "script, scene and rendering together need more than %zu MiB, their part of the %llu "
             "MiB of %s (--limit render-memory=SIZE allows more)",
             ceiling->most >> 20, (unsigned long long)(ceiling->whole / MIB), ceiling->whose);
}
