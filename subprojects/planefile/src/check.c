/* What is asked of a plane before it is written. */
#include "band.h"

static bool is_far(planefile_point at) {
  return at.x < -PLANEFILE_FAR || at.x > PLANEFILE_FAR || at.y < -PLANEFILE_FAR ||
         at.y > PLANEFILE_FAR;
}

/* Whether a coordinate is not on the grid. */
static bool is_between(int32_t at, uint16_t count) {
  return planefile_place_of(planefile_step_at(at, count), count) != at;
}

static bool is_piece(const planefile_band *plane, uint32_t index, planefile_grid grid) {
  const planefile_piece *piece = &plane->pieces[index];
  if (piece->degree < (piece->is_rational ? 2 : 1) || piece->degree > 3 ||
      piece->point > plane->point_count || plane->point_count - piece->point <= piece->degree)
    return false;
  const planefile_point *points = &plane->points[piece->point];
  for (int i = 0; i <= piece->degree; i++)
    if (is_far(points[i]) || is_between(points[i].x, grid.columns) ||
        is_between(points[i].y, grid.rows) ||
        (piece->is_rational &&
         (points[i].w < PLANEFILE_WEIGHT / 16 || points[i].w / 16 >= (uint32_t)PLANEFILE_WEIGHT)))
      return false;
  return points[piece->degree].y >= points[0].y;
}

static bool is_chain(const planefile_band *plane, const planefile_chain *chain,
                     planefile_grid grid) {
  if (chain->piece_count == 0 || chain->piece > plane->piece_count ||
      chain->piece_count > plane->piece_count - chain->piece)
    return false;
  for (uint32_t i = chain->piece; i < chain->piece + chain->piece_count; i++) {
    const planefile_piece *piece = &plane->pieces[i], *before = piece - 1;
    if (!is_piece(plane, i, grid))
      return false;
    if (i > chain->piece) {
      const planefile_point *end = &plane->points[before->point + before->degree];
      const planefile_point *start = &plane->points[piece->point];
      if (end->x != start->x || end->y != start->y)
        return false;
    }
  }
  return true;
}

static bool is_border(const planefile_band *plane, const planefile_border *border,
                      planefile_grid grid) {
  if (border->chain >= plane->chain_count || border->left >= plane->cell_count ||
      border->right >= plane->cell_count || border->left == border->right)
    return false;
  const planefile_chain *chain = &plane->chains[border->chain];
  const planefile_piece *last = &plane->pieces[chain->piece + chain->piece_count - 1];
  return !is_between(border->top, grid.rows) && !is_between(border->foot, grid.rows) &&
         border->top >= 0 && border->top < border->foot && border->foot <= PLANEFILE_SIDE &&
         border->top >= plane->points[plane->pieces[chain->piece].point].y &&
         border->foot <= plane->points[last->point + last->degree].y;
}

static bool is_cell(const planefile_cell *cell) {
  for (int c = 0; c < 4; c++)
    if (cell->colour[c] < -PLANEFILE_BRIGHT || cell->colour[c] > PLANEFILE_BRIGHT)
      return false;
  return true;
}

/* A cell that varies has no colour of its own, and cell 0 does not vary. */
static bool is_program(const planefile_band *plane, uint32_t cell) {
  static const planefile_cell none;
  const planefile_program *program = &plane->programs[cell];
  return program->step_count == 0 ||
         (cell > 0 && memcmp(&plane->cells[cell], &none, sizeof none) == 0 &&
          pf_program_is_good(plane, *program));
}

/* Whether those that are shown are good. */
static bool are_pictures(const planefile_band *plane) {
  bool is_good = true;
  for (uint32_t i = 0; i < plane->axis_count && is_good; i++) {
    const planefile_axis *axis = &plane->axes[i];
    is_good = axis->kind != PLANEFILE_PICTURE || axis->picture >= plane->picture_count ||
              (plane->pictures && pf_picture_is_good(&plane->pictures[axis->picture]));
  }
  return is_good;
}

bool pf_plane_is_good(const planefile_band *plane, planefile_grid grid) {
  bool is_good = plane->top == 0 && plane->foot == PLANEFILE_SIDE && plane->cell_count > 0;
  for (uint32_t i = 0; is_good && i < plane->chain_count; i++)
    is_good = is_chain(plane, &plane->chains[i], grid);
  for (uint32_t i = 0; is_good && i < plane->border_count; i++)
    is_good = is_border(plane, &plane->borders[i], grid);
  for (uint32_t i = 0; is_good && i < plane->cell_count; i++)
    is_good = is_cell(&plane->cells[i]) && (!plane->programs || is_program(plane, i));
  return is_good && are_pictures(plane);
}

int pf_border_compare(const void *first, const void *second) {
  const planefile_border *a = first, *b = second;
  int by_chain = pf_order(a->chain, b->chain);
  return by_chain ? by_chain : pf_order(a->top, b->top);
}
