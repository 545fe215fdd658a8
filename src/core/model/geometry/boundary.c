#include "model/geometry/boundary.h"

#include "base/keys.h"
#include "base/number.h"
#include "base/sort.h"
#include "model/geometry/matrix.h"

#include <math.h>
#include <string.h>

void cs_boundary_init(cs_boundary_set *set) { memset(set, 0, sizeof *set); }

void cs_boundary_finish(cs_boundary_set *set, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, set, points, chains);
  cs_boundary_init(set);
}

/* A cubic adds three points to its outline, and its stretch has four; contours of artwork turn once
 * in two or three pieces. */
celspan_status cs_boundary_expect(celspan_context *context, cs_boundary_set *set, size_t pieces,
                                  size_t points) {
  size_t curves = points > pieces ? points - pieces : 0;
  if (pieces == 0)
    return CELSPAN_OK;
  CS_TRY(CS_ARRAY_RESERVE(context, set->points, set->point_count + 5 * curves / 2));
  CS_TRY(CS_ARRAY_RESERVE(context, set->pieces, set->piece_count + pieces));
  return CS_ARRAY_RESERVE(context, set->chains, set->chain_count + 2 * pieces / 5);
}

bool cs_boundary_around_box(const celspan_box *box, const celspan_matrix *matrix,
                            cs_boundary_frame *out) {
  bool is_in_front = true;
  *out = (cs_boundary_frame){INFINITY, -INFINITY, INFINITY, -INFINITY};
  for (int corner = 0; corner < 4; corner++) {
    cs_hpoint own = {box->x + (corner & 1 ? box->width : 0),
                     box->y + (corner & 2 ? box->height : 0), 1};
    cs_hpoint at = cs_matrix_apply(matrix, own);
    double x = at.x / at.w, y = at.y / at.w; /* may be NaN, which then changes nothing */
    is_in_front = is_in_front && at.w > 0;
    out->left = cs_number_least(x, out->left);
    out->right = cs_number_most(x, out->right);
    out->top = cs_number_least(y, out->top);
    out->bottom = cs_number_most(y, out->bottom);
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

/* A whole number that grows with the height; heights that are very close have the same number. */
static inline int32_t height_key(double y) {
  const float height = (float)y + 0.0f; /* no -0 */
  int32_t bits;
  memcpy(&bits, &height, sizeof bits);
  return bits < 0 ? bits ^ INT32_MAX : bits;
}

/* Moves the chains to the places that the keys give. */
static void move_chains(cs_boundary_chain *chains, uint64_t *keys, size_t count) {
  for (size_t i = 0; i < count; i++) {
    const cs_boundary_chain first = chains[i];
    size_t at = i;
    for (size_t from; (from = cs_key_number(keys[at])) != i; at = from) {
      chains[at] = chains[from];
      keys[at] = cs_key(cs_key_by(keys[at]), at);
    }
    chains[at] = first;
    keys[at] = cs_key(cs_key_by(keys[at]), at);
  }
}

celspan_status cs_boundary_sort(celspan_context *context, cs_boundary_set *set) {
  size_t count = set->chain_count;
  uint64_t *keys;
  CS_TRY(CS_MAKE(context, keys, count + 1));
  for (size_t i = 0; i < count; i++)
    keys[i] = cs_key(height_key(set->chains[i].y0), i);
  celspan_status status = cs_keys_sort(context, keys, count);
  if (status == CELSPAN_OK)
    move_chains(set->chains, keys, count);
  for (size_t i = 0, end; i < count && status == CELSPAN_OK; i = end) {
    for (end = i + 1; end < count && cs_key_by(keys[end]) == cs_key_by(keys[i]);)
      end++;
    sort_chains(set->chains + i, end - i);
  }
  cs_mem_free(context->memory, keys, (count + 1) * sizeof *keys);
  return status;
}
