/* Any bytes as a stroke: no fault, no memory beyond a bound, no leak, every refusal with a
 * sentence; an accepted stroke is drawn, with a number and positions of curves that can be drawn.
 *
 *   bytes   0: cap, join, closed, the kind of line and whether the fine outline, which takes most
 *           of the time, is left out    1: degree    2: dashes, 0 to 3
 *           3..: numbers, two bytes each, beginning with width, miter, dash offset, tapers, from,
 *           to and the dashes; the rest is path data, or points with their widths
 */
#include "tests/fuzz/target.h"

#include "model/scene/inside.h"
#include "model/stroke/outliner.h"
#include "tests/fuzz/bytes.h"
#include "tests/fuzz/meter.h"

#define MOST_BYTES ((size_t)2 << 20) /* so that thousands of dashes end early */
#define POINTS 64
#define DASHES 3

static size_t fail_at, allocations;

/* ---------------------------------------------------------------- a stroke of bytes */

typedef struct sketch {
  celspan_stroke_desc desc;
  celspan_point points[POINTS];
  double widths[POINTS], dashes[DASHES];
  char data[4096];
} sketch;

static void read_line(bytes_reader *r, sketch *s, bool is_path, bool has_widths) {
  if (is_path) {
    size_t size = r->size < sizeof s->data - 1 ? r->size : sizeof s->data - 1;
    memcpy(s->data, r->bytes, size);
    s->desc.data = s->data;
    return;
  }
  for (; r->size > 0 && s->desc.point_count < POINTS; s->desc.point_count++) {
    s->points[s->desc.point_count].x = bytes_number(r);
    s->points[s->desc.point_count].y = bytes_number(r);
    s->widths[s->desc.point_count] = has_widths ? bytes_number(r) : 0;
  }
  s->desc.points = s->points;
  s->desc.widths = has_widths ? s->widths : NULL;
}

static void read_sketch(bytes_reader r, sketch *s) {
  *s = (sketch){.desc = CELSPAN_STROKE_DESC};
  int what = bytes_take(&r);
  s->desc.cap = (celspan_stroke_cap)(what & 3);
  s->desc.join = (celspan_stroke_join)(what >> 2 & 3);
  s->desc.closed = what & 16;
  s->desc.degree = bytes_take(&r) & 31;
  s->desc.dash_count = (size_t)bytes_take(&r) & 3;
  s->desc.width = bytes_number(&r);
  s->desc.miter = bytes_number(&r);
  s->desc.dash_offset = bytes_number(&r);
  s->desc.taper[0] = bytes_number(&r);
  s->desc.taper[1] = bytes_number(&r);
  s->desc.from = bytes_number(&r) / 10;
  s->desc.to = bytes_number(&r) / 10;
  for (size_t i = 0; i < s->desc.dash_count; i++)
    s->dashes[i] = bytes_number(&r);
  s->desc.dashes = s->desc.dash_count > 0 ? s->dashes : NULL;
  read_line(&r, s, what & 32, what & 64);
}

/* ---------------------------------------------------------------- what is done with it */

static bool is_expected(celspan_status status) {
  return status == CELSPAN_OK || status == CELSPAN_BAD_ARGUMENT || status == CELSPAN_LIMIT ||
         status == CELSPAN_NO_MEMORY;
}

static void check_outline(const cs_outline *outline) {
  for (size_t i = 0; i < outline->point_count; i++) {
    cs_hpoint p = outline->points[i];
    demand(isfinite(p.x) && isfinite(p.y) && p.w > 0, "a point that is not finite");
  }
}

/* The whole stroke in a frame, a part of it magnified, and a few rows. */
static void draw(celspan_context *context, const cs_stroke *stroke) {
  const celspan_box *box = &stroke->around;
  double size = fmax(1e-6, fmax(box->width, box->height));
  for (int i = 0; i < 3; i++) {
    double scale = (i == 1 ? 1e5 : 100) / size;
    cs_stroke_view view = {.frame = {0, 100, 0, 100},
                           .tolerance = CS_STROKE_TOLERANCE,
                           .top = i == 2 ? 40 : 0,
                           .bottom = i == 2 ? 42 : 100,
                           .right = i == 0 ? 100 : 60};
    cs_outline outline;
    view.matrix = celspan_matrix_then(celspan_matrix_translation(-box->x, -box->y),
                                      celspan_matrix_scaling(scale, scale));
    cs_outline_init(&outline);
    celspan_status status = cs_stroke_outline(context, stroke, &view, &outline);
    demand(is_expected(status), "a drawing fails in another way");
    if (status == CELSPAN_OK)
      check_outline(&outline);
    cs_outline_finish(&outline, context->memory);
  }
}

static void check_stroke(celspan_context *context, const celspan_object *object, bool is_fine) {
  celspan_box box;
  if (is_fine) {
    (void)celspan_object_bounds(object, &box);
    (void)celspan_object_contains(object, (celspan_point){1, 1});
  }
  draw(context, object->data->stroke);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static sketch s;
  meter m = {{.fail_at = fail_at}, 0, MOST_BYTES};
  celspan_context *context = meter_context(&m);
  read_sketch((bytes_reader){data, size}, &s);
  if (context) {
    celspan_object *object = NULL;
    celspan_status status = celspan_object_create_stroke(context, &s.desc, &object);
    demand(is_expected(status), "a refusal of another kind");
    demand(status == CELSPAN_OK || celspan_context_error(context)[0],
           "a refusal without a sentence");
    if (status == CELSPAN_OK)
      check_stroke(context, object, size == 0 || data[0] < 128);
    celspan_object_unref(object);
    celspan_context_destroy(context);
  }
  allocations = m.watch.allocations;
  meter_close(&m);
  return 0;
}

#ifdef REPLAY_MAIN
#define REPLAY_FAILURES
#include "tests/fuzz/replay.h"
#endif
