#include "scene.h"

#include <stdlib.h>
#include <string.h>

#include "frames/render/ways.h"
#include "measure.h"

void bench_check(celspan_context *context, celspan_status status) {
  if (status != CELSPAN_OK)
    bench_stop("%s", celspan_context_error(context));
}

/* Codes are used as linear light without conversion. */
static celspan_paint make_paint(bench_colour colour) {
  return celspan_paint_rgb((float)(colour.red / 255.0), (float)(colour.green / 255.0),
                           (float)(colour.blue / 255.0), (float)(colour.alpha / 255.0));
}

static celspan_texture *make_texture(celspan_context *context, const bench_shape *shape) {
  celspan_paint paint = make_paint(shape->colour);
  celspan_texture *texture;
  if (shape->is_gradient) {
    const celspan_stop stops[] = {{0, paint}, {1, make_paint(shape->far_colour)}};
    bench_check(context,
                celspan_texture_create_linear(context, (celspan_point){shape->x0, 0},
                                              (celspan_point){shape->x1, 0}, stops, 2, &texture));
  } else
    bench_check(context, celspan_texture_create_paint(context, &paint, &texture));
  return texture;
}

static celspan_object *make_shape(celspan_context *context, const bench_shape *shape) {
  celspan_rule rule = shape->is_evenodd ? CELSPAN_RULE_EVENODD : CELSPAN_RULE_NONZERO;
  celspan_texture *texture = make_texture(context, shape);
  celspan_object *object;
  if (shape->is_spline) {
    celspan_point points[4];
    for (int i = 0; i < 4; i++)
      points[i] = (celspan_point){shape->spline[i].x, shape->spline[i].y};
    celspan_nurbs_desc desc = {.struct_size = sizeof desc,
                               .points = points,
                               .point_count = 4,
                               .degree = 3,
                               .rule = rule,
                               .texture = texture};
    bench_check(context, celspan_object_create_nurbs(context, &desc, &object));
  } else {
    celspan_path_desc desc = {
        .struct_size = sizeof desc, .data = shape->data, .rule = rule, .texture = texture};
    bench_check(context, celspan_object_create_path(context, &desc, &object));
  }
  celspan_texture_unref(texture);
  return object;
}

celspan_rostrum *bench_rostrum(celspan_context *context, celspan_cel *const *cels, size_t count,
                               bool is_backed) {
  celspan_rostrum *rostrum;
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.cels = cels;
  desc.cel_count = count;
  if (is_backed)
    desc.back = (celspan_light){1, 1, 1, 1};
  bench_check(context, celspan_rostrum_create(context, &desc, &rostrum));
  return rostrum;
}

celspan_rostrum *bench_rostrum_of(celspan_context *context, const celspan_cel_desc *desc,
                                  bool is_backed) {
  celspan_cel *cel;
  bench_check(context, celspan_cel_create(context, desc, &cel));
  celspan_rostrum *rostrum = bench_rostrum(context, &cel, 1, is_backed);
  celspan_cel_unref(cel);
  return rostrum;
}

/* All shapes of a drawing; the list and its objects are the caller's. */
static celspan_object **make_shapes(celspan_context *context, const bench_drawing *drawing) {
  celspan_object **objects = calloc(drawing->shape_count, sizeof *objects);
  for (size_t i = 0; i < drawing->shape_count; i++)
    objects[i] = make_shape(context, &drawing->shapes[i]);
  return objects;
}

static void free_shapes(celspan_object **objects, size_t count) {
  for (size_t i = 0; i < count; i++)
    celspan_object_unref(objects[i]);
  free(objects);
}

celspan_object *bench_union(celspan_context *context, const bench_drawing *drawing) {
  celspan_object **objects = make_shapes(context, drawing), *whole;
  bench_check(context, celspan_object_create_boolean(context, CELSPAN_OPERATOR_UNION, objects,
                                                     drawing->shape_count, &whole));
  free_shapes(objects, drawing->shape_count);
  return whole;
}

celspan_cel *bench_cel(celspan_context *context, const bench_drawing *drawing,
                       const celspan_cel_desc *desc) {
  celspan_object **objects = make_shapes(context, drawing);
  celspan_cel_desc whole = desc ? *desc : CELSPAN_CEL_DESC;
  celspan_cel *cel;
  whole.objects = objects;
  whole.object_count = drawing->shape_count;
  bench_check(context, celspan_cel_create(context, &whole, &cel));
  free_shapes(objects, drawing->shape_count);
  return cel;
}

celspan_rostrum *bench_scene(celspan_context *context, const bench_drawing *drawing,
                             const celspan_cel_desc *desc) {
  celspan_cel *cel = bench_cel(context, drawing, desc);
  celspan_rostrum *rostrum = bench_rostrum(context, &cel, 1, true);
  celspan_cel_unref(cel);
  return rostrum;
}

void bench_choose_way(celspan_context *context, celspan_frame_desc *desc, const char *way) {
  static const struct {
    const char *name;
    cs_ways_forced forced;
    bool repeats, keeps;
  } ways[] = {
      {"area", CS_WAYS_BY_RULE, false, false}, {"swept", CS_WAYS_SWEPT, false, false},
      {"first", CS_WAYS_BY_RULE, true, false}, {"mapped", CS_WAYS_MAPPED, true, false},
      {"again", CS_WAYS_BY_RULE, true, true},  {"mapped-again", CS_WAYS_MAPPED, true, true}};
  size_t i = sizeof ways / sizeof *ways;
  while (i > 0 && strcmp(ways[--i].name, way) != 0)
    ;
  context->root->forced_way = ways[i].forced;
  desc->repeats = ways[i].repeats;
  context->root->held_bytes = 0; /* what is drawn again is drawn, and not copied as a whole */
  if (!ways[i].keeps)
    context->root->map_bytes = 0;
}

celspan_frame_desc bench_frame(const celspan_exposure *exposure, int width, int height,
                               const celspan_antialias_mode *mode) {
  celspan_frame_desc desc = CELSPAN_FRAME_DESC;
  desc.exposures = exposure;
  desc.exposure_count = 1;
  desc.film_width = desc.film_height = 1;
  desc.width = width;
  desc.height = height;
  desc.has_antialias = mode != NULL;
  desc.antialias = mode ? *mode : CELSPAN_ANTIALIAS_AREA;
  desc.workers = 1;
  return desc;
}
