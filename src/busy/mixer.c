#include "busy/mixer.h"

#include "paint/colours.h"

#include <math.h>

/* Where a tangle has more than CS_SIDE_TANGLE sides, the slab is cut where two of them cross, and so
 * on, so often at most. */
#define CUTS 32

void cs_mixer_init(cs_mixer *mixer, const cs_row_tools *tools, const cs_units *units,
                   const cs_columns *columns) {
  *mixer = (cs_mixer){
      .composer = tools->composer, .painter = tools->painter, .units = units, .columns = columns};
}

void cs_mixer_finish(cs_mixer *mixer, cs_memory *memory) {
  cs_mem_free(memory, mixer->events, mixer->event_capacity * sizeof *mixer->events);
  cs_mem_free(memory, mixer->sides, mixer->capacity * sizeof *mixer->sides);
  cs_mem_free(memory, mixer->heights, mixer->height_capacity * sizeof *mixer->heights);
  cs_mem_free(memory, mixer->present, mixer->present_capacity * sizeof *mixer->present);
  *mixer = (cs_mixer){0};
}

/* ---------------------------------------------------------------- events */

static celspan_status add_event(cs_mixer *mixer, double y, uint32_t layer, int32_t change) {
  for (size_t i = 0; i < mixer->event_count; i++) {
    cs_event *event = &mixer->events[i];
    if (event->layer == layer && event->y == y) {
      event->change += change;
      if (event->change == 0)
        *event = mixer->events[--mixer->event_count];
      return CELSPAN_OK;
    }
  }
  CS_TRY(cs_mem_reserve(mixer->composer->context, (void **)&mixer->events, &mixer->event_capacity,
                        mixer->event_count + 1, sizeof *mixer->events));
  mixer->events[mixer->event_count++] = (cs_event){y, layer, change};
  return CELSPAN_OK;
}

celspan_status cs_mixer_pass(cs_mixer *mixer, const cs_unit *unit) {
  if (unit->y0 > 0)
    CS_TRY(add_event(mixer, unit->y0, unit->layer, unit->direction));
  return unit->y1 < 1 ? add_event(mixer, unit->y1, unit->layer, -unit->direction) : CELSPAN_OK;
}

/* Whether a layer is seen where `cover` hides all behind it. */
static inline bool is_visible(uint32_t layer, uint32_t cover) {
  return cover == CS_STACK_NONE || layer >= cover;
}

bool cs_mixer_has_events(const cs_mixer *mixer, const cs_cell *cell) {
  for (size_t i = 0; i < mixer->event_count; i++)
    if (is_visible(mixer->events[i].layer, cell->cover))
      return true;
  return false;
}

/* ---------------------------------------------------------------- parts of the pixel */

static celspan_status colour_of(cs_mixer *mixer, const cs_cell *cell, cs_v4 *colour) {
  *colour = cell->colour;
  if (cell->length == 0)
    return CELSPAN_OK;
  const cs_run run = {mixer->column, mixer->column + 1, mixer->centre};
  float rgba[1][4];
  mixer->varies = true;
  CS_TRY(cs_painter_colours(mixer->painter, cell, run, rgba));
  *colour = cs_v4_load(rgba[0]);
  return CELSPAN_OK;
}

/* A part of the pixel shows the cell at the state of the composer. */
static celspan_status add_part(cs_mixer *mixer, double share) {
  if (share == 0 || cs_set_hash_same(mixer->hash, mixer->composer->hash))
    return CELSPAN_OK;
  cs_cell cell;
  cs_v4 colour;
  cs_composer_cell(mixer->composer, &cell);
  CS_TRY(colour_of(mixer, &cell, &colour));
  cs_v4d step = cs_v4d_step(mixer->base, colour);
  mixer->sum = cs_v4d_add(mixer->sum, cs_v4d_scale(share, step));
  return CELSPAN_OK;
}

static inline void cross(cs_mixer *mixer, const cs_side *side) {
  cs_composer_cross(mixer->composer, side->layer, side->change);
}

static inline void cross_back(cs_mixer *mixer, const cs_side *side) {
  cs_composer_cross(mixer->composer, side->layer, -side->change);
}

