/* Tracings as files: SVG drawings, and scripts of celspan. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "celspan/trace.h"
#include "inside/elementary.h"
#include "inside/number.h"
#include "inside/sinks.h"
#include "tools/trace/fit.h"
#include "tools/trace/path_text.h"
#include "tools/trace/result.h"
#include "tools/trace/spline.h"

/* ---------------------------------------------------------------- contour */

/* The outline of a stroke as lines and cubics, for formats that have no strokes of varying width.
 *
 *      .--------------.        points of both sides and around both ends, close together, fitted as
 *     (   - - - - - -  )       an edge is
 *      '--------------'
 *
 * INVARIANT: within 1/20 pixel of the outline that the stroke is drawn with, but where the inner
 * side of a bend runs back on itself, which is inside of it.
 */

/* The contours of lines; a closed line has two, one for each side. */
typedef struct cs_contours {
  celspan_point start[2];
  cs_fit_pieces pieces[2];
  size_t count;
} cs_contours;

#define PI 3.14159265358979323846
/* The distance between points in pixels, and the angle between points around an end. */
#define STEP 0.4
enum { CAP_POINTS = 12, MOST_POINTS = 1000000 };

static const cs_fit_rules rules = {.tolerance = 0.05,
                                   .mean = 0.05,
                                   .straight = 0.0375,
                                   .about = 3,
                                   .turn = 0.5,
                                   .near = 4,
                                   .rounding = 0.2,
                                   .noise = 0.02};

typedef struct drawer {
  celspan_context *context;
  const cs_shape *shape;
  cs_points *points;
} drawer;

static cs_station station_at(const drawer *d, double parameter) {
  const cs_shape *shape = d->shape;
  return cs_spline_at(shape->points, shape->widths, shape->point_count, shape->is_closed,
                      parameter);
}

/* The place at a parameter, and the direction, measured from a little before it to a little
 * after. */
static cs_station along_at(const drawer *d, double parameter, celspan_point *along) {
  double before = parameter - 1e-4, after = parameter + 1e-4;
  if (!d->shape->is_closed) {
    before = before < 0 ? 0 : before;
    after = after > 1 ? 1 : after;
  }
  cs_station a = station_at(d, before), b = station_at(d, after);
  double dx = b.v[0] - a.v[0], dy = b.v[1] - a.v[1], length = cs_number_length(dx, dy);
  *along = length > 0 ? (celspan_point){dx / length, dy / length} : (celspan_point){1, 0};
  return station_at(d, parameter);
}

/* A point of the outline, turned from the direction: to the right by a quarter turn, or ahead by
 * 0. */
static celspan_status add_at(const drawer *d, const cs_station *place, celspan_point along,
                             double angle) {
  double sine, cosine, radius = 0.5 * place->v[2];
  cs_elementary_sincos(angle, &sine, &cosine);
  return cs_points_add(d->context, d->points,
                       (celspan_point){
                           place->v[0] + radius * (cosine * along.x - sine * along.y),
                           place->v[1] + radius * (sine * along.x + cosine * along.y),
                       });
}

static size_t step_count(const drawer *d) {
  double length = 0;
  size_t count = d->shape->point_count;
  for (size_t i = 0; i + !d->shape->is_closed < count; i++) {
    celspan_point a = d->shape->points[i], b = d->shape->points[(i + 1) % count];
    length += cs_number_length(a.x - b.x, a.y - b.y);
  }
  double steps = length / STEP + 4;
  return steps < MOST_POINTS ? (size_t)steps : MOST_POINTS;
}

/* One side, forwards or backwards: on the left in the direction of travel. */
static celspan_status add_side(const drawer *d, bool is_back) {
  size_t steps = step_count(d);
  for (size_t i = 0; i < steps + !d->shape->is_closed; i++) {
    celspan_point along;
    double parameter = (double)i / (double)steps;
    cs_station place = along_at(d, is_back ? 1 - parameter : parameter, &along);
    CS_TRY(add_at(d, &place, along, is_back ? 0.5 * PI : -0.5 * PI));
  }
  return CELSPAN_OK;
}

