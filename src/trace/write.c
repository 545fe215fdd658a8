/* Tracings as files: SVG drawings, and scripts of celspan. */
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "output/file.h"
#include "trace/contour.h"
#include "trace/text.h"

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
    const cs_pieces *pieces = &contours.pieces[k];
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

static bool ends_with(const char *path, const char *ending) {
  size_t length = strlen(path), tail = strlen(ending);
  return length > tail && strcasecmp(path + length - tail, ending) == 0;
}

celspan_status celspan_trace_write(celspan_context *context, const celspan_trace *trace,
                                   const char *path) {
  writer w = {context, trace, NULL};
  bool is_script = ends_with(path, ".lua");
  if (!is_script && !ends_with(path, ".svg"))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: a tracing is written as .svg or .lua, by the ending of its name", path);
  CS_TRY(cs_file_create(context, NULL, path, &w.file));
  celspan_status status = is_script ? write_script(&w) : write_svg(&w);
  if (status == CELSPAN_OK)
    return cs_file_commit(w.file, context);
  cs_file_discard(w.file, context);
  return status;
}
