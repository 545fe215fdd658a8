/* Scan-line primitives on a row: the spans a procedure returns enter the row as pairs of upright
 * edges beside the swept boundaries, so they take part in booleans, lights and antialiasing like
 * any primitive.
 *
 * Procedures are called at pixel centres under "none" and on CS_PROCEDURES_ROWS heights a pixel
 * under "area", where a span stands for that share of the row.
 */
#ifndef CS_ROW_PROCEDURES_H
#define CS_ROW_PROCEDURES_H

#include "row/row.h"

#define CS_PROCEDURES_ROWS 16

typedef struct cs_procedure_edge {
  double x; /* held to the frame */
  uint32_t layer, span;
  int32_t direction; /* +1 where the span begins, -1 where it ends */
} cs_procedure_edge;

typedef struct cs_procedure_edges {
  cs_procedure_edge *edges;
  size_t count, capacity;
} cs_procedure_edges;

/* Whether a scan-line primitive may be seen on row y. */
bool cs_procedures_meet(const cs_row_maker *maker, int32_t y);
/* Calls every procedure at a height of the frame; appends its spans to the composer's strips and
 * their edges to `edges` (room in the scan's arena), in no order.
 * Errors: NO_MEMORY; CALLBACK and what procedures return. */
CELSPAN_CHECKED celspan_status cs_procedures_collect(cs_row_maker *maker, double height,
                                                     cs_procedure_edges *edges);
/* A whole row at pixel centres, with strips. */
CELSPAN_CHECKED celspan_status cs_procedures_centre_row(cs_row_maker *maker, int32_t y,
                                                        cs_row *out);

#endif
