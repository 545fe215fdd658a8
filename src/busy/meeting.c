#include "busy/meeting.h"

#include "area/edges.h"
#include "paint/colours.h"

/* Units in one tangle: the areas right of all sets of them are measured one by one. Where there are
 * more, the slab is cut where two of them cross, and so on, so often at most. */
#define TANGLE 4
#define CUTS 32
/* Units that cross by less than this, in pixels, are taken as if they only touched: it is far less
 * than any colour shows, and far more than the errors of rounding. */
#define TOUCHING 0x1p-20

/* A side in a slab, and the area right of it there. */
typedef struct cs_present {
  const cs_side *side;
  double right;
  size_t first; /* the number of the leftmost side of its tangle */
} cs_present;

/* A part of the pixel's height through which all units go that are in it. */
typedef struct slab {
  double top, foot;
} slab;

void cs_meeting_init(cs_meeting *meeting, const cs_row_tools *tools, const cs_units *units,
                     const cs_columns *columns) {
  *meeting = (cs_meeting){
      .composer = tools->composer, .painter = tools->painter, .units = units, .columns = columns};
}

void cs_meeting_finish(cs_meeting *meeting, cs_memory *memory) {
  cs_mem_free(memory, meeting->events, meeting->event_capacity * sizeof *meeting->events);
  cs_mem_free(memory, meeting->sides, meeting->capacity * sizeof *meeting->sides);
  cs_mem_free(memory, meeting->heights, meeting->height_capacity * sizeof *meeting->heights);
  cs_mem_free(memory, meeting->present, meeting->present_capacity * sizeof *meeting->present);
  *meeting = (cs_meeting){0};
}

/* ---------------------------------------------------------------- events */

static celspan_status add_event(cs_meeting *meeting, double y, uint32_t layer, int32_t change) {
  for (size_t i = 0; i < meeting->event_count; i++) {
    cs_event *event = &meeting->events[i];
    if (event->layer == layer && event->y == y) {
      event->change += change;
      if (event->change == 0)
        *event = meeting->events[--meeting->event_count];
      return CELSPAN_OK;
    }
  }
  CS_TRY(cs_mem_reserve(meeting->composer->context, (void **)&meeting->events,
                        &meeting->event_capacity, meeting->event_count + 1,
                        sizeof *meeting->events));
  meeting->events[meeting->event_count++] = (cs_event){y, layer, change};
  return CELSPAN_OK;
}

celspan_status cs_meeting_pass(cs_meeting *meeting, const cs_unit *unit) {
  if (unit->y0 > 0)
    CS_TRY(add_event(meeting, unit->y0, unit->layer, unit->direction));
  return unit->y1 < 1 ? add_event(meeting, unit->y1, unit->layer, -unit->direction) : CELSPAN_OK;
}

/* Whether a layer is seen where `cover` hides all behind it. */
static inline bool is_seen(uint32_t layer, uint32_t cover) {
  return cover == CS_STACK_NONE || layer >= cover;
}

bool cs_meeting_has_events(const cs_meeting *meeting, const cs_cell *cell) {
  for (size_t i = 0; i < meeting->event_count; i++)
    if (is_seen(meeting->events[i].layer, cell->cover))
      return true;
  return false;
}

/* ---------------------------------------------------------------- parts of the pixel */

static celspan_status colour_of(cs_meeting *meeting, const cs_cell *cell, cs_v4 *colour) {
  *colour = cell->colour;
  if (cell->length == 0)
    return CELSPAN_OK;
  const cs_run run = {meeting->column, meeting->column + 1, meeting->centre};
  float rgba[1][4];
  meeting->varies = true;
  CS_TRY(cs_painter_colours(meeting->painter, cell, run, rgba));
  *colour = cs_v4_load(rgba[0]);
  return CELSPAN_OK;
}

/* A part of the pixel shows the cell at the state of the composer. */
static celspan_status add_part(cs_meeting *meeting, double share) {
  if (share == 0 || cs_set_hash_same(meeting->hash, meeting->composer->hash))
    return CELSPAN_OK;
  cs_cell cell;
  cs_v4 colour;
  cs_composer_cell(meeting->composer, &cell);
  CS_TRY(colour_of(meeting, &cell, &colour));
  cs_v4d step = cs_v4d_step(meeting->base, colour);
  meeting->sum = cs_v4d_add(meeting->sum, cs_v4d_scale(share, step));
  return CELSPAN_OK;
}

