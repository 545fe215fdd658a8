#include "cli/video/planes.h"

#include "base/context.h"
#include "output/pixels.h"
#include "output/ycbcr.h"

static size_t halves(int32_t count) { return ((size_t)count + 1) / 2; }

/* Pixels of a kept row: an even number of them. */
static size_t row_pixels(const cs_planes *planes) { return 2 * halves(planes->width); }

static size_t rows_size(const cs_planes *planes) {
  return 2 * row_pixels(planes) * sizeof *planes->rows[0];
}

static size_t luma_size(int32_t width, int32_t height) { return (size_t)width * (size_t)height; }

static size_t chroma_size(int32_t width, int32_t height, bool is_halved) {
  return is_halved ? halves(width) * halves(height) : luma_size(width, height);
}

size_t cs_planes_size(int32_t width, int32_t height, bool is_halved) {
  return luma_size(width, height) + 2 * chroma_size(width, height, is_halved);
}

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  cs_planes *planes = user;
  planes->width = width;
  planes->height = height;
  planes->rows[0] = cs_mem_resize(context->memory, NULL, 0, rows_size(planes));
  if (!planes->rows[0])
    return cs_fail_memory(context);
  planes->rows[1] = planes->rows[0] + row_pixels(planes);
  return CELSPAN_OK;
}

/* Of the row, or of the two rows that end with it. */
static void put_chroma(const cs_planes *planes, int32_t y, const uint32_t *row) {
  size_t size = chroma_size(planes->width, planes->height, planes->is_halved);
  unsigned char *cb = planes->bytes + luma_size(planes->width, planes->height), *cr = cb + size;
  if (!planes->is_halved) {
    size_t offset = (size_t)y * (size_t)planes->width;
    cs_ycbcr_chroma(row, planes->width, cb + offset, cr + offset);
  } else if (y % 2 == 1 || y == planes->height - 1) {
    size_t offset = (size_t)(y / 2) * halves(planes->width);
    cs_ycbcr_halved(planes->rows[0], row, (int32_t)halves(planes->width), cb + offset, cr + offset);
  }
}

static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  const cs_planes *planes = user;
  uint32_t *row = planes->rows[y % 2];
  (void)context;
  celspan_spans_code_at(&planes->coding, planes->x, planes->y + y, spans, span_count, row);
  row[row_pixels(planes) - 1] = row[planes->width - 1];
  cs_ycbcr_luma(row, planes->width, planes->bytes + (size_t)y * (size_t)planes->width);
  put_chroma(planes, y, row);
  return CELSPAN_OK;
}

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  cs_planes *planes = user;
  cs_mem_free(context->memory, planes->rows[0], planes->rows[0] ? rows_size(planes) : 0);
  planes->rows[0] = NULL;
  return outcome;
}

celspan_sink cs_planes_sink(cs_planes *planes, const celspan_coding *coding,
                            const celspan_frame_desc *frame, bool is_halved, unsigned char *bytes) {
  bool dithers = coding->depth == CELSPAN_DEPTH_8_DITHER;
  *planes = (cs_planes){.coding = cs_pixels_resolve(coding, CELSPAN_DEPTH_8),
                        .x = frame->crop_x,
                        .y = frame->crop_y,
                        .is_halved = is_halved,
                        .bytes = bytes};
  if (celspan_frame_is_opaque(frame)) /* the same, by a faster way */
    planes->coding.alpha = CELSPAN_ALPHA_STRAIGHT;
  bool takes_codes = !dithers && cs_pixels_takes_codes(&planes->coding);
  if (dithers)
    planes->coding.depth = CELSPAN_DEPTH_8_DITHER;
  return (celspan_sink){planes, begin, put_row, end, takes_codes};
}
