/* Effects: blurred objects, soft shadows, glows and outlines, made of mattes, groups and
 * compositions.
 *
 *     blur      a composition that holds the object as a defocused cel; its frame ends where
 *               the blur does, so that the blur follows all transforms of the object. Where
 *               its edges continue, the object is extended (extend.h), and the frame is its bounds
 *     shadow    group{ blur(silhouette), object }
 *     glow      group{ blur(silhouette) in mode "add", object }
 *     outline   group{ clip(ground, the shape grown), object }; where the shape does not say all,
 *               group{ matte(ground, blur(silhouette), its light many times brighter), object }
 *
 * A silhouette is the object's bounds in one colour, with the object as their matte: as soft as the
 * object is. A mode stays outermost: it is removed from the object, and given to the result.
 */
#include <math.h>

#include "base/description.h"
#include "model/scene/bounds.h"
#include "model/scene/check.h"
#include "model/scene/displace.h"
#include "model/scene/effect.h"
#include "model/scene/extend.h"
#include "model/scene/grow.h"
#include "model/scene/primitive_data.h"

#define EXTENT_GAUSSIAN 3 /* radii; farther away nothing of the blur can be seen */
#define EXTENT 2

/* ---------------------------------------------------------------- steps */

static celspan_status move(celspan_context *context, celspan_object **object, double x, double y) {
  celspan_object *made = NULL;
  const celspan_matrix matrix = celspan_matrix_translation(x, y);
  celspan_status status = celspan_object_transform(context, *object, &matrix, &made);
  return cs_effect_replace(object, status, made);
}

static celspan_status fade(celspan_context *context, celspan_object **object, double k) {
  celspan_object *made = NULL;
  celspan_status status = celspan_object_fade(context, *object, k, &made);
  return cs_effect_replace(object, status, made);
}

/* Makes *object present where `by` is present, or where it is not. */
static celspan_status mask(celspan_context *context, celspan_object **object, celspan_object *by,
                           bool inverts) {
  celspan_object *made = NULL;
  celspan_status status =
      celspan_object_create_matte(context, *object, by, CELSPAN_MATTE_ALPHA, inverts, &made);
  return cs_effect_replace(object, status, made);
}

/* ---------------------------------------------------------------- blur */

static celspan_status make_cel(celspan_context *context, celspan_object *object,
                               const celspan_blur_desc *desc, celspan_cel **out) {
  celspan_cel_desc fields = CELSPAN_CEL_DESC;
  fields.objects = &object;
  fields.object_count = 1;
  fields.defocus_radius = desc->radius;
  fields.defocus_kernel = desc->kernel;
  return celspan_cel_create(context, &fields, out);
}

static celspan_status compose(celspan_context *context, celspan_object *object,
                              const celspan_blur_desc *desc, const celspan_box *frame,
                              double brightness, celspan_object **out) {
  celspan_cel *cel;
  CS_TRY(make_cel(context, object, desc, &cel));
  celspan_status status = cs_effect_compose(context, cel, frame, brightness, out);
  celspan_cel_unref(cel);
  return status;
}

/* The bounds of what is blurred. Means over pixels are 0 around the object, wherever the frame
 * ends, so the outlines of its strokes need not be made. */
static celspan_status blurred_bounds(celspan_context *context, celspan_object *object,
                                     const celspan_blur_desc *desc, bool *is_there,
                                     celspan_box *out) {
  const celspan_matrix identity = celspan_matrix_identity();
  if (desc->kernel != CELSPAN_DEFOCUS_PIXEL || desc->edge == CELSPAN_BLUR_EXTEND)
    return cs_bounds_object(context, object, is_there, out);
  *is_there = cs_bounds_around(&object, 1, &identity, out);
  return CELSPAN_OK;
}

