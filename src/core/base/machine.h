/* What this process may use of the machine.
 *
 *   processors   those that it may run on (taskset, cpusets), and not more than the quota of its
 *                control group, rounded up
 *   memory       the machine's, and not more than its control group's limit
 *
 * CELSPAN_CGROUP names the folder of another control group, for tests.
 */
#pragma once

#include <stdint.h>

#include "base/control_group.h"

/* The control group of this process. */
void cs_machine_group(cs_control_group *out);
/* The processors that a process in this group may use; at least 1. */
int cs_machine_processors(const cs_control_group *group);
/* Bytes; 0: unknown. */
uint64_t cs_machine_memory(void);
