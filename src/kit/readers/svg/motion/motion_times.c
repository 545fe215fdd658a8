#include "readers/svg/motion/motion_times.h"

#include <math.h>

#include "inside/context.h"

/* How many steps for each animation are tried to find whether they ever end. */
#define TRIES 64
#define SCANS 16 /* moments that are looked at in one step */
/* How often an interval may change at one time: then it is part of a circle, and stays. */
#define CHANGES 100

typedef enum kind { END, BEGIN } kind; /* at the same time, ends come first */

typedef struct event {
  double time;
  kind kind;
  uint32_t animation;
  uint32_t serial; /* it counts only if it is the latest one of the animation */
} event;

/* An animation that waits for another one. Places in lists are counted from 1; 0: the last one. */
typedef struct link {
  uint32_t animation;         /* the one that waits */
  uint32_t next, next_source; /* of the same other one; of the same that waits */
  kind kind;                  /* the kind of the moment of the one that waits */
  bool after_end;
  double offset, time; /* time: by the interval now; INFINITY: there is none */
} link;

/* A moment that does not change any more: the interval that gave it is over. */
typedef struct kept {
  double time;
  uint32_t next;
} kept;

typedef struct state {
  uint32_t followers, sources; /* the first links: of those that wait for it, and of itself */
  uint32_t kept[2];            /* by kind */
  bool is_active, is_queued, had_end, was_empty;
  double begin, end; /* the begin and end of the interval that runs or comes next; INFINITY: none */
  double after;      /* the end of the interval before; -INFINITY: none */
  double period;     /* between its last two beginnings; 0: it began once */
  uint32_t serial;
  uint32_t changes, wave; /* changes: in this wave, the changes that one event leads to */
} state;

typedef struct running {
  celspan_context *context;
  const cs_svg_timing *timings;
  size_t count;
  cs_svg_interval *intervals;
  state *states;
  uint32_t *queue; /* a ring: whose intervals may have changed */
  size_t first, queued;
  link *links;
  size_t link_count, link_capacity;
  kept *kept;
  size_t kept_count, kept_capacity;
  uint32_t unused; /* of `kept` that can be used again */
  event *heap;     /* a heap: the earliest first */
  size_t waiting, capacity;
  uint32_t wave;             /* the number of events so far */
  double last_end;           /* of the intervals that ended */
  size_t steps, scans, most; /* of work so far; most: of steps */
} running;

static bool is_spent(const running *c) { return c->steps + c->scans / SCANS > c->most; }

/* ---------------------------------------------------------------- events */

static bool is_earlier(const event *a, const event *b) {
  if (a->time != b->time)
    return a->time < b->time;
  if (a->kind != b->kind)
    return a->kind < b->kind;
  return a->animation < b->animation;
}

static celspan_status push(running *c, event pushed) {
  c->steps++;
  if (isnan(pushed.time) || pushed.time == INFINITY)
    return CELSPAN_OK;
  CS_TRY(CS_RESERVE(c->context, c->heap, c->capacity, c->waiting + 1));
  size_t place = c->waiting++;
  for (; place > 0 && is_earlier(&pushed, &c->heap[(place - 1) / 2]); place = (place - 1) / 2)
    c->heap[place] = c->heap[(place - 1) / 2];
  c->heap[place] = pushed;
  return CELSPAN_OK;
}

static event pop(running *c) {
  const event top = c->heap[0], moved = c->heap[--c->waiting];
  size_t place = 0, below;
  while ((below = 2 * place + 1) < c->waiting) {
    below += below + 1 < c->waiting && is_earlier(&c->heap[below + 1], &c->heap[below]);
    if (!is_earlier(&c->heap[below], &moved))
      break;
    c->heap[place] = c->heap[below];
    place = below;
  }
  c->heap[place] = moved;
  return top;
}

/* ---------------------------------------------------------------- moments */

/* The earlier one of two, of which `time` must be at `from` or later; is_later: later. */
static double earlier(double best, double time, double from, bool is_later) {
  return time < best && (is_later ? time > from : time >= from) ? time : best;
}

