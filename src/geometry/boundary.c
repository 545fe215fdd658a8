#include "geometry/boundary.h"

#include <math.h>
#include <string.h>

#include "geometry/matrix.h"
#include "geometry/polyline.h"

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

static void sift_down(cs_boundary_chain *chains, size_t root, size_t count) {
  cs_boundary_chain moved = chains[root];
  for (size_t child; (child = 2 * root + 1) < count; root = child) {
    if (child + 1 < count && is_before(&chains[child], &chains[child + 1]))
      child++;
    if (!is_before(&moved, &chains[child]))
      break;
    chains[root] = chains[child];
  }
  chains[root] = moved;
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

/* ---------------------------------------------------------------- walks */

/* Makes the segment that the walk names the current one; its group has been made. */
static inline void copy_segment(cs_boundary_walk *walk) {
  const cs_boundary_group *made = &walk->made;
  uint32_t at = walk->segment;
  walk->x0 = made->x[at];
  walk->y0 = made->y[at];
  walk->x1 = made->x[at + 1];
  walk->y1 = made->y[at + 1];
  walk->slope = made->slope[at];
  walk->curve = made->curve[at];
}

/* leaps: false where the group is not the first one of its leap, whose arc has then been rejected.
 */
static void begin_group(const cs_boundary_set *set, cs_boundary_walk *walk, uint32_t group,
                        bool leaps) {
  cs_polyline_group(set, &set->pieces[walk->piece], group, leaps, &walk->made);
  walk->group = walk->made.first;
  walk->segment = 0;
}

bool cs_boundary_next(const cs_boundary_set *set, cs_boundary_walk *walk) {
  const cs_boundary_chain *chain = &set->chains[walk->chain];
  const cs_boundary_piece *piece = &set->pieces[walk->piece];
  if (walk->segment + 1 < walk->made.count) {
    walk->segment++;
  } else if ((walk->group + walk->made.groups) * piece->group < piece->chords) {
    uint32_t group = walk->group + walk->made.groups;
    begin_group(set, walk, group, group % piece->leap == 0);
  } else if (walk->piece + 1 < chain->piece + chain->piece_count) {
    walk->piece++;
    begin_group(set, walk, 0, true);
  } else {
    return false;
  }
  copy_segment(walk);
  return true;
}

/* The first piece of the chain that ends below y. */
static uint32_t find_piece(const cs_boundary_set *set, const cs_boundary_chain *chain, double y) {
  uint32_t low = chain->piece, high = chain->piece + chain->piece_count - 1;
  while (low < high) {
    uint32_t middle = low + (high - low) / 2;
    if (set->pieces[middle].y1 > y)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

/* A group at or before the first one of the piece that ends below y. Half a pixel of margin,
 * because the end of a group may have been moved to a whole height. */
static uint32_t find_group(const cs_boundary_set *set, const cs_boundary_piece *piece, double y) {
  double rounding = 1e-10 * (1 + fabs(piece->y0) + fabs(piece->y1)), safe = y - 0.5 - rounding;
  uint32_t low = 0, high = piece->chords / piece->group - 1;
  while (low < high) {
    uint32_t middle = low + (high - low) / 2;
    if (cs_polyline_plain(set, piece, (middle + 1) * piece->group).y > safe)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

void cs_boundary_start(const cs_boundary_set *set, uint32_t chain, double y,
                       cs_boundary_walk *walk) {
  walk->chain = chain;
  walk->piece = find_piece(set, &set->chains[chain], y);
  begin_group(set, walk, find_group(set, &set->pieces[walk->piece], y), true);
  copy_segment(walk);
  while (walk->y1 <= y && cs_boundary_next(set, walk)) {
  }
}
