#include "output/pixels.h"
#include "output/sink.h"

typedef struct memory_sink {
  celspan_coding coding;
  unsigned char *pixels;
  size_t stride;
} memory_sink;

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  const memory_sink *sink = user;
  (void)height;
  size_t needed = (size_t)width * celspan_coding_pixel_size(&sink->coding);
  if (sink->stride >= needed)
    return CELSPAN_OK;
  return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                 "the stride is %zu bytes; a row of %d pixels needs at least %zu", sink->stride,
                 (int)width, needed);
}

static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  const memory_sink *sink = user;
  (void)context;
  cs_pixels_row(&sink->coding, spans, span_count, sink->pixels + (size_t)y * sink->stride);
  return CELSPAN_OK;
}

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  cs_mem_free(context->memory, user, sizeof(memory_sink));
  return outcome;
}

celspan_status cs_sink_memory(celspan_context *context, const celspan_coding *coding, void *pixels,
                              size_t stride, celspan_sink *out) {
  memory_sink *sink = cs_mem_array(context->memory, 1, sizeof *sink);
  if (!sink)
    return cs_fail_memory(context);
  *sink = (memory_sink){cs_pixels_resolve(coding, CELSPAN_DEPTH_8), pixels, stride};
  *out = (celspan_sink){.user = sink,
                        .begin = begin,
                        .row = put_row,
                        .end = end,
                        .takes_codes = cs_pixels_takes_codes(&sink->coding)};
  return CELSPAN_OK;
}