static inline void cross(cs_meeting *meeting, const cs_side *side) {
  cs_composer_cross(meeting->composer, side->layer, side->change);
}

static inline void cross_back(cs_meeting *meeting, const cs_side *side) {
  cs_composer_cross(meeting->composer, side->layer, -side->change);
}

/* ---------------------------------------------------------------- places on units */

/* x at a height of the piece that begins at a point. */
static inline double x_at(const celspan_point *above, double y) {
  const celspan_point *below = above + 1;
  if (y == above->y)
    return above->x;
  if (y == below->y)
    return below->x;
  return above->x + (y - above->y) * ((below->x - above->x) / (below->y - above->y));
}

/* The piece of a unit that goes on below a height. */
static inline const celspan_point *piece_below(const celspan_point *piece, double y) {
  while (piece[1].y <= y)
    piece++;
  return piece;
}

/* The area of a side in a slab of the pixel. */
static double area_in(const cs_meeting *meeting, const cs_side *side, const slab *in) {
  if (!side->points)
    return in->foot - in->top;
  if (side->y0 == in->top && side->y1 == in->foot)
    return side->area;
  double area = 0;
  const celspan_point *piece = side->points;
  for (double y = in->top, end; y < in->foot; y = end) {
    piece = piece_below(piece, y);
    end = piece[1].y < in->foot ? piece[1].y : in->foot;
    area += cs_edges_cover(x_at(piece, y), x_at(piece, end), end - y, meeting->column);
  }
  return area;
}

/* Whether one side is nowhere right of another one in a slab, as far as the pixel shows. */
static bool is_left(const cs_present *a, const cs_present *b, const slab *in) {
  if (a->right >= in->foot - in->top || b->right <= 0 || a->side->high <= b->side->low)
    return true;
  const celspan_point *pa = a->side->points, *pb = b->side->points;
  for (double y = in->top, end; y < in->foot; y = end) {
    pa = piece_below(pa, y);
    pb = piece_below(pb, y);
    end = pa[1].y < pb[1].y ? pa[1].y : pb[1].y;
    end = end < in->foot ? end : in->foot;
    double before = x_at(pa, y) - x_at(pb, y), after = x_at(pa, end) - x_at(pb, end);
    if (before > TOUCHING || after > TOUCHING)
      return false;
  }
  return true;
}

/* The height inside a slab at which two units cross first; the foot of the slab: there is none. */
static double find_crossing(const cs_present *a, const cs_present *b, const slab *in) {
  const celspan_point *pa = a->side->points, *pb = b->side->points;
  double last = 0; /* how far they were apart when they were last apart */
  for (double y = in->top, end; y < in->foot; y = end) {
    pa = piece_below(pa, y);
    pb = piece_below(pb, y);
    end = pa[1].y < pb[1].y ? pa[1].y : pb[1].y;
    end = end < in->foot ? end : in->foot;
    double before = x_at(pa, y) - x_at(pb, y), after = x_at(pa, end) - x_at(pb, end);
    last = before != 0 ? before : last;
    if (last * after < 0) {
      double at = before == 0 ? y : y + (end - y) * (before / (before - after));
      at = cs_edges_round(at);
      return at > in->top ? at : in->foot;
    }
  }
  return in->foot;
}

/* In order from left to right: by area, then by anything that tells apart what is not the same. */
static bool is_before(const cs_present *a, const cs_present *b) {
  if (a->right != b->right || !a->side->points || !b->side->points)
    return a->right > b->right;
  uint32_t count = a->side->count < b->side->count ? a->side->count : b->side->count;
  int order = memcmp(a->side->points, b->side->points, count * sizeof *a->side->points);
  return order != 0 ? order < 0 : a->side->count < b->side->count;
}

/* ---------------------------------------------------------------- tangles */

/* Straight lines between two heights. */
typedef struct lines {
  double x0[TANGLE], x1[TANGLE];
  int count;
} lines;

static inline double x_between(const lines *l, int i, double part) {
  return part >= 1 ? l->x1[i] : l->x0[i] + part * (l->x1[i] - l->x0[i]);
}

/* The share of the height, after `part`, at which another line overtakes the rightmost one; 1 when
 * none does. *by: which. */
