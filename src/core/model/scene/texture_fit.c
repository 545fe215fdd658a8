#include "model/scene/texture_fit.h"

#include <math.h>

#include "base/description.h"
#include "model/geometry/matrix.h"
#include "model/scene/check.h"

static const celspan_box unit_box = {0, 0, 1, 1};

/* ---------------------------------------------------------------- geometry */

/* The ends of a line through the middle of the box, in a direction, as long as the box is in this
 * direction. They are one point if the box has no length there. */
static void place_line(const celspan_box *box, celspan_point way, celspan_point ends[2]) {
  const celspan_point middle = {box->x + box->width / 2, box->y + box->height / 2};
  const double length = sqrt(way.x * way.x + way.y * way.y);
  ends[0] = ends[1] = middle;
  if (!(length > 0))
    return;
  const double x = way.x / length, y = way.y / length;
  const double half = (fabs(x) * box->width + fabs(y) * box->height) / 2;
  ends[0] = (celspan_point){middle.x - half * x, middle.y - half * y};
  ends[1] = (celspan_point){middle.x + half * x, middle.y + half * y};
  /* exactly the sides, as a hand would write them */
  if (x == 0 || y == 0)
    for (int i = 0; i < 2; i++) {
      const bool is_far = (x + y > 0) == (i == 1);
      if (x == 0)
        ends[i].y = is_far ? box->y + box->height : box->y;
      else
        ends[i].x = is_far ? box->x + box->width : box->x;
    }
}

/* The direction of the line of a fit in a box. Towards a corner, it is at a right angle to the
 * line through the two corners beside it. */
static celspan_point way_in(const cs_texture_variation *of, const celspan_box *box) {
  const celspan_point way = {of->points[1].x - of->points[0].x, of->points[1].y - of->points[0].y};
  return of->fit == CS_TEXTURE_FIT_SIDE ? (celspan_point){way.x * box->height, way.y * box->width}
                                        : way;
}

/* The ellipse that touches all sides: a circle of the box's width, made higher or lower. */
static void place_ellipse(const celspan_box *box, cs_texture_variation *own) {
  const celspan_point middle = {box->x + box->width / 2, box->y + box->height / 2};
  own->points[0] = middle;
  own->radius = box->width / 2;
  if (box->width == box->height)
    return;
  own->matrix = celspan_matrix_scaling_about(1, box->height / box->width, middle);
  own->has_matrix = celspan_matrix_inverse(own->matrix, &own->inverse);
}

/* ---------------------------------------------------------------- fitting */

/* A gradient without an extent. */
static celspan_status create_first(celspan_context *context, const celspan_texture *texture,
                                   celspan_texture **out) {
  celspan_texture *flat;
  CS_TRY(cs_texture_create_kind(context, CS_TEXTURE_FLAT, &flat));
  flat->flat = texture->variation->stops[0].paint;
  return cs_texture_finish(flat, out);
}

static celspan_status create_fitted(celspan_context *context, const celspan_texture *texture,
                                    const celspan_box *box, celspan_texture **out) {
  const cs_texture_variation *from = texture->variation;
  const bool is_ellipse = from->fit == CS_TEXTURE_FIT_ELLIPSE;
  celspan_point ends[2];
  place_line(box, way_in(from, box), ends);
  const bool has_extent = is_ellipse ? box->width > 0 && box->height > 0
                                     : ends[0].x != ends[1].x || ends[0].y != ends[1].y;
  if (!has_extent)
    return create_first(context, texture, out);
  celspan_texture *made;
  CS_TRY(cs_texture_copy(context, texture, from->stop_count, cs_mark_keep(texture->mark), &made));
  cs_texture_variation *own = cs_texture_own(made);
  own->fit = CS_TEXTURE_FIT_NONE;
  if (is_ellipse) {
    place_ellipse(box, own);
  } else {
    own->points[0] = ends[0];
    own->points[1] = ends[1];
  }
  return cs_texture_finish(made, out);
}

celspan_status cs_texture_fit(celspan_context *context, celspan_texture **texture,
                              const celspan_box *box) {
  celspan_texture *fitted;
  if ((*texture)->variation->fit == CS_TEXTURE_FIT_NONE)
    return CELSPAN_OK;
  CS_TRY(create_fitted(context, *texture, box, &fitted));
  celspan_texture_unref(*texture);
  *texture = fitted;
  return CELSPAN_OK;
}

celspan_matrix cs_texture_fit_light(const celspan_texture *texture, const celspan_matrix *matrix,
                                    double width, double height) {
  if (texture->variation->fit == CS_TEXTURE_FIT_NONE)
    return *matrix;
  return celspan_matrix_then(celspan_matrix_scaling(width, height), *matrix);
}

/* ---------------------------------------------------------------- the face */

static celspan_status check(celspan_context *context, const char *noun,
                            const celspan_fitted_desc *desc) {
  CS_TRY(cs_check_choice(context, noun, "fit", (unsigned)desc->fit, CELSPAN_GRADIENT_ELLIPSE + 1));
  CS_TRY(cs_check_range(context, noun, "to_x", desc->to_x, -1, 1));
  CS_TRY(cs_check_range(context, noun, "to_y", desc->to_y, -1, 1));
  if (desc->fit == CELSPAN_GRADIENT_SIDE && desc->to_x == 0 && desc->to_y == 0)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: to_x and to_y are both 0, which is no side; one of them must be -1 or 1",
                   noun);
  return cs_check_number(context, noun, "angle", desc->degrees);
}

static void fill(const celspan_fitted_desc *desc, cs_texture_variation *own) {
  own->fit = CS_TEXTURE_FIT_SIDE + (cs_texture_fit_kind)desc->fit;
  own->points[0] = (celspan_point){0.5, 0.5};
  own->radius = desc->fit == CELSPAN_GRADIENT_ELLIPSE ? 0.5 : 0;
  if (desc->fit == CELSPAN_GRADIENT_ELLIPSE)
    return;
  celspan_point way = {desc->to_x, desc->to_y};
  if (desc->fit == CELSPAN_GRADIENT_ANGLE) {
    const celspan_matrix turn = cs_matrix_turn(desc->degrees, (celspan_point){0, 0});
    way = (celspan_point){-turn.m[1], -turn.m[4]}; /* up, turned */
  }
  celspan_point ends[2];
  place_line(&unit_box, way, ends);
  own->points[0] = ends[0];
  own->points[1] = ends[1];
}

celspan_status celspan_texture_create_fitted(celspan_context *context,
                                             const celspan_fitted_desc *desc,
                                             celspan_texture **out) {
  CS_READ(context, "gradient", celspan_fitted_desc, desc);
  const bool is_ellipse = desc->fit == CELSPAN_GRADIENT_ELLIPSE;
  const char *noun = is_ellipse ? "radial" : "linear";
  celspan_texture *texture = NULL;
  CS_TRY(check(context, noun, desc));
  CS_TRY(cs_texture_create_stops(context, noun, is_ellipse ? CS_TEXTURE_RADIAL : CS_TEXTURE_LINEAR,
                                 desc->stops, desc->stop_count, false, &texture));
  if (texture->kind != CS_TEXTURE_FLAT)
    fill(desc, cs_texture_own(texture));
  return cs_texture_finish(texture, out);
}
