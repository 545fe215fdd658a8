/* A frame that is ready to be rendered: its description checked, and every exposure compiled.
 *
 *   celspan_frame_desc --check, compile--> cs_frame --row_worker.h, one a thread--> rows of spans
 *
 * A crowded frame shows more than CS_COMPILE_DASHES dashes. It has no plans: each row worker
 * compiles smaller parts of it, one after the other, so that memory holds only the dashes of such
 * a part.
 *
 * Invariant: a frame does not change once it is made; the row workers share it.
 */
#pragma once

#include "engine/map/sheets.h"
#include "engine/span/row_queue.h"
#include "frames/render/compile.h"
#include "output/sinks/coder.h"

#define CS_FRAME_BAND 16 /* rows that are held together (held.h), a multiple of CS_MAP_ROWS */

typedef struct cs_frame {
  /* one for each exposure of weight > 0; empty where the frame is crowded, or the exposure is drawn
   * from maps */
  CS_ARRAY(cs_plan, plans);
  CS_ARRAY(cs_map_frame, maps); /* one for each exposure; empty where the exposure has a plan */
  CS_ARRAY(float, weights);
  CS_ARRAY(celspan_rostrum *, rostrums); /* as cs_rostrum_shown: references */
  size_t count;
  cs_view view;       /* the view of the rows asked for, with all their columns */
  bool repeats;       /* see celspan_frame_desc */
  bool has_antialias; /* the same for all exposures; otherwise each exposure has its own */
  cs_antialias antialias;
  bool is_crowded;
  int32_t width, height; /* the width and height of the whole frame */
  int32_t crop_x, crop_y, crop_width, crop_height;
  int workers; /* at least 1 */
  int strip_height;
  struct cs_held *held;  /* held.h; NULL: no bands are held */
  bool takes_codes;      /* rows may contain codes, because their sink takes them */
  const cs_coder *coder; /* cs_sink_coder of the sink; NULL where spans are kept (held.c) */
} cs_frame;

/* Whether the description can be read and rendered. Errors: BAD_ARGUMENT and LIMIT, naming the
 * field. */
CELSPAN_CHECKED celspan_status cs_frame_check(celspan_context *context,
                                              const celspan_frame_desc *desc);
/* Errors: those of checking; those of cs_compile. */
CELSPAN_CHECKED celspan_status cs_frame_create(celspan_context *context,
                                               const celspan_frame_desc *desc, cs_frame *out);
void cs_frame_free(cs_frame *frame, cs_memory *memory);
/* Compiles all exposures for a view, into plans that were empty; view->most_dashes is the limit for
 * all exposures together. The plans must be freed, also after an error. *is_crowded: whether one of
 * the plans is crowded. Errors: those of cs_compile. */
CELSPAN_CHECKED celspan_status cs_frame_compile(celspan_context *context, const cs_frame *frame,
                                                const cs_view *view, int workers, cs_plan *plans,
                                                bool *is_crowded);
void cs_frame_free_plans(const cs_frame *frame, cs_plan *plans, cs_memory *memory);
/* cs_context_workers, up to the most threads of a frame. */
int cs_frame_workers(celspan_context *context, int wanted);
/* Copies row y of the crop, coded where the frame has a coder. Any thread. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_frame_queue_row(celspan_context *context, const cs_frame *frame,
                                                  int32_t y, const cs_row *row, cs_row_queue *out);

/* ---- render.c */

/* As celspan_frame_render, and the sink is ended or discarded in any case. */
CELSPAN_CHECKED celspan_status cs_frame_render_own(celspan_context *context,
                                                   const celspan_frame_desc *desc,
                                                   celspan_sink *sink,
                                                   celspan_statistics *statistics);

/* How many threads the description of these rows asks for; 1 where they must be made by the thread
 * that calls. */
int cs_rows_workers(const celspan_rows *rows);
