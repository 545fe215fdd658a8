#include "tools/trace/result.h"

#include "inside/context.h"

#define SHAPES_MOST 1048576

void cs_result_finish_shape(cs_memory *memory, cs_shape *shape) {
  celspan_object_unref(shape->object);
  cs_mem_free(memory, shape->data, shape->data_size);
  cs_mem_free(memory, shape->points, shape->point_count * sizeof *shape->points);
  cs_mem_free(memory, shape->widths, shape->point_count * sizeof *shape->widths);
}

celspan_status cs_result_add(celspan_context *context, celspan_trace *trace,
                             const cs_shape *shape) {
  celspan_status status =
      trace->count < SHAPES_MOST
          ? CS_RESERVE(context, trace->shapes, trace->capacity, trace->count + 1)
          : cs_fail(context, CELSPAN_LIMIT,
                    "trace: there are more than %d shapes, which is the limit; ask for fewer "
                    "colours, or drop larger speckles",
                    SHAPES_MOST);
  if (status == CELSPAN_OK) {
    trace->shapes[trace->count++] = *shape;
  } else {
    cs_shape dropped = *shape;
    cs_result_finish_shape(trace->memory, &dropped);
  }
  return status;
}

static void destroy(celspan_trace *trace) {
  cs_memory *memory = trace->memory;
  for (size_t i = 0; i < trace->count; i++)
    cs_result_finish_shape(memory, &trace->shapes[i]);
  cs_mem_free(memory, trace->shapes, trace->capacity * sizeof *trace->shapes);
  celspan_object_unref(trace->object);
  cs_counted_free(memory, trace, sizeof *trace);
}

CS_COUNTED(celspan_trace)
