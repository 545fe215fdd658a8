/* Which task of a farm's array this process is, as the farm says in the environment. */
#pragma once

#include <stdbool.h>
#include <stdint.h>

/* task: the number of the task, from 1, and how many there are. count: how many; 0: the farm must
 * say it. Returns false, without a change, unless a farm's array has set its variables. Threads: no
 * other thread changes the environment. */
bool cs_task_find(int32_t count, int32_t task[2]);
