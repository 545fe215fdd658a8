#include "geometry/boundary.h"

#include <math.h>
#include <string.h>

#include "geometry/matrix.h"

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
static bool is_before(const cs_boundary_chain *a, const cs_boundary_chain *b) {
  if (a->y0 != b->y0)
    return a->y0 < b->y0;
  if (a->x0 != b->x0)
    return a->x0 < b->x0;
  return a->layer != b->layer ? a->layer < b->layer : a->piece < b->piece;
}

/* Brings a heap in order whose root alone may be out of place. Most roots came from the bottom and
 * go back there: so the way down to a leaf is made without asking, and the root comes up from it. */
static void sift_down(cs_boundary_chain *chains, size_t root, size_t count) {
  cs_boundary_chain moved = chains[root];
  size_t hole = root;
  for (size_t child; (child = 2 * hole + 1) < count; hole = child) {
    child += child + 1 < count && is_before(&chains[child], &chains[child + 1]);
    chains[hole] = chains[child];
  }
  for (size_t parent; hole > root && is_before(&chains[parent = (hole - 1) / 2], &moved);
       hole = parent)
    chains[hole] = chains[parent];
  chains[hole] = moved;
}

/* A heap sort: in place, without memory of its own, n log n always. */
void cs_boundary_sort(cs_boundary_set *set) {
  cs_boundary_chain *chains = set->chains;
  for (size_t i = set->chain_count / 2; i-- > 0;)
    sift_down(chains, i, set->chain_count);
  for (size_t i = set->chain_count; i-- > 1;) {
    cs_boundary_chain largest = chains[0];
    chains[0] = chains[i];
    chains[i] = largest;
    sift_down(chains, 0, i);
  }
}
