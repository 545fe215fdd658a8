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
 * operands say so (inside.h).
 */
#include <math.h>

#include "base/number.h"
#include "scene/check.h"
#include "scene/inside.h"
#include "scene/oracle.h"

/* One call of celspan_probe: the point of the film that is evaluated. */
typedef struct probe_call {
  celspan_context *context;
  double film_width, film_height;
  celspan_point point;
} probe_call;

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
  *out = cs_inside_own_point(matrix, probe->point, &own) &&
         cs_inside_outline(&data->outline, data->rule, own);
  return *out && data->kind == CS_PRIMITIVE_DATA_SCANLINE
             ? cs_oracle_primitive(probe->context, data, own, out, &unused)
             : CELSPAN_OK;
}

static celspan_status present(const probe_call *probe, const celspan_object *object,
                              const celspan_matrix *parent, bool *out) {
  const cs_primitive_data *data = object->data;
  const celspan_matrix whole = celspan_matrix_then(object->matrix, *parent);
  *out = false;
  if (data->is_empty)
    return CELSPAN_OK;
  if (data->kind != CS_PRIMITIVE_DATA_BOOLEAN)
    return primitive_present(probe, data, &whole, out);
  size_t count = 0;
  bool first = false;
  for (size_t i = 0; i < data->operand_count; i++) {
    bool is_present;
    CS_TRY(present(probe, data->operands[i], &whole, &is_present));
    count += is_present;
    first = first || (i == 0 && is_present);
  }
  *out = cs_inside_is_present(data->op, count, data->operand_count, first);
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
  const celspan_matrix whole = celspan_matrix_then(object->matrix, *parent);
  celspan_point own;
  bool is_there;
  *out = cs_oracle_clear;
  if (data->kind == CS_PRIMITIVE_DATA_BOOLEAN) {
    size_t shown = 0;
    while (shown < data->operand_count && cs_inside_shows(data->op, shown))
      shown++;
    CS_TRY(paint_list(probe, data->operands, shown, &whole, out));
  } else if (cs_inside_own_point(&whole, probe->point, &own)) {
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

/* The light that travels to the camera, and the matte of each channel. */
typedef struct light_ray {
  double light[3], matte[3];
} light_ray;

static void add_back(light_ray *ray, celspan_light back) {
  const double rgb[3] = {(double)back.r, (double)back.g, (double)back.b}, a = (double)back.a;
  for (int c = 0; c < 3; c++) {
    ray->light[c] += rgb[c];
    ray->matte[c] += a - ray->matte[c] * a;
  }
}

static void pass_cel(light_ray *ray, const cs_oracle_paint *shade, celspan_light front) {
  const double rgb[3] = {(double)front.r, (double)front.g, (double)front.b};
  for (int c = 0; c < 3; c++) {
    ray->light[c] = shade->s[c] * rgb[c] + shade->t[c] * ray->light[c];
    ray->matte[c] = 1 - shade->t[c] * (1 - ray->matte[c]);
  }
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

static light_ray light_cels(const celspan_rostrum *rostrum, const cs_oracle_paint *shades,
                            size_t rear) {
  light_ray ray = {{0, 0, 0}, {0, 0, 0}};
  add_back(&ray, cs_scene_back(rostrum, rostrum->back));
  for (size_t i = rear; i < rostrum->cel_count; i++) {
    add_back(&ray, cs_scene_back(rostrum, rostrum->cels[i]->back));
    pass_cel(&ray, &shades[i], cs_scene_front(rostrum, rostrum->cels[i]));
  }
  return ray;
}

static celspan_status add_exposure(const probe_call *probe, const celspan_exposure *exposure,
                                   double rgba[4]) {
  const celspan_rostrum *rostrum = exposure->rostrum;
  cs_memory *memory = probe->context->memory;
  cs_oracle_paint *shades = cs_mem_array(memory, rostrum->cel_count, sizeof *shades);
  if (!shades && rostrum->cel_count > 0)
    return cs_fail_memory(probe->context);
  size_t rear = 0;
  celspan_status status = paint_cels(probe, rostrum, shades, &rear);
  if (status == CELSPAN_OK) {
    light_ray ray = light_cels(rostrum, shades, rear);
    for (int c = 0; c < 3; c++) {
      rgba[c] += exposure->weight * ray.light[c];
      rgba[3] += exposure->weight * ray.matte[c] / 3;
    }
  }
  cs_mem_free(memory, shades, rostrum->cel_count * sizeof *shades);
  return status;
}

/* ---------------------------------------------------------------- checking */

static celspan_status check(celspan_context *context, const celspan_exposure *exposures,
                            size_t exposure_count, double film_width, double film_height,
                            celspan_point point) {
  if (exposure_count > 0)
    CS_TRY(cs_check_given(context, "probe", "exposures", exposures));
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