/* ---------------------------------------------------------------- tangles */

/* areas[set]: of what lies right of all units of the set, becomes that of what lies right of just
 * these. */
static void separate(double *areas, int count) {
  for (int i = 0; i < count; i++)
    for (unsigned set = 0; set < 1u << count; set++)
      if (!(set >> i & 1))
        areas[set] -= areas[set | 1u << i];
}

/* Adds the parts of a tangle that are not right of all of it, and crosses it. *rest: the area right
 * of all units further left; becomes what of it is right of the tangle, too. */
static celspan_status add_tangle(cs_mixer *mixer, const cs_present *tangle, int count,
                                 const cs_slab *in, double *rest) {
  double areas[1 << CS_SIDE_TANGLE];
  unsigned all = (1u << count) - 1, at = 0;
  areas[0] = *rest;
  for (unsigned set = 1; set <= all; set++)
    areas[set] = set & (set - 1) ? cs_side_area_right(mixer->column, tangle, set, in)
                                 : tangle[__builtin_ctz(set)].right;
  *rest = areas[all];
  separate(areas, count);
  for (unsigned step = 0; step <= all; step++) { /* in Gray's order: one crossing from set to set */
    unsigned set = step ^ step >> 1, change = set ^ at;
    if (change != 0)
      (set & change ? cross : cross_back)(mixer, tangle[__builtin_ctz(change)].side);
    at = set;
    if (set != all)
      CS_TRY(add_part(mixer, areas[set]));
  }
  for (int i = 0; i < count; i++)
    if (!(at >> i & 1))
      cross(mixer, tangle[i].side);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- one and two */

static celspan_status mix_one(cs_mixer *mixer, const cs_side *a) {
  cross(mixer, a);
  celspan_status status = add_part(mixer, a->area);
  cross_back(mixer, a);
  return status;
}

/* Whether one unit is left of another one at all heights of that. */
static inline bool is_beside(const cs_side *a, const cs_side *b) {
  return a->high <= b->low && a->y0 <= b->y0 && a->y1 >= b->y1;
}

/* The area that lies on both sides. */
static double area_of_both(const cs_mixer *mixer, const cs_side *a, const cs_side *b) {
  if (is_beside(a, b))
    return b->area;
  if (is_beside(b, a))
    return a->area;
  const cs_slab shared = {a->y0 > b->y0 ? a->y0 : b->y0, a->y1 < b->y1 ? a->y1 : b->y1};
  if (shared.foot <= shared.top)
    return 0;
  cs_present pair[2] = {{a, cs_side_area(mixer->column, a, &shared), 0},
                        {b, cs_side_area(mixer->column, b, &shared), 0}};
  if (cs_side_is_before(&pair[1], &pair[0])) {
    cs_present first = pair[1];
    pair[1] = pair[0];
    pair[0] = first;
  }
  return cs_side_is_left(&pair[0], &pair[1], &shared)
             ? pair[1].right
             : cs_side_area_right(mixer->column, pair, 3, &shared);
}

static celspan_status mix_two(cs_mixer *mixer, const cs_side *a, const cs_side *b) {
  double both = area_of_both(mixer, a, b);
  cross(mixer, a);
  celspan_status status = add_part(mixer, a->area - both);
  cross(mixer, b);
  if (status == CELSPAN_OK)
    status = add_part(mixer, both);
  cross_back(mixer, a);
  if (status == CELSPAN_OK)
    status = add_part(mixer, b->area - both);
  cross_back(mixer, b);
  return status;
}

/* ---------------------------------------------------------------- slabs */

/* Puts the sides of a slab in order; their number. */
static size_t order_slab(cs_mixer *mixer, const cs_slab *in) {
  size_t count = 0;
  for (size_t i = 0; i < mixer->count; i++) {
    const cs_side *side = &mixer->sides[i];
    if (side->y0 > in->top || side->y1 < in->foot)
      continue;
    cs_present present = {side, cs_side_area(mixer->column, side, in), 0};
    size_t k = count++;
    for (; k > 0 && cs_side_is_before(&present, &mixer->present[k - 1]); k--)
      mixer->present[k] = mixer->present[k - 1];
    mixer->present[k] = present;
  }
  return count;
}

/* Whether a side crosses any of those from first to end - 1, which are left of it on the whole. */
static bool is_tangled(const cs_present *present, size_t first, size_t end, size_t side,
                       const cs_slab *in) {
  for (size_t i = end; i-- > first;)
    if (!cs_side_is_left(&present[i], &present[side], in))
      return true;
  return false;
}

/* Finds the tangles of a slab. A side that is right of all of a tangle is right of all before that
 * tangle, too; but one that joins a tangle may cross what is before it. */
static void find_tangles(cs_present *present, size_t count, const cs_slab *in) {
  for (size_t side = 0; side < count; side++) {
    size_t first = side, before;
    while (first > 0 &&
           (before = present[first - 1].first, is_tangled(present, before, first, side, in)))
      first = before;
    for (size_t i = first; i <= side; i++)
      present[i].first = first;
  }
}

/* The crossing of neighbours in a tangle that is nearest to the middle of its slab. */
static void find_cut(const cs_present *tangle, size_t count, const cs_slab *in, double *cut) {
  double middle = 0.5 * (in->top + in->foot);
  for (size_t i = 1; i < count; i++) {
    double crossing = cs_side_intersection(&tangle[i - 1], &tangle[i], in);
    if (crossing < in->foot && fabs(crossing - middle) < fabs(*cut - middle))
      *cut = crossing;
  }
}

/* Where a tangle of a slab is too large: the height of a crossing in it, at which its slab is cut;
 * the foot of the slab if there is none. */
static double find_large(const cs_present *present, size_t count, const cs_slab *in) {
  double cut = in->foot;
  for (size_t end = count, first; end > 0; end = first) {
    first = present[end - 1].first;
    if (end - first > CS_SIDE_TANGLE)
      find_cut(present + first, end - first, in, &cut);
  }
  return cut;
}

/* Adds the parts between the sides of a slab, from left to right. Tangles that are too large are
 * taken as if nothing crossed in them. */
static celspan_status add_parts(cs_mixer *mixer, size_t count, const cs_slab *in) {
  const cs_present *present = mixer->present;
  double rest = in->foot - in->top;
  celspan_status status = CELSPAN_OK;
  size_t first = 0;
  for (size_t end; status == CELSPAN_OK && first < count; first = end) {
    end = first + 1;
    while (end < count && present[end].first == first && end - first < CS_SIDE_TANGLE)
      end++;
    if (end < count && present[end].first == first)
      end = first + 1;
    status = add_tangle(mixer, present + first, (int)(end - first), in, &rest);
  }
  if (status == CELSPAN_OK)
    status = add_part(mixer, rest);
  while (first-- > 0)
    cross_back(mixer, present[first].side);
  return status;
}

static celspan_status mix_slab(cs_mixer *mixer, const cs_slab *in, int cuts) {
  size_t count = order_slab(mixer, in);
  find_tangles(mixer->present, count, in);
  double cut = cuts > 0 ? find_large(mixer->present, count, in) : in->foot;
  if (cut == in->foot)
    return add_parts(mixer, count, in);
  const cs_slab above = {in->top, cut}, below = {cut, in->foot};
  CS_TRY(mix_slab(mixer, &above, cuts - 1));
  return mix_slab(mixer, &below, cuts - 1);
}

static void put_height(cs_mixer *mixer, double y) {
  size_t k = mixer->height_count;
  while (k > 0 && mixer->heights[k - 1] > y)
    k--;
  if (k > 0 && mixer->heights[k - 1] == y)
    return;
  memmove(mixer->heights + k + 1, mixer->heights + k,
          (mixer->height_count - k) * sizeof *mixer->heights);
  mixer->heights[k] = y;
  mixer->height_count++;
}

static celspan_status find_heights(cs_mixer *mixer) {
  celspan_context *context = mixer->composer->context;
  CS_TRY(cs_mem_reserve(context, (void **)&mixer->heights, &mixer->height_capacity,
                        2 * mixer->count + 2, sizeof *mixer->heights));
  CS_TRY(cs_mem_reserve(context, (void **)&mixer->present, &mixer->present_capacity, mixer->count,
                        sizeof *mixer->present));
  mixer->heights[0] = 0;
  mixer->heights[1] = 1;
  mixer->height_count = 2;
  for (size_t i = 0; i < mixer->count; i++) {
    put_height(mixer, mixer->sides[i].y0);
    put_height(mixer, mixer->sides[i].y1);
  }
  return CELSPAN_OK;
}

static celspan_status mix_slabs(cs_mixer *mixer) {
  CS_TRY(find_heights(mixer));
  for (size_t i = 1; i < mixer->height_count; i++) {
    const cs_slab whole = {mixer->heights[i - 1], mixer->heights[i]};
    CS_TRY(mix_slab(mixer, &whole, CUTS));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- pixels */

/* A layer covers what is behind it only where it is all over the pixel. */
static uint32_t find_cover(const cs_mixer *mixer, uint32_t cover, uint32_t head) {
  for (uint32_t k = head; k != 0; k = mixer->columns->nodes[k].next)
    if (mixer->units->units[mixer->columns->nodes[k].unit].layer == cover)
      return CS_STACK_NONE;
  for (size_t i = 0; i < mixer->event_count; i++)
    if (mixer->events[i].layer == cover)
      return CS_STACK_NONE;
  return cover;
}

static void put_unit(cs_mixer *mixer, const cs_unit *unit, double area) {
  mixer->sides[mixer->count++] = (cs_side){.points = cs_units_points(mixer->units, unit),
                                           .count = unit->count,
                                           .layer = unit->layer,
                                           .change = unit->direction,
                                           .y0 = unit->y0,
                                           .y1 = unit->y1,
                                           .low = unit->low,
                                           .high = unit->high,
                                           .area = area};
}

static void put_event(cs_mixer *mixer, const cs_event *event) {
  mixer->sides[mixer->count++] = (cs_side){.layer = event->layer,
                                           .change = event->change,
                                           .y0 = event->y,
                                           .y1 = 1,
                                           .low = -INFINITY,
                                           .high = -INFINITY,
                                           .area = 1 - event->y};
}

/* The units and events of the pixel that are not hidden. */
static celspan_status collect(cs_mixer *mixer, uint32_t head) {
  size_t most = mixer->event_count;
  for (uint32_t k = head; k != 0; k = mixer->columns->nodes[k].next)
    most++;
  CS_TRY(cs_mem_reserve(mixer->composer->context, (void **)&mixer->sides, &mixer->capacity, most,
                        sizeof *mixer->sides));
  mixer->count = 0;
  for (uint32_t k = head; k != 0; k = mixer->columns->nodes[k].next) {
    const cs_node *node = &mixer->columns->nodes[k];
    const cs_unit *unit = &mixer->units->units[node->unit];
    if (is_visible(unit->layer, mixer->cover))
      put_unit(mixer, unit, node->area);
  }
  for (size_t i = 0; i < mixer->event_count; i++)
    if (is_visible(mixer->events[i].layer, mixer->cover))
      put_event(mixer, &mixer->events[i]);
  return CELSPAN_OK;
}

static celspan_status mix(cs_mixer *mixer) {
  const cs_side *sides = mixer->sides;
  return mixer->count == 0   ? CELSPAN_OK
         : mixer->count == 1 ? mix_one(mixer, &sides[0])
         : mixer->count == 2 ? mix_two(mixer, &sides[0], &sides[1])
                             : mix_slabs(mixer);
}

celspan_status cs_mixer_colour(cs_mixer *mixer, int32_t column, const cs_cell *cell, uint32_t head,
                               cs_v4 *colour) {
  mixer->column = column;
  mixer->hash = mixer->composer->hash;
  mixer->varies = false;
  mixer->sum = cs_v4_wide(cs_v4_all(0));
  mixer->cover = find_cover(mixer, cell->cover, head);
  CS_TRY(colour_of(mixer, cell, &mixer->base));
  CS_TRY(collect(mixer, head));
  CS_TRY(mix(mixer));
  *colour = cs_v4_bounded(cs_v4_narrow(cs_v4d_add(cs_v4_wide(mixer->base), mixer->sum)));
  return CELSPAN_OK;
}
