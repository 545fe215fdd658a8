/* Scan-line primitives on a row: the spans a procedure returns enter the row as pairs of upright
 * edges beside the swept boundaries, so they take part in booleans, lights and antialiasing like
 * any primitive.
 *
 * Procedures are called at pixel centres under "none" and on CS_STRIPS_ROWS heights a pixel under
 * "area", where a span stands for that share of the row.
 */
#ifndef CS_FILTER_STRIPS_H
#define CS_FILTER_STRIPS_H

#include "filter/scan.h"

#define CS_STRIPS_ROWS 16

typedef struct cs_strip_edge {
  double x; /* held to the frame */
  uint32_t leaf, strip;
  int32_t direction; /* +1 where the span begins, -1 where it ends */
} cs_strip_edge;

typedef struct cs_strip_edges {
  cs_strip_edge *edges;
  size_t count, capacity;
} cs_strip_edges;

/* Whether a scan-line primitive may be seen on row y. */
bool cs_strips_meet(const cs_scan *scan, int32_t y);
/* Calls every procedure at a height of the frame; appends its spans to the composer's strips and
 * their edges to `edges` (room in the scan's arena), in no order.
 * Errors: NO_MEMORY; CALLBACK and what procedures return. */
CELSPAN_CHECKED celspan_status cs_strips_collect(cs_scan *scan, double height,
                                                 cs_strip_edges *edges);
/* A whole row at pixel centres, with strips. */
CELSPAN_CHECKED celspan_status cs_strips_centre_row(cs_scan *scan, int32_t y, cs_row *out);

#endif
