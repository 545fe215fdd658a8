/* Tracing, from the picture to its shapes:
 *
 *   picture --scan--> codes --colours--> a few --labels--> one a pixel --speckles--> fewer
 *     --regions, borders--> graph --curves--> lines and cubics --shapes--> paths, objects
 *                              \--lines--> centre lines and widths --> strokes
 */
#include <string.h>

#include "celspan/trace.h"
#include "inside/context.h"
#include "inside/description.h"
#include "inside/scene.h"
#include "inside/sort.h"
#include "tools/trace/borders.h"
#include "tools/trace/colours.h"
#include "tools/trace/curves.h"
#include "tools/trace/drawn_lines.h"
#include "tools/trace/path_text.h"
#include "tools/trace/regions.h"
#include "tools/trace/result.h"

CS_DESCRIBE(celspan_trace_desc, picture, .colours = 2, .speckle = 2, .smooth = 1)

/* ---------------------------------------------------------------- shapes */

/* Regions as shapes: closed paths, each made of the chains around its region.
 *
 *     +-------A-------+       region 1: A, then back along B
 *     |   1   |       |       region 2: B, then C
 *     +---+   B   2   C       B is the same curve in both, in opposite directions: so nothing shows
 *         |   |       |       through between them
 *     +---+---+-------+
 *
 * INVARIANT: every chain is in two paths, once in each direction, except the picture's rim, which
 * is in one. So at every point of the picture the winding numbers of all paths add up to 1,
 * wherever the curves run, even across each other: some path is always there, and no light leaks
 * between.
 */

typedef struct maker {
  celspan_context *context;
  const cs_material *material;
  const cs_regions *regions;
  const cs_borders *borders;
  const cs_curves *curves;
  CS_ARRAY(cs_way, first);       /* by region: its first way */
  CS_ARRAY(cs_way, next);        /* by way: another one around the same region */
  CS_ARRAY(unsigned char, used); /* by way: it is part of a path */
  CS_ARRAY(struct place, order); /* the regions that have a colour, the largest first */
} maker;

/* ---------------------------------------------------------------- ways around a region */

static uint32_t region_left_of(const cs_borders *borders, cs_way way) {
  const cs_chain *chain = &borders->chains[way / 2];
  return way % 2 == 0 ? chain->left : chain->right;
}

static void list_ways(const maker *m) {
  for (size_t i = 0; i < m->regions->count; i++)
    m->first[i] = CS_WAY_NONE;
  for (size_t i = 2 * m->borders->chain_count; i-- > 0;) {
    uint32_t region = region_left_of(m->borders, (cs_way)i);
    if (region == CS_REGION_OUTSIDE)
      continue;
    m->next[i] = m->first[region];
    m->first[region] = (cs_way)i;
  }
}

/* The way that continues around the region on the left: the sharpest turn to the left. */
static cs_way go_on(const cs_borders *borders, cs_way way) {
  const cs_chain *chain = &borders->chains[way / 2];
  bool is_back = way % 2 == 1;
  uint32_t end = is_back ? chain->from : chain->to;
  if (end == CS_NODE_NONE)
    return way;
  int direction = is_back ? (borders->directions[chain->first] + 2) % 4
                          : borders->directions[chain->first + chain->count - 1];
  static const int turns[] = {3, 0, 1, 2};
  for (size_t i = 0; i < sizeof turns / sizeof *turns; i++) {
    cs_way next = borders->nodes[end].out[(direction + turns[i]) % 4];
    if (next != CS_WAY_NONE)
      return next;
  }
  return way;
}

/* ---------------------------------------------------------------- paths */

static celspan_point start_of(const maker *m, cs_way way) {
  const cs_trace_curve *curve = &m->curves->list[way / 2];
  const cs_piece *pieces = m->curves->pieces.items + curve->first;
  return way % 2 == 0 || curve->count == 0 ? curve->start : pieces[curve->count - 1].to;
}

static celspan_status draw_way(const maker *m, cs_writing *path, cs_way way) {
  const cs_trace_curve *curve = &m->curves->list[way / 2];
  const cs_piece *pieces = m->curves->pieces.items + curve->first;
  bool is_back = way % 2 == 1;
  for (size_t i = 0; i < curve->count; i++) {
    size_t at = is_back ? curve->count - 1 - i : i;
    celspan_point to = !is_back ? pieces[at].to : at > 0 ? pieces[at - 1].to : curve->start;
    CS_TRY(cs_pieces_draw(m->context, path, &pieces[at], to, is_back));
  }
  return CELSPAN_OK;
}

/* Draws the ways around a region, from one way until this way comes again. */
static celspan_status draw_around(const maker *m, cs_writing *path, cs_way begun) {
  celspan_point start = start_of(m, begun);
  CS_TRY(cs_writing_draw(m->context, path, 'M', &start, 1));
  cs_way way = begun;
  do {
    m->used[way] = 1;
    CS_TRY(draw_way(m, path, way));
    way = go_on(m->borders, way);
  } while (way != begun && !m->used[way]);
  return cs_writing_add(m->context, path, "Z");
}

