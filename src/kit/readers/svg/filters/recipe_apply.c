/* Applying recipes: each step makes an object of earlier ones, in a table of makers. */
#include <math.h>

#include "inside/context.h"
#include "inside/scene.h"
#include "readers/svg/document/objects.h"
#include "readers/svg/document/recipe.h"
#include "readers/svg/document/shapes.h"

/* Terms of a sum. */
#define TERMS (4 * CS_SVG_SUM_MOST)

/* ---------------------------------------------------------------- objects */

/* A recipe that is being applied, and the current step. An object that is NULL draws nothing. */
typedef struct applying {
  celspan_context *context;
  const cs_svg_recipe *recipe;
  const cs_svg_step *step;
  celspan_object **results; /* the results of the sources and the steps so far */
} applying;

static celspan_object *input(const applying *a, size_t index) {
  return a->results[a->recipe->inputs[a->step->first_input + index]];
}

static celspan_object *kept(celspan_object *object) {
  return object ? celspan_object_ref(object) : NULL;
}

static celspan_status convert(const applying *a, celspan_space space, celspan_object **object) {
  celspan_object *made = NULL;
  celspan_status status = cs_object_in_space(a->context, *object, space, &made);
  return cs_svg_object_replace(status, made, object);
}

/* Objects on top of each other, composited as a group in the step's space. */
static celspan_status unite(const applying *a, celspan_object *const *objects, size_t count,
                            celspan_object **out) {
  celspan_group_desc desc = CELSPAN_GROUP_DESC;
  desc.objects = objects;
  desc.object_count = count;
  desc.isolate = CELSPAN_ISOLATION_ON;
  desc.space = a->step->space;
  *out = count == 1 ? celspan_object_ref(objects[0]) : NULL;
  return count > 1 ? celspan_object_create_group(a->context, &desc, out) : CELSPAN_OK;
}

/* `front` in a mode over `back`; either may be NULL. */
static celspan_status blend(const applying *a, celspan_object *back, celspan_object *front,
                            celspan_blend mode, celspan_object **out) {
  celspan_object *both[2] = {back, NULL};
  if (!back || !front) {
    *out = kept(back ? back : front);
    return CELSPAN_OK;
  }
  CS_TRY(celspan_object_blend(a->context, front, mode, &both[1]));
  celspan_status status = unite(a, both, 2, out);
  celspan_object_unref(both[1]);
  return status;
}

static bool is_within(const celspan_box *inner, const celspan_box *outer) {
  return inner->x >= outer->x && inner->y >= outer->y &&
         inner->x + inner->width <= outer->x + outer->width &&
         inner->y + inner->height <= outer->y + outer->height;
}

/* Cuts off everything outside of a box. */
static celspan_status cut(const applying *a, const celspan_box *box, celspan_object **object) {
  const celspan_matrix identity = celspan_matrix_identity();
  celspan_object *both[2] = {*object, NULL}, *made = NULL;
  celspan_box bounds;
  bool is_there = false;
  if (*object)
    CS_TRY(cs_bounds_object(a->context, *object, &is_there, &bounds));
  if (!is_there || (is_within(&bounds, box) && box->width > 0 && box->height > 0))
    return CELSPAN_OK;
  if (!(box->width > 0) || !(box->height > 0))
    return cs_svg_object_replace(CELSPAN_OK, NULL, object);
  CS_TRY(cs_svg_rectangle(a->context, box, &identity, &both[1]));
  celspan_status status =
      celspan_object_create_boolean(a->context, CELSPAN_OPERATOR_CLIP, both, 2, &made);
  celspan_object_unref(both[1]);
  return cs_svg_object_replace(status, made, object);
}

/* ---------------------------------------------------------------- steps of compositing */

static celspan_status make_merge(const applying *a, celspan_object **out) {
  celspan_object **objects;
  size_t count = 0, most = a->step->input_count;
  CS_TRY(CS_MAKE(a->context, objects, most));
  for (size_t i = 0; i < most; i++)
    if (input(a, i))
      objects[count++] = input(a, i);
  celspan_status status = unite(a, objects, count, out);
  cs_mem_free(a->context->memory, objects, most * sizeof(celspan_object *));
  return status;
}

