/* Parcels of planes: arcs of no height, slivers and what is as thin but was drawn, joints, borders
 * that do not meet, boxes of pixels that are apart, and memory that is not there.
 */
#include <math.h>

#include "celspan/plane.h"
#include "tests/support/frame_rows.h"
#include "tests/support/memory.h"
#include "writers/parcels/boxes.h"
#include "writers/parcels/making.h"
#include "writers/parcels/plot.h"
#include "writers/parcels/under.h"

enum { SIDE = 1000 };

static celspan_texture *ink(studio *s) { return studio_paint(s, celspan_paint_rgb(0, 0, 0, 1)); }

static celspan_plane *plane_of(studio *s, const celspan_rostrum *rostrum) {
  celspan_plane_desc desc = CELSPAN_PLANE_DESC;
  celspan_plane *plane = NULL;
  desc.width = desc.height = SIDE;
  studio_check(s, celspan_plane_create(s->context, rostrum, &desc, &plane));
  return plane;
}

/* ---------------------------------------------------------------- arcs */

/* Two upright arcs with a fill between them, and one of no height in front. */
static cs_parcels upright(celspan_context *context, double width) {
  cs_parcels p = {.width = SIDE, .height = SIDE, .columns = 700, .rows = 7000, .fill_count = 3};
  const double x[3] = {500, 500, 500 + width};
  for (uint32_t i = 0; i < 3; i++) {
    const celspan_point top = {x[i], SIDE / 4.0}, foot = {x[i], i == 0 ? SIDE / 4.0 : SIDE / 2.0};
    const cs_parcel_curve line = {true, {top, top, foot, foot}};
    const cs_parcel_arc arc = {i,
                               1,
                               i == 2 ? 2 : 1,
                               i == 2 ? 1 : 2,
                               PLANEFILE_SIDE / 4,
                               i == 0 ? PLANEFILE_SIDE / 4 : PLANEFILE_SIDE / 2};
    CHECK(CS_ARRAY_APPEND(context, p.curves, p.curve_count, line) == CELSPAN_OK);
    CHECK(CS_ARRAY_APPEND(context, p.arcs, p.arc_count, arc) == CELSPAN_OK);
  }
  return p;
}

static celspan_status count_visit(const cs_beside *row, size_t place, void *user) {
  size_t *counts = user;
  CHECK(place < row->count && row->count == 2);
  counts[row->arcs[place]]++;
  return CELSPAN_OK;
}

static void check_rows(celspan_context *context) {
  size_t counts[3] = {0};
  cs_parcels p = upright(context, 1);
  CHECK(cs_beside_walk(context, &p, 3, count_visit, counts) == CELSPAN_OK);
  CHECK(counts[0] == 0 && counts[1] == 3 && counts[2] == 3);
  cs_parcels_finish(&p, context->memory);
}

/* Steps across are 700 units and those down are 7000, which count for flat borders alone. */
static void check_slivers(celspan_context *context) {
  for (int steps = 1; steps <= 5; steps += 4) {
    cs_parcels p = upright(context, steps * 700.0 / PLANEFILE_SIDE * SIDE);
    CHECK(cs_parcels_join_slivers(context, &p) == CELSPAN_OK);
    CHECK(p.arc_count == (steps == 1 ? 0 : 2));
    cs_parcels_finish(&p, context->memory);
  }
}

/* Two upright arcs, one below the other, and a third one that leaves them on the right, nearly flat
 * and too late, by 3 units. loop_count: 2 if a walk leads from each to each other one. */
static double begin_of_third(celspan_context *context, size_t loop_count) {
  cs_parcel_curve curves[3] = {{true, {{500, 250}, {500, 250}, {500, 500}, {500, 500}}},
                               {true, {{500, 500}, {500, 500}, {500, 750}, {500, 750}}},
                               {false, {{503, 500}, {533, 500.3}, {563, 500.6}, {593, 500.9}}}};
  const int32_t unit = PLANEFILE_SIDE / SIDE;
  cs_parcel_arc arcs[3] = {{0, 1, 1, 2, 250 * unit, 500 * unit},
                           {1, 1, 1, 3, 500 * unit, 750 * unit},
                           {2, 1, 2, 3, 500 * unit, 501 * unit}};
  cs_parcel_walk walks[4] = {{0, false}, {2, false}, {0, false}, {1, false}};
  cs_parcel_loop loops[2] = {{0, 2}, {2, 2}};
  cs_parcels p = {.width = SIDE,
                  .height = SIDE,
                  .columns = 700,
                  .rows = 7000,
                  .curves = curves,
                  .arcs = arcs,
                  .walks = walks,
                  .loops = loops,
                  .arc_count = 3,
                  .loop_count = loop_count};
  CHECK(cs_joints_make(context, &p) == CELSPAN_OK);
  const celspan_point *third = curves[2].points;
  CHECK(curves[0].points[3].x == 500 && curves[1].points[0].x == 500);
  CHECK(third[0].y == 500 && third[3].x == 593 && third[3].y == 500.9);
  CHECK(fabs(third[1].y - third[0].y - (third[1].x - third[0].x) / 100) < 0.031);
  return third[0].x;
}

