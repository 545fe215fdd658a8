/* How a sink receives rows from several threads: in shares. A share is some successive rows, put by
 * one thread into a store of its own; finished shares are joined in order by the calling thread.
 *
 *   worker 0   | share 0 | share 3 | ...    put rows, each into its own share, at the same time
 *   worker 1   | share 1 | share 2 |
 *                   |         |
 *   caller          join 0, join 1, join 2, ...  --> file or memory
 *
 * Nothing is copied on the way, and a worker waits for the others only at the end.
 *
 * INVARIANT: the result is what the sink's own `row` would make of the same rows. begin and end of
 * the sink are called as always; its `row` is not called.
 */
#pragma once

#include "base/context.h"

/* Functions may be NULL if they would do nothing. */
typedef struct cs_shares {
  void *user;
  /* rows of each share, except that the last one may have fewer; 0: the caller may choose */
  int32_t rows;
  bool takes_above; /* the row above a share, if there is one, is put before the share's own rows */
  /* Workers, one for each thread, and shares are opened once and used many times. context: of the
   * thread. Errors: NO_MEMORY. */
  celspan_status (*open_worker)(void *user, celspan_context *context, void **worker);
  void (*close_worker)(void *user, celspan_context *context, void *worker);
  celspan_status (*open_share)(void *user, celspan_context *context, void **share);
  void (*close_share)(void *user, celspan_context *context, void *share);
  /* Begins a share. worker, share: NULL if there is no function to open them. y: a row of the
   * crop. */
  celspan_status (*begin)(void *worker, celspan_context *context, void *share, int32_t index);
  celspan_status (*row)(void *user, void *worker, celspan_context *context, int32_t y,
                        const celspan_span *spans, size_t span_count);
  celspan_status (*end)(void *worker, celspan_context *context);
  /* Where `row` will put the pixels of row y, if these are codes that spans may contain: codes that
   * are already there are not copied. worker: NULL if the sink's own `row` is called. */
  unsigned char *(*pixels)(void *user, void *worker, int32_t y);
  celspan_status (*join)(void *user, celspan_context *context, void *share, int32_t index);
} cs_shares;

/* The calls of shares that have their own memory, if the functions of the file have these names. */
#define CS_SHARES_CALLS                                                                            \
  .open_worker = open_worker, .close_worker = close_worker, .open_share = open_share,              \
  .close_share = close_share, .begin = begin_share, .row = put_share_row, .join = join_share

/* How each kind of sink fills its shares; false: the sink, which has begun, is of another kind.
 * cs_sink_shares calls all these functions. */
bool cs_memory_sink_shares(const celspan_sink *sink, cs_shares *out);
bool cs_ycc_sink_shares(const celspan_sink *sink, cs_shares *out);
bool cs_png_sink_shares(const celspan_sink *sink, cs_shares *out);
bool cs_span_sink_shares(const celspan_sink *sink, cs_shares *out);
/* The sink for which this one codes (output/sinks/coder.h); any other sink is its own. */
const celspan_sink *cs_coder_sink_inner(const celspan_sink *sink);
/* Turns the shares of that sink into shares of this one. */
void cs_coder_sink_shares(const celspan_sink *sink, cs_shares *shares);
/* The coder of a sink of each kind (output/sinks/coder.h); NULL: the sink is of another kind.
 * cs_sink_coder calls all these functions. */
const struct cs_coder *cs_coder_sink_own(const celspan_sink *sink);
const struct cs_coder *cs_memory_sink_coder(const celspan_sink *sink);
const struct cs_coder *cs_ycc_sink_coder(const celspan_sink *sink);
/* Whether the sink, which has begun, can receive rows in shares. A sink without `row` always
 * can. */
bool cs_sink_shares(const celspan_sink *sink, cs_shares *out);
