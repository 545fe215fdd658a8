#include "cli/tiles/means.h"

#include "base/context.h"
#include "cli/interrupt.h"
#include "output/sink.h"

static size_t pixels_size(const cs_tile_means *base) {
  return (size_t)base->width * (size_t)base->height * 4 * sizeof(float);
}

celspan_status cs_tile_means_begin(celspan_context *context, int32_t width, int32_t height,
                                   cs_tile_means *out, celspan_sink *sink) {
  const celspan_coding coding = {CELSPAN_DEPTH_FLOAT, CELSPAN_TRANSFER_LINEAR,
                                 CELSPAN_ALPHA_PREMULTIPLIED};
  cs_tile_means made = {.width = width, .height = height};
  made.pixels = cs_mem_array(context->memory, 1, pixels_size(&made));
  if (!made.pixels)
    return cs_fail_memory(context);
  celspan_status status =
      cs_sink_memory(context, &coding, made.pixels, (size_t)width * 4 * sizeof(float), sink);
  if (status == CELSPAN_OK)
    *out = made;
  else
    cs_tile_means_free(context, &made);
  return status;
}

void cs_tile_means_free(celspan_context *context, cs_tile_means *base) {
  if (base->pixels)
    cs_mem_free(context->memory, base->pixels, pixels_size(base));
  base->pixels = NULL;
}

/* How much of [at, at + 1) lies in [from, to). */
static double overlap(int32_t at, double from, double to) {
  double left = at > from ? at : from, right = at + 1 < to ? at + 1 : to;
  return right > left ? right - left : 0;
}

/* The mean over [x0, x1) x [y0, y1). */
static void mean_over(const cs_tile_means *base, double x0, double x1, double y0, double y1,
                      float out[4]) {
  double sum[4] = {0, 0, 0, 0}, all = 0;
  for (int32_t y = (int32_t)y0; y < base->height && y < y1; y++)
    for (int32_t x = (int32_t)x0; x < base->width && x < x1; x++) {
      const float *pixel = base->pixels + 4 * ((size_t)y * (size_t)base->width + (size_t)x);
      double weight = overlap(x, x0, x1) * overlap(y, y0, y1);
      all += weight;
      for (int c = 0; c < 4; c++)
        sum[c] += weight * (double)pixel[c];
    }
  for (int c = 0; c < 4; c++)
    out[c] = (float)(sum[c] / all);
}

static celspan_status put_rows(celspan_context *context, const cs_tile_means *base, int32_t width,
                               int32_t height, float *row, const celspan_sink *sink) {
  double across = (double)base->width / width, down = (double)base->height / height;
  const celspan_span span = {.x0 = 0, .x1 = width, .kind = CELSPAN_SPAN_ARRAY, .array = row};
  CS_TRY(sink->begin(sink->user, context, width, height));
  for (int32_t y = 0; y < height; y++) {
    if (cs_interrupt_signal())
      return CELSPAN_CANCELLED;
    for (int32_t x = 0; x < width; x++)
      mean_over(base, x * across, (x + 1) * across, y * down, (y + 1) * down, row + 4 * (size_t)x);
    CS_TRY(sink->row(sink->user, context, y, &span, 1));
  }
  return CELSPAN_OK;
}

celspan_status cs_tile_means_render(celspan_context *context, const cs_tile_means *base,
                                    int32_t width, int32_t height, const celspan_sink *sink) {
  size_t size = (size_t)width * 4 * sizeof(float);
  float *row = cs_mem_array(context->memory, 1, size);
  celspan_status status =
      row ? put_rows(context, base, width, height, row, sink) : cs_fail_memory(context);
  status = sink->end(sink->user, context, status);
  cs_mem_free(context->memory, row, size);
  return status;
}
