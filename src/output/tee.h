/* One row to two sinks: a frame is written and hashed while it is made once.
 */
#ifndef CS_OUTPUT_TEE_H
#define CS_OUTPUT_TEE_H

#include "celspan/celspan.h"

typedef struct cs_tee {
  celspan_sink sinks[2]; /* ended in this order */
  bool is_ended;         /* false after a render: the sinks are the caller's to discard */
} cs_tee;

/* tee: its sinks are set; kept by the sink as long as it is used. */
celspan_sink cs_tee_sink(cs_tee *tee);

#endif