/* Half a turn around an end, from the left side to the right side. */
static celspan_status add_cap(const drawer *d, bool is_back) {
  celspan_point along;
  cs_station place = along_at(d, is_back ? 0 : 1, &along);
  for (int i = 1; i < CAP_POINTS; i++)
    CS_TRY(add_at(d, &place, along, (is_back ? 0.5 : -0.5) * PI + PI * i / CAP_POINTS));
  return CELSPAN_OK;
}

static celspan_status add_contour(const drawer *d, cs_contours *out) {
  size_t at = out->count++;
  return cs_fit_closed(d->context, d->points, &rules, &out->start[at], &out->pieces[at]);
}

static celspan_status draw(const drawer *d, cs_contours *out) {
  CS_TRY(add_side(d, false));
  if (d->shape->is_closed) {
    CS_TRY(add_contour(d, out));
    d->points->count = 0;
    CS_TRY(add_side(d, true));
    return add_contour(d, out);
  }
  CS_TRY(add_cap(d, false));
  CS_TRY(add_side(d, true));
  CS_TRY(add_cap(d, true));
  return add_contour(d, out);
}

/* Errors: NO_MEMORY. The result must be finished, also after a failure. */
static CELSPAN_CHECKED celspan_status cs_contours_make(celspan_context *context,
                                                       const cs_shape *shape, cs_contours *out) {
  cs_points points = {.items = NULL};
  const drawer d = {context, shape, &points};
  *out = (cs_contours){.count = 0};
  celspan_status status = draw(&d, out);
  cs_points_finish(context, &points);
  return status;
}

static void cs_contours_finish(celspan_context *context, cs_contours *contours) {
  for (size_t i = 0; i < contours->count; i++)
    cs_pieces_finish(context, &contours->pieces[i]);
}

/* ---------------------------------------------------------------- write */

typedef struct writer {
  celspan_context *context;
  const celspan_trace *trace;
  cs_file *file;
} writer;

static celspan_status put(const writer *w, const char *text) {
  return cs_file_write(w->file, w->context, text, strlen(text));
}

/* ---------------------------------------------------------------- SVG */

/* The path data of a stroke's outline. */
static celspan_status draw_stroke(const writer *w, const cs_shape *shape, cs_writing *path) {
  cs_contours contours;
  celspan_status status = cs_contours_make(w->context, shape, &contours);
  for (size_t k = 0; k < contours.count && status == CELSPAN_OK; k++) {
    const cs_fit_pieces *pieces = &contours.pieces[k];
    status = cs_writing_draw(w->context, path, 'M', &contours.start[k], 1);
    for (size_t i = 0; i < pieces->count && status == CELSPAN_OK; i++)
      status = cs_pieces_draw(w->context, path, &pieces->items[i], pieces->items[i].to, false);
    if (status == CELSPAN_OK)
      status = cs_writing_add(w->context, path, "Z");
  }
  cs_contours_finish(w->context, &contours);
  return status;
}

static celspan_status put_outline(const writer *w, const cs_shape *shape) {
  cs_writing path = {.bytes = NULL};
  if (shape->data)
    return put(w, shape->data);
  celspan_status status = draw_stroke(w, shape, &path);
  if (status == CELSPAN_OK)
    status = put(w, path.bytes);
  cs_writing_finish(w->context, &path);
  return status;
}

static celspan_status put_path(const writer *w, const cs_shape *shape, size_t index) {
  char head[96];
  snprintf(head, sizeof head, "<path id=\"shape-%zu\" fill=\"#%02x%02x%02x\" d=\"", index + 1,
           shape->colour[0], shape->colour[1], shape->colour[2]);
  CS_TRY(put(w, head));
  CS_TRY(put_outline(w, shape));
  return put(w, "\"/>\n");
}

