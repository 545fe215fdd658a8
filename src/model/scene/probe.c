/* The oracle: the colour of one point of a frame, by direct evaluation of the scene. There is no
 * sweep and there are no spans; arithmetic is in doubles except where the scene stores floats.
 *
 *   rear light                 L = its light
 *       |    back light B      L = L + B
 *       v
 *   [ cel 0 ] <-- front F      L = S F + T L         S, T: the paint of the cel at the point
 *       |    back light B      L = L + B
 *       v
 *   [ cel 1 ] <-- front F      L = S F + T L
 *       :
 *       v
 *     camera                   the sum of L over the exposures, by their weights
 *
 * The paint of a cel is that of its objects over each other; a boolean object is present where its
 * operands say so (inside.h). Where an object is a rostrum, its own film is evaluated in the same
 * way, and L and the matte that arrive at its camera are its paint. A light with a shape is its
 * texture at the point.
 */
#include <math.h>

#include "base/number.h"
#include "model/scene/check.h"
#include "model/scene/inside.h"
#include "model/scene/oracle.h"

/* The point that is evaluated, and the film it belongs to: that of the call, or that of a rostrum
 * which is an object. */
typedef struct probe_call {
  celspan_context *context;
  double film_width, film_height;
  celspan_point point;
} probe_call;

/* The light that travels to the camera, and the matte of each channel. */
typedef struct light_ray {
  double light[3], matte[3];
} light_ray;

/* ---------------------------------------------------------------- objects */

static celspan_status present(const probe_call *probe, const celspan_object *object,
                              const celspan_matrix *parent, bool *out);
static celspan_status paint(const probe_call *probe, const celspan_object *object,
                            const celspan_matrix *parent, cs_oracle_paint *out);

/* A procedure is present where it has spans. Finding that out also makes its paint, which is not
 * used here. */
