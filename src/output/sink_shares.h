/* Which sinks receive rows in shares (output/shares.h). */
#ifndef CS_OUTPUT_SINK_SHARES_H
#define CS_OUTPUT_SINK_SHARES_H

#include "output/shares.h"

/* Whether the sink, which has begun, receives rows in shares. A sink without `row` always does. */
bool cs_sink_shares(const celspan_sink *sink, cs_shares *out);

#endif
