#include "engine/sample/node_row.h"

#include <math.h>

#include "base/vector.h"

/* How far a line between vertices may be from the nodes: half the tolerance of other lines. */
#define TOLERANCE (0.25f / 1023)
#define CONSTANT 3 /* this many equal neighbouring nodes become a line of their own */

/* The constant stretch that was looked for last, since it is asked for several times. */
typedef struct cs_node_stretch {
  int32_t from, end;
} stretch;

void cs_node_row_free(cs_node_polyline *polyline, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, polyline, at, constant);
  *polyline = (cs_node_polyline){0};
}

static void add_vertex(const cs_node_row *row, int32_t i, cs_node_polyline *out) {
  float(*values)[4] = out->values + out->count * (size_t)row->plane_count;
  for (int plane = 0; plane < row->plane_count; plane++)
    memcpy(values[plane], row->planes[plane][i], sizeof *values);
  out->at[out->count++] = i;
}

static inline bool is_constant(const cs_node_row *row, int planes, int32_t i) {
  for (int plane = 0; plane < planes; plane++)
    if (!cs_v4_same(cs_v4_load(row->planes[plane][i]), cs_v4_load(row->planes[plane][i + 1])))
      return false;
  return true;
}

/* The last node of the even group that begins with node i; i where none does. */
static inline int32_t even_end(const cs_node_row *row, int32_t i) {
  if ((uint32_t)i % CS_DEFOCUSED_GROUP != 0 || !row->even ||
      !row->even[(uint32_t)i / CS_DEFOCUSED_GROUP])
    return i;
  int32_t end = i + CS_DEFOCUSED_GROUP - 1;
  return end < row->last ? end : row->last;
}

/* Whether a constant stretch may begin with node i. */
static inline bool may_be_constant(const cs_node_row *row, int planes, int32_t i) {
  return even_end(row, i) > i || is_constant(row, planes, i);
}

static inline int32_t same_until(const cs_node_row *row, int planes, int32_t i) {
  int32_t end = even_end(row, i);
  while (end < row->last && is_constant(row, planes, end))
    end = even_end(row, end + 1);
  return end;
}

/* The last node of the constant stretch from i on; i where it is too short to count. */
static int32_t constant_end(const cs_node_row *row, int32_t i) {
  stretch *found = row->found;
  if (found->from == i)
    return found->end;
  int32_t end = row->plane_count == 1 ? same_until(row, 1, i) : same_until(row, 2, i);
  *found = (stretch){i, end - i >= CONSTANT || end == row->last ? end : i};
  return found->end;
}

/* The slopes that a line from a node on may have, so that it is near every node after it:
 *
 *     value                   . most
 *       |               . - '
 *       |         . - '  |               o  a node, and above and below it
 *       |    . ' |       o               |  how far a line may pass from it
 *       |  o     o       |
 *       |    ` . |                   each node narrows the slopes; the line ends at the
 *       |         ` - .              last node whose own slope is still among them
 *       |               ` - . least
 *       +--+-----+-------+-----> node
 */
typedef struct swing {
  cs_v4 least[2], most[2];
} swing;

/* Whether the line from node `from` to another node is near all nodes between them. If so, narrows
 * the range of slopes by the other node. across: the distance between the two nodes. */
static inline bool swing_admits(swing *s, const cs_node_row *row, int planes, int32_t from,
                                int32_t across) {
  float scale = 1 / (float)across;
  cs_v4 slack = cs_v4_all(TOLERANCE * scale);
  for (int plane = 0; plane < planes; plane++) {
    const float(*start)[4] = row->planes[plane] + from;
    cs_v4 slope = (cs_v4_load(start[across]) - cs_v4_load(start[0])) * scale;
    if (!cs_v4_is_between(slope, s->least[plane], s->most[plane]))
      return false;
    s->least[plane] = cs_v4_max(s->least[plane], slope - slack);
    s->most[plane] = cs_v4_min(s->most[plane], slope + slack);
  }
  return true;
}

/* The last node that a line from `from` may end at, or the first before it at which a constant
 * stretch begins. */
