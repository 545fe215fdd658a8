#include "tools/trace/borders.h"

#include "inside/sort.h"

static inline bool is_before(const cs_node *a, const cs_node *b) {
  return a->y != b->y ? a->y < b->y : a->x < b->x;
}
CS_SORT_DEFINE(sort_nodes, cs_node, is_before)

typedef struct walker {
  celspan_context *context;
  const cs_material *material;
  const cs_regions *regions;
  cs_borders *out;
  /* by corner: 1: the side to the right is in a chain; 2: the side below is */
  unsigned char *walked;
} walker;

/* ---------------------------------------------------------------- corners */

/* The labels about a corner, clockwise from the top left. */
static void labels_about(const walker *w, int32_t x, int32_t y, unsigned char about[4]) {
  const unsigned char *below = cs_labels_at(w->material->labels, x, y);
  const unsigned char *above = below - w->material->labels->stride;
  about[0] = above[-1];
  about[1] = above[0];
  about[2] = below[0];
  about[3] = below[-1];
}

static bool is_node(const walker *w, int32_t x, int32_t y) {
  unsigned char a[4];
  labels_about(w, x, y, a);
  int sides = (a[0] != a[1]) + (a[1] != a[2]) + (a[2] != a[3]) + (a[3] != a[0]);
  return sides == 3 || (sides == 4 && cs_material_join(w->material, x, y) == CS_JOIN_NONE);
}

/* The direction in which a chain leaves a corner that is not a node; direction: in which it
 * arrived. */
static int go_on(const walker *w, int32_t x, int32_t y, int direction) {
  unsigned char a[4];
  labels_about(w, x, y, a);
  /* the labels around the corner, seen in that direction: behind and ahead, on the left and on the
   * right */
  unsigned char left_behind = a[direction], left = a[(direction + 1) % 4];
  unsigned char right = a[(direction + 2) % 4], right_behind = a[(direction + 3) % 4];
  bool turns_left = left_behind != left, turns_right = right_behind != right;
  if (turns_left && turns_right && left != right) {
    /* If the label behind on the left is joined with the label ahead on the right, the border turns
     * about the pixel between them. */
    bool is_joined = cs_material_join(w->material, x, y) == CS_JOIN_NW_SE;
    return (direction + (is_joined == (direction % 2 == 0) ? 1 : 3)) % 4;
  }
  return turns_left ? (direction + 3) % 4 : left != right ? direction : (direction + 1) % 4;
}

/* ---------------------------------------------------------------- nodes */

static celspan_status add_node(walker *w, int32_t x, int32_t y) {
  cs_borders *out = w->out;
  return CS_ARRAY_APPEND(w->context, out->nodes, out->node_count,
                         (cs_node){x, y, {CS_WAY_NONE, CS_WAY_NONE, CS_WAY_NONE, CS_WAY_NONE}});
}

static bool is_side(const walker *w, int32_t x, int32_t y) {
  const unsigned char *at = cs_labels_at(w->material->labels, x, y);
  return at[-1] != at[0];
}

/* Visits both ends of an upright side; every node is an end of such a side. The upper end of this
 * side is the lower end of the side above it, if there is one. */
static celspan_status find_nodes_at(walker *w, int32_t x, int32_t y) {
  if (!is_side(w, x, y - 1) && is_node(w, x, y))
    CS_TRY(add_node(w, x, y));
  return is_node(w, x, y + 1) ? add_node(w, x, y + 1) : CELSPAN_OK;
}

/* Calls `at` left of each run and at the end of each row. */
static celspan_status walk_rows(walker *w, celspan_status (*at)(walker *, int32_t x, int32_t y)) {
  const cs_regions *regions = w->regions;
  for (int32_t y = 0; y < regions->height; y++) {
    for (size_t i = regions->rows[y]; i < regions->rows[y + 1]; i++)
      CS_TRY(at(w, regions->runs[i].x0, y));
    CS_TRY(at(w, regions->width, y));
  }
  return CELSPAN_OK;
}

static celspan_status find_nodes(walker *w) {
  CS_TRY(walk_rows(w, find_nodes_at));
  sort_nodes(w->out->nodes, w->out->node_count);
  return CELSPAN_OK;
}

static uint32_t node_at(const cs_borders *borders, int32_t x, int32_t y) {
  const cs_node sought = {.x = x, .y = y};
  size_t low = 0, high = borders->node_count;
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (is_before(&borders->nodes[middle], &sought))
      low = middle + 1;
    else
      high = middle;
  }
  bool is_found =
      low < borders->node_count && borders->nodes[low].x == x && borders->nodes[low].y == y;
  return is_found ? (uint32_t)low : CS_NODE_NONE;
}

/* ---------------------------------------------------------------- chains */

/* The mark of a side: it belongs to the left or upper corner of the side. */
static unsigned char *mark_of(const walker *w, int32_t x, int32_t y, int direction,
                              unsigned char *bit) {
  x -= direction == 2;
  y -= direction == 3;
  *bit = direction % 2 == 0 ? 1 : 2;
  return w->walked + (size_t)y * ((size_t)w->regions->width + 1) + (size_t)x;
}