static celspan_status make_blend(const applying *a, celspan_object **out) {
  return blend(a, input(a, 1), input(a, 0), a->step->blend, out);
}

static celspan_status make_in(const applying *a, celspan_object **out) {
  return cs_svg_object_mask(a->context, input(a, 0), input(a, 1), false, out);
}

static celspan_status make_out(const applying *a, celspan_object **out) {
  return cs_svg_object_mask(a->context, input(a, 0), input(a, 1), true, out);
}

/* The two parts do not overlap, so they are added. */
static celspan_status make_both(const applying *a, bool inverts, celspan_object **out) {
  celspan_object *front, *back = NULL;
  CS_TRY(cs_svg_object_mask(a->context, input(a, 0), input(a, 1), inverts, &front));
  celspan_status status = cs_svg_object_mask(a->context, input(a, 1), input(a, 0), true, &back);
  if (status == CELSPAN_OK)
    status = blend(a, back, front, CELSPAN_BLEND_ADD, out);
  celspan_object_unref(front);
  celspan_object_unref(back);
  return status;
}

static celspan_status make_atop(const applying *a, celspan_object **out) {
  return make_both(a, false, out);
}

static celspan_status make_xor(const applying *a, celspan_object **out) {
  return make_both(a, true, out);
}

/* Appends an object times a weight: as many times as the whole part of the weight, and once more,
 * faded, for the rest. */
static celspan_status add_terms(const applying *a, celspan_object *object, double weight,
                                celspan_object **terms, size_t *count) {
  for (; object && weight > 0; weight--) {
    celspan_object *faded, *added = NULL;
    CS_TRY(celspan_object_fade(a->context, object, fmin(weight, 1), &faded));
    celspan_status status = celspan_object_blend(
        a->context, faded, *count > 0 ? CELSPAN_BLEND_ADD : CELSPAN_BLEND_NORMAL, &added);
    celspan_object_unref(faded);
    CS_TRY(status);
    terms[(*count)++] = added;
  }
  return CELSPAN_OK;
}

/* An object in the colours of the step's grade, faded by its opacity. */
static celspan_status grade(const applying *a, celspan_object *object, celspan_object **out) {
  celspan_group_desc desc = CELSPAN_GROUP_DESC;
  desc.objects = &object;
  desc.object_count = 1;
  desc.space = a->step->space;
  desc.grade = a->step->grade;
  desc.opacity = a->step->opacity;
  return object ? celspan_object_create_group(a->context, &desc, out) : CELSPAN_OK;
}

/* The product of the inputs; one of them is a flood. */
static celspan_status multiply(const applying *a, celspan_object **out) {
  celspan_object *other = NULL;
  if (!(a->step->weights[3] > 0))
    return CELSPAN_OK;
  CS_TRY(grade(a, input(a, !a->step->flood), &other));
  celspan_status status =
      cs_svg_object_mask(a->context, other, input(a, (size_t)a->step->flood), false, out);
  celspan_object_unref(other);
  return status;
}

static celspan_status make_sum(const applying *a, celspan_object **out) {
  const celspan_paint white = celspan_paint_rgb(1, 1, 1, 1);
  celspan_object *terms[TERMS], *ground, *product = NULL;
  size_t count = 0;
  CS_TRY(cs_svg_object_flood(a->context, &a->step->box, &white, &ground));
  celspan_status status = multiply(a, &product);
  celspan_object *const parts[4] = {input(a, 0), input(a, 1), ground, product};
  for (int i = 0; i < 4 && status == CELSPAN_OK; i++)
    status = add_terms(a, parts[i], a->step->weights[i], terms, &count);
  if (status == CELSPAN_OK)
    status = unite(a, terms, count, out);
  celspan_object_unref(ground);
  celspan_object_unref(product);
  while (count > 0)
    celspan_object_unref(terms[--count]);
  return status;
}

/* ---------------------------------------------------------------- steps of one input */

/* Changes an object, or nothing, by the step's rule. */
static celspan_status change(const applying *a, celspan_object **object) {
  celspan_object *made = NULL;
  celspan_status status =
      cs_nearby_object_create(a->context, *object, a->step->nearby, &a->step->box, &made);
  CS_TRY(cs_svg_object_replace(status, made, object));
  return convert(a, a->step->space, object);
}

