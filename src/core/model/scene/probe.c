/* The oracle: the colour of one point of a frame, by direct evaluation of the scene. There is no
 * sweep and there are no spans; arithmetic is in doubles except where the scene stores floats.
 *
 *   camera     light 0, through 1
 *       |
 *   [ cel 1 ] <-- front F      light += through S F, through *= T     S, T: the paint of the cel at
 *       |    back light B      light += through B                           the point
 *       v
 *   [ cel 0 ] <-- front F
 *       |    back light B
 *       v
 *   rear light                 light += through B
 *
 * The paint of a cel is that of its objects over each other; a boolean object is present where its
 * operands say so (inside.h). Where an object is a rostrum, its own film is evaluated in the same
 * way, and what arrives at its camera is its paint. A light with a shape is its texture at the
 * point. A displaced cel is evaluated at the point that it shows there; blurs are left out. Where a
 * cel or an object has a mode, all that is behind it is seen by itself first.
 */
#include <math.h>

#include "base/description.h"
#include "base/number.h"
#include "model/geometry/matrix.h"
#include "model/scene/check.h"
#include "model/scene/inside.h"
#include "model/scene/oracle.h"
#include "model/scene/pattern.h"
#include "model/scene/shift.h"
#include "model/scene/texture_fit.h"

/* The point that is evaluated, and the film that it belongs to: the film of the call, or the film
 * of a rostrum that is an object. */
typedef struct probe_call {
  celspan_context *context;
  double film_width, film_height;
  celspan_point point;
  celspan_space space; /* the space of all numbers */
} probe_call;

/* The light at the point. */
typedef struct light_sample {
  double rgb[3], matte;
} light_sample;

static const light_sample white = {{1, 1, 1}, 1};

/* ---------------------------------------------------------------- objects */

static celspan_status present(const probe_call *probe, const celspan_object *object,
                              const celspan_matrix *parent, bool *out);

/* A procedure is present where it has spans. The test also makes the procedure's paint, which is
 * not used here. */
static celspan_status primitive_present(const probe_call *probe, const cs_primitive_data *data,
                                        const celspan_matrix *matrix, bool *out) {
  celspan_point own;
  cs_oracle_paint unused;
  *out = cs_inside_own_point(matrix, probe->point, &own) && cs_inside_primitive(data, own);
  return *out && data->kind == CS_PRIMITIVE_DATA_SCANLINE
             ? cs_oracle_primitive(probe->context, data, own, probe->space, out, &unused)
             : CELSPAN_OK;
}

