#include "frames/render/through.h"

#include <math.h>

#include "model/geometry/matrix.h"
#include "model/pictures/store.h"
#include "model/scene/texture.h"

/* A pixel that the layer only touches takes the colour at its middle, which may lie outside the
 * layer. */
#define BESIDE 1 /* pixels */
/* Rounding may put a mix of two paints, or a plane, beyond the greater of its ends. */
#define ROUNDING (1 + 0x1p-20f)

static const cs_v4 clear = {1, 1, 1, 0};

static cs_v4 transmission(const cs_paint *paint) {
  return (cs_v4){paint->t[0], paint->t[1], paint->t[2], 0};
}

/* A corner of the part of the frame in which the formula is asked, in own units. */
static cs_hpoint corner_of(const cs_shade *shade, const cs_boundary_frame *visible, int corner) {
  double x = corner % 2 ? visible->right + BESIDE : visible->left - BESIDE;
  double y = corner / 2 ? visible->bottom + BESIDE : visible->top - BESIDE;
  return cs_matrix_apply(&shade->inverse, (cs_hpoint){x, y, 1});
}

/* Whether the formula may be asked at or behind the horizon, where it is clear. */
static bool meets_horizon(const cs_shade *shade, const cs_boundary_frame *visible) {
  if (shade->is_affine)
    return false;
  for (int corner = 0; corner < 4; corner++)
    if (!(corner_of(shade, visible, corner).w > 0))
      return true;
  return false;
}

static cs_v4 stops_through(const celspan_texture *texture) {
  cs_v4 most = cs_v4_all(0);
  for (size_t i = 0; i < texture->variation->stop_count; i++)
    most = cs_v4_max(transmission(&texture->variation->stops[i].paint), most);
  return most;
}

/* The planes of a triangle continue outside it, so they are greatest in a corner of the visible
 * box. */
static cs_v4 triangle_through(const cs_shade *shade, const cs_boundary_frame *visible) {
  cs_v4 most = cs_v4_all(0);
  for (int corner = 0; corner < 4; corner++) {
    cs_hpoint own = corner_of(shade, visible, corner);
    for (int c = 0; c < 3; c++) {
      const double *plane = shade->plane[3 + c];
      float t = (float)((plane[0] * own.x + plane[1] * own.y) / own.w + plane[2]);
      most[c] = t > most[c] ? t : most[c];
    }
  }
  return most;
}

cs_v4 cs_through_shade(const cs_shade *shade, const cs_boundary_frame *visible) {
  bool is_triangle = shade->texture->kind == CS_TEXTURE_TRIANGLE;
  if (meets_horizon(shade, visible))
    return clear;
  cs_v4 most = is_triangle ? triangle_through(shade, visible) : stops_through(shade->texture);
  return cs_v4_min(most * ROUNDING, clear);
}

cs_v4 cs_through_least(const cs_stack *stack, const cs_layer *layer) {
  bool hides = layer->kind == CS_LAYER_PICTURE && layer->role == CS_LAYER_PAINT &&
               cs_image_layer_hides(&stack->images[layer->index]);
  return hides ? cs_v4_all(1 - layer->fade) : layer->t;
}

static bool has_alpha(celspan_context *context, const cs_picture *picture) {
  celspan_context branch; /* its errors are not errors of the frame */
  celspan_picture_info info;
  cs_context_branch(&branch, context);
  return cs_store_info(&branch, picture, &info) != CELSPAN_OK || info.has_alpha;
}

cs_v4 cs_through_layer(celspan_context *context, const cs_stack *stack, const cs_layer *layer) {
  cs_v4 least = cs_through_least(stack, layer);
  if (layer->kind != CS_LAYER_PICTURE || least[0] == layer->t[0])
    return layer->t;
  return has_alpha(context, stack->images[layer->index].texture->variation->picture) ? layer->t
                                                                                     : least;
}

double cs_through_halvings(cs_v4 t) {
  float most = t[0] > t[1] ? t[0] : t[1];
  int exponent;
  double through = most > t[2] ? most : t[2], part = frexp(through, &exponent); /* 0.5 to 1 */
  if (!(through > 0) || exponent <= -CS_THROUGH_OPAQUE)
    return CS_THROUGH_OPAQUE;
  return 2 * (1 - part) - exponent;
}
