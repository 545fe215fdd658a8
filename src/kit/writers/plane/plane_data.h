/* A plane, as its units share it.
 *
 * Invariant: `plane` is the result of reading the bytes.
 */
#pragma once

#include <planefile.h>
#include <stdatomic.h>

#include "celspan/plane.h"
#include "inside/context.h"
#include "inside/frames.h"
#include "writers/record/recording.h"

struct celspan_plane {
  atomic_size_t references;
  cs_memory *memory;
  celspan_plane *whole; /* owned: the plane of another frame of the film, which has the bytes; or
                           NULL */
  unsigned char *bytes; /* the bytes of the file */
  size_t size, capacity;
  planefile_plane *plane;
};

/* The failure of a call of the subproject. */
CELSPAN_CHECKED celspan_status cs_plane_report(celspan_context *context, planefile_status status);

/* The failure of a call that writes a record. */
CELSPAN_CHECKED celspan_status cs_plane_report_record(celspan_context *context,
                                                      planefile_status status,
                                                      const cs_recording *made);

/* A frame before it is written, and the plans that its pictures are made from. */
typedef struct cs_plane_frame {
  cs_recording record;
  CS_ARRAY(cs_plan, plans);
  CS_ARRAY(celspan_rostrum *, shown); /* what they were made of: references */
  size_t plan_count, shown_count;
} cs_plane_frame;
/* The visible part of a frame, whose places are on a grid. out: must be finished, also after an
 * error. Errors: those of celspan_plane_create. */
CELSPAN_CHECKED celspan_status cs_plane_record(celspan_context *context,
                                               const celspan_exposure *exposures, size_t count,
                                               const celspan_plane_desc *desc, planefile_grid grid,
                                               cs_plane_frame *out);
void cs_plane_frame_finish(cs_plane_frame *frame, cs_memory *memory);
