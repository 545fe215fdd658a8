#include "tools/trace/result.h"

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

celspan_trace *celspan_trace_ref(celspan_trace *trace) {
  atomic_fetch_add_explicit(&trace->references, 1, memory_order_relaxed);
  return trace;
}

void celspan_trace_unref(celspan_trace *trace) {
  if (!trace || atomic_fetch_sub_explicit(&trace->references, 1, memory_order_acq_rel) != 1)
    return;
  cs_memory *memory = trace->memory;
  for (size_t i = 0; i < trace->count; i++)
    cs_result_finish_shape(memory, &trace->shapes[i]);
  cs_mem_free(memory, trace->shapes, trace->capacity * sizeof *trace->shapes);
  celspan_object_unref(trace->object);
  cs_mem_free(memory, trace, sizeof *trace);
  cs_memory_unref(memory);
}