/* The first of the written moments, which are sorted. */
static double first_written(const cs_svg_moment *list, size_t count, double from, bool is_later) {
  size_t low = 0, high = count;
  while (low < high) {
    size_t middle = (low + high) / 2;
    const cs_svg_moment *it = &list[middle];
    if (it->after < 0 && (is_later ? it->offset <= from : it->offset < from))
      low = middle + 1;
    else
      high = middle;
  }
  return low < count && list[low].after < 0 ? list[low].offset : INFINITY;
}

/* The first moment of an animation from `from` on; INFINITY: there is none. */
static double first_moment(running *c, uint32_t animation, kind which, double from, bool is_later) {
  const cs_svg_timing *timing = &c->timings[animation];
  const state *s = &c->states[animation];
  double best = which == BEGIN ? first_written(timing->begins, timing->begin_count, from, is_later)
                               : first_written(timing->ends, timing->end_count, from, is_later);
  for (uint32_t at = s->sources; at > 0; at = c->links[at - 1].next_source, c->scans++)
    if (c->links[at - 1].kind == which)
      best = earlier(best, c->links[at - 1].time, from, is_later);
  for (uint32_t at = s->kept[which]; at > 0; at = c->kept[at - 1].next, c->scans++)
    best = earlier(best, c->kept[at - 1].time, from, is_later);
  return best;
}

/* Whether any end is known, over or not. */
static bool has_end_moment(running *c, uint32_t animation) {
  const cs_svg_timing *timing = &c->timings[animation];
  bool found = c->states[animation].had_end || (timing->end_count > 0 && timing->ends[0].after < 0);
  for (uint32_t at = c->states[animation].sources; at > 0 && !found; c->scans++) {
    const link *it = &c->links[at - 1];
    found = it->kind == END && it->time < INFINITY;
    at = it->next_source;
  }
  return found;
}

/* Keeps the moment of a link whose interval is over. */
static celspan_status keep(running *c, const link *it) {
  state *s = &c->states[it->animation];
  s->had_end = s->had_end || it->kind == END;
  if (it->time < s->after)
    return CELSPAN_OK;
  uint32_t place = c->unused;
  if (place > 0)
    c->unused = c->kept[place - 1].next;
  else {
    CS_TRY(CS_APPEND(c->context, c->kept, c->kept_count, c->kept_capacity, (kept){0, 0}));
    place = (uint32_t)c->kept_count;
  }
  c->kept[place - 1] = (kept){it->time, s->kept[it->kind]};
  s->kept[it->kind] = place;
  return CELSPAN_OK;
}

/* Forgets kept moments before the end of the last interval. */
static void forget(running *c, state *s, kind which) {
  for (uint32_t *at = &s->kept[which]; *at > 0; c->scans++) {
    kept *it = &c->kept[*at - 1];
    uint32_t place = *at;
    if (it->time >= s->after) {
      at = &it->next;
      continue;
    }
    *at = it->next;
    it->next = c->unused;
    c->unused = place;
  }
}

/* ---------------------------------------------------------------- intervals */

/* The end of an interval that begins at `begin`. False: all ends are over, there is no interval.
 * Source: SMIL 3.0, 5.4.5, with the end at which the animation begins again. */
static bool find_end(running *c, uint32_t animation, double begin, double *out) {
  const cs_svg_timing *timing = &c->timings[animation];
  const state *s = &c->states[animation];
  bool is_used = s->was_empty && begin == s->after;
  double given = first_moment(c, animation, END, begin, is_used);
  double end = fmin(begin + timing->whole, given);
  end = fmin(fmax(end, begin + timing->least), begin + timing->most);
  if (timing->restart == CS_SVG_RESTART_ALWAYS)
    end = fmin(end, first_moment(c, animation, BEGIN, begin, true));
  *out = end;
  return given < INFINITY || timing->end_is_open || !has_end_moment(c, animation);
}

/* The interval after the last one. Source: SMIL 3.0, 5.4.3: one that is over at 0 does not
 * count. */
static bool find_next(running *c, uint32_t animation, double *begin, double *end) {
  double from = c->states[animation].after;
  if (from > -INFINITY && c->timings[animation].restart == CS_SVG_RESTART_NEVER)
    return false;
  for (bool is_later = false; !is_spent(c); c->steps++) {
    *begin = first_moment(c, animation, BEGIN, from, is_later);
    if (*begin == INFINITY || !find_end(c, animation, *begin, end))
      return false;
    if (*end > 0 || (*begin == 0 && *end == 0))
      return true;
    is_later = *end <= *begin;
    from = *end;
  }
  return false;
}

