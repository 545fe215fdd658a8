#include "model/geometry/boundary.h"

#include "base/sort.h"
#include "model/geometry/matrix.h"

#include <math.h>
#include <string.h>

void cs_boundary_init(cs_boundary_set *set) { memset(set, 0, sizeof *set); }

void cs_boundary_finish(cs_boundary_set *set, cs_memory *memory) {
  cs_mem_free(memory, set->points, set->point_capacity * sizeof *set->points);
  cs_mem_free(memory, set->pieces, set->piece_capacity * sizeof *set->pieces);
  cs_mem_free(memory, set->chains, set->chain_capacity * sizeof *set->chains);
  cs_boundary_init(set);
}

bool cs_boundary_around_box(const celspan_box *box, const celspan_matrix *matrix,
                            cs_boundary_frame *out) {
  bool is_in_front = true;
  *out = (cs_boundary_frame){INFINITY, -INFINITY, INFINITY, -INFINITY};
  for (int corner = 0; corner < 4; corner++) {
    cs_hpoint own = {box->x + (corner & 1 ? box->width : 0),
                     box->y + (corner & 2 ? box->height : 0), 1};
    cs_hpoint at = cs_matrix_apply(matrix, own);
    is_in_front = is_in_front && at.w > 0;
    out->left = fmin(out->left, at.x / at.w);
    out->right = fmax(out->right, at.x / at.w);
    out->top = fmin(out->top, at.y / at.w);
    out->bottom = fmax(out->bottom, at.y / at.w);
  }
  return is_in_front;
}

/* ---------------------------------------------------------------- order */

/* A strict order: no two chains share a first piece, and pieces are numbered as they are added. */
static inline bool is_before(const cs_boundary_chain *a, const cs_boundary_chain *b) {
  if (a->y0 != b->y0)
    return a->y0 < b->y0;
  if (a->x0 != b->x0)
    return a->x0 < b->x0;
  return a->layer != b->layer ? a->layer < b->layer : a->piece < b->piece;
}

CS_SORT_DEFINE(sort_chains, cs_boundary_chain, is_before)

void cs_boundary_sort(cs_boundary_set *set) { sort_chains(set->chains, set->chain_count); }