static double find_overtaking(const lines *l, int rightmost, double part, int *by) {
  double earliest = 1;
  for (int i = 0; i < l->count; i++) {
    double before = l->x0[rightmost] - l->x0[i], after = l->x1[rightmost] - l->x1[i];
    if (after >= 0 || before <= after)
      continue;
    double share = before / (before - after);
    share = share > part ? share : part;
    if (share < earliest) {
      earliest = share;
      *by = i;
    }
  }
  return earliest;
}

/* The area right of all lines: right of the rightmost one at each height. */
static double area_right_of(const lines *l, double height, int32_t column) {
  int rightmost = 0;
  for (int i = 1; i < l->count; i++)
    if (l->x0[i] > l->x0[rightmost] ||
        (l->x0[i] == l->x0[rightmost] && l->x1[i] > l->x1[rightmost]))
      rightmost = i;
  double area = 0;
  for (double part = 0; part < 1;) {
    int by = rightmost;
    double end = find_overtaking(l, rightmost, part, &by);
    area += cs_edges_cover(x_between(l, rightmost, part), x_between(l, rightmost, end),
                           height * (end - part), column);
    rightmost = by;
    part = end;
  }
  return area;
}

/* The area right of all units of a set, in a slab. */
static double area_right_of_set(const cs_meeting *meeting, const cs_present *tangle, unsigned set,
                                const slab *in) {
  const celspan_point *pieces[TANGLE];
  int count = 0;
  for (int i = 0; set >> i; i++)
    if (set >> i & 1)
      pieces[count++] = tangle[i].side->points;
  double area = 0;
  for (double y = in->top; y < in->foot;) {
    lines l = {.count = count};
    double end = in->foot;
    for (int i = 0; i < count; i++) {
      pieces[i] = piece_below(pieces[i], y);
      end = pieces[i][1].y < end ? pieces[i][1].y : end;
    }
    for (int i = 0; i < count; i++) {
      l.x0[i] = x_at(pieces[i], y);
      l.x1[i] = x_at(pieces[i], end);
    }
    area += area_right_of(&l, end - y, meeting->column);
    y = end;
  }
  return area;
}

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
static celspan_status add_tangle(cs_meeting *meeting, const cs_present *tangle, int count,
                                 const slab *in, double *rest) {
  double areas[1 << TANGLE];
  unsigned all = (1u << count) - 1, at = 0;
  areas[0] = *rest;
  for (unsigned set = 1; set <= all; set++)
    areas[set] = set & (set - 1) ? area_right_of_set(meeting, tangle, set, in)
                                 : tangle[__builtin_ctz(set)].right;
  *rest = areas[all];
  separate(areas, count);
  for (unsigned step = 0; step <= all; step++) { /* in Gray's order: one crossing from set to set */
    unsigned set = step ^ step >> 1, change = set ^ at;
    if (change != 0)
      (set & change ? cross : cross_back)(meeting, tangle[__builtin_ctz(change)].side);
    at = set;
    if (set != all)
      CS_TRY(add_part(meeting, areas[set]));
  }
  for (int i = 0; i < count; i++)
    if (!(at >> i & 1))
      cross(meeting, tangle[i].side);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- one and two */

static celspan_status mix_one(cs_meeting *meeting, const cs_side *a) {
  cross(meeting, a);
  celspan_status status = add_part(meeting, a->area);
  cross_back(meeting, a);
  return status;
}

/* Whether one unit is left of another one at all heights of that. */
static inline bool is_beside(const cs_side *a, const cs_side *b) {
  return a->high <= b->low && a->y0 <= b->y0 && a->y1 >= b->y1;
}

/* The area that lies on both sides. */
static double area_of_both(const cs_meeting *meeting, const cs_side *a, const cs_side *b) {
  if (is_beside(a, b))
    return b->area;
  if (is_beside(b, a))
    return a->area;
  const slab shared = {a->y0 > b->y0 ? a->y0 : b->y0, a->y1 < b->y1 ? a->y1 : b->y1};
  if (shared.foot <= shared.top)
    return 0;
  cs_present pair[2] = {{a, area_in(meeting, a, &shared), 0}, {b, area_in(meeting, b, &shared), 0}};
  if (is_before(&pair[1], &pair[0])) {
    cs_present first = pair[1];
    pair[1] = pair[0];
    pair[0] = first;
  }
  return is_left(&pair[0], &pair[1], &shared) ? pair[1].right
                                              : area_right_of_set(meeting, pair, 3, &shared);
}

static celspan_status mix_two(cs_meeting *meeting, const cs_side *a, const cs_side *b) {
  double both = area_of_both(meeting, a, b);
  cross(meeting, a);
  celspan_status status = add_part(meeting, a->area - both);
  cross(meeting, b);
  if (status == CELSPAN_OK)
    status = add_part(meeting, both);
  cross_back(meeting, a);
  if (status == CELSPAN_OK)
    status = add_part(meeting, b->area - both);
  cross_back(meeting, b);
  return status;
}

/* ---------------------------------------------------------------- slabs */

/* Puts the sides of a slab in order; their number. */
static size_t order_slab(cs_meeting *meeting, const slab *in) {
  size_t count = 0;
  for (size_t i = 0; i < meeting->count; i++) {
    const cs_side *side = &meeting->sides[i];
    if (side->y0 > in->top || side->y1 < in->foot)
      continue;
    cs_present present = {side, area_in(meeting, side, in), 0};
    size_t k = count++;
    for (; k > 0 && is_before(&present, &meeting->present[k - 1]); k--)
      meeting->present[k] = meeting->present[k - 1];
    meeting->present[k] = present;
  }
  return count;
}

/* Whether a side crosses any of those from first to end - 1, which are left of it on the whole. */
static bool is_tangled(const cs_present *present, size_t first, size_t end, size_t side,
                       const slab *in) {
  for (size_t i = end; i-- > first;)
    if (!is_left(&present[i], &present[side], in))
      return true;
  return false;
}

/* Finds the tangles of a slab. A side that is right of all of a tangle is right of all before that
 * tangle, too; but one that joins a tangle may cross what is before it. */
static void find_tangles(cs_present *present, size_t count, const slab *in) {
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
static void find_cut(const cs_present *tangle, size_t count, const slab *in, double *cut) {
  double middle = 0.5 * (in->top + in->foot);
  for (size_t i = 1; i < count; i++) {
    double crossing = find_crossing(&tangle[i - 1], &tangle[i], in);
    if (crossing < in->foot && fabs(crossing - middle) < fabs(*cut - middle))
      *cut = crossing;
  }
}

/* Where a tangle of a slab is too large: the height of a crossing in it, at which its slab is cut;
 * the foot of the slab if there is none. */
static double find_large(const cs_present *present, size_t count, const slab *in) {
  double cut = in->foot;
  for (size_t end = count, first; end > 0; end = first) {
    first = present[end - 1].first;
    if (end - first > TANGLE)
      find_cut(present + first, end - first, in, &cut);
  }
  return cut;
}

/* Adds the parts between the sides of a slab, from left to right. Tangles that are too large are
 * taken as if nothing crossed in them. */
static celspan_status add_parts(cs_meeting *meeting, size_t count, const slab *in) {
  const cs_present *present = meeting->present;
  double rest = in->foot - in->top;
  celspan_status status = CELSPAN_OK;
  size_t first = 0;
  for (size_t end; status == CELSPAN_OK && first < count; first = end) {
    end = first + 1;
    while (end < count && present[end].first == first && end - first < TANGLE)
      end++;
    if (end < count && present[end].first == first)
      end = first + 1;
    status = add_tangle(meeting, present + first, (int)(end - first), in, &rest);
  }
  if (status == CELSPAN_OK)
    status = add_part(meeting, rest);
  while (first-- > 0)
    cross_back(meeting, present[first].side);
  return status;
}

static celspan_status mix_slab(cs_meeting *meeting, const slab *in, int cuts) {
  size_t count = order_slab(meeting, in);
  find_tangles(meeting->present, count, in);
  double cut = cuts > 0 ? find_large(meeting->present, count, in) : in->foot;
  if (cut == in->foot)
    return add_parts(meeting, count, in);
  const slab above = {in->top, cut}, below = {cut, in->foot};
  CS_TRY(mix_slab(meeting, &above, cuts - 1));
  return mix_slab(meeting, &below, cuts - 1);
}

static void put_height(cs_meeting *meeting, double y) {
  size_t k = meeting->height_count;
  while (k > 0 && meeting->heights[k - 1] > y)
    k--;
  if (k > 0 && meeting->heights[k - 1] == y)
    return;
  memmove(meeting->heights + k + 1, meeting->heights + k,
          (meeting->height_count - k) * sizeof *meeting->heights);
  meeting->heights[k] = y;
  meeting->height_count++;
}

static celspan_status find_heights(cs_meeting *meeting) {
  celspan_context *context = meeting->composer->context;
  CS_TRY(cs_mem_reserve(context, (void **)&meeting->heights, &meeting->height_capacity,
                        2 * meeting->count + 2, sizeof *meeting->heights));
  CS_TRY(cs_mem_reserve(context, (void **)&meeting->present, &meeting->present_capacity,
                        meeting->count, sizeof *meeting->present));
  meeting->heights[0] = 0;
  meeting->heights[1] = 1;
  meeting->height_count = 2;
  for (size_t i = 0; i < meeting->count; i++) {
    put_height(meeting, meeting->sides[i].y0);
    put_height(meeting, meeting->sides[i].y1);
  }
  return CELSPAN_OK;
}

static celspan_status mix_slabs(cs_meeting *meeting) {
  CS_TRY(find_heights(meeting));
  for (size_t i = 1; i < meeting->height_count; i++) {
    const slab whole = {meeting->heights[i - 1], meeting->heights[i]};
    CS_TRY(mix_slab(meeting, &whole, CUTS));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- pixels */

/* A layer covers what is behind it only where it is all over the pixel. */
static uint32_t find_cover(const cs_meeting *meeting, uint32_t cover, uint32_t head) {
  for (uint32_t k = head; k != 0; k = meeting->columns->nodes[k].next)
    if (meeting->units->units[meeting->columns->nodes[k].unit].layer == cover)
      return CS_STACK_NONE;
  for (size_t i = 0; i < meeting->event_count; i++)
    if (meeting->events[i].layer == cover)
      return CS_STACK_NONE;
  return cover;
}

static void put_unit(cs_meeting *meeting, const cs_unit *unit, double area) {
  meeting->sides[meeting->count++] = (cs_side){.points = cs_units_points(meeting->units, unit),
                                               .count = unit->count,
                                               .layer = unit->layer,
                                               .change = unit->direction,
                                               .y0 = unit->y0,
                                               .y1 = unit->y1,
                                               .low = unit->low,
                                               .high = unit->high,
                                               .area = area};
}

static void put_event(cs_meeting *meeting, const cs_event *event) {
  meeting->sides[meeting->count++] = (cs_side){.layer = event->layer,
                                               .change = event->change,
                                               .y0 = event->y,
                                               .y1 = 1,
                                               .low = -INFINITY,
                                               .high = -INFINITY,
                                               .area = 1 - event->y};
}

/* The units and events of the pixel that are not hidden. */
static celspan_status gather(cs_meeting *meeting, uint32_t head) {
  size_t most = meeting->event_count;
  for (uint32_t k = head; k != 0; k = meeting->columns->nodes[k].next)
    most++;
  CS_TRY(cs_mem_reserve(meeting->composer->context, (void **)&meeting->sides, &meeting->capacity,
                        most, sizeof *meeting->sides));
  meeting->count = 0;
  for (uint32_t k = head; k != 0; k = meeting->columns->nodes[k].next) {
    const cs_node *node = &meeting->columns->nodes[k];
    const cs_unit *unit = &meeting->units->units[node->unit];
    if (is_seen(unit->layer, meeting->cover))
      put_unit(meeting, unit, node->area);
  }
  for (size_t i = 0; i < meeting->event_count; i++)
    if (is_seen(meeting->events[i].layer, meeting->cover))
      put_event(meeting, &meeting->events[i]);
  return CELSPAN_OK;
}

static celspan_status mix(cs_meeting *meeting) {
  const cs_side *sides = meeting->sides;
  return meeting->count == 0   ? CELSPAN_OK
         : meeting->count == 1 ? mix_one(meeting, &sides[0])
         : meeting->count == 2 ? mix_two(meeting, &sides[0], &sides[1])
                               : mix_slabs(meeting);
}

celspan_status cs_meeting_colour(cs_meeting *meeting, int32_t column, const cs_cell *cell,
                                 uint32_t head, cs_v4 *colour) {
  meeting->column = column;
  meeting->hash = meeting->composer->hash;
  meeting->varies = false;
  meeting->sum = cs_v4_wide(cs_v4_all(0));
  meeting->cover = find_cover(meeting, cell->cover, head);
  CS_TRY(colour_of(meeting, cell, &meeting->base));
  CS_TRY(gather(meeting, head));
  CS_TRY(mix(meeting));
  *colour = cs_v4_bounded(cs_v4_narrow(cs_v4d_add(cs_v4_wide(meeting->base), meeting->sum)));
  return CELSPAN_OK;
}