static celspan_status draw_region(const maker *m, cs_writing *path, uint32_t region) {
  for (cs_way way = m->first[region]; way != CS_WAY_NONE; way = m->next[way])
    if (!m->used[way])
      CS_TRY(draw_around(m, path, way));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- shapes */

static celspan_status add_shape(const maker *m, uint32_t region, celspan_trace *out) {
  const cs_region *from = &m->regions->list[region];
  const cs_flat_colour *colour = &m->material->colours->list[from->label];
  cs_shape shape = {.x = from->x, .y = from->y0, .area = from->area};
  cs_writing path = {.bytes = NULL};
  memcpy(shape.colour, colour->code, sizeof shape.colour);
  celspan_status status = draw_region(m, &path, region);
  if (status != CELSPAN_OK) {
    cs_writing_finish(m->context, &path);
    return status;
  }
  shape.data = path.bytes;
  shape.data_size = path.capacity;
  return cs_result_add(m->context, out, &shape);
}

typedef struct place {
  uint32_t region, area;
} place;

static inline bool is_before(const place *a, const place *b) {
  return a->area != b->area ? a->area > b->area : a->region < b->region;
}
CS_SORT_DEFINE(sort_places, place, is_before)

static celspan_status add_shapes(maker *m, celspan_trace *out) {
  size_t count = 0, ways = 2 * m->borders->chain_count;
  CS_TRY(CS_ARRAY_MAKE(m->context, m->first, m->regions->count));
  CS_TRY(CS_ARRAY_MAKE(m->context, m->next, ways));
  CS_TRY(CS_ARRAY_MAKE(m->context, m->used, ways));
  CS_TRY(CS_ARRAY_MAKE(m->context, m->order, m->regions->count));
  list_ways(m);
  for (uint32_t i = 0; i < m->regions->count; i++)
    if (m->regions->list[i].label < m->material->colours->count)
      m->order[count++] = (place){i, m->regions->list[i].area};
  sort_places(m->order, count);
  for (size_t i = 0; i < count; i++)
    CS_TRY(add_shape(m, m->order[i].region, out));
  return CELSPAN_OK;
}

/* Adds a shape for each region that has a colour, the largest first. Errors: NO_MEMORY, LIMIT. */
static CELSPAN_CHECKED celspan_status make_shapes(celspan_context *context,
                                                  const cs_material *material,
                                                  const cs_regions *regions,
                                                  const cs_borders *borders,
                                                  const cs_curves *curves, celspan_trace *out) {
  maker m = {.context = context,
             .material = material,
             .regions = regions,
             .borders = borders,
             .curves = curves};
  celspan_status status = add_shapes(&m, out);
  CS_ARRAYS_FREE(context->memory, &m, first, order);
  return status;
}

#define SMOOTH_MOST 16

/* ---------------------------------------------------------------- objects */

static celspan_status make_texture(celspan_context *context, const unsigned char code[3],
                                   celspan_texture **out) {
  celspan_paint paint =
      celspan_paint_rgb(cs_transfer_decode(CELSPAN_TRANSFER_SRGB, (float)code[0] / 255.0f),
                        cs_transfer_decode(CELSPAN_TRANSFER_SRGB, (float)code[1] / 255.0f),
                        cs_transfer_decode(CELSPAN_TRANSFER_SRGB, (float)code[2] / 255.0f), 1);
  return celspan_texture_create_paint(context, &paint, out);
}

static celspan_status make_object(celspan_context *context, cs_shape *shape) {
  celspan_texture *texture;
  celspan_status status;
  CS_TRY(make_texture(context, shape->colour, &texture));
  if (shape->data) {
    const celspan_path_desc path = {
        .struct_size = sizeof path, .data = shape->data, .texture = texture};
    status = celspan_object_create_path(context, &path, &shape->object);
  } else {
    celspan_stroke_desc stroke = cs_lines_stroke(shape);
    stroke.texture = texture;
    status = celspan_object_create_stroke(context, &stroke, &shape->object);
  }
  celspan_texture_unref(texture);
  return status;
}

/* The union of all shapes. */
static celspan_status unite(celspan_context *context, celspan_trace *trace) {
  celspan_object **objects;
  CS_TRY(CS_MAKE(context, objects, trace->count + 1));
  for (size_t i = 0; i < trace->count; i++)
    objects[i] = trace->shapes[i].object;
  celspan_status status = celspan_object_create_boolean(context, CELSPAN_OPERATOR_UNION, objects,
                                                        trace->count, &trace->object);
  cs_mem_free(context->memory, objects, (trace->count + 1) * sizeof *objects);
  return status;
}

static celspan_status make_objects(celspan_context *context, celspan_trace *trace) {
  for (size_t i = 0; i < trace->count; i++)
    CS_TRY(make_object(context, &trace->shapes[i]));
  return unite(context, trace);
}

/* ---------------------------------------------------------------- tracing */

static celspan_status outline_regions(celspan_context *context, const celspan_trace_desc *desc,
                                      const cs_material *given, const cs_regions *regions,
                                      celspan_trace *out) {
  cs_material told = *given;
  const cs_material *material = &told;
  told.is_whole = cs_edge_is_whole(given, regions);
  cs_borders borders;
  cs_curves curves = {.list = NULL};
  celspan_status status = cs_borders_make(context, material, regions, &borders);
  if (status == CELSPAN_OK)
    status = cs_curves_make(context, material, &borders, desc->smooth, &curves);
  if (status == CELSPAN_OK)
    status = make_shapes(context, material, regions, &borders, &curves, out);
  cs_curves_finish(&curves, context);
  cs_borders_finish(&borders, context);
  return status;
}

static celspan_status trace_regions(celspan_context *context, const celspan_trace_desc *desc,
                                    const cs_material *material, celspan_trace *out) {
  const cs_region_source source = cs_region_source_of(material, CS_CORNERS_AS_BORDERS);
  cs_regions regions;
  CS_TRY(cs_speckles_drop(context, material, (uint32_t)desc->speckle));
  CS_TRY(cs_regions_make(context, &source, &regions));
  celspan_status status = desc->lines
                              ? cs_lines_make(context, material, &regions, desc->smooth, out)
                              : outline_regions(context, desc, material, &regions, out);
  cs_regions_finish(&regions, context);
  return status;
}

static celspan_status trace_scan(celspan_context *context, const celspan_trace_desc *desc,
                                 const cs_scan *scan, celspan_trace *out) {
  cs_colours colours;
  cs_labels labels;
  out->width = scan->width;
  out->height = scan->height;
  CS_TRY(desc->codes ? cs_colours_take(context, scan, desc->codes, (size_t)desc->colours, &colours)
                     : cs_colours_find(context, scan, (size_t)desc->colours, &colours));
  CS_TRY(cs_labels_make(context, scan, &colours, &labels));
  const cs_material material = {scan, &colours, &labels, false};
  celspan_status status = trace_regions(context, desc, &material, out);
  cs_labels_finish(&labels, context);
  return status;
}

static celspan_status trace_picture(celspan_context *context, const celspan_trace_desc *desc,
                                    celspan_trace *out) {
  cs_picture *picture;
  cs_scan scan;
  CS_TRY(cs_picture_create(context, desc->picture, &picture));
  celspan_status status = cs_scan_read(context, picture, &scan);
  if (status == CELSPAN_OK) {
    status = trace_scan(context, desc, &scan, out);
    cs_scan_finish(&scan, context);
  }
  cs_picture_unref(picture);
  return status;
}

static celspan_status check(celspan_context *context, const celspan_trace_desc *desc) {
  if (desc->colours < 1 || desc->colours > CS_COLOURS_MOST)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "trace: colours must be 1 to %d, got %d",
                   CS_COLOURS_MOST, desc->colours);
  if (!(desc->smooth >= 0 && desc->smooth <= SMOOTH_MOST))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "trace: smooth must be 0 to %d, got %g",
                   SMOOTH_MOST, desc->smooth);
  if (desc->speckle < 0)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "trace: speckle must be 0 or more, got %d",
                   desc->speckle);
  return CELSPAN_OK;
}

