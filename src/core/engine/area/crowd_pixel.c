#include "engine/area/crowd_pixel.h"

void cs_crowd_pixel_finish(cs_crowd_pixel *pixel, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, &pixel->whole, layers, layers);
  CS_ARRAYS_FREE(memory, &pixel->solver, lines, numbers);
  CS_ARRAYS_FREE(memory, pixel, between, between);
}

/* Lane 3 is 0 behind any layer. */
static inline bool is_dark(cs_v4 through) {
  return !cs_v4_any_above(through, cs_v4_all(CS_CROWD_HIDDEN));
}

/* ---------------------------------------------------------------- whole layers */

void cs_crowd_pixel_forget(cs_crowd_pixel *pixel) {
  pixel->whole.count = 0;
  pixel->whole.is_all = false;
}

/* Learns one more layer. Returns whether there is one. */
static bool learn(cs_crowd_pixel *pixel) {
  cs_crowd_whole *w = &pixel->whole;
  const cs_composer *composer = pixel->composer;
  uint32_t end = w->count > 0 ? w->layers[w->count - 1] : (uint32_t)composer->stack->layer_count;
  uint32_t layer = cs_set_below(composer->set, composer->filled, end);
  w->is_all = layer == CS_STACK_NONE;
  if (!w->is_all && CS_ARRAY_APPEND(composer->context, w->layers, w->count, layer)) {
    pixel->failure = CELSPAN_NO_MEMORY;
    w->is_all = true;
  }
  return !w->is_all;
}

static inline bool knows(cs_crowd_pixel *pixel, size_t place) {
  cs_crowd_whole *w = &pixel->whole;
  return place < w->count || (!w->is_all && learn(pixel));
}