static celspan_status make_colour(const applying *a, celspan_object **out) {
  CS_TRY(grade(a, input(a, 0), out));
  return a->step->nearby ? change(a, out) : CELSPAN_OK;
}

static celspan_status make_luma(const applying *a, celspan_object **out) {
  const celspan_paint black = celspan_paint_rgb(0, 0, 0, 1);
  celspan_object *by = kept(input(a, 0)), *ground = NULL, *light = NULL;
  if (!by)
    return CELSPAN_OK;
  celspan_status status = convert(a, a->step->space, &by);
  if (status == CELSPAN_OK)
    status = cs_svg_object_silhouette(a->context, by, &black, &ground);
  if (status == CELSPAN_OK && ground) {
    status = celspan_object_create_matte(a->context, ground, by, CELSPAN_MATTE_LUMA, false, &light);
    celspan_object_unref(ground);
  }
  celspan_object_unref(by);
  *out = light;
  return status;
}

static celspan_status move(const applying *a, celspan_object **object) {
  const celspan_matrix matrix = celspan_matrix_translation(a->step->offset.x, a->step->offset.y);
  return *object ? cs_svg_object_move(a->context, &matrix, object) : CELSPAN_OK;
}

static celspan_status make_offset(const applying *a, celspan_object **out) {
  *out = kept(input(a, 0));
  return move(a, out);
}

static celspan_status blur(const applying *a, celspan_object **object) {
  const celspan_point *radius = &a->step->radius;
  if (!*object || !(fmax(radius->x, radius->y) > 0))
    return CELSPAN_OK;
  CS_TRY(cs_svg_object_blur(a->context, radius, CELSPAN_DEFOCUS_GAUSSIAN, object));
  return convert(a, a->step->space, object);
}

static celspan_status make_blur(const applying *a, celspan_object **out) {
  *out = kept(input(a, 0));
  return blur(a, out);
}

static celspan_status make_shadow(const applying *a, celspan_object **out) {
  celspan_object *shadow = NULL;
  celspan_status status =
      cs_svg_object_silhouette(a->context, input(a, 0), &a->step->paint, &shadow);
  if (status == CELSPAN_OK)
    status = blur(a, &shadow);
  if (status == CELSPAN_OK)
    status = move(a, &shadow);
  if (status == CELSPAN_OK)
    status = blend(a, shadow, input(a, 0), CELSPAN_BLEND_NORMAL, out);
  celspan_object_unref(shadow);
  return status;
}

/* The channels are in the step's space, and clear is black. */
static celspan_status make_displaced(const applying *a, celspan_object **out) {
  const cs_svg_step *step = a->step;
  celspan_displace_desc desc = CELSPAN_DISPLACE_DESC;
  celspan_object *object = input(a, 0), *nothing = NULL;
  if (!object || fabs(step->scale) > CELSPAN_BLUR_MOST)
    return CELSPAN_OK;
  if (!input(a, 1))
    CS_TRY(celspan_object_create_boolean(a->context, CELSPAN_OPERATOR_UNION, NULL, 0, &nothing));
  desc.by = nothing ? nothing : input(a, 1);
  desc.x = step->channels[0];
  desc.y = step->channels[1];
  desc.scale = step->scale;
  desc.space = step->space;
  celspan_status status = cs_displace_object(a->context, object, &desc, true, out);
  celspan_object_unref(nothing);
  return status;
}

/* The tile of the input in all of a box. */
static celspan_status repeat(const applying *a, const celspan_box *box, celspan_object **out) {
  celspan_pattern_desc desc = CELSPAN_PATTERN_DESC;
  celspan_texture *texture;
  desc.art = input(a, 0);
  desc.box = a->step->tile;
  if (!desc.art || !(desc.box.width > 0) || !(desc.box.height > 0))
    return CELSPAN_OK;
  CS_TRY(celspan_texture_create_pattern(a->context, &desc, &texture));
  celspan_status status = cs_svg_object_fill(a->context, box, texture, out);
  celspan_texture_unref(texture);
  return status;
}

static celspan_status make_tile(const applying *a, celspan_object **out) {
  return repeat(a, &a->step->box, out);
}

