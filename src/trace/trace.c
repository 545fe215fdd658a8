/* Tracing, from the picture to its shapes:
 *
 *   picture --scan--> codes --colours--> a few --labels--> one a pixel --speckles--> fewer
 *     --regions, borders--> graph --curves--> lines and cubics --shapes--> paths, objects
 *                              \--lines--> centre lines and widths --> strokes
 */
#include "trace/borders.h"
#include "trace/curves.h"
#include "trace/lines.h"
#include "trace/shapes.h"
#include "trace/speckles.h"

#define SHAPES_MOST 1048576
#define SMOOTH_MOST 16

/* ---------------------------------------------------------------- life */

void cs_result_finish_shape(cs_memory *memory, cs_shape *shape) {
  celspan_object_unref(shape->object);
  cs_mem_free(memory, shape->data, shape->data_size);
  cs_mem_free(memory, shape->points, shape->point_count * sizeof *shape->points);
  cs_mem_free(memory, shape->widths, shape->point_count * sizeof *shape->widths);
}

celspan_status cs_result_add(celspan_context *context, celspan_trace *trace,
                             const cs_shape *shape) {
  celspan_status status =
      trace->count < SHAPES_MOST
          ? cs_mem_reserve(context, (void **)&trace->shapes, &trace->capacity, trace->count + 1,
                           sizeof *trace->shapes)
          : cs_fail(context, CELSPAN_LIMIT,
                    "trace: there are more than %d shapes, which is the limit; ask for fewer "
                    "colours, or drop larger speckles",
                    SHAPES_MOST);
  if (status == CELSPAN_OK) {
    trace->shapes[trace->count++] = *shape;
  } else {
    cs_shape dropped = *shape;
    cs_result_finish_shape(trace->memory, &dropped);
  }
  return status;
}

celspan_trace *celspan_trace_ref(celspan_trace *trace) {
  atomic_fetch_add_explicit(&trace->references, 1, memory_order_relaxed);
  return trace;
}

void celspan_trace_unref(celspan_trace *trace) {
  if (!trace || atomic_fetch_sub_explicit(&trace->references, 1, memory_order_acq_rel) != 1)
    return;
  cs_memory *memory = trace->memory;
  for (size_t i = 0; i < trace->count; i++)
    cs_result_finish_shape(memory, &trace->shapes[i]);
  cs_mem_free(memory, trace->shapes, trace->capacity * sizeof *trace->shapes);
  celspan_object_unref(trace->object);
  cs_mem_free(memory, trace, sizeof *trace);
  cs_memory_unref(memory);
}

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
    const celspan_path_desc path = {.data = shape->data, .texture = texture};
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
  celspan_object **objects = cs_mem_array(context->memory, trace->count + 1, sizeof *objects);
  if (!objects)
    return cs_fail_memory(context);
  for (size_t i = 0; i < trace->count; i++)
    objects[i] = trace->shapes[i].object;
  celspan_status status =
      celspan_object_create_boolean(context, CELSPAN_UNION, objects, trace->count, &trace->object);
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
    status = cs_shapes_make(context, material, regions, &borders, &curves, out);
  cs_curves_finish(&curves, context);
  cs_borders_finish(&borders, context);
  return status;
}

static celspan_status trace_regions(celspan_context *context, const celspan_trace_desc *desc,
                                    const cs_material *material, celspan_trace *out) {
  cs_regions regions;
  CS_TRY(cs_speckles_drop(context, material, (uint32_t)desc->speckle));
  CS_TRY(cs_regions_make(context, material, CS_CORNERS_AS_BORDERS, &regions));
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
  CS_TRY(cs_picture_create(context, &desc->picture, &picture));
  celspan_status status = cs_scan_read(context, picture, &scan);
  if (status == CELSPAN_OK) {
    status = trace_scan(context, desc, &scan, out);
    cs_scan_finish(&scan, context);
  }
  cs_picture_unref(picture);
  return status;
}

static celspan_status check(celspan_context *context, const celspan_trace_desc *desc) {
  if (desc->struct_size != sizeof *desc)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "trace: struct_size is not that of the header");
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
  celspan_trace *trace = cs_mem_array(context->memory, 1, sizeof *trace);
  if (!trace)
    return cs_fail_memory(context);
  trace->references = 1;
  trace->memory = cs_memory_ref(context->memory);
  celspan_status status = trace_picture(context, desc, trace);
  if (status == CELSPAN_OK)
    *out = trace;
  else
    celspan_trace_unref(trace);
  return status;
}

celspan_status celspan_trace_create(celspan_context *context, const celspan_trace_desc *desc,
                                    celspan_trace **out) {
  celspan_trace *trace;
  CS_TRY(cs_result_make(context, desc, &trace));
  celspan_status status = make_objects(context, trace);
  if (status == CELSPAN_OK)
    *out = trace;
  else
    celspan_trace_unref(trace);
  return status;
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
  *out = (celspan_trace_shape){
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
  return true;
}