/* For an object without a mode. brightness: the factor of its light. */
static celspan_status blur(celspan_context *context, celspan_object *object,
                           const celspan_blur_desc *desc, double brightness, celspan_object **out) {
  celspan_box box = {0};
  bool is_there;
  CS_TRY(blurred_bounds(context, object, desc, &is_there, &box));
  double extent =
      desc->radius * (desc->kernel == CELSPAN_DEFOCUS_GAUSSIAN ? EXTENT_GAUSSIAN : EXTENT);
  const bool extends = desc->edge == CELSPAN_BLUR_EXTEND;
  double grow = extends ? 0 : extent;
  const celspan_box frame = {box.x - grow, box.y - grow, box.width + 2 * grow,
                             box.height + 2 * grow};
  if (!is_there || !(frame.width > 0 && frame.height > 0)) {
    *out = celspan_object_ref(object);
    return CELSPAN_OK;
  }
  celspan_object *extended = NULL;
  const celspan_matrix identity = celspan_matrix_identity();
  celspan_status status = CELSPAN_OK;
  if (extends)
    status = cs_extend(context, &object, 1, &identity, &box, extent, &extended);
  if (status == CELSPAN_OK)
    status = compose(context, extends ? extended : object, desc, &frame, brightness, out);
  celspan_object_unref(extended);
  return status;
}

static celspan_status add_blur(celspan_context *context, celspan_object *object, const void *desc,
                               celspan_object **out) {
  return blur(context, object, desc, 1, out);
}

static celspan_status check_blur(celspan_context *context, const char *noun, const char *field,
                                 double radius) {
  return cs_check_range(context, noun, field, radius, 0, CELSPAN_BLUR_MOST);
}

celspan_status celspan_object_blur(celspan_context *context, celspan_object *object,
                                   const celspan_blur_desc *desc, celspan_object **out) {
  CS_READ(context, "blur", celspan_blur_desc, desc);
  CS_TRY(cs_check_given(context, "blur", "the object", object));
  CS_TRY(cs_check_choice(context, "blur", "along", (unsigned)desc->along, CELSPAN_BLUR_SPIN + 1));
  if (desc->along != CELSPAN_BLUR_AROUND)
    return cs_displace_blur(context, object, desc, out);
  CS_TRY(check_blur(context, "blur", "radius", desc->radius));
  CS_TRY(cs_check_choice(context, "blur", "kernel", (unsigned)desc->kernel,
                         CELSPAN_DEFOCUS_PIXEL + 1));
  CS_TRY(cs_check_choice(context, "blur", "edge", (unsigned)desc->edge, CELSPAN_BLUR_EXTEND + 1));
  return cs_effect_make(context, object, add_blur, desc, out);
}

/* ---------------------------------------------------------------- silhouettes */

/* A rectangle with the texture: the bounds, enlarged by `grow` on each side. */
static celspan_status make_ground(celspan_context *context, const celspan_box *box, double grow,
                                  celspan_texture *texture, celspan_object **out) {
  const celspan_rect_desc desc = {
      sizeof desc, box->x - grow, box->y - grow, box->width + 2 * grow, box->height + 2 * grow,
      0,           texture};
  return celspan_object_create_rect(context, &desc, out);
}

/* The colour where the object is, or (inverts) where it is not, as far as `grow` beyond its bounds;
 * then moved and blurred. */
typedef struct silhouette {
  celspan_texture *colour;
  bool inverts;
  double grow;
  celspan_point offset;
  double radius;
  double gain;
} silhouette;

static celspan_status blur_silhouette(celspan_context *context, celspan_object **object,
                                      const silhouette *look) {
  celspan_blur_desc desc = CELSPAN_BLUR_DESC;
  celspan_object *made = NULL;
  desc.radius = look->radius;
  CS_TRY(move(context, object, look->offset.x, look->offset.y));
  if (look->radius == 0 && look->gain == 1)
    return CELSPAN_OK;
  celspan_status status = blur(context, *object, &desc, look->gain, &made);
  return cs_effect_replace(object, status, made);
}

static celspan_status make_silhouette(celspan_context *context, celspan_object *object,
                                      const silhouette *look, celspan_object **out) {
  celspan_box box = {0};
  bool is_there;
  celspan_object *made = NULL;
  CS_TRY(cs_bounds_object(context, object, &is_there, &box));
  CS_TRY(make_ground(context, &box, look->grow, look->colour, &made));
  celspan_status status = mask(context, &made, object, look->inverts);
  if (status == CELSPAN_OK)
    status = blur_silhouette(context, &made, look);
  return CS_GIVE(status, made, celspan_object_unref, out);
}

