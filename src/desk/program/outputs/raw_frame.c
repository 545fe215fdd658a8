#include "program/outputs/raw_frame.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "inside/context.h"
#include "inside/frames.h"
#include "inside/sinks.h"

/* Bytes that are written together: a system call for each row takes long. */
#define RAW_TOGETHER ((size_t)128 << 10)

/* A sink that writes coded rows of a frame to standard output, without a header. */
typedef struct raw_rows {
  size_t pixel_size;
  unsigned char *rows; /* rows that are not written yet */
  size_t row_size, count, capacity;
} raw_rows;

static celspan_status begin_raw(void *user, celspan_context *context, int32_t width,
                                int32_t height) {
  raw_rows *raw = user;
  (void)height;
  raw->row_size = (size_t)width * raw->pixel_size;
  raw->capacity = raw->row_size < RAW_TOGETHER ? RAW_TOGETHER / raw->row_size : 1;
  raw->rows = cs_mem_resize(context->memory, NULL, 0, raw->capacity * raw->row_size);
  return raw->rows ? CELSPAN_OK : cs_fail_memory(context);
}

static celspan_status fail_output(celspan_context *context) {
  return celspan_context_fail(context, CELSPAN_OUTPUT, "standard output: %s", strerror(errno));
}

static celspan_status write_raw(raw_rows *raw, celspan_context *context) {
  size_t size = raw->count * raw->row_size;
  raw->count = 0;
  return fwrite(raw->rows, 1, size, stdout) == size ? CELSPAN_OK : fail_output(context);
}

/* The end of a frame. */
static celspan_status flush(celspan_context *context) {
  return fflush(stdout) == 0 ? CELSPAN_OK : fail_output(context);
}

static celspan_status put_raw_row(void *user, celspan_context *context, int32_t y,
                                  const celspan_span *spans, size_t span_count) {
  raw_rows *raw = user;
  (void)y, (void)span_count;
  memcpy(raw->rows + raw->count++ * raw->row_size, spans->codes, raw->row_size);
  return raw->count == raw->capacity ? write_raw(raw, context) : CELSPAN_OK;
}

static celspan_status end_raw(void *user, celspan_context *context, celspan_status outcome) {
  raw_rows *raw = user;
  if (outcome == CELSPAN_OK)
    outcome = write_raw(raw, context);
  cs_mem_free(context->memory, raw->rows, raw->capacity * raw->row_size);
  raw->rows = NULL;
  return outcome == CELSPAN_OK ? flush(context) : outcome;
}

celspan_status cs_raw_frame_print(celspan_context *context, const celspan_frame_desc *frame,
                                  const celspan_coding *coding) {
  const cs_coder coder = cs_coder_of(coding, frame->crop_x, frame->crop_y);
  raw_rows raw = {.pixel_size = celspan_coding_pixel_size(&coder.coding)};
  celspan_sink sink = {sizeof sink, &raw, begin_raw, put_raw_row, end_raw, false};
  CS_TRY(cs_coder_sink(context, &coder, &sink));
  return cs_frame_render_own(context, frame, &sink, NULL);
}

/* ---------------------------------------------------------------- slots */

/* Bytes of a row. */
static size_t stride_of(const celspan_frame_desc *frame, const celspan_coding *coding) {
  const celspan_coding resolved = cs_pixels_resolve(coding, CELSPAN_DEPTH_8);
  int32_t width = frame->crop_width > 0 ? frame->crop_width : frame->width;
  return (size_t)width * celspan_coding_pixel_size(&resolved);
}

celspan_status cs_raw_frame_slots(celspan_context *context, const celspan_frame_desc *frame,
                                  const celspan_coding *coding, cs_slots *slots) {
  int32_t height = frame->crop_width > 0 ? frame->crop_height : frame->height;
  size_t size = stride_of(frame, coding) * (size_t)height;
  size_t count = cs_slots_count(context, size, frame->workers);
  *slots = (cs_slots){0};
  return count > 1 ? cs_slots_open(slots, context, count, size) : CELSPAN_OK;
}

celspan_status cs_raw_frame_make(celspan_context *context, const celspan_frame_desc *frame,
                                 const celspan_coding *coding, const cs_slots *slots, size_t slot) {
  return celspan_frame_pixels(context, frame, coding, slots->frames[slot], stride_of(frame, coding),
                              NULL);
}

celspan_status cs_raw_frame_give(celspan_context *context, const cs_slots *slots, size_t slot) {
  bool is_written = fwrite(slots->frames[slot], 1, slots->frame_size, stdout) == slots->frame_size;
  return is_written ? flush(context) : fail_output(context);
}
