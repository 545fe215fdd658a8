#include "cli/raw_rows.h"

#include <errno.h>
#include <string.h>

#include "base/context.h"
#include "output/pixels.h"

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  cs_raw_rows *raw = user;
  (void)height;
  raw->row_size = (size_t)width * celspan_coding_pixel_size(&raw->coding);
  raw->row = cs_mem_resize(context->memory, NULL, 0, raw->row_size);
  return raw->row ? CELSPAN_OK : cs_fail_memory(context);
}

static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  cs_raw_rows *raw = user;
  celspan_spans_code_at(&raw->coding, raw->x, raw->y + y, spans, span_count, raw->row);
  if (fwrite(raw->row, 1, raw->row_size, raw->stream) == raw->row_size)
    return CELSPAN_OK;
  return celspan_context_fail(context, CELSPAN_OUTPUT, "standard output: row %d: %s", y,
                              strerror(errno));
}

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  cs_raw_rows *raw = user;
  cs_mem_free(context->memory, raw->row, raw->row_size);
  raw->row = NULL;
  if (outcome == CELSPAN_OK && fflush(raw->stream) != 0)
    return celspan_context_fail(context, CELSPAN_OUTPUT, "standard output: %s", strerror(errno));
  return outcome;
}

celspan_sink cs_raw_rows_sink(cs_raw_rows *raw, const celspan_coding *coding,
                              const celspan_frame_desc *frame, FILE *stream) {
  bool dithers = coding->depth == CELSPAN_DEPTH_8_DITHER;
  *raw = (cs_raw_rows){.coding = cs_pixels_resolve(coding, CELSPAN_DEPTH_8),
                       .x = frame->crop_x,
                       .y = frame->crop_y,
                       .stream = stream};
  bool takes_codes = !dithers && cs_pixels_takes_codes(&raw->coding);
  if (dithers)
    raw->coding.depth = CELSPAN_DEPTH_8_DITHER;
  return (celspan_sink){raw, begin, put_row, end, takes_codes};
}