static void enqueue(running *c, uint32_t animation) {
  if (c->states[animation].is_queued)
    return;
  c->states[animation].is_queued = true;
  c->queue[(c->first + c->queued++) % c->count] = animation;
}

/* Sets the moments of the animations that wait for this one. */
static void inform(running *c, uint32_t animation) {
  const state *s = &c->states[animation];
  for (uint32_t at = s->followers; at > 0; at = c->links[at - 1].next) {
    link *it = &c->links[at - 1];
    double time = (it->after_end ? s->end : s->begin) + it->offset;
    c->steps++;
    if (time == it->time)
      continue;
    it->time = time;
    enqueue(c, it->animation);
  }
}

static bool may_change(const running *c, state *s) {
  s->changes = s->wave == c->wave ? s->changes + 1 : 1;
  s->wave = c->wave;
  return s->changes <= CHANGES;
}

/* Finds the interval that runs or comes next, which others may have changed. */
static celspan_status resolve(running *c, uint32_t animation) {
  state *s = &c->states[animation];
  double begin = s->begin, end;
  c->steps++;
  if (s->is_active)
    (void)find_end(c, animation, begin, &end);
  else if (!find_next(c, animation, &begin, &end))
    begin = end = INFINITY;
  if ((begin == s->begin && end == s->end) || !may_change(c, s))
    return CELSPAN_OK;
  s->begin = begin;
  s->end = end;
  if (s->is_active)
    c->intervals[animation].end = end;
  inform(c, animation);
  return push(
      c, (event){s->is_active ? end : begin, s->is_active ? END : BEGIN, animation, ++s->serial});
}

static celspan_status settle(running *c) {
  c->wave++;
  while (c->queued > 0 && !is_spent(c)) {
    uint32_t animation = c->queue[c->first];
    c->first = (c->first + 1) % c->count;
    c->queued--;
    c->states[animation].is_queued = false;
    CS_TRY(resolve(c, animation));
  }
  return CELSPAN_OK;
}

static celspan_status begin(running *c, uint32_t animation) {
  state *s = &c->states[animation];
  cs_svg_interval *interval = &c->intervals[animation];
  s->period = interval->has_begun ? s->begin - interval->begin : 0;
  s->is_active = true;
  *interval = (cs_svg_interval){true, true, s->begin, s->end};
  return push(c, (event){s->end, END, animation, ++s->serial});
}

static celspan_status finish(running *c, uint32_t animation) {
  state *s = &c->states[animation];
  for (uint32_t at = s->followers; at > 0; at = c->links[at - 1].next) {
    link *it = &c->links[at - 1];
    c->steps++;
    CS_TRY(keep(c, it));
    it->time = INFINITY;
  }
  c->intervals[animation].is_active = s->is_active = false;
  c->last_end = fmax(c->last_end, s->end);
  s->after = s->end;
  s->was_empty = s->begin == s->end;
  s->begin = s->end = INFINITY;
  forget(c, s, BEGIN);
  forget(c, s, END);
  enqueue(c, animation);
  return CELSPAN_OK;
}

static celspan_status handle(running *c, event it) {
  if (it.serial != c->states[it.animation].serial)
    return CELSPAN_OK;
  CS_TRY(it.kind == BEGIN ? begin(c, it.animation) : finish(c, it.animation));
  return settle(c);
}

/* ---------------------------------------------------------------- the clock */

static celspan_status add_links(running *c, uint32_t animation, const cs_svg_moment *moments,
                                size_t count, kind which) {
  state *s = &c->states[animation];
  for (size_t i = 0; i < count; i++) {
    const cs_svg_moment *it = &moments[i];
    if (it->after < 0)
      continue;
    state *other = &c->states[it->after];
    CS_TRY(CS_APPEND(c->context, c->links, c->link_count, c->link_capacity,
                     (link){.animation = animation,
                            .next = other->followers,
                            .next_source = s->sources,
                            .kind = which,
                            .after_end = it->after_end,
                            .offset = it->offset,
                            .time = INFINITY}));
    other->followers = s->sources = (uint32_t)c->link_count;
  }
  return CELSPAN_OK;
}