static bool is_walked(const walker *w, int32_t x, int32_t y, int direction) {
  unsigned char bit;
  const unsigned char *mark = mark_of(w, x, y, direction, &bit);
  return (*mark & bit) != 0;
}

static celspan_status add_direction(walker *w, int32_t x, int32_t y, int direction) {
  cs_borders *out = w->out;
  unsigned char bit;
  CS_TRY(CS_ARRAY_RESERVE(w->context, out->directions, out->direction_count + 1));
  out->directions[out->direction_count++] = (unsigned char)direction;
  unsigned char *mark = mark_of(w, x, y, direction, &bit);
  *mark |= bit;
  return CELSPAN_OK;
}

static uint32_t region_beside(const walker *w, int32_t x, int32_t y, int direction, bool is_left) {
  bool is_up = is_left ? direction == 0 || direction == 3 : direction == 3 || direction == 2;
  bool is_back = is_left ? direction == 2 || direction == 3 : direction == 1 || direction == 2;
  return cs_regions_at(w->regions, x - is_back, y - is_up);
}

/* From a corner to the next node, or once around a closed chain. */
static celspan_status walk(walker *w, cs_chain *chain, int direction) {
  int32_t x = chain->x, y = chain->y;
  int begun = direction;
  for (;;) {
    CS_TRY(add_direction(w, x, y, direction));
    x += cs_border_x(direction);
    y += cs_border_y(direction);
    if (is_node(w, x, y)) {
      chain->to = node_at(w->out, x, y);
      break;
    }
    direction = go_on(w, x, y, direction);
    if (x == chain->x && y == chain->y && direction == begun)
      break;
  }
  chain->count = (uint32_t)(w->out->direction_count - chain->first);
  return CELSPAN_OK;
}

static celspan_status add_chain(walker *w, int32_t x, int32_t y, int direction, uint32_t from) {
  cs_borders *out = w->out;
  cs_chain chain = {
      .x = x, .y = y, .first = out->direction_count, .from = from, .to = CS_NODE_NONE};
  chain.left = region_beside(w, x, y, direction, true);
  chain.right = region_beside(w, x, y, direction, false);
  CS_TRY(walk(w, &chain, direction));
  CS_TRY(CS_ARRAY_RESERVE(w->context, out->chains, out->chain_count + 1));
  cs_way way = (cs_way)(2 * out->chain_count);
  out->chains[out->chain_count++] = chain;
  if (from == CS_NODE_NONE)
    return CELSPAN_OK;
  int last = out->directions[out->direction_count - 1];
  out->nodes[from].out[direction] = way;
  out->nodes[chain.to].out[(last + 2) % 4] = way + 1;
  return CELSPAN_OK;
}

/* Whether a border leaves a corner in a direction: if so, the pixels on both sides differ. */
static bool departs(const walker *w, int32_t x, int32_t y, int direction) {
  unsigned char a[4];
  labels_about(w, x, y, a);
  return a[(direction + 1) % 4] != a[(direction + 2) % 4];
}

static celspan_status walk_from_nodes(walker *w) {
  for (uint32_t i = 0; i < w->out->node_count; i++)
    for (int direction = 0; direction < 4; direction++) {
      int32_t x = w->out->nodes[i].x, y = w->out->nodes[i].y;
      if (departs(w, x, y, direction) && !is_walked(w, x, y, direction))
        CS_TRY(add_chain(w, x, y, direction, i));
    }
  return CELSPAN_OK;
}

static celspan_status walk_closed_at(walker *w, int32_t x, int32_t y) {
  return is_walked(w, x, y, 1) ? CELSPAN_OK : add_chain(w, x, y, 1, CS_NODE_NONE);
}

/* The remaining chains have no node. Every closed chain has an upright side. */
static celspan_status walk_closed(walker *w) { return walk_rows(w, walk_closed_at); }

celspan_status cs_borders_make(celspan_context *context, const cs_material *material,
                               const cs_regions *regions, cs_borders *out) {
  size_t corners = ((size_t)regions->width + 1) * ((size_t)regions->height + 1);
  walker w = {context, material, regions, out, cs_mem_array(context->memory, corners, 1)};
  *out = (cs_borders){.nodes = NULL};
  if (!w.walked)
    return cs_fail_memory(context);
  celspan_status status = find_nodes(&w);
  if (status == CELSPAN_OK)
    status = walk_from_nodes(&w);
  if (status == CELSPAN_OK)
    status = walk_closed(&w);
  cs_mem_free(context->memory, w.walked, corners);
  return status;
}

void cs_borders_finish(cs_borders *borders, celspan_context *context) {
  CS_ARRAYS_FREE(context->memory, borders, nodes, directions);
  *borders = (cs_borders){.nodes = NULL};
}
