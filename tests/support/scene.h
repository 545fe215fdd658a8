/* Scenes in few words, for tests: everything made is kept in a list and released at the end; a
 * failure is a failed check. */
#pragma once

#include "celspan/celspan.h"
#include "tests/support/check.h"

#define STUDIO_CAPACITY 512

/* The collection in which a test builds its scene. */
typedef struct studio {
  celspan_context *context;
  celspan_object *objects[STUDIO_CAPACITY];
  celspan_texture *textures[STUDIO_CAPACITY];
  celspan_cel *cels[STUDIO_CAPACITY];
  celspan_rostrum *rostrums[STUDIO_CAPACITY];
  size_t object_count, texture_count, cel_count, rostrum_count;
} studio;

static inline void studio_finish(studio *s) {
  while (s->rostrum_count > 0)
    celspan_rostrum_unref(s->rostrums[--s->rostrum_count]);
  while (s->cel_count > 0)
    celspan_cel_unref(s->cels[--s->cel_count]);
  while (s->object_count > 0)
    celspan_object_unref(s->objects[--s->object_count]);
  while (s->texture_count > 0)
    celspan_texture_unref(s->textures[--s->texture_count]);
}

static inline void studio_check(studio *s, celspan_status status) {
  if (!CHECK(status == CELSPAN_OK))
    fprintf(stderr, "  %s\n", celspan_context_error(s->context));
}

/* Adds the result of a call to the studio and returns it: NULL after a failed check. */
#define STUDIO_TAKE(s, list, count, type, call)                                                    \
  type *made = NULL;                                                                               \
  studio_check(s, call);                                                                           \
  if (made)                                                                                        \
    s->list[s->count++] = made;                                                                    \
  return made

static inline celspan_texture *studio_paint(studio *s, celspan_paint paint) {
  STUDIO_TAKE(s, textures, texture_count, celspan_texture,
              celspan_texture_create_paint(s->context, &paint, &made));
}

static inline celspan_texture *studio_linear(studio *s, celspan_point from, celspan_point to,
                                             const celspan_stop *stops, size_t count) {
  STUDIO_TAKE(s, textures, texture_count, celspan_texture,
              celspan_texture_create_linear(s->context, from, to, stops, count, &made));
}

static inline celspan_texture *studio_radial(studio *s, celspan_point centre, double radius,
                                             const celspan_stop *stops, size_t count) {
  STUDIO_TAKE(s, textures, texture_count, celspan_texture,
              celspan_texture_create_radial(s->context, centre, radius, stops, count, &made));
}

static inline celspan_texture *studio_focal(studio *s, celspan_point centre, double radius,
                                            celspan_point focus, const celspan_stop *stops,
                                            size_t count) {
  STUDIO_TAKE(s, textures, texture_count, celspan_texture,
              celspan_texture_create_focal(s->context, centre, radius, focus, stops, count, &made));
}

static inline celspan_texture *studio_conic(studio *s, celspan_point centre, double angle,
                                            const celspan_stop *stops, size_t count) {
  STUDIO_TAKE(s, textures, texture_count, celspan_texture,
              celspan_texture_create_conic(s->context, centre, angle, stops, count, &made));
}

static inline celspan_texture *studio_gradient(studio *s, const celspan_point points[3],
                                               const celspan_paint paints[3]) {
  STUDIO_TAKE(s, textures, texture_count, celspan_texture,
              celspan_texture_create_gradient(s->context, points, paints, &made));
}

static inline celspan_object *studio_rect(studio *s, double x, double y, double width,
                                          double height, celspan_texture *texture) {
  celspan_rect_desc desc = {sizeof desc, x, y, width, height, 0, texture};
  STUDIO_TAKE(s, objects, object_count, celspan_object,
              celspan_object_create_rect(s->context, &desc, &made));
}

