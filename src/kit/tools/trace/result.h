/* The contents of a tracing: the value behind celspan_trace.
 *
 * INVARIANT: immutable once it is made, and counted. A shape's object is made from its text, so
 * that a reader of the text makes the same object.
 */
#pragma once

#include "celspan/trace.h"
#include "inside/context.h"

typedef struct cs_shape {
  unsigned char colour[3];
  int32_t x, y; /* a pixel of it */
  double area;  /* pixels */
  char *data;   /* path data; NULL: a stroke */
  size_t data_size;
  celspan_point *points; /* the points of a stroke */
  double *widths;
  size_t point_count;
  bool is_closed;
  celspan_object *object; /* NULL if it is not made */
} cs_shape;

struct celspan_trace {
  atomic_size_t references;
  cs_memory *memory;
  int32_t width, height;
  cs_shape *shapes;
  size_t count, capacity;
  celspan_object *object; /* the union of their objects; NULL if these are not made */
};

/* Adds a copy of a shape. The tracing owns the shape's contents from now on, also after a failure.
 * Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_result_add(celspan_context *context, celspan_trace *trace,
                                             const cs_shape *shape);
/* celspan_trace_create without the objects, for callers that make their own. */
CELSPAN_CHECKED celspan_status cs_result_make(celspan_context *context,
                                              const celspan_trace_desc *desc, celspan_trace **out);
void cs_result_finish_shape(cs_memory *memory, cs_shape *shape);