/* Joins *effect and the object, either of which may be in front. */
static celspan_status join(celspan_context *context, celspan_object **effect,
                           celspan_object *object, bool is_in_front) {
  celspan_object *made = NULL;
  celspan_object *const both[] = {is_in_front ? object : *effect, is_in_front ? *effect : object};
  celspan_group_desc desc = CELSPAN_GROUP_DESC;
  desc.objects = both;
  desc.object_count = 2;
  celspan_status status = celspan_object_create_group(context, &desc, &made);
  return cs_effect_replace(effect, status, made);
}

/* ---------------------------------------------------------------- shadows */

static celspan_status check_shadow(celspan_context *context, const celspan_object *object,
                                   const celspan_shadow_desc *desc) {
  double opacity;
  CS_TRY(cs_check_given(context, "shadow", "the object", object));
  CS_TRY(cs_check_point(context, "shadow", "offset", 0, desc->offset));
  CS_TRY(check_blur(context, "shadow", "blur", desc->blur));
  return cs_check_share(context, "shadow", "opacity", desc->opacity, &opacity);
}

static celspan_status add_shadow(celspan_context *context, celspan_object *object, const void *user,
                                 celspan_object **shadow) {
  const celspan_shadow_desc *desc = user;
  double extent = EXTENT_GAUSSIAN * desc->blur + fabs(desc->offset.x) + fabs(desc->offset.y);
  const silhouette look = {.colour = desc->colour,
                           .inverts = desc->is_inside,
                           .grow = desc->is_inside ? extent : 0,
                           .offset = desc->offset,
                           .radius = desc->blur,
                           .gain = 1};
  CS_TRY(make_silhouette(context, object, &look, shadow));
  if (desc->is_inside)
    CS_TRY(mask(context, shadow, object, false));
  CS_TRY(fade(context, shadow, desc->opacity));
  return desc->is_alone ? CELSPAN_OK : join(context, shadow, object, desc->is_inside);
}

celspan_status celspan_object_shadow(celspan_context *context, celspan_object *object,
                                     const celspan_shadow_desc *desc, celspan_object **out) {
  CS_READ(context, "shadow", celspan_shadow_desc, desc);
  CS_TRY(check_shadow(context, object, desc));
  return cs_effect_make(context, object, add_shadow, desc, out);
}

/* ---------------------------------------------------------------- glows */

static celspan_status check_glow(celspan_context *context, const celspan_object *object,
                                 const celspan_glow_desc *desc) {
  CS_TRY(cs_check_given(context, "glow", "the object", object));
  CS_TRY(check_blur(context, "glow", "radius", desc->radius));
  return cs_check_size(context, "glow", "gain", desc->gain);
}

static celspan_status add_glow(celspan_context *context, celspan_object *object, const void *user,
                               celspan_object **glow) {
  const celspan_glow_desc *desc = user;
  const silhouette look = {.colour = desc->colour, .radius = desc->radius, .gain = desc->gain};
  CS_TRY(make_silhouette(context, object, &look, glow));
  CS_TRY(cs_effect_give_mode(context, glow, CELSPAN_BLEND_ADD));
  return join(context, glow, object, false);
}

celspan_status celspan_object_glow(celspan_context *context, celspan_object *object,
                                   const celspan_glow_desc *desc, celspan_object **out) {
  CS_READ(context, "glow", celspan_glow_desc, desc);
  CS_TRY(check_glow(context, object, desc));
  return cs_effect_make(context, object, add_glow, desc, out);
}

/* ---------------------------------------------------------------- outlines */

/* How many times brighter a blurred silhouette is made as a matte: an object that covers a 32nd of
 * the disc around a point gives full strength there. Along a straight side this happens from 0.86
 * of the width inwards. */
#define SPREAD_STOPS 5

static celspan_status check_outline(celspan_context *context, const celspan_object *object,
                                    const celspan_outline_desc *desc) {
  double opacity;
  CS_TRY(cs_check_given(context, "outline", "the object", object));
  CS_TRY(check_blur(context, "outline", "width", desc->width));
  CS_TRY(check_blur(context, "outline", "blur", desc->blur));
  CS_TRY(cs_check_choice(context, "outline", "join", (unsigned)desc->join,
                         CELSPAN_STROKE_JOIN_BEVEL + 1));
  return cs_check_share(context, "outline", "opacity", desc->opacity, &opacity);
}