static celspan_status present(const probe_call *probe, const celspan_object *object,
                              const celspan_matrix *parent, bool *out) {
  const cs_primitive_data *data = object->data;
  const celspan_matrix whole = celspan_matrix_then(*object->matrix, *parent);
  *out = false;
  if (data->is_empty)
    return CELSPAN_OK;
  if (data->kind != CS_PRIMITIVE_DATA_BOOLEAN)
    return primitive_present(probe, data, &whole, out);
  size_t count = 0;
  bool first = false;
  for (size_t i = 0; i < data->boolean->operand_count; i++) {
    bool is_present;
    CS_TRY(present(probe, data->boolean->operands[i], &whole, &is_present));
    count += is_present;
    first = first || (i == 0 && is_present);
  }
  *out = cs_inside_is_present(data->boolean->op, count, data->boolean->operand_count, first);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- places */

/* A place in an isolating group, on the way from the camera to the rear: in a list of objects, or
 * in a rostrum. Behind its last item the way continues in the list around it, unless this isolates.
 *
 *     rostrum, rear first   0          1             2       3             4
 *                           its back   back light    cel 1   back light    cel 2
 *                           light      of cel 1              of cel 2
 */
typedef struct place place;
struct place {
  const place *around; /* NULL: nothing around it can be seen from here */
  const probe_call *probe;
  const celspan_rostrum *rostrum; /* NULL: the place is in a list of objects */
  celspan_object *const *objects; /* the objects of a list */
  size_t left;           /* objects of a list, or places of a rostrum, that have not been met yet */
  celspan_matrix matrix; /* for a list: from its units to film units */
  light_sample front;    /* for a list: the light that falls on it */
};

/* Adds everything that can be seen behind a place. */
static celspan_status see(place at, cs_oracle_sight *seen);

static bool is_hidden(const cs_oracle_sight *seen) {
  return seen->through[0] == 0 && seen->through[1] == 0 && seen->through[2] == 0;
}

/* Adds a part of the picture; if a mode needs it, everything behind the place, too. */
static celspan_status add_part(place *at, celspan_blend mode, const cs_oracle_sight *part,
                               cs_oracle_sight *seen) {
  if (mode == CELSPAN_BLEND_NORMAL) {
    *seen = cs_oracle_before(seen, part);
    return CELSPAN_OK;
  }
  cs_oracle_sight back = cs_oracle_nothing;
  CS_TRY(see(*at, &back));
  back = cs_oracle_blend(mode, part, &back);
  *seen = cs_oracle_before(seen, &back);
  at->around = NULL;
  at->left = 0;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- objects seen by themselves */

static celspan_status see_list(const probe_call *probe, celspan_object *const *objects,
                               size_t count, const celspan_matrix *matrix,
                               const light_sample *front, cs_oracle_sight *out) {
  *out = cs_oracle_nothing;
  return see(
      (place){
          .probe = probe, .objects = objects, .left = count, .matrix = *matrix, .front = *front},
      out);
}

static celspan_status see_rostrum(const probe_call *probe, const celspan_rostrum *rostrum,
                                  cs_oracle_sight *out) {
  *out = cs_oracle_nothing;
  return see((place){.probe = probe, .rostrum = rostrum, .left = 2 * rostrum->cel_count + 1}, out);
}

/* The sight by itself where the strength and its alpha are more than 1, else nothing. */
static cs_oracle_sight dissolve(double strength, const cs_oracle_sight *sight) {
  double alpha = cs_oracle_alpha(sight);
  cs_oracle_sight whole = {.keep = 1};
  if (strength + alpha <= 1)
    return cs_oracle_nothing;
  for (int c = 0; c < 3; c++)
    whole.light[c] = sight->light[c] / alpha;
  return whole;
}

/* The strength of a matte comes from the second operand, which is not drawn. */
static celspan_status see_matte(const probe_call *probe, const cs_boolean *boolean,
                                const celspan_matrix *matrix, const light_sample *front,
                                cs_oracle_sight *out) {
  cs_oracle_sight by;
  CS_TRY(see_list(probe, boolean->operands, 1, matrix, front, out));
  CS_TRY(see_list(probe, boolean->operands + 1, 1, matrix, &white, &by));
  double luma = 0.2126 * by.light[0] + 0.7152 * by.light[1] + 0.0722 * by.light[2];
  double m = cs_number_clamp(boolean->is_luma ? luma : cs_oracle_alpha(&by), 0, 1);
  m = boolean->inverts ? 1 - m : m;
  *out = boolean->dissolves ? dissolve(m, out) : cs_oracle_fade(out, m);
  return CELSPAN_OK;
}

/* How many operands of a boolean are painted; the others only decide where it is present. */
static size_t count_shown(const cs_boolean *boolean) {
  size_t shown = 0;
  while (shown < boolean->operand_count && cs_inside_shows(boolean->op, shown))
    shown++;
  return shown;
}

static void light_paint(const cs_oracle_paint *paint, const light_sample *front,
                        cs_oracle_sight *out) {
  for (int c = 0; c < 3; c++) {
    out->light[c] = paint->s[c] * front->rgb[c];
    out->through[c] = paint->t[c];
  }
}

/* Handles a colour that is composited as a whole in another space: grades it, converts it to the
 * space of the probe, and lights it. */
static void light_whole(const probe_call *probe, celspan_space space, const celspan_grade *grade,
                        const light_sample *front, cs_oracle_sight *sight) {
  if (grade)
    cs_oracle_grade(grade, space, sight);
  if (space != probe->space)
    *sight = cs_oracle_leave(probe->space, sight);
  for (int c = 0; c < 3; c++)
    sight->light[c] *= front->rgb[c];
}

/* A union with a grade, or in a space of its own. */
static celspan_status see_developed(const probe_call *probe, const cs_boolean *boolean,
                                    const celspan_matrix *whole, const light_sample *front,
                                    cs_oracle_sight *out) {
  probe_call inner = *probe;
  inner.space = cs_boolean_space(boolean, probe->space);
  CS_TRY(see_list(&inner, boolean->operands, count_shown(boolean), whole, &white, out));
  light_whole(probe, inner.space, boolean->grade, front, out);
  return CELSPAN_OK;
}

/* A composition inside another one: the light that it sends, and its matte. */
static celspan_status see_nested(const probe_call *probe, const celspan_rostrum *rostrum,
                                 celspan_point own, const light_sample *front,
                                 cs_oracle_sight *out) {
  const probe_call inner = {probe->context, rostrum->width, rostrum->height, own,
                            cs_space_inside(rostrum->space, probe->space)};
  CS_TRY(see_rostrum(&inner, rostrum, out));
  for (int c = 0; c < 3; c++)
    out->through[c] *= out->keep;
  out->keep = 1;
  light_whole(probe, inner.space, rostrum->grade, front, out);
  return CELSPAN_OK;
}

/* An object that is present at the point, without its fade. whole: its matrix to film units. */
static celspan_status see_data(const probe_call *probe, const cs_primitive_data *data,
                               const celspan_matrix *whole, const light_sample *front,
                               cs_oracle_sight *out) {
  celspan_point own;
  bool is_there;
  cs_oracle_paint paint = cs_oracle_clear;
  if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN && data->boolean->op == CS_OPERATOR_MATTE)
    return see_matte(probe, data->boolean, whole, front, out);
  if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN && cs_boolean_develops(data->boolean, probe->space))
    return see_developed(probe, data->boolean, whole, front, out);
  if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN)
    return see_list(probe, data->boolean->operands, count_shown(data->boolean), whole, front, out);
  if (!cs_inside_own_point(whole, probe->point, &own))
    return CELSPAN_OK;
  if (data->repeat)
    own = cs_pattern_fold(data->repeat, own);
  if (data->kind == CS_PRIMITIVE_DATA_ROSTRUM)
    return see_nested(probe, data->rostrum, own, front, out);
  CS_TRY(cs_oracle_primitive(probe->context, data, own, probe->space, &is_there, &paint));
  light_paint(&paint, front, out);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- objects in their place */

