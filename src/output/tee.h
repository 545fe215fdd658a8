/* A sink that passes every row to two others: a frame made once is written and hashed.
 *
 * INVARIANT: both sinks get the same calls, the second one only if the first succeeded; but `end`
 * always reaches both.
 */
#ifndef CS_OUTPUT_TEE_H
#define CS_OUTPUT_TEE_H

#include "celspan/celspan.h"

typedef struct cs_tee {
  celspan_sink sinks[2]; /* ended in this order */
  bool is_ended;         /* false after a render: the sinks are the caller's to discard */
} cs_tee;

/* tee: its sinks are set; borrowed until the sink ends. */
celspan_sink cs_tee_sink(cs_tee *tee);

#endif