static celspan_status write_svg(const writer *w) {
  char head[160];
  snprintf(head, sizeof head,
           "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" "
           "viewBox=\"0 0 %d %d\">\n",
           w->trace->width, w->trace->height, w->trace->width, w->trace->height);
  CS_TRY(put(w, head));
  for (size_t i = 0; i < w->trace->count; i++)
    CS_TRY(put_path(w, &w->trace->shapes[i], i));
  return put(w, "</svg>\n");
}

/* ---------------------------------------------------------------- scripts */

static const char SCRIPT_HEAD[] =
    "-- A drawing that celspan traced. Rendered, it is a film of one frame; for other scripts it "
    "is\n"
    "-- a module: require \"NAME\", or select(2, dofile \"NAME.lua\"), gives { object =, shapes = "
    "}.\n"
    "local celspan = require \"celspan\"\n"
    "local shapes, objects = {}, {}\n"
    "local function add(object, fields)\n"
    "  fields.object, objects[#objects + 1], shapes[#shapes + 1] = object, object, fields\n"
    "end\n"
    "local function area(fields)\n"
    "  add(celspan.path { d = fields.d, texture = fields.colour }, fields)\n"
    "end\n"
    "local function line(fields)\n"
    "  add(celspan.stroke { points = fields.points, closed = fields.closed, degree = 3, cap = "
    "\"round\",\n"
    "    join = \"round\", texture = fields.colour }, fields)\n"
    "end\n";

static celspan_status put_points(const writer *w, const cs_shape *shape) {
  CS_TRY(put(w, shape->is_closed ? "closed = true, points = {" : "closed = false, points = {"));
  for (size_t i = 0; i < shape->point_count; i++) {
    char text[128];
    snprintf(text, sizeof text, "%s{%s,%s,%s}", i > 0 ? "," : "",
             cs_decimal_of(shape->points[i].x).text, cs_decimal_of(shape->points[i].y).text,
             cs_decimal_of(shape->widths[i]).text);
    CS_TRY(put(w, text));
  }
  return put(w, "} }\n");
}

static celspan_status put_call(const writer *w, const cs_shape *shape) {
  char head[128];
  snprintf(head, sizeof head, "%s { colour = \"#%02x%02x%02x\", x = %d, y = %d, area = %.0f, ",
           shape->data ? "area" : "line", shape->colour[0], shape->colour[1], shape->colour[2],
           shape->x, shape->y, shape->area);
  CS_TRY(put(w, head));
  if (!shape->data)
    return put_points(w, shape);
  CS_TRY(put(w, "d = \""));
  CS_TRY(put(w, shape->data));
  return put(w, "\" }\n");
}

static celspan_status write_script(const writer *w) {
  char tail[512];
  CS_TRY(put(w, SCRIPT_HEAD));
  for (size_t i = 0; i < w->trace->count; i++)
    CS_TRY(put_call(w, &w->trace->shapes[i]));
  snprintf(
      tail, sizeof tail,
      "local art = { object = celspan.union(objects), shapes = shapes, width = %d, height = "
      "%d }\n"
      "if ... then return art end\n"
      "return celspan.film { size = { art.width, art.height }, frames = 1, frame = function()\n"
      "  return celspan.rostrum { celspan.cel { art.object } }\n"
      "end }, art\n",
      w->trace->width, w->trace->height);
  return put(w, tail);
}

/* ---------------------------------------------------------------- files */

celspan_status celspan_trace_write(celspan_context *context, const celspan_trace *trace,
                                   const char *path) {
  writer w = {context, trace, NULL};
  bool is_script = strcasecmp(cs_file_ending(path), "lua") == 0;
  if (!is_script && strcasecmp(cs_file_ending(path), "svg") != 0)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: a tracing is written as .svg or .lua, by the ending of its name", path);
  CS_TRY(cs_file_create(context, NULL, path, &w.file));
  celspan_status status = is_script ? write_script(&w) : write_svg(&w);
  return cs_file_end(w.file, context, status);
}