static celspan_status primitive_present(const probe_call *probe, const cs_primitive_data *data,
                                        const celspan_matrix *matrix, bool *out) {
  celspan_point own;
  cs_oracle_paint unused;
  *out = cs_inside_own_point(matrix, probe->point, &own) && cs_inside_primitive(data, own);
  return *out && data->kind == CS_PRIMITIVE_DATA_SCANLINE
             ? cs_oracle_primitive(probe->context, data, own, out, &unused)
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

/* What a rostrum shows at a point of its own film: defined below. */
static celspan_status shown(const probe_call *probe, const celspan_rostrum *rostrum,
                            light_ray *out);

/* The paint of a composition inside another one: the light that it sends, and its matte. */
static celspan_status paint_rostrum(const probe_call *probe, const celspan_rostrum *rostrum,
                                    celspan_point own, cs_oracle_paint *out) {
  const probe_call inner = {probe->context, rostrum->width, rostrum->height, own};
  light_ray ray;
  CS_TRY(shown(&inner, rostrum, &ray));
  out->beta = 1;
  for (int c = 0; c < 3; c++) {
    out->s[c] = ray.light[c];
    out->t[c] = 1 - ray.matte[c];
    out->beta = fmin(out->beta, ray.matte[c]);
  }
  return CELSPAN_OK;
}

/* The objects of a list over each other; later ones are nearer. Hidden ones are not evaluated. */
static celspan_status paint_list(const probe_call *probe, celspan_object *const *objects,
                                 size_t count, const celspan_matrix *matrix, cs_oracle_paint *out) {
  *out = cs_oracle_clear;
  for (size_t i = count; i-- > 0 && !cs_oracle_hides(out);) {
    bool is_present;
    cs_oracle_paint shade;
    CS_TRY(present(probe, objects[i], matrix, &is_present));
    if (!is_present)
      continue;
    CS_TRY(paint(probe, objects[i], matrix, &shade));
    *out = cs_oracle_over(out, &shade);
  }
  return CELSPAN_OK;
}

/* The paint of an object that is present at the point. */
static celspan_status paint(const probe_call *probe, const celspan_object *object,
                            const celspan_matrix *parent, cs_oracle_paint *out) {
  const cs_primitive_data *data = object->data;
  const celspan_matrix whole = celspan_matrix_then(*object->matrix, *parent);
  celspan_point own;
  bool is_there;
  *out = cs_oracle_clear;
  if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN) {
    size_t shown = 0;
    while (shown < data->boolean->operand_count && cs_inside_shows(data->boolean->op, shown))
      shown++;
    CS_TRY(paint_list(probe, data->boolean->operands, shown, &whole, out));
  } else if (!cs_inside_own_point(&whole, probe->point, &own)) {
    return CELSPAN_OK;
  } else if (data->kind == CS_PRIMITIVE_DATA_ROSTRUM) {
    CS_TRY(paint_rostrum(probe, data->rostrum, own, out));
  } else {
    CS_TRY(cs_oracle_primitive(probe->context, data, own, &is_there, out));
  }
  *out = cs_oracle_mix(&cs_oracle_clear, out, object->fade);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the stack */

static celspan_status paint_cel(const probe_call *probe, const celspan_rostrum *rostrum,
                                size_t index, cs_oracle_paint *out) {
  const celspan_cel *cel = rostrum->cels[index];
  celspan_matrix matrix;
  CS_TRY(cs_scene_cel_matrix(probe->context, rostrum, index, probe->film_width, probe->film_height,
                             &matrix));
  CS_TRY(paint_list(probe, cel->objects, cel->object_count, &matrix, out));
  *out = cs_oracle_mix(&cs_oracle_clear, out, cel->opacity);
  return CELSPAN_OK;
}

/* What a light is at the point. */
typedef struct light_sample {
  double rgb[3], matte;
} light_sample;

/* A light that is a texture. matrix: its units to film units. Outside a picture it is dark. */
static celspan_status sample_texture(const probe_call *probe, const cs_light *light,
                                     const celspan_matrix *matrix, light_sample *out) {
  const celspan_texture *texture = light->texture;
  const celspan_box film = {0, 0, probe->film_width, probe->film_height};
  celspan_point own;
  cs_oracle_paint shade;
  *out = (light_sample){{0, 0, 0}, 0};
  if (!cs_inside_own_point(matrix, probe->point, &own))
    return CELSPAN_OK;
  if (texture->kind == CS_TEXTURE_PICTURE && !texture->variation->has_box &&
      texture->variation->wrap == CELSPAN_WRAP_CLEAR &&
      !(own.x >= 0 && own.x < film.width && own.y >= 0 && own.y < film.height))
    return CELSPAN_OK;
  CS_TRY(cs_oracle_texture(probe->context, texture, &film, own, &shade));
  out->matte = light->matte * shade.beta;
  for (int c = 0; c < 3; c++)
    out->rgb[c] = light->gain * shade.s[c];
  return CELSPAN_OK;
}

/* index: of the cel that the light belongs to. */
static celspan_status sample_light(const probe_call *probe, const celspan_rostrum *rostrum,
                                   size_t index, const cs_light *light, light_sample *out) {
  const celspan_light *flat = &light->flat;
  *out = (light_sample){{(double)flat->r, (double)flat->g, (double)flat->b}, (double)flat->a};
  if (!light->texture)
    return CELSPAN_OK;
  celspan_matrix matrix = cs_scene_camera(rostrum, probe->film_width, probe->film_height);
  if (light->on == CELSPAN_LIGHT_ON_CEL)
    CS_TRY(cs_scene_cel_matrix(probe->context, rostrum, index, probe->film_width,
                               probe->film_height, &matrix));
  return sample_texture(probe, light, &matrix, out);
}

static celspan_status add_back(const probe_call *probe, const celspan_rostrum *rostrum,
                               size_t index, const cs_light *light, light_ray *ray) {
  const cs_light back = cs_scene_back(rostrum, light);
  light_sample sample;
  CS_TRY(sample_light(probe, rostrum, index, &back, &sample));
  for (int c = 0; c < 3; c++) {
    ray->light[c] += sample.rgb[c];
    ray->matte[c] += sample.matte - ray->matte[c] * sample.matte;
  }
  return CELSPAN_OK;
}

static celspan_status pass_cel(const probe_call *probe, const celspan_rostrum *rostrum,
                               size_t index, const cs_oracle_paint *shade, light_ray *ray) {
  const cs_light front = cs_scene_front(rostrum, rostrum->cels[index]);
  light_sample sample;
  CS_TRY(sample_light(probe, rostrum, index, &front, &sample));
  for (int c = 0; c < 3; c++) {
    ray->light[c] = shade->s[c] * sample.rgb[c] + shade->t[c] * ray->light[c];
    ray->matte[c] = 1 - shade->t[c] * (1 - ray->matte[c]);
  }
  return CELSPAN_OK;
}

/* shades: gets the paints of the cels. *rear: the rearmost cel that is not hidden. */
static celspan_status paint_cels(const probe_call *probe, const celspan_rostrum *rostrum,
                                 cs_oracle_paint *shades, size_t *rear) {
  cs_oracle_paint all = cs_oracle_clear;
  size_t index = rostrum->cel_count;
  while (index > 0 && !cs_oracle_hides(&all)) {
    index--;
    CS_TRY(paint_cel(probe, rostrum, index, &shades[index]));
    all = cs_oracle_over(&all, &shades[index]);
  }
  *rear = index;
  return CELSPAN_OK;
}

static celspan_status light_cels(const probe_call *probe, const celspan_rostrum *rostrum,
                                 const cs_oracle_paint *shades, size_t rear, light_ray *out) {
  *out = (light_ray){{0, 0, 0}, {0, 0, 0}};
  CS_TRY(add_back(probe, rostrum, 0, &rostrum->back, out));
  for (size_t i = rear; i < rostrum->cel_count; i++) {
    CS_TRY(add_back(probe, rostrum, i, &rostrum->cels[i]->back, out));
    CS_TRY(pass_cel(probe, rostrum, i, &shades[i], out));
  }
  return CELSPAN_OK;
}

static celspan_status shown(const probe_call *probe, const celspan_rostrum *rostrum,
                            light_ray *out) {
  cs_memory *memory = probe->context->memory;
  cs_oracle_paint *shades = cs_mem_array(memory, rostrum->cel_count, sizeof *shades);
  if (!shades && rostrum->cel_count > 0)
    return cs_fail_memory(probe->context);
  size_t rear = 0;
  celspan_status status = paint_cels(probe, rostrum, shades, &rear);
  if (status == CELSPAN_OK)
    status = light_cels(probe, rostrum, shades, rear, out);
  cs_mem_free(memory, shades, rostrum->cel_count * sizeof *shades);
  return status;
}

static celspan_status add_exposure(const probe_call *probe, const celspan_exposure *exposure,
                                   double rgba[4]) {
  light_ray ray;
  CS_TRY(shown(probe, exposure->rostrum, &ray));
  for (int c = 0; c < 3; c++) {
    rgba[c] += exposure->weight * ray.light[c];
    rgba[3] += exposure->weight * ray.matte[c] / 3;
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- checking */

static celspan_status check(celspan_context *context, const celspan_exposure *exposures,
                            size_t exposure_count, double film_width, double film_height,
                            celspan_point point) {
  CS_TRY(cs_check_list(context, "probe", "exposures", exposures, exposure_count, CS_CHECK_ITEMS));
  for (size_t i = 0; i < exposure_count; i++) {
    CS_TRY(cs_check_item(context, (cs_check_field){"probe", "exposures", i + 1, "weight"},
                         exposures[i].weight, 0, CS_NUMBER_LIMIT));
    if (!exposures[i].rostrum)
      return cs_fail(context, CELSPAN_BAD_ARGUMENT, "probe: exposures[%zu].rostrum is missing",
                     i + 1);
  }
  CS_TRY(cs_check_positive(context, "probe", "film width", film_width));
  CS_TRY(cs_check_positive(context, "probe", "film height", film_height));
  return cs_check_point(context, "probe", "point", 0, point);
}

celspan_status celspan_probe(celspan_context *context, const celspan_exposure *exposures,
                             size_t exposure_count, double film_width, double film_height,
                             celspan_point point, double rgba[4]) {
  CS_TRY(check(context, exposures, exposure_count, film_width, film_height, point));
  const probe_call probe = {context, film_width, film_height, point};
  double sum[4] = {0, 0, 0, 0};
  for (size_t i = 0; i < exposure_count; i++)
    CS_TRY(add_exposure(&probe, &exposures[i], sum));
  for (int c = 0; c < 4; c++)
    rgba[c] = c < 3 ? sum[c] : fmin(sum[c], 1);
  return CELSPAN_OK;
}
