/* celspan compare A B: whether two pictures show the same, row by row, in memory of two rows.
 *
 * Coded values are compared: sRGB, straight, at 16 bits when both pictures hold integers and as
 * floats when one of them does not.
 */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "base/context.h"
#include "cli/interrupt.h"
#include "cli/still.h"
#include "cli/verbs.h"
#include "output/pixels.h"

typedef struct comparison {
  celspan_coding coding;
  int32_t width, height;
  double tolerance;
  double largest;
  int32_t x, y; /* where the largest difference is */
  int channel;
  uint64_t differing; /* pixels */
} comparison;

static double value(const comparison *c, const void *row, size_t i) {
  return c->coding.depth == CELSPAN_DEPTH_16 ? ((const uint16_t *)row)[i] / 65535.0
                                             : (double)((const float *)row)[i];
}

static double difference(double a, double b) {
  if (isnan(a) || isnan(b))
    return isnan(a) && isnan(b) ? 0 : (double)INFINITY;
  return a == b ? 0 : fabs(a - b); /* equal infinities are equal */
}

static void compare_rows(comparison *c, int32_t y, const void *row_a, const void *row_b) {
  for (int32_t x = 0; x < c->width; x++) {
    bool differs = false;
    for (int channel = 0; channel < 4; channel++) {
      size_t i = 4 * (size_t)x + (size_t)channel;
      double d = difference(value(c, row_a, i), value(c, row_b, i));
      differs |= d > c->tolerance;
      if (d > c->largest) {
        c->largest = d;
        c->x = x;
        c->y = y;
        c->channel = channel;
      }
    }
    c->differing += differs;
  }
}

static celspan_status code_row(cs_still_rows *rows, const comparison *c, int32_t y, void *row) {
  const celspan_span *spans = NULL;
  size_t count = 0;
  celspan_status status = cs_still_rows_get(rows, y, &spans, &count);
  if (status == CELSPAN_OK)
    cs_pixels_row(&c->coding, spans, count, row);
  return status;
}

static celspan_status compare_all(celspan_context *context, comparison *c, cs_still_rows *a,
                                  cs_still_rows *b) {
  size_t row_size = (size_t)c->width * celspan_coding_pixel_size(&c->coding);
  void *row_a = cs_mem_resize(context->memory, NULL, 0, row_size);
  void *row_b = cs_mem_resize(context->memory, NULL, 0, row_size);
  celspan_status status = CELSPAN_OK;
  if (!row_a || !row_b)
    status = cs_fail_memory(context);
  for (int32_t y = 0; y < c->height && status == CELSPAN_OK; y++) {
    if (cs_interrupt_signal())
      status = CELSPAN_CANCELLED;
    if (status == CELSPAN_OK)
      status = code_row(a, c, y, row_a);
    if (status == CELSPAN_OK)
      status = code_row(b, c, y, row_b);
    if (status == CELSPAN_OK)
      compare_rows(c, y, row_a, row_b);
  }
  cs_mem_free(context->memory, row_a, row_size);
  cs_mem_free(context->memory, row_b, row_size);
  return status;
}

static celspan_status compare_stills(celspan_context *context, comparison *c,
                                     const cs_still *still_a, const celspan_frame_desc *frame_a,
                                     const cs_still *still_b, const celspan_frame_desc *frame_b) {
  cs_still_rows a = {NULL, NULL}, b = a;
  celspan_status status = cs_still_rows_create(context, still_a, frame_a, &a);
  if (status == CELSPAN_OK)
    status = cs_still_rows_create(context, still_b, frame_b, &b);
  if (status == CELSPAN_OK)
    status = compare_all(context, c, &a, &b);
  cs_still_rows_destroy(&a);
  cs_still_rows_destroy(&b);
  return status;
}

static cs_exit answer(const comparison *c) {
  printf("largest_difference %.9g", c->largest);
  if (c->largest > 0)
    printf(" x %d y %d channel %c", c->x, c->y, "rgba"[c->channel]);
  printf(" pixels_differing %" PRIu64 " pixels %" PRIu64 "\n", c->differing,
         (uint64_t)c->width * (uint64_t)c->height);
  return c->differing ? CS_EXIT_DIFFERENT : CS_EXIT_OK;
}

static cs_exit compare(celspan_context *context, const cs_request *request, const cs_still *a,
                       const cs_still *b) {
  if (a->info.width != b->info.width || a->info.height != b->info.height) {
    printf("sizes_differ %dx%d %dx%d\n", a->info.width, a->info.height, b->info.width,
           b->info.height);
    return CS_EXIT_DIFFERENT;
  }
  bool is_float = a->info.is_float || b->info.is_float;
  celspan_coding coding = {is_float ? CELSPAN_DEPTH_FLOAT : CELSPAN_DEPTH_16, CELSPAN_TRANSFER_SRGB,
                           CELSPAN_ALPHA_STRAIGHT};
  comparison c = {.coding = coding,
                  .width = a->info.width,
                  .height = a->info.height,
                  .tolerance = request->tolerance};
  celspan_frame_desc frame_a, frame_b;
  cs_exit outcome = cs_still_frame(a, request, &frame_a);
  if (outcome == CS_EXIT_OK)
    outcome = cs_still_frame(b, request, &frame_b);
  if (outcome != CS_EXIT_OK)
    return outcome;
  celspan_status status = compare_stills(context, &c, a, &frame_a, b, &frame_b);
  if (status != CELSPAN_OK)
    return cs_report_failure(context, status, NULL);
  return answer(&c);
}

cs_exit cs_compare_run(celspan_context *context, const cs_request *request) {
  cs_still a = {.exposure.rostrum = NULL}, b = a;
  cs_exit outcome = cs_still_open(context, request->operands[0], &a);
  if (outcome == CS_EXIT_OK)
    outcome = cs_still_open(context, request->operands[1], &b);
  if (outcome == CS_EXIT_OK)
    outcome = compare(context, request, &a, &b);
  cs_still_close(&a);
  cs_still_close(&b);
  return outcome;
}