/* An object that is present: its own look; if modes inside it act on its backdrop, everything that
 * is seen behind its operands, too. */
static celspan_status see_object(place *at, const celspan_object *object, cs_oracle_sight *seen) {
  const cs_primitive_data *data = object->data;
  const celspan_matrix whole = celspan_matrix_then(*object->matrix, at->matrix);
  const celspan_blend mode = cs_object_mode(object);
  cs_oracle_sight part = cs_oracle_nothing;
  if (mode == CELSPAN_BLEND_NORMAL && cs_object_blends(object, at->probe->space)) {
    const place around = *at;
    at->left = 0;
    at->around = NULL;
    return see((place){.around = &around,
                       .probe = at->probe,
                       .objects = data->boolean->operands,
                       .left = count_shown(data->boolean),
                       .matrix = whole,
                       .front = at->front},
               seen);
  }
  CS_TRY(see_data(at->probe, data, &whole, &at->front, &part));
  part = cs_oracle_fade(&part, object->fade);
  return add_part(at, mode, &part, seen);
}

/* ---------------------------------------------------------------- the stack */

/* A light that is a texture. matrix: its units to film units. Outside a picture it is dark. */
static celspan_status sample_texture(const probe_call *probe, const cs_light *light,
                                     const celspan_matrix *matrix, light_sample *out) {
  const celspan_texture *texture = light->texture;
  const celspan_box film = {0, 0, probe->film_width, probe->film_height};
  const celspan_matrix whole = cs_texture_fit_light(texture, matrix, film.width, film.height);
  celspan_point own;
  cs_oracle_paint shade;
  *out = (light_sample){{0, 0, 0}, 0};
  if (!cs_inside_own_point(&whole, probe->point, &own))
    return CELSPAN_OK;
  if (texture->kind == CS_TEXTURE_PICTURE && !texture->variation->has_box &&
      texture->variation->wrap == CELSPAN_WRAP_CLEAR &&
      !(own.x >= 0 && own.x < film.width && own.y >= 0 && own.y < film.height))
    return CELSPAN_OK;
  CS_TRY(cs_oracle_texture(probe->context, texture, &film, own, probe->space, &shade));
  out->matte = light->matte * shade.beta;
  for (int c = 0; c < 3; c++)
    out->rgb[c] = light->gain * shade.s[c];
  return CELSPAN_OK;
}

