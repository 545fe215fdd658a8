/* Which task of a farm's array this process is. */
#include "program/options/argument.h"

#include <stddef.h>
#include <stdlib.h>

/* The variables of an array of tasks. The index runs from `first` to `last` in steps; a variable
 * that a farm does not have is NULL.
 *
 *   first   first + step   first + 2 step   ...   last       indices
 *     1          2               3          ...   count      tasks
 *
 * Sources: the manuals of sbatch and qsub (Grid Engine), "Indexed Job" of Kubernetes, and "Array
 * job environment variables" of AWS Batch.
 */
typedef struct farm_array {
  const char *index, *first, *last, *step, *count;
} farm_array;

static const farm_array arrays[] = {
    {"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_MAX", "SLURM_ARRAY_TASK_STEP",
     NULL},
    {"SGE_TASK_ID", "SGE_TASK_FIRST", "SGE_TASK_LAST", "SGE_TASK_STEPSIZE", NULL},
    {"AWS_BATCH_JOB_ARRAY_INDEX", NULL, NULL, NULL, "AWS_BATCH_JOB_ARRAY_SIZE"},
    {"JOB_COMPLETION_INDEX", NULL, NULL, NULL, NULL},
};

/* A whole number from 0. Returns false if the variable is not set, or has another text. */
static bool read_variable(const char *name, long long *out) {
  const char *text = name ? getenv(name) : NULL;
  char *end = NULL;
  long long number = text ? strtoll(text, &end, 10) : -1;
  if (!end || end == text || *end || number < 0 || number > INT32_MAX)
    return false;
  *out = number;
  return true;
}

static bool read_array(const farm_array *array, int32_t count, int32_t task[2]) {
  long long index, first = 0, last = 0, step = 1, tasks = count;
  if (!read_variable(array->index, &index))
    return false;
  read_variable(array->first, &first);
  if (!read_variable(array->step, &step) || step < 1)
    step = 1;
  if (!tasks && read_variable(array->last, &last))
    tasks = (last - first) / step + 1;
  if (!tasks)
    read_variable(array->count, &tasks);
  long long number = (index - first) / step + 1;
  if (index < first || number > tasks)
    return false;
  task[0] = (int32_t)number;
  task[1] = (int32_t)tasks;
  return true;
}

bool cs_task_find(int32_t count, int32_t task[2]) {
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
    if (read_array(&arrays[i], count, task))
      return true;
  return false;
}
