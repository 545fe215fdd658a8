/* How a sink takes rows from several threads: in parts of some rows, each filled by one thread, and
 * joined in order by one. Nothing is copied on the way, and nothing waits for its turn but the end.
 *
 *   rows of a part --begin, row, ..., end (any thread)--> part --join (in order)--> the sink
 *
 * INVARIANT: what comes out is what the sink's own `row` would have made of the same rows. begin
 * and end of the sink are called as ever; its `row` is not.
 */
#ifndef CS_OUTPUT_PARTS_H
#define CS_OUTPUT_PARTS_H

#include "base/context.h"

/* Functions may be NULL where there is nothing to do. */
typedef struct cs_parts {
  void *user;
  int32_t rows;     /* of a part, the last may have fewer; 0: any number */
  bool takes_above; /* the row above a part, where there is one, comes before its own */
  /* What a thread fills parts with, and the parts, which are used again and again. context: of the
   * thread. Errors: NO_MEMORY. */
  celspan_status (*open_hand)(void *user, celspan_context *context, void **hand);
  void (*close_hand)(void *user, celspan_context *context, void *hand);
  celspan_status (*open_part)(void *user, celspan_context *context, void **part);
  void (*close_part)(void *user, celspan_context *context, void *part);
  /* hand, part: NULL where there are none. y: of the crop. */
  celspan_status (*begin)(void *hand, celspan_context *context, void *part, int32_t index);
  celspan_status (*row)(void *user, void *hand, celspan_context *context, int32_t y,
                        const celspan_span *spans, size_t span_count);
  celspan_status (*end)(void *hand, celspan_context *context);
  celspan_status (*join)(void *user, celspan_context *context, void *part, int32_t index);
} cs_parts;

/* Whether the sink, which has begun, takes rows in parts. One without `row` takes them anyhow. */
bool cs_sink_parts(const celspan_sink *sink, cs_parts *out);

/* Of the sinks that do: false when the sink is another. */
bool cs_memory_parts(const celspan_sink *sink, cs_parts *out);
bool cs_png_parts(const celspan_sink *sink, cs_parts *out);

#endif