/* index: of the cel that the light belongs to. */
static celspan_status sample_light(const probe_call *probe, const celspan_rostrum *rostrum,
                                   size_t index, const cs_light *light, light_sample *out) {
  const celspan_light flat = cs_light_in(light, probe->space);
  *out = (light_sample){{(double)flat.r, (double)flat.g, (double)flat.b}, (double)flat.a};
  if (!light->texture)
    return CELSPAN_OK;
  celspan_matrix matrix = cs_scene_camera(rostrum, probe->film_width, probe->film_height);
  if (light->on == CELSPAN_LIGHT_ON_CEL)
    CS_TRY(cs_scene_cel_matrix(probe->context, rostrum, index, probe->film_width,
                               probe->film_height, &matrix));
  return sample_texture(probe, light, &matrix, out);
}

/* index: of the cel that the light belongs to. */
static celspan_status see_back(const probe_call *probe, const celspan_rostrum *rostrum,
                               size_t index, const cs_light *light, cs_oracle_sight *seen) {
  const cs_light back = cs_scene_back(rostrum, light);
  light_sample sample;
  CS_TRY(sample_light(probe, rostrum, index, &back, &sample));
  for (int c = 0; c < 3; c++)
    seen->light[c] += seen->through[c] * sample.rgb[c];
  seen->keep *= 1 - sample.matte;
  return CELSPAN_OK;
}

/* One channel of a sight without its alpha, in a space. */
static double channel_of(const probe_call *probe, const cs_oracle_sight *seen,
                         celspan_channel channel, celspan_space space) {
  double alpha = cs_oracle_alpha(seen);
  if (channel == CELSPAN_CHANNEL_ALPHA || !(alpha > 0))
    return alpha;
  double light = seen->light[channel];
  if (space != probe->space)
    light = cs_oracle_convert(space, light, alpha);
  return cs_number_clamp(light / alpha, 0, 1);
}

/* A displaced cel shows another point. matrix: from its units to film units. *is_there: false where
 * that point is beyond the horizon. */
static celspan_status displace(const probe_call *probe, const cs_shift *shift,
                               const celspan_matrix *matrix, bool *is_there, probe_call *out) {
  cs_oracle_sight by;
  celspan_point own;
  *out = *probe;
  *is_there = true;
  CS_TRY(see_list(probe, shift->by->objects, 1, matrix, &white, &by));
  const bool is_clear = !(cs_oracle_alpha(&by) > 0);
  if ((is_clear && !shift->moves_clear) || !cs_inside_own_point(matrix, probe->point, &own))
    return CELSPAN_OK;
  own.x += shift->scale * (channel_of(probe, &by, shift->channels[0], shift->space) - 0.5);
  own.y += shift->scale * (channel_of(probe, &by, shift->channels[1], shift->space) - 0.5);
  celspan_matrix facing = cs_matrix_facing(matrix);
  cs_hpoint p = cs_matrix_apply(&facing, (cs_hpoint){own.x, own.y, 1});
  *is_there = p.w > 0;
  if (*is_there)
    out->point = (celspan_point){p.x / p.w, p.y / p.w};
  return CELSPAN_OK;
}

static celspan_status see_cel(place *at, size_t index, cs_oracle_sight *seen) {
  const probe_call *probe = at->probe;
  const celspan_cel *cel = at->rostrum->cels[index];
  const cs_light front = cs_scene_front(at->rostrum, cel);
  const place around = *at;
  place objects = {.probe = probe, .objects = cel->objects, .left = cel->object_count};
  cs_oracle_sight part = cs_oracle_nothing;
  CS_TRY(cs_scene_cel_matrix(probe->context, at->rostrum, index, probe->film_width,
                             probe->film_height, &objects.matrix));
  CS_TRY(sample_light(probe, at->rostrum, index, &front, &objects.front));
  probe_call moved;
  if (cel->shift && cel->shift->by) {
    bool is_there;
    CS_TRY(displace(probe, cel->shift, &objects.matrix, &is_there, &moved));
    objects.probe = &moved;
    objects.left = is_there ? objects.left : 0;
  }
  if (cs_cel_blends(cel, probe->space) && cel->blend == CELSPAN_BLEND_NORMAL) {
    objects.around = &around;
    at->left = 0;
    return see(objects, seen);
  }
  CS_TRY(see(objects, &part));
  if (cel->grade)
    cs_oracle_grade(cel->grade, probe->space, &part);
  part = cs_oracle_fade(&part, cel->opacity);
  return add_part(at, cel->blend, &part, seen);
}

