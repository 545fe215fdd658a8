/* Faults on purpose: the n-th call of some kind fails, once or with all that follow.
 *
 * A plan belongs to one kind of calls: to the system, to a host's functions, or for memory. Calls
 * may come from any thread; the plan changes only while there is one thread.
 */
#pragma once

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

/* Instead of an errno: reads and writes process half of their bytes, successfully. */
enum { FAULT_SHORT = -1 };

typedef struct fault_plan {
  atomic_size_t made;   /* calls so far, those that failed included */
  atomic_size_t failed; /* of those */
  size_t at;            /* the call of this number fails, counted from 1; 0: none */
  bool is_for_good;     /* all later ones fail too */
  int error;            /* calls to the system: their errno, or FAULT_SHORT */
  const char *only;     /* calls to the system: NULL, or the one that is counted, such as "close" */
  const char *call;     /* the first one that failed; NULL: none */
} fault_plan;

/* Resets the counts. */
static inline void fault_arm(fault_plan *plan, size_t at, bool is_for_good) {
  plan->made = plan->failed = 0;
  plan->at = at;
  plan->is_for_good = is_for_good;
  plan->call = NULL;
}

static inline void fault_disarm(fault_plan *plan) { plan->at = 0; }

/* Counts a call; true: it must fail. */
static inline bool fault_comes(fault_plan *plan, const char *call) {
  size_t number = ++plan->made;
  bool comes = plan->at > 0 && (plan->is_for_good ? number >= plan->at : number == plan->at);
  if (comes && plan->failed++ == 0)
    plan->call = call;
  return comes;
}