/* *moments: how many are written. */
static celspan_status start(running *c, size_t *moments) {
  CS_TRY(CS_MAKE(c->context, c->states, c->count));
  CS_TRY(CS_MAKE(c->context, c->queue, c->count));
  *moments = 0;
  for (size_t i = 0; i < c->count; i++) {
    c->intervals[i] = (cs_svg_interval){false, false, 0, 0};
    c->states[i].after = -INFINITY;
    c->states[i].begin = c->states[i].end = INFINITY;
    enqueue(c, (uint32_t)i);
  }
  for (size_t i = 0; i < c->count; i++) {
    const cs_svg_timing *timing = &c->timings[i];
    *moments += timing->begin_count + timing->end_count;
    CS_TRY(add_links(c, (uint32_t)i, timing->begins, timing->begin_count, BEGIN));
    CS_TRY(add_links(c, (uint32_t)i, timing->ends, timing->end_count, END));
  }
  return CELSPAN_OK;
}

/* *is_whole: false if it takes more than `most` steps, and `tries` for each animation and
 * moment. */
static celspan_status run(running *c, double seconds, size_t most, size_t tries, bool *is_whole) {
  size_t moments;
  CS_TRY(start(c, &moments));
  c->most = most + tries * (c->count + moments);
  CS_TRY(settle(c));
  while (c->waiting > 0 && c->heap[0].time <= seconds && !is_spent(c))
    CS_TRY(handle(c, pop(c)));
  *is_whole = !is_spent(c);
  return CELSPAN_OK;
}

static void stop(running *c) {
  cs_memory *memory = c->context->memory;
  cs_mem_free(memory, c->states, c->count * sizeof *c->states);
  cs_mem_free(memory, c->queue, c->count * sizeof *c->queue);
  cs_mem_free(memory, c->links, c->link_capacity * sizeof *c->links);
  cs_mem_free(memory, c->kept, c->kept_capacity * sizeof *c->kept);
  cs_mem_free(memory, c->heap, c->capacity * sizeof *c->heap);
}

celspan_status cs_svg_times_run(celspan_context *context, const cs_svg_timing *timings,
                                size_t count, double seconds, cs_svg_interval *out) {
  running c = {.context = context, .timings = timings, .count = count, .intervals = out};
  bool is_whole = true;
  celspan_status status = run(&c, seconds, CS_SVG_MOTION_STEPS, 1, &is_whole);
  stop(&c);
  if (status == CELSPAN_OK && !is_whole)
    return cs_fail(
        context, CELSPAN_LIMIT,
        "the animations begin and end too often until %g s: they take more than %d steps", seconds,
        CS_SVG_MOTION_STEPS);
  return status;
}

/* ---------------------------------------------------------------- the extent */

/* One that has no end: it repeats, or it stays as it is from its beginning on. */
static void add_endless(const cs_svg_timing *timing, const cs_svg_interval *interval,
                        cs_svg_extent *out) {
  if (timing->simple < INFINITY)
    out->period = fmax(out->period, timing->simple);
  else
    out->end = fmax(out->end, interval->begin);
}

celspan_status cs_svg_times_measure(celspan_context *context, const cs_svg_timing *timings,
                                    size_t count, cs_svg_extent *out) {
  running c = {.context = context, .timings = timings, .count = count};
  bool is_whole = true;
  celspan_status status = CS_MAKE(context, c.intervals, count);
  if (status == CELSPAN_OK)
    status = run(&c, INFINITY, TRIES, TRIES, &is_whole);
  for (size_t i = 0; i < count && status == CELSPAN_OK; i++) {
    const cs_svg_interval *it = &c.intervals[i];
    if (it->is_active && it->end == INFINITY)
      add_endless(&timings[i], it, out);
    if (!is_whole)
      out->period = fmax(out->period, c.states[i].period);
  }
  if (status == CELSPAN_OK && is_whole)
    out->end = fmax(out->end, c.last_end);
  cs_mem_free(context->memory, c.intervals, count * sizeof *c.intervals);
  stop(&c);
  return status;
}
