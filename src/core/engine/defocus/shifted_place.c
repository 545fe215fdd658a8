#include "engine/defocus/shifted_place.h"

#include <math.h>

#include "base/number.h"
#include "model/scene/bounds.h"

/* ---------------------------------------------------------------- rectangles */

/* The whole pixels that two rectangles share. */
static cs_shifted_part shared(const cs_boundary_frame *a, const cs_boundary_frame *b) {
  return (cs_shifted_part){
      {cs_number_floor(fmax(a->left, b->left)), cs_number_floor(fmax(a->top, b->top))},
      {cs_number_ceil(fmin(a->right, b->right)), cs_number_ceil(fmin(a->bottom, b->bottom))}};
}

static cs_boundary_frame grown(const cs_boundary_frame *a, double x, double y) {
  return (cs_boundary_frame){a->left - x, a->right + x, a->top - y, a->bottom + y};
}

static celspan_box box_of(const cs_boundary_frame *a) {
  return (celspan_box){a->left, a->top, a->right - a->left, a->bottom - a->top};
}

/* ---------------------------------------------------------------- what is read */

/* The box of a cel's objects in a place; all of `beyond` where it reaches the horizon. *is_there:
 * false where there is nothing. */
static celspan_status find_art(celspan_context *context, const cs_defocus_cel *place,
                               const celspan_cel *cel, const cs_boundary_frame *beyond,
                               bool *is_there, cs_boundary_frame *out) {
  const celspan_matrix identity = celspan_matrix_identity();
  celspan_box box;
  CS_TRY(cs_bounds_drawing(context, cel, &identity, is_there, &box));
  if (*is_there && !cs_boundary_around_box(&box, &place->matrix, out))
    *out = *beyond;
  return CELSPAN_OK;
}

/* What the shift may read for the pixels of a rectangle; all of `beyond` where that is beyond a
 * horizon. */
static cs_boundary_frame find_reads(const cs_defocus_cel *place, const celspan_matrix *to_units,
                                    const cs_boundary_frame *shown,
                                    const cs_boundary_frame *beyond) {
  const celspan_box pixels = box_of(shown);
  cs_boundary_frame units, out;
  if (!cs_boundary_around_box(&pixels, to_units, &units))
    return *beyond;
  const celspan_box own = box_of(&units), far = cs_shift_reads(place->cel->shift, &own);
  return cs_boundary_around_box(&far, &place->matrix, &out) ? grown(&out, 1, 1) : *beyond;
}

/* A plane is as large as numbers allow, and only its making refuses the cel (writers/plane). */
static celspan_status check_sides(celspan_context *context, const cs_shifted_part *part) {
  double width = (double)part->end[0] - part->first[0],
         height = (double)part->end[1] - part->first[1];
  return fmax(width, height) <= CS_SHIFTED_SIDE ? CELSPAN_OK
                                                : cs_shifted_refuse(context, width, height);
}

/* frame: with a pixel more on each side. */
static celspan_status find_parts(celspan_context *context, const cs_defocus_cel *place,
                                 const cs_boundary_frame *frame, bool *is_there,
                                 cs_shifted_place *out) {
  const cs_boundary_frame beyond = grown(frame, place->width, place->height);
  const cs_shifted_part *s = &out->shown;
  const cs_boundary_frame shown = {s->first[0], s->end[0], s->first[1], s->end[1]};
  const celspan_cel *by = place->cel->shift->by;
  cs_boundary_frame art;
  bool has_by = false;
  CS_TRY(find_art(context, place, place->cel, &beyond, is_there, &art));
  if (*is_there) {
    const cs_boundary_frame read = find_reads(place, &out->map.to_units, &shown, &beyond);
    art = grown(&art, 1, 1);
    out->read = shared(&read, &art);
    *is_there = cs_shifted_part_has_pixels(&out->read);
  }
  if (by && *is_there)
    CS_TRY(find_art(context, place, by, &beyond, &has_by, &art));
  if (has_by)
    out->by = shared(&art, &shown);
  return *is_there ? check_sides(context, &out->read) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- the place */

static void fill_map(const cs_defocus_cel *place, cs_shifted_place *out) {
  const cs_shifted_part *shown = &out->shown, *read = &out->read;
  cs_shifted *map = &out->map;
  map->space = place->space;
  map->columns = (cs_defocused_range){shown->first[0], shown->end[0]};
  map->rows = (cs_defocused_range){shown->first[1], shown->end[1]};
  /* the first node lies outside the part */
  map->to_nodes = celspan_matrix_then(
      place->matrix, celspan_matrix_translation(0.5 - read->first[0], 0.5 - read->first[1]));
  for (int k = 0; k < 2; k++) {
    map->from_at[k] = 1 - read->first[k];
    map->by_at[k] = 1 - out->by.first[k];
  }
}

celspan_status cs_shifted_place_find(celspan_context *context, const cs_defocus_cel *place,
                                     bool *is_seen, cs_boundary_frame *visible,
                                     cs_shifted_place *out) {
  const cs_boundary_frame frame = {-1, place->width + 1.0, -1, place->height + 1.0};
  const celspan_box film = {0, 0, place->film_width, place->film_height};
  cs_boundary_frame ends;
  *out = (cs_shifted_place){0};
  if (!cs_boundary_around_box(&film, &place->to_pixels, &ends))
    ends = frame;
  out->shown = shared(&ends, &frame);
  *visible = (cs_boundary_frame){
      fmax(floor(ends.left), place->frame.left), fmin(ceil(ends.right), place->frame.right),
      fmax(floor(ends.top), place->frame.top), fmin(ceil(ends.bottom), place->frame.bottom)};
  *is_seen = cs_shifted_part_has_pixels(&out->shown) && visible->left < visible->right &&
             visible->top < visible->bottom &&
             celspan_matrix_inverse(place->matrix, &out->map.to_units);
  if (*is_seen)
    CS_TRY(find_parts(context, place, &frame, is_seen, out));
  if (*is_seen)
    fill_map(place, out);
  return CELSPAN_OK;
}