static celspan_status make_nearby(const applying *a, celspan_object **out) {
  const cs_svg_step *step = a->step;
  const celspan_box *box = &step->box;
  const double x = step->nearby->size[0], y = step->nearby->size[1];
  const celspan_box around = {box->x - x, box->y - y, box->width + 2 * x, box->height + 2 * y};
  if (step->tile.width > 0)
    CS_TRY(repeat(a, &around, out));
  else
    *out = kept(input(a, 0));
  return change(a, out);
}

/* ---------------------------------------------------------------- morphology */

/* feMorphology of an input of one colour, which is the step's paint: the points around which the
 * rectangle of two radii contains some of the input, or nothing but the input.
 *
 *     input --> light of 1 where it is --> mean of the rectangle --> much brighter --> matte
 *
 * INVARIANT: a rectangle counts as touched when the input fills 1/256 of it.
 */

/* How many times brighter a mean is made, so that every trace of light counts. */
#define ALL_THERE 256

/* *object as a group with `factor` times its light. */
static celspan_status brighten(celspan_context *context, double factor, celspan_object **object) {
  celspan_grade_desc fields = CELSPAN_GRADE_DESC;
  celspan_object *made = NULL;
  fields.has_matrix = true;
  for (int c = 0; c < 3; c++)
    fields.matrix[c][c] = factor;
  celspan_status status = cs_object_graded(context, *object, &fields, &made);
  return cs_svg_object_replace(status, made, object);
}

/* The paint in a box, where there is light, or where it is dark. */
static celspan_status paint_by(celspan_context *context, const celspan_box *box,
                               const celspan_paint *paint, celspan_object *light, bool inverts,
                               celspan_object **out) {
  celspan_object *ground;
  CS_TRY(cs_svg_object_flood(context, box, paint, &ground));
  celspan_status status =
      celspan_object_create_matte(context, ground, light, CELSPAN_MATTE_LUMA, inverts, out);
  celspan_object_unref(ground);
  return status;
}

/* Light of 1 in a box: where the input is, or for shrinking, where the input is not. */
static celspan_status light_up(const applying *a, const celspan_box *box, celspan_object **out) {
  const cs_svg_step *step = a->step;
  const celspan_paint white = celspan_paint_rgb(1, 1, 1, 1);
  celspan_object *light;
  CS_TRY(cs_svg_object_silhouette(a->context, input(a, 0), &white, &light));
  celspan_status status = brighten(a->context, 1 / (double)step->paint.beta, &light);
  if (status == CELSPAN_OK)
    status = paint_by(a->context, box, &white, light, step->kind == CS_SVG_STEP_SHRINK, out);
  celspan_object_unref(light);
  return status;
}

static celspan_status paint_near(const applying *a, const celspan_box *box, celspan_object **out) {
  const cs_svg_step *step = a->step;
  celspan_object *light = NULL;
  CS_TRY(light_up(a, box, &light));
  celspan_status status =
      cs_svg_object_blur(a->context, &step->radius, CELSPAN_DEFOCUS_BOX, &light);
  if (status == CELSPAN_OK)
    status = brighten(a->context, ALL_THERE, &light);
  if (status == CELSPAN_OK)
    status = paint_by(a->context, box, &step->paint, light, step->kind == CS_SVG_STEP_SHRINK, out);
  celspan_object_unref(light);
  return status;
}