/* The place of a layer among those that are known. */
static size_t place_of(const cs_crowd_whole *w, uint32_t layer) {
  size_t low = 0, high = w->count;
  while (low < high) {
    size_t middle = (low + high) / 2;
    if (w->layers[middle] > layer)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

void cs_crowd_pixel_change(cs_crowd_pixel *pixel, uint32_t layer) {
  cs_crowd_whole *w = &pixel->whole;
  size_t place = place_of(w, layer);
  if (place == w->count && !w->is_all)
    return;
  if (place < w->count && w->layers[place] == layer) {
    for (size_t k = place + 1; k < w->count; k++)
      w->layers[k - 1] = w->layers[k];
    w->count--;
  } else if (CS_ARRAY_APPEND(pixel->composer->context, w->layers, w->count, layer)) {
    pixel->failure = CELSPAN_NO_MEMORY;
  } else {
    for (size_t k = w->count - 1; k > place; k--)
      w->layers[k] = w->layers[k - 1];
    w->layers[place] = layer;
  }
}

static inline void add_whole(cs_crowd_pixel *pixel, cs_over_pair pair) {
  pixel->light += pixel->through * pair.e;
  pixel->through *= pair.t;
  pixel->is_hidden = is_dark(pixel->through);
}

/* Continues to a layer, which is then passed by; below 0: through all that can be visible. */
static void walk_on(cs_crowd_pixel *pixel, int64_t layer) {
  const cs_crowd_whole *w = &pixel->whole;
  const cs_layer *layers = pixel->composer->stack->layers;
  cs_v4 light = pixel->light, through = pixel->through;
  size_t k = pixel->place;
  bool is_hidden = pixel->is_hidden;
  for (; !is_hidden && (k < w->count || knows(pixel, k)) && w->layers[k] > layer; k++) {
    const cs_layer *own = &layers[w->layers[k]];
    light += through * own->s;
    through *= own->t;
    is_hidden = is_dark(through);
  }
  pixel->place = k + (k < w->count && w->layers[k] == layer);
  pixel->light = light;
  pixel->through = through;
  pixel->is_hidden = is_hidden;
}

/* ---------------------------------------------------------------- partial layers */

celspan_status cs_crowd_pixel_begin(cs_crowd_pixel *pixel, size_t most) {
  celspan_context *context = pixel->composer->context;
  pixel->solver.line_count = pixel->solver.partial_count = 0;
  pixel->place = 0;
  pixel->light = cs_v4_all(0);
  pixel->through = cs_v4_all(1);
  pixel->is_hidden = false;
  CS_TRY(CS_ARRAY_RESERVE(context, pixel->solver.lines, 2 * most));
  CS_TRY(CS_ARRAY_RESERVE(context, pixel->between, most + 1));
  return CS_ARRAY_RESERVE(context, pixel->solver.partials, most);
}

/* The least and the greatest winding of a layer in the pixel. */
typedef struct windings {
  int32_t low, high;
} windings;

static inline void note(windings *w, int32_t winding) {
  w->low = winding < w->low ? winding : w->low;
  w->high = winding > w->high ? winding : w->high;
}

static inline bool overlap(const cs_crowd_line *a, const cs_crowd_line *b) {
  return a->ya < b->yb && b->ya < a->yb;
}

/* Notes the windings between two lines of a layer that overlap in height, by the one on the left.
 * Returns false where they cross, or touch so that neither is on the left. */
static bool note_between(const cs_crowd_line *a, const cs_crowd_line *b, const cs_crowd_line *sides,
                         size_t side_count, windings *w) {
  int32_t top = a->ya > b->ya ? a->ya : b->ya, foot = a->yb < b->yb ? a->yb : b->yb;
  cs_crowd_ends p = cs_crowd_ends_of(a, top, foot), q = cs_crowd_ends_of(b, top, foot);
  double above = p.top - q.top, below = p.foot - q.foot;
  if (above * below < 0 || above + below == 0)
    return false;
  const cs_crowd_line *left = above + below < 0 ? a : b;
  for (size_t i = 0; i < side_count; i++)
    if (sides[i].ya < foot && top < sides[i].yb) {
      note(w, sides[i].direction + left->direction);
      note(w, sides[i].direction + a->direction + b->direction);
    }
  return true;
}

/* The windings of a layer; false where they are not clear at once: its lines cross, or three of
 * them are at one height. */
static bool find_windings(const cs_crowd_line *lines, size_t count, size_t sides, windings *w) {
  *w = (windings){INT32_MAX, INT32_MIN};
  for (size_t i = 0; i < sides; i++)
    note(w, lines[i].direction);
  for (size_t k = sides; k < count; k++) {
    const cs_crowd_line *line = &lines[k], *other = NULL;
    for (size_t i = sides; i < count; i++)
      if (i != k && overlap(&lines[i], line)) {
        if (other)
          return false;
        other = &lines[i];
      }
    for (size_t i = 0; i < sides && !other; i++)
      if (overlap(&lines[i], line))
        note(w, lines[i].direction + line->direction);
    if (other > line && !note_between(line, other, lines, sides, w))
      return false;
  }
  return true;
}

/* Makes the lines of a plain layer sum to 0 outside and to 1 inside: `low` counts as 0, or, if it
 * is the inside, as 1. Returns the share of the pixel inside. */
static double make_plain(cs_crowd_line *lines, size_t *count, size_t sides, int32_t low,
                         bool is_turned) {
  size_t kept = 0;
  double twice = 0;
  for (size_t i = 0; i < *count; i++) {
    cs_crowd_line line = lines[i];
    line.direction -= i < sides ? low : 0;
    line.direction = is_turned ? (i < sides) - line.direction : line.direction;
    twice += (double)line.direction * cs_crowd_right_of_one(&line);
    lines[kept] = line;
    kept += line.direction != 0;
  }
  *count = kept;
  return twice * (1 / CS_CROWD_TWICE);
}

/* Adds a layer with lines, whose area is 1 or 0 where it is not partial. */
static double add_partial(cs_crowd_pixel *pixel, uint32_t layer, size_t first, size_t sides,
                          cs_crowd_partial *out) {
  windings w;
  int32_t mask = pixel->composer->presences[layer].rule.winding_mask;
  cs_crowd_line *lines = pixel->solver.lines + first;
  size_t count = pixel->solver.line_count - first;
  *out = (cs_crowd_partial){.first = first, .mask = mask};
  bool is_known = find_windings(lines, count, sides, &w);
  bool low = (w.low & mask) != 0, high = (w.high & mask) != 0;
  if (is_known && w.high - w.low <= 1) {
    if (low == high)
      return low;
    out->area = make_plain(lines, &count, sides, w.low, low);
    out->is_plain = true;
    pixel->solver.line_count = first + count;
    return out->area;
  }
  return 0.5;
}

int cs_crowd_pixel_add(cs_crowd_pixel *pixel, uint32_t layer, size_t first, size_t sides) {
  const cs_layer *own = &pixel->composer->stack->layers[layer];
  cs_crowd_partial *partial = &pixel->solver.partials[pixel->solver.partial_count];
  walk_on(pixel, layer);
  double area = pixel->is_hidden ? 0 : add_partial(pixel, layer, first, sides, partial);
  if (area <= 0 || area >= 1) {
    pixel->solver.line_count = first;
    if (area > 0)
      add_whole(pixel, (cs_over_pair){own->s, own->t});
    return area > 0;
  }
  partial->layer = own;
  partial->end = pixel->solver.line_count;
  partial->hides = cs_crowd_most(1 - own->t);
  partial->before = pixel->through;
  pixel->between[pixel->solver.partial_count++] = pixel->light;
  pixel->light = cs_v4_all(0);
  return -1;
}

celspan_status cs_crowd_pixel_colour(cs_crowd_pixel *pixel, cs_v4 *out) {
  cs_over over;
  size_t count = pixel->solver.partial_count;
  walk_on(pixel, -1);
  pixel->between[count] = pixel->light;
  if (count > 0)
    CS_TRY(cs_crowd_solver_solve(&pixel->solver, pixel->composer->context));
  cs_over_begin(&over, pixel->composer->stack, pixel->composer->outers);
  over.e = pixel->between[0];
  for (size_t i = 0; i < count; i++) {
    const cs_crowd_partial *p = &pixel->solver.partials[i];
    over.e += p->before * p->reached * p->layer->s + p->after * pixel->between[i + 1];
  }
  over.t = pixel->is_hidden ? cs_v4_all(0) : pixel->through;
  over.t *= count > 0 ? pixel->solver.partials[count - 1].after : cs_v4_all(1);
  *out = cs_v4_settled(cs_over_end(&over));
  return CELSPAN_OK;
}