celspan_status cs_result_make(celspan_context *context, const celspan_trace_desc *desc,
                              celspan_trace **out) {
  CS_TRY(check(context, desc));
  celspan_trace *trace;
  CS_TRY(CS_COUNTED_MAKE(context, trace));
  celspan_status status = trace_picture(context, desc, trace);
  return CS_GIVE(status, trace, celspan_trace_unref, out);
}

celspan_status celspan_trace_create(celspan_context *context, const celspan_trace_desc *desc,
                                    celspan_trace **out) {
  CS_READ(context, "trace", celspan_trace_desc, desc);
  celspan_trace *trace;
  CS_TRY(cs_result_make(context, desc, &trace));
  celspan_status status = make_objects(context, trace);
  return CS_GIVE(status, trace, celspan_trace_unref, out);
}

/* ---------------------------------------------------------------- facts */

void celspan_trace_size(const celspan_trace *trace, int32_t *width, int32_t *height) {
  *width = trace->width;
  *height = trace->height;
}

celspan_object *celspan_trace_object(const celspan_trace *trace) { return trace->object; }

size_t celspan_trace_shape_count(const celspan_trace *trace) { return trace->count; }

bool celspan_trace_shape_at(const celspan_trace *trace, size_t index, celspan_trace_shape *out) {
  if (index >= trace->count)
    return false;
  const cs_shape *shape = &trace->shapes[index];
  const celspan_trace_shape whole = {
      .object = shape->object,
      .colour = {shape->colour[0], shape->colour[1], shape->colour[2]},
      .area = shape->area,
      .x = shape->x,
      .y = shape->y,
      .data = shape->data,
      .points = shape->points,
      .widths = shape->widths,
      .point_count = shape->point_count,
      .is_closed = shape->is_closed,
  };
  return CS_RESULT(NULL, "trace", celspan_trace_shape, &whole, out) == CELSPAN_OK;
}