static inline celspan_object *studio_circle(studio *s, double x, double y, double radius,
                                            celspan_texture *texture) {
  celspan_ellipse_desc desc = {sizeof desc, {x, y}, radius, radius, texture};
  STUDIO_TAKE(s, objects, object_count, celspan_object,
              celspan_object_create_ellipse(s->context, &desc, &made));
}

static inline celspan_object *studio_polygon(studio *s, const celspan_point *points, size_t count,
                                             celspan_rule rule, celspan_texture *texture) {
  celspan_polygon_desc desc = {sizeof desc, points, count, rule, texture};
  STUDIO_TAKE(s, objects, object_count, celspan_object,
              celspan_object_create_polygon(s->context, &desc, &made));
}

static inline celspan_object *studio_path(studio *s, const char *data, celspan_texture *texture) {
  const celspan_path_desc desc = {.struct_size = sizeof desc, .data = data, .texture = texture};
  STUDIO_TAKE(s, objects, object_count, celspan_object,
              celspan_object_create_path(s->context, &desc, &made));
}

static inline celspan_object *studio_scanline(studio *s, const celspan_scanline_desc *desc) {
  STUDIO_TAKE(s, objects, object_count, celspan_object,
              celspan_object_create_scanline(s->context, desc, &made));
}

static inline celspan_object *studio_boolean(studio *s, celspan_operator op,
                                             celspan_object *const *operands, size_t count) {
  STUDIO_TAKE(s, objects, object_count, celspan_object,
              celspan_object_create_boolean(s->context, op, operands, count, &made));
}

static inline celspan_object *studio_pair(studio *s, celspan_operator op, celspan_object *a,
                                          celspan_object *b) {
  celspan_object *const operands[] = {a, b};
  return studio_boolean(s, op, operands, 2);
}

static inline celspan_object *studio_transform(studio *s, celspan_object *object,
                                               celspan_matrix matrix) {
  STUDIO_TAKE(s, objects, object_count, celspan_object,
              celspan_object_transform(s->context, object, &matrix, &made));
}

static inline celspan_object *studio_group(studio *s, const celspan_group_desc *desc) {
  STUDIO_TAKE(s, objects, object_count, celspan_object,
              celspan_object_create_group(s->context, desc, &made));
}

static inline celspan_object *studio_fade(studio *s, celspan_object *object, double k) {
  STUDIO_TAKE(s, objects, object_count, celspan_object,
              celspan_object_fade(s->context, object, k, &made));
}

static inline celspan_cel *studio_cel(studio *s, celspan_cel_desc desc,
                                      celspan_object *const *objects, size_t count) {
  desc.objects = objects;
  desc.object_count = count;
  STUDIO_TAKE(s, cels, cel_count, celspan_cel, celspan_cel_create(s->context, &desc, &made));
}

static inline celspan_rostrum *studio_rostrum(studio *s, celspan_rostrum_desc desc,
                                              celspan_cel *const *cels, size_t count) {
  desc.cels = cels;
  desc.cel_count = count;
  STUDIO_TAKE(s, rostrums, rostrum_count, celspan_rostrum,
              celspan_rostrum_create(s->context, &desc, &made));
}

/* One cel of one object, everything else at its default. */
static inline celspan_rostrum *studio_show(studio *s, celspan_object *object) {
  celspan_cel *cel = studio_cel(s, CELSPAN_CEL_DESC, &object, 1);
  return studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cel, 1);
}

#undef STUDIO_TAKE

/* A frame as large as the film, of exposures that the caller keeps; mode: NULL for the
 * default. Everything else at its default. */
static inline celspan_frame_desc studio_frame(const celspan_exposure *exposures, size_t count,
                                              int32_t width, int32_t height,
                                              const celspan_antialias_mode *mode) {
  celspan_frame_desc desc = CELSPAN_FRAME_DESC;
  desc.exposures = exposures;
  desc.exposure_count = count;
  desc.width = width;
  desc.height = height;
  desc.has_antialias = mode != NULL;
  desc.antialias = mode ? *mode : CELSPAN_ANTIALIAS_AREA;
  return desc;
}
