/* Gradients as textures. */
#include <math.h>

#include "base/elementary.h"
#include "model/scene/check.h"
#include "model/scene/texture.h"

/* Twice the area of a triangle below this share of its longest side squared is rounding. */
#define FLAT_TRIANGLE 1e-12
/* A focus lies inside its circle: at most so far from the centre, as a share of the radius. */
#define FOCUS_SHARE 0.9999

#define TURN 6.283185307179586

static double square(double x) { return x * x; }

static double distance_squared(celspan_point a, celspan_point b) {
  return square(a.x - b.x) + square(a.y - b.y);
}

static bool triangle_is_flat(const celspan_point p[3]) {
  double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
  double longest = distance_squared(p[0], p[1]);
  longest = fmax(longest, distance_squared(p[1], p[2]));
  longest = fmax(longest, distance_squared(p[2], p[0]));
  return fabs(area) <= FLAT_TRIANGLE * longest;
}

celspan_status celspan_texture_create_gradient(celspan_context *context,
                                               const celspan_point points[3],
                                               const celspan_paint paints[3],
                                               celspan_texture **out) {
  CS_TRY(cs_check_given(context, "gradient", "points", points));
  CS_TRY(cs_check_given(context, "gradient", "paints", paints));
  for (size_t i = 0; i < 3; i++) {
    CS_TRY(cs_check_point(context, "gradient", "points", i + 1, points[i]));
    CS_TRY(cs_check_paint(context, "gradient", "paints", i + 1, &paints[i]));
  }
  if (triangle_is_flat(points))
    return cs_texture_create_flat(context, &paints[2], out);
  celspan_texture *texture = NULL;
  CS_TRY(cs_texture_create_kind(context, CS_TEXTURE_TRIANGLE, &texture));
  for (int i = 0; i < 3; i++) {
    cs_texture_own(texture)->points[i] = points[i];
    cs_texture_own(texture)->corners[i] = cs_paint_from_straight(&paints[i]);
  }
  return cs_texture_finish(texture, out);
}

static celspan_status check_stops(celspan_context *context, const char *noun,
                                  const celspan_stop *stops, size_t count) {
  if (!stops || count == 0)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s: there is no stop; it needs one or more",
                   noun);
  CS_TRY(cs_check_list(context, noun, "stops", stops, count, CS_CHECK_ITEMS));
  for (size_t i = 0; i < count; i++) {
    CS_TRY(cs_check_item(context, (cs_check_field){noun, "stops", i + 1, "at"}, stops[i].at, 0, 1));
    if (i > 0 && stops[i].at < stops[i - 1].at)
      return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                     "%s: stops[%zu].at is %s, less than %s of the stop before; stops must ascend",
                     noun, i + 1, cs_check_number_text(stops[i].at).text,
                     cs_check_number_text(stops[i - 1].at).text);
    CS_TRY(cs_check_paint(context, noun, "stops", i + 1, &stops[i].paint));
  }
  return CELSPAN_OK;
}

celspan_status cs_texture_create_stops(celspan_context *context, const char *noun,
                                       cs_texture_kind kind, const celspan_stop *stops,
                                       size_t count, bool is_degenerate, celspan_texture **out) {
  CS_TRY(check_stops(context, noun, stops, count));
  if (is_degenerate || count == 1)
    return cs_texture_create_flat(context, &stops[count - 1].paint, out);
  celspan_texture *texture = NULL;
  CS_TRY(cs_texture_create_kind(context, kind, &texture));
  cs_texture_variation *variation = cs_texture_own(texture);
  variation->stops = cs_mem_array(context->memory, count, sizeof *variation->stops);
  if (!variation->stops) {
    celspan_texture_unref(texture);
    return cs_fail_memory(context);
  }
  variation->stop_count = count;
  for (size_t i = 0; i < count; i++)
    variation->stops[i] = (cs_stop){stops[i].at, cs_paint_from_straight(&stops[i].paint)};
  *out = texture;
  return CELSPAN_OK;
}

celspan_status celspan_texture_create_linear(celspan_context *context, celspan_point from,
                                             celspan_point to, const celspan_stop *stops,
                                             size_t stop_count, celspan_texture **out) {
  CS_TRY(cs_check_point(context, "linear", "from", 0, from));
  CS_TRY(cs_check_point(context, "linear", "to", 0, to));
  celspan_texture *texture = NULL;
  CS_TRY(cs_texture_create_stops(context, "linear", CS_TEXTURE_LINEAR, stops, stop_count,
                                 !(distance_squared(from, to) > 0), &texture));
  if (texture->kind == CS_TEXTURE_LINEAR) {
    cs_texture_own(texture)->points[0] = from;
    cs_texture_own(texture)->points[1] = to;
  }
  return cs_texture_finish(texture, out);
}

/* The vector from the centre to the focus, limited to the inside of the circle. */
static celspan_point focus_offset(celspan_point centre, double radius, celspan_point focus) {
  celspan_point offset = {focus.x - centre.x, focus.y - centre.y};
  double distance = sqrt(square(offset.x) + square(offset.y)), most = FOCUS_SHARE * radius;
  double share = distance > most ? most / distance : 1;
  return (celspan_point){share * offset.x, share * offset.y};
}

celspan_status celspan_texture_create_radial(celspan_context *context, celspan_point centre,
                                             double radius, const celspan_stop *stops,
                                             size_t stop_count, celspan_texture **out) {
  return celspan_texture_create_focal(context, centre, radius, centre, stops, stop_count, out);
}

celspan_status celspan_texture_create_focal(celspan_context *context, celspan_point centre,
                                            double radius, celspan_point focus,
                                            const celspan_stop *stops, size_t stop_count,
                                            celspan_texture **out) {
  CS_TRY(cs_check_point(context, "radial", "centre", 0, centre));
  CS_TRY(cs_check_size(context, "radial", "radius", radius));
  CS_TRY(cs_check_point(context, "radial", "focus", 0, focus));
  celspan_texture *texture = NULL;
  CS_TRY(cs_texture_create_stops(context, "radial", CS_TEXTURE_RADIAL, stops, stop_count,
                                 !(radius > 0), &texture));
  if (texture->kind == CS_TEXTURE_RADIAL) {
    cs_texture_variation *variation = cs_texture_own(texture);
    variation->points[0] = centre;
    variation->points[1] = focus_offset(centre, radius, focus);
    variation->radius = radius;
  }
  return cs_texture_finish(texture, out);
}

celspan_status celspan_texture_create_conic(celspan_context *context, celspan_point centre,
                                            double radians, const celspan_stop *stops,
                                            size_t stop_count, celspan_texture **out) {
  CS_TRY(cs_check_point(context, "conic", "centre", 0, centre));
  CS_TRY(cs_check_number(context, "conic", "angle", radians));
  celspan_texture *texture = NULL;
  CS_TRY(cs_texture_create_stops(context, "conic", CS_TEXTURE_CONIC, stops, stop_count, false,
                                 &texture));
  if (texture->kind == CS_TEXTURE_CONIC) {
    cs_texture_variation *variation = cs_texture_own(texture);
    double sine, cosine;
    cs_elementary_sincos(fmod(radians, TURN), &sine, &cosine);
    variation->points[0] = centre;
    variation->points[1] = (celspan_point){sine, -cosine};
  }
  return cs_texture_finish(texture, out);
}