static celspan_status make_morphology(const applying *a, celspan_object **out) {
  const cs_svg_step *step = a->step;
  const double x = fmin(step->radius.x, CELSPAN_BLUR_MOST),
               y = fmin(step->radius.y, CELSPAN_BLUR_MOST);
  celspan_box box;
  bool is_there = false;
  if (input(a, 0))
    CS_TRY(cs_bounds_object(a->context, input(a, 0), &is_there, &box));
  if (!is_there || !(fmax(x, y) > 0)) {
    *out = kept(input(a, 0));
    return CELSPAN_OK;
  }
  box = (celspan_box){box.x - x, box.y - y, box.width + 2 * x, box.height + 2 * y};
  return step->paint.beta > 0 ? paint_near(a, &box, out) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- steps without inputs */

static celspan_status make_flood(const applying *a, celspan_object **out) {
  return cs_svg_object_flood(a->context, &a->step->box, &a->step->paint, out);
}

static celspan_status make_image(const applying *a, celspan_object **out) {
  *out = kept(a->step->object);
  return *out ? convert(a, a->recipe->space, out) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- the whole */

/* *out: NULL before the call; after it the result, and after a failure the result so far. */
typedef celspan_status step_maker(const applying *a, celspan_object **out);

static step_maker *const makers[] = {[CS_SVG_STEP_MERGE] = make_merge,
                                     [CS_SVG_STEP_BLEND] = make_blend,
                                     [CS_SVG_STEP_IN] = make_in,
                                     [CS_SVG_STEP_OUT] = make_out,
                                     [CS_SVG_STEP_ATOP] = make_atop,
                                     [CS_SVG_STEP_XOR] = make_xor,
                                     [CS_SVG_STEP_SUM] = make_sum,
                                     [CS_SVG_STEP_COLOUR] = make_colour,
                                     [CS_SVG_STEP_LUMA] = make_luma,
                                     [CS_SVG_STEP_OFFSET] = make_offset,
                                     [CS_SVG_STEP_BLUR] = make_blur,
                                     [CS_SVG_STEP_DISPLACE] = make_displaced,
                                     [CS_SVG_STEP_SHADOW] = make_shadow,
                                     [CS_SVG_STEP_FLOOD] = make_flood,
                                     [CS_SVG_STEP_TILE] = make_tile,
                                     [CS_SVG_STEP_NEARBY] = make_nearby,
                                     [CS_SVG_STEP_IMAGE] = make_image,
                                     [CS_SVG_STEP_GROW] = make_morphology,
                                     [CS_SVG_STEP_SHRINK] = make_morphology};

/* The element in the form in which the steps use it, and its silhouette. */
static celspan_status make_sources(applying *a, celspan_object *object) {
  const celspan_paint black = celspan_paint_rgb(0, 0, 0, 1);
  celspan_object **source = &a->results[0];
  *source = kept(object);
  if (object)
    CS_TRY(convert(a, a->recipe->space, source));
  if (object)
    CS_TRY(cs_svg_object_move(a->context, &a->recipe->back, source));
  CS_TRY(cut(a, &a->recipe->region, source));
  return cs_svg_object_silhouette(a->context, *source, &black, &a->results[1]);
}

static celspan_status make_steps(applying *a, celspan_object *object) {
  CS_TRY(make_sources(a, object));
  for (size_t i = 0; i < a->recipe->step_count; i++) {
    const cs_svg_step *step = &a->recipe->steps[i];
    celspan_object **result = &a->results[CS_SVG_SOURCES + i];
    a->step = step;
    if (step->box.width > 0 && step->box.height > 0)
      CS_TRY(makers[step->kind](a, result));
    CS_TRY(cut(a, &step->box, result));
  }
  return CELSPAN_OK;
}

/* A filter without steps shows nothing. */
static celspan_status apply_one(celspan_context *context, const cs_svg_recipe *recipe,
                                celspan_object **object) {
  applying a = {.context = context, .recipe = recipe};
  const size_t count = CS_SVG_SOURCES + recipe->step_count;
  celspan_object *made = NULL;
  if (recipe->step_count == 0)
    return cs_svg_object_replace(CELSPAN_OK, NULL, object);
  CS_TRY(CS_MAKE(context, a.results, count));
  celspan_status status = make_steps(&a, *object);
  if (status == CELSPAN_OK)
    made = kept(a.results[count - 1]);
  if (made)
    status = cs_svg_object_move(context, &recipe->matrix, &made);
  for (size_t i = 0; i < count; i++)
    celspan_object_unref(a.results[i]);
  cs_mem_free(context->memory, a.results, count * sizeof(celspan_object *));
  return status == CELSPAN_OK ? cs_svg_object_replace(status, made, object) : status;
}

celspan_status cs_svg_recipe_apply(celspan_context *context, const cs_svg_recipe *recipe,
                                   celspan_object **object) {
  for (; recipe; recipe = recipe->next)
    CS_TRY(apply_one(context, recipe, object));
  return CELSPAN_OK;
}