static void check_joints(celspan_context *context) {
  CHECK(begin_of_third(context, 1) == 503); /* the line between two is that of both sides */
  CHECK(begin_of_third(context, 2) == 500);
}

/* ---------------------------------------------------------------- boxes */

static void check_boxes(void) {
  cs_boxes boxes = {.count = 0};
  cs_boxes_add(&boxes, (cs_box){0, 0, 10, 10});
  cs_boxes_add(&boxes, (cs_box){20, 0, 30, 10});
  cs_boxes_add(&boxes, (cs_box){100, 0, 110, 10});
  CHECK(boxes.count == 3);
  cs_boxes_add(&boxes, (cs_box){9, 9, 20, 20}); /* overlaps the first one and touches the second */
  CHECK(boxes.count == 2);
  const cs_box joined = boxes.all[1];
  CHECK(joined.x0 == 0 && joined.y0 == 0 && joined.x1 == 30 && joined.y1 == 20);
}

/* What is one more than there is room for goes to its neighbour. */
static void check_many_boxes(void) {
  cs_boxes boxes = {.count = 0};
  for (int32_t i = 0; i <= CS_BOXES; i++)
    cs_boxes_add(&boxes, (cs_box){10 * i, 0, 10 * i + 2, 2});
  CHECK(boxes.count == CS_BOXES);
  const cs_box last = boxes.all[CS_BOXES - 1];
  CHECK(last.x0 == 10 * (CS_BOXES - 1) && last.x1 == 10 * CS_BOXES + 2 && last.y1 == 2);
}

/* ---------------------------------------------------------------- planes */

static celspan_status write_drawing(studio *s, const celspan_plane *plane, cs_plot_facts *facts) {
  const cs_plot_desc desc = {.precision = 3, .scale = 0.1};
  cs_plot *plot;
  CHECK(cs_plot_begin(s->context, "parcels.svg", &desc, &plot) == CELSPAN_OK);
  return cs_plot_end(plot, cs_plot_add_plane(plot, plane, facts));
}

/* A border that ends too early is no sum of pictures. */
static void check_apart(studio *s) {
  cs_plot_facts facts;
  celspan_plane *plane = plane_of(s, studio_show(s, studio_rect(s, 100, 100, 300, 300, ink(s))));
  CHECK(write_drawing(s, plane, &facts) == CELSPAN_OK && facts.areas == 1 && !facts.is_picture);
  planefile_border *first = (planefile_border *)planefile_plane_band(plane->plane, 0)->borders;
  first->foot -= PLANEFILE_SIDE / 1000;
  CHECK(write_drawing(s, plane, &facts) == CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(s->context), "do not meet") != NULL);
  celspan_plane_unref(plane);
  remove("parcels.svg");
  studio_finish(s);
}

/* Discs that have a part of their outlines in common, so that arcs are cut and joined. */
static celspan_plane *discs(studio *s) {
  celspan_object *objects[3] = {studio_circle(s, 500, 500, 400, ink(s)),
                                studio_circle(s, 500, 500, 400, NULL),
                                studio_rect(s, 100, 300, 500, 500, ink(s))};
  celspan_cel *cel = studio_cel(s, CELSPAN_CEL_DESC, objects, 3);
  return plane_of(s, studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cel, 1));
}

static celspan_status make_all(studio *s, const celspan_plane *plane) {
  cs_parcels parcels;
  cs_under under = {0};
  celspan_status status = cs_parcels_make(s->context, plane, &parcels);
  if (status == CELSPAN_OK)
    status = cs_under_make(s->context, &parcels, 1, &under);
  cs_under_finish(&under, s->context->memory);
  cs_parcels_finish(&parcels, s->context->memory);
  return status;
}

/* Every allocation fails once. */
static void check_failures_of_memory(studio *s, memory_watch *watch) {
  celspan_plane *plane = discs(s);
  bool has_failed = true;
  for (size_t n = 1; has_failed; n++) {
    watch->fail_at = watch->allocations + n;
    celspan_status status = make_all(s, plane);
    watch->fail_at = 0;
    has_failed = status != CELSPAN_OK;
    CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY);
  }
  celspan_plane_unref(plane);
  studio_finish(s);
}

int main(void) {
  memory_watch watch = {0};
  studio s = {.context = memory_watch_context(&watch)};
  check_rows(s.context);
  check_slivers(s.context);
  check_joints(s.context);
  check_boxes();
  check_many_boxes();
  check_apart(&s);
  check_failures_of_memory(&s, &watch);
  celspan_context_destroy(s.context);
  CHECK(watch.blocks == 0 && watch.size_errors == 0);
  return check_done();
}