/* The texture wherever the object is, or is nearer than the width. */
static celspan_status outline_vector(celspan_context *context, celspan_object *object,
                                     const cs_grow *how, celspan_texture *texture,
                                     celspan_object **out) {
  celspan_object *grown, *ground = NULL;
  celspan_box box = {0};
  bool is_there;
  CS_TRY(cs_grow_object(context, object, how, &grown));
  celspan_status status = cs_bounds_object(context, grown, &is_there, &box);
  if (status == CELSPAN_OK)
    status = make_ground(context, &box, 0, texture, &ground);
  celspan_object *const both[] = {ground, grown};
  if (status == CELSPAN_OK)
    status = celspan_object_create_boolean(context, CELSPAN_OPERATOR_CLIP, both, 2, out);
  celspan_object_unref(ground);
  celspan_object_unref(grown);
  return status;
}

/* *object as a group whose light is SPREAD_STOPS brighter. */
static celspan_status brighten(celspan_context *context, celspan_object **object) {
  celspan_grade_desc fields = CELSPAN_GRADE_DESC;
  celspan_object *made = NULL;
  fields.exposure = SPREAD_STOPS;
  celspan_status status = cs_object_graded(context, *object, &fields, &made);
  return cs_effect_replace(object, status, made);
}

/* A white silhouette, spread by the width. */
static celspan_status spread(celspan_context *context, celspan_object *object, double width,
                             celspan_object **out) {
  const celspan_paint paint = celspan_paint_rgb(1, 1, 1, 1);
  celspan_blur_desc disc = CELSPAN_BLUR_DESC;
  silhouette look = {.gain = 1};
  celspan_object *made = NULL, *wide = NULL;
  disc.radius = width;
  disc.kernel = CELSPAN_DEFOCUS_DISC;
  CS_TRY(celspan_texture_create_paint(context, &paint, &look.colour));
  celspan_status status = make_silhouette(context, object, &look, &made);
  celspan_texture_unref(look.colour);
  CS_TRY(status);
  status = blur(context, made, &disc, 1, &wide);
  celspan_object_unref(made);
  if (status == CELSPAN_OK)
    status = brighten(context, &wide);
  return CS_GIVE(status, wide, celspan_object_unref, out);
}

/* The same for an object with an alpha of its own. */
static celspan_status outline_alpha(celspan_context *context, celspan_object *object,
                                    const celspan_outline_desc *desc, celspan_object **out) {
  celspan_object *wide, *ground = NULL;
  celspan_box box = {0};
  bool is_there;
  CS_TRY(cs_bounds_object(context, object, &is_there, &box));
  CS_TRY(spread(context, object, desc->width, &wide));
  celspan_status status = make_ground(context, &box, desc->width, desc->texture, &ground);
  if (status == CELSPAN_OK)
    status = celspan_object_create_matte(context, ground, wide, CELSPAN_MATTE_LUMA, false, out);
  celspan_object_unref(ground);
  celspan_object_unref(wide);
  return status;
}

static celspan_status add_outline(celspan_context *context, celspan_object *object,
                                  const void *user, celspan_object **outline) {
  const celspan_outline_desc *desc = user;
  const silhouette look = {.radius = desc->blur, .gain = 1};
  const cs_grow how = {desc->width, desc->join};
  const bool is_vector = cs_grow_is_vector(object);
  CS_TRY(is_vector ? outline_vector(context, object, &how, desc->texture, outline)
                   : outline_alpha(context, object, desc, outline));
  CS_TRY(blur_silhouette(context, outline, &look));
  CS_TRY(fade(context, outline, desc->opacity));
  if (!desc->is_alone)
    CS_TRY(join(context, outline, object, false));
  return is_vector && desc->blur == 0 ? cs_grow_note(context, *outline, object, &how) : CELSPAN_OK;
}

celspan_status celspan_object_outline(celspan_context *context, celspan_object *object,
                                      const celspan_outline_desc *desc, celspan_object **out) {
  CS_READ(context, "outline", celspan_outline_desc, desc);
  CS_TRY(check_outline(context, object, desc));
  return cs_effect_make(context, object, add_outline, desc, out);
}