/* The next thing behind the place. */
static celspan_status see_next(place *at, cs_oracle_sight *seen) {
  size_t next = --at->left;
  bool is_present;
  if (!at->rostrum) {
    CS_TRY(present(at->probe, at->objects[next], &at->matrix, &is_present));
    return is_present ? see_object(at, at->objects[next], seen) : CELSPAN_OK;
  }
  if (next == 0)
    return see_back(at->probe, at->rostrum, 0, &at->rostrum->back, seen);
  size_t index = (next - 1) / 2;
  const cs_light *back = &at->rostrum->cels[index]->back;
  return next % 2 == 1 ? see_back(at->probe, at->rostrum, index, back, seen)
                       : see_cel(at, index, seen);
}

/* Hidden layers are not evaluated. */
static celspan_status see(place at, cs_oracle_sight *seen) {
  while ((at.left > 0 || at.around) && !is_hidden(seen)) {
    if (at.left > 0)
      CS_TRY(see_next(&at, seen));
    else
      at = *at.around;
  }
  return CELSPAN_OK;
}

/* What is seen of the rostrum of an exposure. probe: of the film. */
static celspan_status see_whole(const probe_call *probe, celspan_rostrum *rostrum,
                                cs_oracle_sight *seen) {
  probe_call inner = *probe;
  inner.space = cs_space_inside(rostrum->space, probe->space);
  CS_TRY(see_rostrum(&inner, rostrum, seen));
  light_whole(probe, inner.space, rostrum->grade, &white, seen);
  return CELSPAN_OK;
}

/* Adds the light of an exposure. */
static celspan_status add_exposure(const probe_call *probe, const celspan_exposure *exposure,
                                   double rgba[4]) {
  cs_oracle_sight seen;
  celspan_rostrum *shown;
  CS_TRY(cs_rostrum_shown(probe->context, exposure->rostrum, probe->film_width, probe->film_height,
                          0, probe->space, &shown));
  celspan_status status = see_whole(probe, shown, &seen);
  celspan_rostrum_unref(shown);
  CS_TRY(status);
  double alpha = cs_oracle_alpha(&seen);
  for (int c = 0; c < 3; c++)
    rgba[c] +=
        exposure->weight * (probe->space == CELSPAN_SPACE_SRGB
                                ? cs_oracle_convert(CELSPAN_SPACE_LINEAR, seen.light[c], alpha)
                                : seen.light[c]);
  rgba[3] += exposure->weight * alpha;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- checking */

static celspan_status check(celspan_context *context, const celspan_frame_desc *desc,
                            celspan_point point) {
  CS_TRY(cs_check_list(context, "probe", "exposures", desc->exposures, desc->exposure_count,
                       CS_CHECK_ITEMS));
  for (size_t i = 0; i < desc->exposure_count; i++) {
    CS_TRY(cs_check_item(context, (cs_check_field){"probe", "exposures", i + 1, "weight"},
                         desc->exposures[i].weight, 0, CS_NUMBER_LIMIT));
    if (!desc->exposures[i].rostrum)
      return cs_fail(context, CELSPAN_BAD_ARGUMENT, "probe: exposures[%zu].rostrum is missing",
                     i + 1);
  }
  CS_TRY(cs_check_positive(context, "probe", "film width", desc->film_width));
  CS_TRY(cs_check_positive(context, "probe", "film height", desc->film_height));
  CS_TRY(cs_check_choice(context, "probe", "space", (unsigned)desc->space, CELSPAN_SPACE_SRGB + 1));
  return cs_check_point(context, "probe", "point", 0, point);
}

celspan_status celspan_probe(celspan_context *context, const celspan_frame_desc *desc,
                             celspan_point point, double rgba[4]) {
  CS_READ(context, "probe", celspan_frame_desc, desc);
  CS_TRY(check(context, desc, point));
  const probe_call probe = {context, desc->film_width, desc->film_height, point,
                            cs_space_inside(desc->space, CELSPAN_SPACE_LINEAR)};
  double sum[4] = {0, 0, 0, 0};
  for (size_t i = 0; i < desc->exposure_count; i++)
    CS_TRY(add_exposure(&probe, &desc->exposures[i], sum));
  for (int c = 0; c < 4; c++)
    rgba[c] = c < 3 ? sum[c] : fmin(sum[c], 1);
  return CELSPAN_OK;
}