static inline int32_t swing_to(const cs_node_row *row, int planes, int32_t from) {
  swing s = {{cs_v4_all(-INFINITY), cs_v4_all(-INFINITY)},
             {cs_v4_all(INFINITY), cs_v4_all(INFINITY)}};
  for (int32_t i = from + 1; i <= row->last; i++) {
    if (!swing_admits(&s, row, planes, from, i - from))
      return i - 1;
    if (i < row->last && may_be_constant(row, planes, i) && constant_end(row, i) > i)
      return i;
  }
  return row->last;
}

/* The loop for one plane is nearly all of the time that is spent on rows of nodes. */
static int32_t swing_end(const cs_node_row *row, int32_t from) {
  return row->plane_count == 1 ? swing_to(row, 1, from) : swing_to(row, 2, from);
}

/* By how much the sum of the nodes between two nodes grows when a line takes their place. */
static cs_v4 light_added(const cs_node_row *row, int plane, int32_t from, int32_t to) {
  if (to - from == 1)
    return cs_v4_all(0);
  const float(*nodes)[4] = row->planes[plane];
  cs_v4 sum = cs_v4_all(0), ends = cs_v4_load(nodes[from]) + cs_v4_load(nodes[to]);
  for (int32_t i = from + 1; i < to; i++)
    sum += cs_v4_load(nodes[i]);
  return ends * (0.5f * (float)(to - from - 1)) - sum;
}

/* Whether a vertex keeps its value: at the ends of the row, and beside constant stretches. */
static bool is_fixed(const cs_node_polyline *polyline, size_t first, size_t k) {
  return k == first || k + 1 == polyline->count || polyline->constant[k - first] ||
         polyline->constant[k - first - 1];
}

/* Lines between nodes lie above a hollow and below a hill of the nodes between them. So that the
 * row keeps its light, the light that a line adds is subtracted from the values of its ends: half
 * from each, or all from one end if only this end may change. first: the first of the row's
 * vertices. */
static void balance(const cs_node_row *row, cs_node_polyline *polyline, size_t first) {
  size_t planes = (size_t)row->plane_count;
  for (size_t p = 0; p < planes; p++) {
    cs_v4 owed = cs_v4_all(0); /* to be subtracted for the line that ends in the vertex */
    bool moves_next = false;
    for (size_t k = first; k + 1 < polyline->count; k++) {
      bool moves = moves_next;
      moves_next = !is_fixed(polyline, first, k + 1);
      cs_v4 added = polyline->constant[k - first]
                        ? cs_v4_all(0)
                        : light_added(row, (int)p, polyline->at[k], polyline->at[k + 1]);
      cs_v4 here = moves_next ? 0.5f * added : added;
      if (moves) {
        float *value = polyline->values[k * planes + p];
        float wide = 0.5f * (float)(polyline->at[k + 1] - polyline->at[k - 1]);
        cs_v4_store(value, cs_v4_bounded(cs_v4_load(value) - (owed + here) * (1 / wide)));
      }
      owed = moves ? added - here : added;
    }
  }
}

celspan_status cs_node_row_append(celspan_context *context, cs_node_row *row,
                                  cs_node_polyline *out) {
  stretch found = {-1, -1};
  row->found = &found;
  size_t first = out->count, limit = first + (size_t)row->last + 1;
  CS_TRY(CS_ARRAY_RESERVE(context, out->at, limit));
  CS_TRY(CS_ARRAY_RESERVE(context, out->values, limit * (size_t)row->plane_count));
  CS_TRY(CS_ARRAY_RESERVE(context, out->constant, (size_t)row->last + 1));
  add_vertex(row, 0, out);
  for (int32_t i = 0; i < row->last;) {
    int32_t end = constant_end(row, i);
    out->constant[out->count - 1 - first] = end > i;
    i = end > i ? end : swing_end(row, i);
    add_vertex(row, i, out);
    if (row->is_split && !out->constant[out->count - 2 - first] && i + 1 < row->last &&
        constant_end(row, i) == i) {
      out->constant[out->count - 1 - first] = false;
      add_vertex(row, ++i, out);
    }
  }
  out->constant[out->count - 1 - first] = false;
  balance(row, out, first);
  return CELSPAN_OK;
}
